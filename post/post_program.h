// SPDX-License-Identifier: BSD-3-Clause
// A cutter-location file to the texts of an NC program: reader, planner and writer in a row.
#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "post/cl_path.h"
#include "post/line_map.h"
#include "post/planner.h"
#include "post/writer.h"

namespace ncsim::post {

/// What is known of a cutter-location file before it is posted: one pass over it.
struct ClSummary {
  std::vector<ToolUse> tools;  ///< In the order of their first motion.
  int operations = 0;
  std::size_t motions = 0;  ///< And holes.
  ClUnit unit = ClUnit::kMillimetre;
};

/// Reads the file to its end; all that is wrong with it goes to `diagnostics`.
ClSummary ReadCl(const std::shared_ptr<const nc::Program>& cl, const ClOptions& options,
                 Diagnostics* diagnostics);

struct PostedFile {
  std::string name;  ///< Of an operation's file, with its extension; "" for the program itself.
  std::string text;
  LineMap lines{};  ///< Of a retract, a turn, a tool change: what they stand before.
};

/// What an operation has become. Where it begins the machine still stands as the one before has
/// left it; its tool has been changed.
struct PostedOperation {
  int operation = 0;     ///< ClOperation::index.
  SourcePosition where;  ///< In the cutter-location file.
  std::size_t file = 0;  ///< Of PostedProgram::files.
  int line = 1;          ///< From 1.
  std::size_t ways = 1;  ///< As PlanChoice.
  std::size_t taken = 0;
  PlanMode mode = PlanMode::kIndexed;
};

struct PostedProgram {
  std::vector<PostedFile> files;  ///< The program itself first.
  std::vector<PostedOperation> operations;
  std::size_t moves = 0;
};

/// What does not change between the candidates for one file.
struct PostJob {
  std::shared_ptr<const nc::Program> cl;
  ClOptions cl_options;
  const PostData* post = nullptr;
  const PartGeometry* geometry = nullptr;
  ProgramInfo info;                 ///< `source` is `cl`'s name.
  bool file_for_operation = false;  ///< Each operation is a file that the program calls.
};

/// Plans and writes. What cannot be posted goes to `diagnostics`, with its line in the
/// cutter-location file; the texts are good for nothing then.
PostedProgram PostProgram(const PostJob& job, const PlanOptions& options, Diagnostics* diagnostics);

}  // namespace ncsim::post
