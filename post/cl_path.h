// SPDX-License-Identifier: BSD-3-Clause
// The state machine of a cutter-location file: records -> events with everything modal resolved.
// A stream: its memory does not grow with the file.
#pragma once

#include <memory>
#include <optional>

#include "post/cl_event.h"
#include "post/cl_flavour.h"
#include "post/cl_reader.h"

namespace ncsim::post {

struct ClOptions {
  std::optional<ClFlavour> flavour;  ///< None: from the file.
  std::optional<ClUnit> unit;        ///< Of lengths and points, where the file names none.
  /// Of the tool that the file begins with, where it loads none before its first motion.
  std::optional<int> first_tool;
  bool need_tool = true;  ///< A motion without a tool is an error.
};

class ClPath {
 public:
  /// Errors and warnings go to `diagnostics`, which must outlive this. `file` is the index of the
  /// program's name for SourcePosition.
  ClPath(const std::shared_ptr<const nc::Program>& program, int file, const ClOptions& options,
         Diagnostics* diagnostics);
  ~ClPath();

  /// The next event; false after ClEnd, and after a hundred errors. Once `diagnostics` has errors
  /// the events that follow are good for finding more errors, and for nothing else.
  bool Next(ClEvent* event);

  ClFlavour flavour() const;
  ClUnit unit() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace ncsim::post
