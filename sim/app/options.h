// SPDX-License-Identifier: BSD-3-Clause
// The command line, read. CLI11 stays behind this header.
#pragma once

#include <map>
#include <optional>
#include <ostream>
#include <string>
#include <vector>

#include "post/cl_flavour.h"

namespace ncsim::app {

enum class Format { kText, kJson, kSarif, kJunit, kGithub };

/// How a cutter-location file is to be read where it does not say.
struct ClInput {
  std::optional<post::ClUnit> unit;
  std::optional<post::ClFlavour> flavour;
};

struct CheckOptions {
  std::vector<std::string> programs;
  std::string model;                ///< "" where the job says.
  std::string job;                  ///< "" for the program's own, if it exists.
  std::vector<std::string> assume;  ///< Names, or "all".
  bool strict = false;
  std::optional<double> clearance;  ///< mm; overrides the job's.
  int jobs = 0;                     ///< Threads; 0: as many as there are processors.
  Format format = Format::kText;
  std::string out;     ///< Report file; "" for standard output.
  std::string trace;   ///< "" for none.
  std::string gltf;    ///< "" for none.
  std::string report;  ///< HTML; "" for none.
  std::string cache;   ///< Folder; "" for none.
  bool interpret_only = false;
  std::string inputs;  ///< Where to write what was looked at, for `nightly`; "" for nowhere.
};

struct CompareOptions {
  std::string reference, tested;    ///< A and B.
  std::string model, model_b;       ///< "" where the job says; model_b: as model.
  std::string job, job_b;           ///< "" for the program's own, if it exists; job_b: as job.
  std::optional<double> tolerance;  ///< mm
  std::optional<double> angle_tolerance;  ///< deg
  std::vector<std::string> assume;        ///< Names, or "all".
  bool strict = false;
  Format format = Format::kText;
  std::string out;  ///< Report file; "" for standard output.
  ClInput cl;
};

struct PostCommandOptions {
  std::string cl_file;
  std::string model;  ///< "" where the job says.
  std::string post;   ///< "" for MODEL.post.toml beside the model.
  std::string mode;   ///< "" for what each operation needs.
  std::string job;    ///< "" for the program's own or the file's, if one exists.
  std::string out;    ///< The program; "" for standard output.
  std::map<std::string, std::string> constants;
  std::optional<int> number;         ///< O number; none: of `out`'s name, else 1.
  std::optional<post::ClUnit> unit;  ///< Of the program; none: as the post says.
  std::optional<double> tolerance;   ///< mm
  std::optional<int> first_tool;     ///< In the spindle where the file loads none.
  ClInput cl;
  bool file_for_operation = false;
  bool map = false;  ///< A map of its lines beside each program.
  bool check = true;
  std::vector<std::string> assume;  ///< As CheckOptions.
  bool strict = false;
};

struct NightlyOptions {
  std::string what;   ///< A folder, or a manifest.
  std::string out;    ///< Folder.
  std::string model;  ///< As the others here: of programs that say nothing themselves.
  std::vector<std::string> assume;
  bool strict = false;
  double timeout = 3600.0;         ///< s
  std::string baseline;            ///< "" for none.
  std::string today;               ///< "2026-11-22"; "" for what the clock says.
  int jobs = 1;                    ///< Checks at a time.
  bool all = false;                ///< Also what has not changed.
  int shard = 0, shard_count = 0;  ///< Count 0: not a shard.
  bool merge = false;
  bool reports = false;    ///< A page of each program.
  std::string executable;  ///< That checks; "" for this program.
};

struct Command {
  enum class Kind { kCheck, kPost, kCompare, kNightly, kInspect, kExplain, kDone };
  Kind kind = Kind::kDone;
  int exit_code = 0;  ///< kDone: help or a usage error has been written.
  CheckOptions check;
  CompareOptions compare;
  PostCommandOptions post;
  NightlyOptions nightly;
  std::string model;  ///< kInspect.
  std::string rule;   ///< kExplain; "" for all.
};

/// Reads `args` (without the program's name). Help and version go to `out`, usage errors to `err`.
Command ParseCommandLine(std::vector<std::string> args, std::ostream& out, std::ostream& err);

}  // namespace ncsim::app
