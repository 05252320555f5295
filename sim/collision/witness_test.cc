// SPDX-License-Identifier: BSD-3-Clause
// Touching points against closed forms.
#include "sim/collision/witness.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "sim/collision/test_rig.h"

namespace ncsim::collision {
namespace {

using Eigen::Vector3d;
using machine::BodyKind;
using ::testing::IsEmpty;
using ::testing::SizeIs;

constexpr double kDepthError = 2e-3;  // of the search, mm

double Norm(double a, double b) { return std::hypot(a, b); }

TEST(WitnessTest, CylinderSideInABoxFace) {
  const ProfileShape cylinder(CylinderProfile(0, 30, 5));
  for (const double face : {4.98, 5.5}) {
    const TriangleTree box(BoxMesh({face, -10, 5}, {20, 10, 25}));
    const Witness witness = *FindWitness(cylinder, box, {{0, 0, 0}, {0, 0, 1}});
    EXPECT_EQ(witness.b.x(), face);
    // Beside the axis the face is further off by y^2 / (2 face).
    EXPECT_LT(std::abs(witness.b.y()), std::sqrt(2.0 * face * kDepthError) + 1e-6);
    EXPECT_GE(witness.b.z(), 5.0);
    EXPECT_LE(witness.b.z(), 25.0);
    EXPECT_NEAR(Norm(witness.a.x(), witness.a.y()), 5.0, 1e-9);
    EXPECT_NEAR(witness.a.z(), witness.b.z(), 1e-9);
    EXPECT_NEAR((witness.a - witness.b).norm(), std::abs(face - 5.0), kDepthError);
  }
}

TEST(WitnessTest, BallTipOnAPlane) {
  const ProfileShape ball(BallProfile(3, 40));
  const TriangleTree plane(BoxMesh({-200, -100, -20}, {150, 300, 0}));
  for (const double height : {-0.1, 0.0, 0.7}) {
    // Tilted by 40 degrees about the ball's centre: the lowest point stays below it.
    const Vector3d axis(std::sin(Radians(40)), 0, std::cos(Radians(40)));
    const Vector3d centre(1, 2, 3 + height);
    const Witness witness = *FindWitness(ball, plane, {centre - 3.0 * axis, axis});
    const double aside = std::sqrt(2.0 * centre.z() * kDepthError);
    EXPECT_NEAR(witness.b.z(), 0.0, 1e-12);
    EXPECT_LT(Norm(witness.b.x() - 1, witness.b.y() - 2), aside);
    EXPECT_NEAR((witness.a - centre).norm(), 3.0, 1e-9);
    EXPECT_NEAR(witness.a.z(), height, kDepthError);
    EXPECT_LT(Norm(witness.a.x() - 1, witness.a.y() - 2), aside);
  }
}

TEST(WitnessTest, AThinPinOnTheAxis) {
  const ProfileShape cylinder(CylinderProfile(0, 30, 5));
  const TriangleTree pin(BoxMesh({-0.1, -0.1, -9}, {0.1, 0.1, 2}));
  const Witness witness = *FindWitness(cylinder, pin, {{0, 0, 0}, {0, 0, 1}});
  EXPECT_NEAR(witness.b.z(), 2.0, kDepthError);
  EXPECT_NEAR(witness.a.z(), 0.0, 1e-9);
}

// The points are as far apart as the certified kernel says, on any pose of a stepped holder.
TEST(WitnessTest, AgreesWithTheKernelOnRandomPoses) {
  const ProfileShape holder(PolyProfile({{0, 0}, {0, 16}, {30, 16}, {30, 25}, {70, 32}, {70, 0}}));
  const TriangleTree sphere(SphereMesh({0, 0, 0}, 40, 24));
  std::mt19937 random(3);
  int inside = 0;
  for (int i = 0; i < 300; ++i) {
    const Eigen::Isometry3d X = RandomPose(random, 70);
    const RevolvedPose pose{X.translation(), X.linear().col(2)};
    const Interval least = ProfileDistance(holder, sphere).Surface(pose, {});
    const Witness witness = *FindWitness(holder, sphere, pose);
    const auto distance = [&](const Vector3d& p) {
      const double z = (p - pose.tip).dot(pose.axis);
      return holder.exact().Distance(z, (p - pose.tip - z * pose.axis).norm());
    };
    EXPECT_NEAR(distance(witness.b), least.upper, 3e-3) << i;
    EXPECT_NEAR(distance(witness.a), 0.0, 1e-9) << i;
    EXPECT_NEAR((witness.a - witness.b).norm(), std::abs(distance(witness.b)), 1e-6) << i;
    inside += least.upper < 0.0 ? 1 : 0;
  }
  EXPECT_GT(inside, 50);
  EXPECT_LT(inside, 250);
}

// On a box of half sides 10: inside or on it, and not inside.
double OnBox(const Vector3d& p) { return p.cwiseAbs().maxCoeff() - 10.0; }

TEST(WitnessTest, TwoBoxesThatOverlap) {
  const FclMesh box(BoxMesh({-10, -10, -10}, {10, 10, 10}));
  std::mt19937 random(5);
  int met = 0;
  for (int i = 0; i < 400; ++i) {
    const Eigen::Isometry3d X = RandomPose(random, 20);
    if (!Collide(box, box, X).value()) continue;
    ++met;
    const auto points = CommonOrNearestPoints(box, box, X);
    ASSERT_TRUE(points.has_value()) << i;
    EXPECT_EQ(points->first, points->second);
    EXPECT_NEAR(OnBox(points->second), 0.0, 1e-9) << i;
    EXPECT_NEAR(OnBox(X.inverse() * points->first), 0.0, 1e-9) << i;
  }
  EXPECT_GT(met, 100);
}

// As machines make contacts: face into face, an edge into a face.
TEST(WitnessTest, TwoBoxesAxisParallelOrTurned) {
  const FclMesh box(BoxMesh({-10, -10, -10}, {10, 10, 10}));
  Eigen::Isometry3d X = Eigen::Isometry3d::Identity();
  X.translation() = Vector3d(19.9, 3, 2);
  auto points = CommonOrNearestPoints(box, box, X);
  ASSERT_TRUE(points.has_value());
  EXPECT_NEAR(OnBox(points->first), 0.0, 1e-9);
  EXPECT_NEAR(OnBox(X.inverse() * points->first), 0.0, 1e-9);
  EXPECT_NEAR(points->first.x(), 9.95, 0.05 + 1e-9);

  X.translation() = Vector3d(20.5, 3, 2);
  points = CommonOrNearestPoints(box, box, X);
  ASSERT_TRUE(points.has_value());
  EXPECT_NEAR(points->first.x(), 10.5, 1e-9);
  EXPECT_NEAR(points->second.x(), 10.0, 1e-9);
  EXPECT_NEAR(points->first.y(), points->second.y(), 1e-9);
  EXPECT_NEAR(OnBox(points->second), 0.0, 1e-9);
  EXPECT_NEAR(OnBox(X.inverse() * points->first), 0.0, 1e-9);

  X.linear() = Eigen::AngleAxisd(Radians(45), Vector3d::UnitZ()).toRotationMatrix();
  X.translation() = Vector3d(10 + 10 * std::sqrt(2.0) - 0.05, 3, 2);
  points = CommonOrNearestPoints(box, box, X);
  ASSERT_TRUE(points.has_value());
  EXPECT_NEAR(points->first.x(), 9.975, 0.025 + 1e-9);
  EXPECT_NEAR(points->first.y(), 3.0, 0.05 + 1e-9);
}

// Tool T3's holder has radius 20 from 90 above the tip; the table turned by C90 carries the jaw's
// (x, y) to (y, -x). The gauge line stands at (X, Y, Z) in the machine.
TEST(WitnessTest, AFindingHasThemInMachineCoordinates) {
  for (const double c : {0.0, 90.0}) {
    Rig rig;
    rig.AddBox("vise_jaw", BodyKind::kFixture, {12, -30, 0}, {60, 30, 111.4});
    rig.Start(0, 0, 200, 0, c);
    rig.Rapid(0, 0, 20, 0, c);
    const CollisionResult result = rig.Run();
    ASSERT_THAT(result.findings, SizeIs(1)) << Words(result);
    const Finding& finding = result.findings[0];
    ASSERT_THAT(finding.points, SizeIs(2));
    const double tip = finding.axes[2].second - Rig::kToolLength;
    for (const auto& p : finding.points) {
      const double toward = c > 0.0 ? -p[1] : p[0];
      EXPECT_GT(toward, 12.0 - 1e-3);
      EXPECT_LT(Norm(p[0], p[1]), 20.0 + 1e-3);
    }
    EXPECT_NEAR(finding.points[0][2], tip + 90.0, 1e-3);
    EXPECT_NEAR(finding.points[1][2], 111.4, 1e-3);
    EXPECT_NEAR(tip + 90.0, 111.4, 0.19);  // 1e-3 of the move
  }
}

// One box in the other: the points are a way apart, each on its own body.
TEST(WitnessTest, TheFirstPointIsOnTheFirstBody) {
  Rig rig;
  rig.facts().tool = 0;
  rig.AddBody("nose", BodyKind::kMachine, BoxMesh({-5, -5, -5}, {5, 5, 5}),
              rig.machine().spindle_link);
  rig.AddBox("tank", BodyKind::kMachine, {-200, -200, -200}, {200, 200, 400});
  rig.Start(0, 0, 10);
  rig.Rapid(1, 0, 10);
  const CollisionResult result = rig.Run();
  ASSERT_THAT(result.findings, SizeIs(1)) << Words(result);
  const auto& points = result.findings[0].points;
  ASSERT_THAT(points, SizeIs(2));
  const auto reach = [](const std::array<double, 3>& p) {
    return Vector3d(p[0], p[1], 0.0).cwiseAbs().maxCoeff();
  };
  EXPECT_LT(reach(points[0]), 7.0);
  EXPECT_GE(reach(points[1]), reach(points[0]) + 100.0);
}

TEST(WitnessTest, ANearMissHasNone) {
  Rig rig;
  rig.check().clearance = 2.0;
  rig.AddBox("jaw", BodyKind::kFixture, {6, -30, 0}, {60, 30, 20});
  rig.Start(0, 0, 200);
  rig.Rapid(0, 0, 10);
  const CollisionResult result = rig.Run();
  ASSERT_THAT(result.findings, SizeIs(1)) << Words(result);
  EXPECT_THAT(result.findings[0].points, IsEmpty());
}

}  // namespace
}  // namespace ncsim::collision
