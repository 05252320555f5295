// SPDX-License-Identifier: BSD-3-Clause
// The contour stage: what must wait for the next moves. Corner rounding and chamfers (,R ,C) and cutter compensation
// (G40-G42, Haas manual 96-8210: type A and B entry, settings 43, 44, 58). Commands in, commands out, in program coordinates.
#pragma once

#include <functional>
#include <memory>

#include "sim/control/command.h"

namespace ncsim::control {

struct ContourOptions {
  bool type_b = false;       ///< Setting 43.
  bool fanuc_corners = true; ///< Setting 58: FANUC (true) or YASNAC.
};

class Contour {
 public:
  using Out = std::function<void(const Command&)>;
  using Report = std::function<void(Finding)>;
  Contour(ContourOptions options, Out out, Report report);
  ~Contour();

  /// `start` is the program position before the first command; later ones are chained.
  void SetPosition(const AxisValues& start);
  /// Passes `command` on at once when nothing waits and no compensation is active.
  void Push(const Command& command);
  /// Sends on all that waits (program end, macro read of a position, tool change, frame change).
  void Flush();

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace ncsim::control
