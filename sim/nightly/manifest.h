// SPDX-License-Identifier: BSD-3-Clause
// What is to be checked: programs found in a folder, or listed in a file.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "sim/base/diagnostics.h"

namespace ncsim::nightly {

/// A program with what it is checked with: a row of the table.
struct Entry {
  std::string name;     ///< Unique; the program's path unless the manifest names it.
  std::string program;  ///< As all paths here: relative to Manifest::root, or absolute.
  std::string job;      ///< "" for the program's own, if it exists.
  std::string model;    ///< "" where the job says.
  std::vector<std::string> assume;
  bool strict = false;
  std::optional<double> clearance;  ///< mm
  double cost = 0.0;                ///< To share work out by: as stated, else bytes.
  double timeout = 0.0;             ///< s

  /// Of `ncsim check`, without what names files to write.
  std::vector<std::string> Words() const;
};

struct Manifest {
  std::string root;  ///< Where the checks run.
  std::vector<Entry> entries;
  std::vector<std::string> notes;  ///< What lies there and is not checked, in words.
};

/// What holds for an entry that says nothing itself.
struct EntryDefaults {
  std::string model;
  std::vector<std::string> assume;
  bool strict = false;
  double timeout = 3600.0;  ///< s
};

/// Every NC program below `folder` that has a job beside it; with a default model, the others too.
/// In order of names. nullopt and diagnostics where there is none, or a folder cannot be read.
std::optional<Manifest> FindPrograms(const std::string& folder, const EntryDefaults& defaults,
                                     Diagnostics* diagnostics);

/// docs/nightly.md. nullopt and diagnostics where something is wrong.
std::optional<Manifest> ReadManifest(const std::string& path, const EntryDefaults& defaults,
                                     Diagnostics* diagnostics);

/// The entries of shard `index` (from 0) of `count`, in order of names: the costliest first, each
/// to the shard that has least to do so far. A pure function of the entries.
std::vector<Entry> Shard(const std::vector<Entry>& entries, int index, int count);

}  // namespace ncsim::nightly
