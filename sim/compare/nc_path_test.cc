// SPDX-License-Identifier: BSD-3-Clause
#include "sim/compare/nc_path.h"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>

#include "sim/motion/test_motions.h"

namespace ncsim::compare {
namespace {

using kinematics::Random;
using motion::Motion;
using motion::PathKind;

/// The bends of CurveInTable say how far a motion gets from its chords; here it is looked, on
/// machines of every layout, with the metal's length and rotary centre not those of the control.
void HoldBends(PathKind kind, double length_error, unsigned seed) {
  Random random(seed);
  for (int run = 0; run < 300; ++run) {
    const kinematics::TestMachine machine = RandomMachine(&random);
    const auto metal =
        kinematics::FiveAxis::Make(machine.tree, machine.spindle_link, machine.table_link);
    ASSERT_TRUE(metal.has_value());
    const auto frame = std::make_shared<motion::TcpFrame>(motion::TcpFrame{*metal, 150.0, 0.0});
    const Motion motion = RandomMotion(&random, kind, machine, frame, random.Uniform(0.05, 1.0));
    const Curve curve = CurveInTable(*metal, motion, 150.0 + length_error);
    for (int i = 0; i < 20; ++i) {
      const double h = random.Uniform(0.01, 1.0), s0 = random.Uniform(0.0, 1.0 - h);
      const double part = random.Uniform(0.0, 1.0);
      const Distance off =
          Between(curve.at(s0 + part * h), Lerp(curve.at(s0), curve.at(s0 + h), part));
      EXPECT_LE(off.position, curve.bend.position * h * h / 8.0 + 1e-9) << run;
      EXPECT_LE(off.axis, curve.bend.axis * h * h / 8.0 + 1e-12) << run;
    }
  }
}

TEST(NcPath, ChordErrorsHoldWithoutTcp) {
  HoldBends(PathKind::kAxisLinear, 0.0, 1);
  HoldBends(PathKind::kAxisArc, 0.0, 2);
}

TEST(NcPath, ChordErrorsHoldUnderTcp) {
  HoldBends(PathKind::kTcpLine, 0.0, 3);
  HoldBends(PathKind::kTcpArc, 25.0, 4);
  HoldBends(PathKind::kTcpCircle, 10.0, 5);
}

// A line under TCP is one chord for the tip, and a circle needs what its sagitta asks for.
TEST(NcPath, ALineHasNoBend) {
  Random random(6);
  const kinematics::TestMachine machine = kinematics::TrunnionBC({0, 0, -500}, {0, 0, -550});
  const auto metal =
      kinematics::FiveAxis::Make(machine.tree, machine.spindle_link, machine.table_link);
  const auto frame = std::make_shared<motion::TcpFrame>(motion::TcpFrame{*metal, 150.0, 0.0});
  const Motion motion = RandomMotion(&random, PathKind::kTcpLine, machine, frame, 1.0);
  EXPECT_EQ(CurveInTable(*metal, motion, 150.0).bend.position, 0.0);
}

}  // namespace
}  // namespace ncsim::compare
