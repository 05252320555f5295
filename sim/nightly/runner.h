// SPDX-License-Identifier: BSD-3-Clause
// Checks the programs of a list, each in a process of its own.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "sim/nightly/manifest.h"
#include "sim/nightly/result.h"

namespace ncsim::nightly {

struct RunOptions {
  std::string executable;  ///< That does `check`; an absolute path.
  std::string build;       ///< Names the executable's contents, and where it and the root lie.
  std::string root;        ///< Manifest::root.
  std::string scratch;     ///< An absolute path of a folder that is there, empty again afterwards.
  int jobs = 1;            ///< Checks at a time.
  int threads = 0;         ///< Of each check; 0: as it likes.
  std::string pages;       ///< Folder for a page of each result (PageName); "" for none.
};

/// Digest of what names a check of `entry`: its words and the build.
std::string KeyOf(const Entry& entry, const std::string& build);

/// Called by one thread at a time, as soon as something is known. `checked`: a process was run.
using Progress = std::function<void(const Result& result, bool checked)>;

/// In the order of `entries`. What `known` still holds, and has its page, is taken as it is. A
/// check that crashes, hangs or prints rubbish is a result that says so, and nothing to the others.
std::vector<Result> RunChecks(const std::vector<Entry>& entries, const RunOptions& options,
                              const std::function<std::optional<Result>(const Entry&)>& known,
                              const Progress& progress);

/// Writes `text` under another name and renames it: the file is whole or not there.
bool WriteWhole(const std::string& path, const std::string& text);

}  // namespace ncsim::nightly
