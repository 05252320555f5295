// SPDX-License-Identifier: BSD-3-Clause
// What the check of one program came to, as a night needs it.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "sim/base/input_log.h"

namespace ncsim::nightly {

struct ReportFinding {
  std::string rule, severity, file, message;
  int line = 0;
  std::vector<std::string> bodies;
  std::string source;  ///< The text of the line; "" where there is none.
};

struct ReportClearance {
  std::vector<std::string> bodies;
  std::optional<double> proven, seen;  ///< mm; none where it is not known.
  std::string file;
  int line = 0;
};

/// What is used of docs/json.md.
struct Report {
  std::string program, verdict, model;
  std::uint64_t blocks = 0;
  double time = 0.0;  ///< s
  std::vector<ReportFinding> findings;
  std::vector<ReportClearance> clearances;
  std::vector<std::string> not_checked;
};

struct Result {
  std::string name;              ///< Entry::name.
  std::optional<Report> report;  ///< None: `trouble` says why.
  std::string trouble;
  bool bad_input = false;  ///< The trouble is the program's or its job's, not ncsim's.
  std::string key;         ///< Of what was to be done, and by which build.
  std::vector<Input> inputs;

  /// It would come out the same if it were done again now (in the folder where it was done).
  bool StillHolds(const std::string& wanted_key, const std::string& root) const;
};

/// The file name of the page that shows this result: another result of the program has another, so
/// a page that is there is the right one.
std::string PageName(const Result& result);

/// Reads what `ncsim check --format json` has written about one program. nullopt for anything else.
std::optional<Report> ReadReport(std::string_view json);

/// `ncsim check --inputs`.
std::string WriteInputs(const std::vector<Input>& inputs);
std::optional<std::vector<Input>> ReadInputs(std::string_view json);

std::string WriteResult(const Result& result);
std::optional<Result> ReadResult(std::string_view json);

/// What a shard leaves behind.
struct ShardFile {
  std::string plan;  ///< Digest of the whole list.
  int index = 0, count = 1;
  std::vector<Result> results;
};
std::string WriteShard(const ShardFile& shard);
std::optional<ShardFile> ReadShard(std::string_view json);

}  // namespace ncsim::nightly
