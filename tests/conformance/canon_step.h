// SPDX-License-Identifier: BSD-3-Clause
// What two interpreters are compared by: one motion or dwell, in machine coordinates of a plain X Y
// Z A B C machine.
#pragma once

#include <Eigen/Core>
#include <array>
#include <string>
#include <vector>

namespace ncsim::conformance {

enum class StepKind { kRapid, kFeed, kArc, kDwell, kToolChange };

struct Step {
  StepKind kind = StepKind::kRapid;
  std::array<double, 6> end{};  ///< X Y Z mm, A B C deg.
  Eigen::Vector3d centre =
      Eigen::Vector3d::Zero();  ///< Arcs, mm; its coordinate along `normal` is not compared.
  int normal = 2;               ///< Arcs: the axis that the plane's normal is.
  double sweep_deg =
      0.0;  ///< Arcs: counter-clockwise about +normal positive; more than 360 for several turns.
  double dwell = 0.0;  ///< s.
  double feed =
      -1.0;  ///< mm/s; -1 where it is not comparable (rapids, rotary or inverse-time moves).
  bool spindle = false;     ///< Turning.
  int tool = -1;            ///< In the spindle; -1: not known.
  double tolerance = 1e-4;  ///< mm: what the last printed digit is worth.
  bool loose =
      false;     ///< Its end in X and Y is the business of the control: see Comparison::loose.
  int line = 0;  ///< Of the source, 0 if not known.
};

/// "feed X1 Y2 Z3", for people.
std::string ToText(const Step& step);

struct Comparison {
  bool agree = false;
  int steps = 0;   ///< Steps of the reference.
  int agreed = 0;  ///< Before the first difference.
  int loose = 0;   ///< Ends that differ where the reference turns cutter compensation on or off.
  int line = 0;    ///< Our source line of the first difference.
  std::string difference;  ///< In words.
};

/// Compares in order. Steps that move nothing are left out on both sides. After a tool change the
/// two machines may stand at different places (one of them moves there): an axis is compared again
/// once either has moved it.
Comparison Compare(const std::vector<Step>& ours, const std::vector<Step>& reference);

}  // namespace ncsim::conformance
