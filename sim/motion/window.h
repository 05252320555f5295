// SPDX-License-Identifier: BSD-3-Clause
// Motions travel in immutable windows, so that memory does not grow with the program.
#pragma once

#include <cstddef>
#include <vector>

#include "sim/motion/motion.h"

namespace ncsim::motion {

/// Motions of the longest window.
inline constexpr std::size_t kWindowSize = 4096;

struct Window {
  std::vector<Motion> motions;
};

/// Cuts a stream of motions into windows: at tool changes; and, so that windows are the same ones
/// again soon behind an edit of the program, where the motions say so. From kShortest motions on, a
/// window ends at the first place that is marked: one joint position in about a thousand is, by its
/// digits alone. Where there is none it ends at kWindowSize.
class WindowCutter {
 public:
  static constexpr std::size_t kShortest = 2048;

  WindowCutter();
  /// The window that is full and does not hold `motion`, which is the first one of the next; or an
  /// empty one.
  Window Add(const Motion& motion);
  /// What is left.
  Window Take();

 private:
  bool EndsBefore(const Motion& motion) const;

  Window window_;
};

}  // namespace ncsim::motion
