// SPDX-License-Identifier: BSD-3-Clause
// Nights in a folder of their own: the program itself checks, behind a script that does what the
// name of a program says.
#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <string>

#include "sim/app/nightly_command.h"

namespace ncsim {

std::string ReadText(const std::filesystem::path& path);
/// Makes the folder too.
void WriteText(const std::filesystem::path& path, const std::string& text);

struct NightOutcome {
  int code = 0, checked = -1;  ///< checked: how many programs; -1 where it is not said.
  std::string out, err;
};

class NightRig : public ::testing::Test {
 protected:
  /// An empty folder `root_`, and `root_`/checker: crashes, hangs, writes half a report for
  /// broken/crash*, broken/hang*, broken/half*; else it is ncsim.
  NightRig();
  ~NightRig() override;

  /// A program in parts/broken with a job.
  void AddBroken(const std::string& name) const;
  /// A night as `options_` say, with `root_`/`out` as its folder.
  NightOutcome Run(const std::string& out);
  /// The rows of nightly.json by name.
  std::map<std::string, nlohmann::json> Rows(const std::string& out) const;
  /// Checks all shards, and leaves `options_` so that the next run merges them.
  void RunShards(const std::string& out, int shards);

  std::filesystem::path root_;
  app::NightlyOptions options_;
};

}  // namespace ncsim
