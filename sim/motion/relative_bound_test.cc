// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "sim/motion/test_motions.h"

namespace ncsim::motion {
namespace {

constexpr double kRounding = 1e-9;
using kinematics::Extent;
using kinematics::FiveAxis;

/// Greatest displacement of points of the extent's ball over the span, by sampling: the centre, and
/// points of its surface.
double Sampled(const Motion& motion, const PairPath& pair, const Span& span, double s_ref,
               double lag_ref, int steps, Random* random) {
  std::vector<Eigen::Vector3d> points{pair.a.p_LC};
  for (int i = 0; i < 12 && pair.a.radius > 0.0; ++i) {
    points.emplace_back(pair.a.p_LC + pair.a.radius * random->Direction());
  }
  const Eigen::Isometry3d X_ref = pair.path.Pose(motion.At(s_ref, lag_ref));
  double farthest = 0.0;
  const int lags = span.lag0 == span.lag1 ? 0 : 4;
  for (int i = 0; i <= steps; ++i) {
    for (int k = 0; k <= lags; ++k) {
      const double s = std::lerp(span.s0, span.s1, static_cast<double>(i) / steps);
      const double lag = lags == 0 ? span.lag0 : std::lerp(span.lag0, span.lag1, k / 4.0);
      const Eigen::Isometry3d X_BA = pair.path.Pose(motion.At(s, lag));
      for (const Eigen::Vector3d& p : points) {
        farthest = std::max(farthest, (X_BA * p - X_ref * p).norm());
      }
    }
  }
  return farthest;
}

class RelativeBoundTest : public testing::TestWithParam<PathKind> {};

/// Over random machines, links, extents, spans and references. The control may believe in axes 2 mm
/// off the metal's.
TEST_P(RelativeBoundTest, IsNeverLessThanWhatIsSampled) {
  Random random(21);
  int tool_to_table = 0;
  int detours = 0;
  for (int i = 0; i < 1000; ++i) {
    const TestMachine machine = RandomMachine(&random, {random.Chance(0.4), random.Chance(0.3)});
    const auto metal = FiveAxis::Make(machine.tree, machine.spindle_link, machine.table_link);
    ASSERT_TRUE(metal.has_value());
    const auto frame =
        std::make_shared<TcpFrame>(TcpFrame{*metal, random.Uniform(50.0, 250.0), 0.0});
    const double scale = std::pow(10.0, random.Uniform(-3.0, 0.0));
    const Motion motion = RandomMotion(&random, GetParam(), machine, frame, scale);

    const int count = static_cast<int>(machine.tree.links().size());
    const bool tool = random.Chance(0.4);
    const int link_a = tool ? machine.spindle_link : random.Below(count);
    const int link_b = tool && random.Chance(0.5) ? machine.table_link : random.Below(count);
    const PairPath pair(machine.tree, {link_a, random.InBox(150.0), random.Uniform(0.0, 100.0)},
                        link_b, random.Chance(0.9) ? &*metal : nullptr);
    tool_to_table += pair.tool_to_table;
    detours += pair.detour.has_value();

    const Span span = RandomSpan(&random, motion);
    const double s_ref = random.Uniform(span.s0, span.s1);
    const double lag_ref = random.Uniform(span.lag0, span.lag1);
    const double bound = RelativeBound(motion, pair, span, s_ref, lag_ref);
    ASSERT_TRUE(std::isfinite(bound));
    EXPECT_LE(Sampled(motion, pair, span, s_ref, lag_ref, 12, &random), bound + kRounding)
        << "case " << i << (pair.tool_to_table ? " tool to table" : "");
  }
  EXPECT_GT(tool_to_table, 100);
  EXPECT_GT(detours, 100);
}

INSTANTIATE_TEST_SUITE_P(Paths, RelativeBoundTest, testing::ValuesIn(kPathKinds),
                         [](const auto& param_info) { return ToString(param_info.param); });

/// A BC machine whose control believes its rotary centre somewhere else: the metal's tip leaves the
/// programmed line.
TEST(RelativeBoundCentreTest, HoldsWhenTheControlBelievesInAnotherCentre) {
  Random random(22);
  double largest_share = 0.0;
  for (int i = 0; i < 300; ++i) {
    const Eigen::Vector3d pivot = random.InBox(300.0);
    const Eigen::Vector3d error = random.InBox(3.0);
    const TestMachine machine = kinematics::TrunnionBC(pivot, pivot + Eigen::Vector3d(0, 0, -50));
    const TestMachine believed =
        kinematics::TrunnionBC(pivot + error, pivot + error + Eigen::Vector3d(0, 0, -50));
    const auto metal = FiveAxis::Make(machine.tree, machine.spindle_link, machine.table_link);
    const auto control = FiveAxis::Make(believed.tree, believed.spindle_link, believed.table_link);
    ASSERT_TRUE(metal.has_value() && control.has_value());
    const auto frame =
        std::make_shared<TcpFrame>(TcpFrame{*control, random.Uniform(50.0, 250.0), error.norm()});
    const Motion motion =
        RandomMotion(&random, random.Chance(0.5) ? PathKind::kTcpLine : PathKind::kTcpArc, machine,
                     frame, std::pow(10.0, random.Uniform(-3.0, 0.0)));
    const Extent tip{machine.spindle_link, {0, 0, frame->length}, 0.0};
    for (const int link_b : {machine.table_link, machine.tree.FindLink("B_link"), 0}) {
      const PairPath pair(machine.tree, tip, link_b, &*metal);
      EXPECT_EQ(pair.tool_to_table, link_b == machine.table_link);
      const double bound = RelativeBound(motion, pair, Span{}, 0.5, 0.0);
      const double moved = Sampled(motion, pair, Span{}, 0.5, 0.0, 24, &random);
      EXPECT_LE(moved, bound + kRounding) << "case " << i;
      if (!pair.tool_to_table) continue;
      // Without the centre's share the bound would be wrong in some cases: the test can fail.
      TcpCurve blind = std::get<TcpCurve>(motion.path);
      blind.frame = std::make_shared<TcpFrame>(TcpFrame{*control, frame->length, 0.0});
      const double without = RelativeBound(MakeMotion(blind), pair, Span{}, 0.5, 0.0);
      largest_share = std::max(largest_share, moved - without);
    }
  }
  EXPECT_GT(largest_share, 0.1);
}

/// Sum of the bounds over the sum of the sampled displacements, for a tool of the UMC kind (150 mm
/// long, extent 80 mm) against table, trunnion and base, on blocks of the usual size.
double Tightness(PathKind kind, const char* link_b, double width) {
  Random random(23);
  const TestMachine machine = kinematics::TrunnionBC({0, 0, -500}, {0, 0, -550});
  const auto metal = FiveAxis::Make(machine.tree, machine.spindle_link, machine.table_link);
  const auto frame = std::make_shared<TcpFrame>(TcpFrame{*metal, 150.0, 0.0});
  const PairPath pair(machine.tree, {machine.spindle_link, {0, 0, 75}, 80.0},
                      machine.tree.FindLink(link_b), &*metal);
  double bounds = 0.0;
  double displacements = 0.0;
  for (int i = 0; i < 100; ++i) {
    const Motion motion = RandomMotion(&random, kind, machine, frame, 0.1);
    Span span = Whole(motion);
    span.s0 = 0.5 - width / 2;
    span.s1 = 0.5 + width / 2;
    bounds += RelativeBound(motion, pair, span, 0.5, 0.5 * span.lag1);
    displacements += Sampled(motion, pair, span, 0.5, 0.5 * span.lag1, 8, &random);
  }
  return bounds / displacements;
}

// What is measured goes into the test's properties.
TEST(RelativeBoundTightnessTest, IsWithinAFactorOfTwo) {
  for (const PathKind kind : kPathKinds) {
    for (const char* link_b : {"workpiece_mount_link", "B_link", "base"}) {
      for (const double width : {0.01, 0.5}) {
        const double tightness = Tightness(kind, link_b, width);
        RecordProperty(ToString(kind) + "_" + link_b + (width < 0.1 ? "_short" : "_long"),
                       std::to_string(tightness));
        EXPECT_LT(tightness, 2.0) << ToString(kind) << " " << link_b << " " << width;
      }
    }
  }
}

// Tilting a long tool about its tip by 1 degree: as seen from the table it moves by 1 degree at its
// own length, whatever the distance of both from the rotary axes. Each body alone moves by much
// more.
TEST(RelativeBoundTcpTest, ToolTiltedAboutItsTipMovesByItsOwnLengthOnly) {
  const TestMachine machine = kinematics::TrunnionBC({0, 0, -500}, {0, 0, -500});
  const auto metal = FiveAxis::Make(machine.tree, machine.spindle_link, machine.table_link);
  TcpCurve curve;
  curve.frame = std::make_shared<TcpFrame>(TcpFrame{*metal, 150.0, 0.0});
  curve.p0_B = curve.p1_B = Eigen::Vector3d(0, 0, 0);
  curve.q0 = curve.q1 = JointVector::Zero(5);
  const double angle = std::numbers::pi / 180.0;
  curve.q1[3] = angle;
  const Motion motion = MakeMotion(curve);
  // A ball of 20 mm about the middle of the tool, 75 mm from the tip.
  const PairPath pair(machine.tree, {machine.spindle_link, {0, 0, 75}, 20.0}, machine.table_link,
                      &*metal);
  ASSERT_TRUE(pair.tool_to_table);
  EXPECT_NEAR(RelativeBound(motion, pair, Span{}, 0.0, 0.0), 95.0 * 2.0 * std::sin(angle / 2.0),
              1e-12);
  const PairPath alone(machine.tree, {machine.spindle_link, {0, 0, 75}, 20.0}, 0, &*metal);
  EXPECT_NEAR(RelativeBound(motion, alone, Span{}, 0.0, 0.0), 500.0 * 2.0 * std::sin(angle / 2.0),
              1e-9);
}

TEST(RelativeBoundTcpTest, BodiesThatDoNotMoveAgainstEachOther) {
  const TestMachine machine = kinematics::TrunnionBC({0, 0, -500}, {0, 0, -500});
  const auto metal = FiveAxis::Make(machine.tree, machine.spindle_link, machine.table_link);
  const Motion motion =
      MakeMotion(AxisLinear{JointVector::Zero(5), JointVector::Constant(5, 10.0)});
  const PairPath pair(machine.tree, {machine.table_link, {0, 0, 0}, 20.0},
                      machine.tree.FindLink("C_link"), &*metal);
  EXPECT_TRUE(pair.path.rigid());
  EXPECT_EQ(RelativeBound(motion, pair, Span{}, 0.3, 0.0), 0.0);
}

}  // namespace
}  // namespace ncsim::motion
