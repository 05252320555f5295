// SPDX-License-Identifier: BSD-3-Clause
#include "sim/motion/travel.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <vector>

#include "sim/motion/test_motions.h"

namespace ncsim::motion {
namespace {

using kinematics::Extent;
using kinematics::FiveAxis;

constexpr int kSteps = 12;

/// Two random motions and the way between them; now and then rests enough for more than one box.
std::vector<Motion> RandomRun(Random* random, const TestMachine& machine,
                              const std::shared_ptr<const TcpFrame>& frame) {
  const double scale = std::pow(10.0, random->Uniform(-3.0, 0.0));
  const auto any = [&] {
    return RandomMotion(random, kPathKinds[random->Below(6)], machine, frame, scale);
  };
  std::vector<Motion> motions{any()};
  const JointVector q = motions.front().q1();
  if (random->Chance(0.1)) motions.resize(Travel::kLeaf + 2, MakeMotion(AxisLinear{q, q}));
  const Motion last = any();
  motions.push_back(MakeMotion(AxisLinear{q, last.q0()}));
  motions.push_back(last);
  return motions;
}

std::vector<const Motion*> Pointers(const std::vector<Motion>& motions) {
  std::vector<const Motion*> pointers;
  for (const Motion& motion : motions) pointers.push_back(&motion);
  return pointers;
}

/// Poses of a motion, with all its lags.
std::vector<JointVector> Poses(const Motion& motion) {
  std::vector<JointVector> poses;
  const Span whole = Whole(motion);
  for (int i = 0; i <= kSteps; ++i) {
    for (int k = 0; k <= (whole.lag1 > 0.0 ? 3 : 0); ++k) {
      poses.push_back(motion.At(static_cast<double>(i) / kSteps, whole.lag1 * k / 3.0));
    }
  }
  return poses;
}

/// Motions of which more than their ends was held.
struct Held {
  int even = 0, dog_legs = 0;
};

// What the totals know of motion i: where it starts and ends, that it is even, how far it gets from
// the middle of its box, and its straight way.
template <class Moved>
void HoldOne(const Motion& motion, const PairPath& pair, const PairTravel& bound, std::size_t i,
             Held* held, const Moved& moved) {
  const Eigen::Isometry3d X_begin = pair.path.Pose(motion.q0());
  const Eigen::Isometry3d X_end = pair.path.Pose(motion.q1());
  ASSERT_LE(moved(bound.Pose(i), X_begin), 1e-6);
  ASSERT_LE(moved(bound.Pose(i + 1), X_end), 1e-6);
  const std::optional<PairTravel::Neighbourhood> around = bound.AroundDogLeg(i);
  ASSERT_EQ(around.has_value(), std::holds_alternative<DogLeg>(motion.path));
  held->dog_legs += around.has_value() ? 1 : 0;
  held->even += bound.Even(i) && bound.Between(i, i + 1) > 1e-3 ? 1 : 0;
  const std::optional<Translation> straight = bound.TranslationOf(i);
  for (const JointVector& q : Poses(motion)) {
    const Eigen::Isometry3d X = pair.path.Pose(q);
    if (around.has_value()) {
      ASSERT_LE(moved(bound.PoseOf(*around), X), around->radius);
    }
    if (bound.Even(i)) {
      ASSERT_LE(moved(X_begin, X) + moved(X, X_end), bound.Between(i, i + 1));
    }
    if (!straight.has_value()) continue;
    constexpr int kPlaces = 64;
    double astray = std::numeric_limits<double>::infinity();
    for (int k = 0; k <= kPlaces; ++k) {
      Eigen::Isometry3d X_way = straight->X_BA;
      X_way.translation() += (static_cast<double>(k) / kPlaces) * straight->way;
      astray = std::min(astray, moved(X_way, X));
    }
    ASSERT_LE(astray, straight->astray + straight->way.norm() / (2 * kPlaces) + 1e-6);
  }
}

// For all stretches of a run: no pose of theirs is further from either of their ends than
// PairTravel says. `moved` measures between two X_BA.
template <class Moved>
void Hold(const std::vector<Motion>& motions, const PairPath& pair, const Travel& travel,
          Held* held, const Moved& moved) {
  const PairTravel bound(pair, travel);
  for (std::size_t i = 0; i < motions.size(); ++i) {
    for (std::size_t j = i + 1; j <= motions.size(); ++j) {
      const Eigen::Isometry3d X_begin = pair.path.Pose(motions[i].At(0.0));
      const Eigen::Isometry3d X_end = pair.path.Pose(motions[j - 1].At(1.0));
      for (const JointVector& q : Poses(motions[j - 1])) {
        ASSERT_LE(moved(X_begin, pair.path.Pose(q)), bound.Between(i, j));
      }
      for (const JointVector& q : Poses(motions[i])) {
        ASSERT_LE(moved(X_end, pair.path.Pose(q)), bound.Between(i, j));
      }
    }
  }
  for (std::size_t i = 0; i < motions.size(); ++i) {
    HoldOne(motions[i], pair, bound, i, held, moved);
    if (::testing::Test::HasFatalFailure()) return;
  }
  for (std::size_t level = 0; level < travel.levels(); ++level) {
    for (std::size_t i = 0; i < motions.size(); ++i) {
      const PairTravel::Neighbourhood around = bound.Around(i, level, 3);
      ASSERT_GT(around.end, i);
      for (const JointVector& q : Poses(motions[i])) {
        ASSERT_LE(moved(bound.PoseOf(around), pair.path.Pose(q)), around.radius);
      }
    }
  }
}

TEST(TravelTest, NoPairGetsFurtherThanItsTotals) {
  Random random(31);
  Held held;
  for (int i = 0; i < 400; ++i) {
    const TestMachine machine = RandomMachine(&random, {random.Chance(0.4), random.Chance(0.3)});
    const auto metal = FiveAxis::Make(machine.tree, machine.spindle_link, machine.table_link);
    ASSERT_TRUE(metal.has_value());
    const double length = random.Uniform(50.0, 250.0);
    // The control may believe in another length.
    const auto frame = std::make_shared<TcpFrame>(
        TcpFrame{*metal, length + (random.Chance(0.3) ? random.Uniform(-9.0, 9.0) : 0.0), 0.0});
    const std::vector<Motion> motions = RandomRun(&random, machine, frame);
    const Travel travel(machine.tree, &*metal, length, Pointers(motions));
    const int count = static_cast<int>(machine.tree.links().size());
    const bool tool = random.Chance(0.5);
    const Extent extent{tool ? machine.spindle_link : random.Below(count), random.InBox(150.0),
                        random.Uniform(0.0, 100.0)};
    const PairPath pair(machine.tree, extent,
                        tool && random.Chance(0.5) ? machine.table_link : random.Below(count),
                        &*metal);
    std::vector<Eigen::Vector3d> points{extent.p_LC};
    for (int k = 0; k < 6; ++k) {
      points.emplace_back(extent.p_LC + extent.radius * random.Direction());
    }
    Hold(motions, pair, travel, &held, [&](const Eigen::Isometry3d& X, const Eigen::Isometry3d& Y) {
      double farthest = 0.0;
      for (const Eigen::Vector3d& p : points) {
        farthest = std::max(farthest, (X * p - Y * p).norm());
      }
      return farthest;
    });
    if (HasFatalFailure()) FAIL() << "case " << i;
  }
  EXPECT_GT(held.even, 50);
  EXPECT_GT(held.dog_legs, 50);
}

// A cylinder about the spindle's axis: what counts is how far its points get from the solid, not
// from themselves.
TEST(TravelTest, ASolidOfRevolutionMayTurnAboutItsAxis) {
  Random random(32);
  Held held;
  double free_spin = 0.0;
  for (int i = 0; i < 300; ++i) {
    const TestMachine machine = RandomMachine(&random, {random.Chance(0.4), random.Chance(0.3)});
    const auto metal = FiveAxis::Make(machine.tree, machine.spindle_link, machine.table_link);
    ASSERT_TRUE(metal.has_value());
    const double length = random.Uniform(50.0, 250.0);
    const auto frame = std::make_shared<TcpFrame>(TcpFrame{*metal, length, 0.0});
    const std::vector<Motion> motions = RandomRun(&random, machine, frame);
    const Travel travel(machine.tree, &*metal, length, Pointers(motions));
    const double half = random.Uniform(1.0, 60.0);
    const double radius = random.Uniform(1.0, 60.0);
    const double middle = random.Uniform(0.0, length);
    PairPath pair(machine.tree,
                  {machine.spindle_link, {0.0, 0.0, middle}, std::hypot(half, radius)},
                  machine.table_link, &*metal);
    const double as_any = PairTravel(pair, travel).Between(0, motions.size());
    pair.revolved = true;
    free_spin = std::max(free_spin, as_any - PairTravel(pair, travel).Between(0, motions.size()));
    Hold(motions, pair, travel, &held, [&](const Eigen::Isometry3d& X, const Eigen::Isometry3d& Y) {
      double farthest = 0.0;
      for (int k = 0; k < 16; ++k) {
        const double angle = 0.785398 * k;
        const Eigen::Vector3d p(radius * std::cos(angle), radius * std::sin(angle),
                                middle + (k < 8 ? half : -half));
        const Eigen::Vector3d seen = X.inverse() * (Y * p);
        const double above = std::max(0.0, std::abs(seen.z() - middle) - half);
        const double beside = std::max(0.0, std::hypot(seen.x(), seen.y()) - radius);
        farthest = std::max(farthest, std::hypot(above, beside));
      }
      return farthest;
    });
    if (HasFatalFailure()) FAIL() << "case " << i;
  }
  EXPECT_GT(held.even, 50);
  EXPECT_GT(held.dog_legs, 50);
  EXPECT_GT(free_spin, 1.0);
}

// The tool against what is no part of the table: the boxes of the tip in the table's frame say
// nothing about it.
TEST(TravelTest, ASolidOfRevolutionAgainstAnyLink) {
  Random random(33);
  Held held;
  for (int i = 0; i < 300; ++i) {
    const TestMachine machine = RandomMachine(&random, {random.Chance(0.4), random.Chance(0.3)});
    const auto metal = FiveAxis::Make(machine.tree, machine.spindle_link, machine.table_link);
    ASSERT_TRUE(metal.has_value());
    const auto frame = std::make_shared<TcpFrame>(TcpFrame{*metal, 100.0, 0.0});
    const std::vector<Motion> motions = RandomRun(&random, machine, frame);
    const Travel travel(machine.tree, &*metal, 100.0, Pointers(motions));
    const Eigen::Vector3d middle(0.0, 0.0, 50.0);
    PairPath pair(machine.tree, {machine.spindle_link, middle, 0.0},
                  random.Below(static_cast<int>(machine.tree.links().size())), &*metal);
    pair.revolved = true;
    // A point on the axis: a turn about it does not move it anyway.
    Hold(motions, pair, travel, &held, [&](const Eigen::Isometry3d& X, const Eigen::Isometry3d& Y) {
      return (X * middle - Y * middle).norm();
    });
    if (HasFatalFailure()) FAIL() << "case " << i;
  }
}

// Along X by 3 and by 4, and a turn of C between: straight sums.
TEST(TravelTest, TotalsOfAxisMotions) {
  const TestMachine machine = kinematics::TrunnionBC({0, 0, 0}, {0, 0, 0});
  const auto metal = FiveAxis::Make(machine.tree, machine.spindle_link, machine.table_link);
  JointVector a = JointVector::Zero(5), b = a, c = a, d = a;
  b[0] = 3.0;
  c = b;
  c[4] = 0.001;
  d = c;
  d[0] = 7.0;
  std::vector<Motion> motions = {MakeMotion(AxisLinear{a, b}), MakeMotion(AxisLinear{b, c}),
                                 MakeMotion(AxisLinear{c, d})};
  motions[1].facts.corner_rounding = 0.5;
  const Travel travel(machine.tree, &*metal, 100.0, Pointers(motions));
  EXPECT_EQ(travel.corner_rounding(), 0.5);
  const PairPath head(machine.tree, {machine.spindle_link, {0, 0, 0}, 10.0}, 0, &*metal);
  EXPECT_NEAR(PairTravel(head, travel).Between(0, 3), 7.0, 1e-5);
  EXPECT_NEAR(PairTravel(head, travel).Between(1, 2), 0.0, 1e-5);
  const int b_link = machine.tree.FindLink("B_link");
  const PairPath platter(machine.tree, {machine.table_link, {30, 40, 0}, 5.0}, b_link, &*metal);
  EXPECT_NEAR(PairTravel(platter, travel).Between(0, 3), 0.055, 1e-4);
}

}  // namespace
}  // namespace ncsim::motion
