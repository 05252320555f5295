// SPDX-License-Identifier: BSD-3-Clause
// Which of the ways that the post ranks passes check.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "post/post_program.h"
#include "sim/app/check_program.h"

namespace ncsim::app {

/// A candidate and what check says of it.
struct Judged {
  post::PostedProgram program;
  ProgramOutcome outcome;
};

/// Makes and checks the candidate with these ways (PlanOptions::choice); nullopt where it cannot be
/// posted.
using JudgeWays = std::function<std::optional<Judged>(const std::map<int, std::size_t>& choice)>;

/// Takes the next way of the first operation in which check finds a crash or an axis at its limit
/// that another way may avoid, until there is none, or until all ways of such operations have been
/// tried: an operation that fails with all of them gets its best one back. `notes`: a line for each
/// way that was given up. At most `limit` candidates are judged.
std::optional<Judged> FindPassing(const JudgeWays& judge, int limit,
                                  std::vector<std::string>* notes);

}  // namespace ncsim::app
