// SPDX-License-Identifier: BSD-3-Clause
// A bare BC table-table machine and motions on it, made by hand: no model, no control.
#pragma once

#include <vector>

#include "sim/checks/check.h"

namespace ncsim::checks {

/// Joints X Y Z B C, in this order, on an X-Y-Z head over a B-C table; the two rotary axes meet in
/// (-381, -254, -500) and the table frame lies there. Limits X -762..0, Y -508..0, Z -444.5..63.5
/// mm, B -35..120 deg, C 37 turns either way; rates 381.6 mm/s and 50 deg/s.
machine::Machine TestMachine();

/// Joint positions from mm and degrees.
motion::JointVector Axes(double x, double y, double z, double b_deg, double c_deg);

/// A feed at 10 mm/s with spindle on, proportional in all axes; 1 s long.
motion::Motion Feed(int line, const motion::JointVector& q0, const motion::JointVector& q1);
/// The same as a rapid in which every axis takes `duration` (s) alone; no ramp.
motion::Motion Rapid(int line, const motion::JointVector& q0, const motion::JointVector& q1,
                     const motion::JointVector& duration);
/// A feed under TCP: the tip goes straight from `p0_B` to `p1_B` while B and C turn.
motion::Motion TcpFeed(const machine::Machine& machine, int line, const Eigen::Vector3d& p0_B,
                       const Eigen::Vector3d& p1_B, double b0_deg, double c0_deg, double b1_deg,
                       double c1_deg);

/// The same with the tool axis on the great circle, which must lead to c1_deg.
motion::Motion VectorFeed(const machine::Machine& machine, int line, const Eigen::Vector3d& p0_B,
                          const Eigen::Vector3d& p1_B, double b0_deg, double c0_deg, double b1_deg,
                          double c1_deg);

/// What a check says to motions, from the first to Finish.
std::vector<Finding> RunCheck(std::unique_ptr<Check> check,
                              const std::vector<motion::Motion>& motions);

}  // namespace ncsim::checks
