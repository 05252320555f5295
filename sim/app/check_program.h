// SPDX-License-Identifier: BSD-3-Clause
// One program, from text to verdict.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "sim/app/options.h"
#include "sim/app/progress.h"
#include "sim/base/finding.h"
#include "sim/nc/program.h"
#include "sim/report/result.h"

namespace ncsim::collision {
class OutcomeCache;
}

namespace ncsim::app {

struct PostedLines;

struct ProgramOutcome {
  int exit_code = 0;
  std::string report;    ///< Text or JSON; "" where there is none, and in formats of all programs.
  std::string summary;   ///< "part.nc: pass, ..."; "" where there is no report.
  std::string messages;  ///< Trouble with the inputs, for standard error.
  /// As in collision::CollisionResult.
  std::uint64_t outcomes = 0, recalled = 0;
  std::optional<report::CheckResult> result;  ///< None where there is no report.
  SourceFiles files;                          ///< That its findings are in.
};

/// Checks one program. `progress`, if not empty, is told how far it is. `cache` may be null.
/// `text`: the program, where it is in no file yet; null: it is read from the file `program`.
/// `posted`: where it comes from; null: that is looked up beside it.
ProgramOutcome CheckProgram(const CheckOptions& options, const std::string& program,
                            const ProgressReport& progress, const collision::OutcomeCache* cache,
                            std::shared_ptr<const nc::Program> text = nullptr,
                            const PostedLines* posted = nullptr);

}  // namespace ncsim::app
