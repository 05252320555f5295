// SPDX-License-Identifier: BSD-3-Clause
// What FCL's mesh-mesh distance is worth: closed forms on random and on lattice poses, where its
// primitives fail (flexible-collision-library/fcl issue 508). A table is printed; the constant that
// is subtracted must cover it tenfold.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <limits>

#include "sim/collision/fcl_backend.h"
#include "sim/collision/tessellate.h"
#include "sim/collision/test_shapes.h"

namespace ncsim::collision {
namespace {

using Eigen::Vector3d;

struct Row {
  const char* name;
  int poses = 0;
  int wrong_hits = 0;
  double over = -1.0;   // greatest (FCL - truth)
  double under = -1.0;  // greatest (truth - FCL)

  void Add(const std::optional<double>& fcl, double truth) {
    ASSERT_TRUE(fcl.has_value());
    ++poses;
    const double expected = std::max(0.0, truth);
    over = std::max(over, *fcl - expected);
    under = std::max(under, expected - *fcl);
  }
  void Check() const {
    std::printf("%-34s %6d poses  over %9.2e mm  under %9.2e mm  wrong hits %d\n", name, poses,
                over, under, wrong_hits);
    EXPECT_LT(over, 0.1 * kFclDistanceError) << name;
    EXPECT_LT(under, 0.1 * kFclDistanceError) << name;
    EXPECT_EQ(wrong_hits, 0) << name;
    EXPECT_GT(poses, 100) << name;
  }
};

// Two axis-parallel boxes.
double BoxGap(const Vector3d& half_a, const Vector3d& half_b, const Vector3d& offset) {
  const Vector3d gap = offset.cwiseAbs() - half_a - half_b;
  if (gap.maxCoeff() <= 0.0) return gap.maxCoeff();
  return gap.cwiseMax(0.0).norm();
}

TEST(FclCharacterizationTest, BoxBoxLattice) {
  Row row{"box-box, lattice"};
  const Vector3d half_a(10, 20, 5);
  const Vector3d half_b(7, 3, 40);
  const FclMesh a(BoxMesh(-half_a, half_a));
  const FclMesh b(BoxMesh(-half_b, half_b));
  for (int x = -60; x <= 60; x += 6) {
    for (int y = -60; y <= 60; y += 6) {
      for (int z = -90; z <= 90; z += 9) {
        Eigen::Isometry3d X = Eigen::Isometry3d::Identity();
        X.translation() = Vector3d(x, y, z);
        const double truth = BoxGap(half_a, half_b, X.translation());
        // One wholly inside the other has no surface contact: the hollow case, tested elsewhere.
        row.Add(Distance(a, b, X, 1e9), truth);
        const auto hit = Collide(a, b, X);
        if (truth != 0.0 && hit != (truth < 0.0)) ++row.wrong_hits;
      }
    }
  }
  row.Check();
}

TEST(FclCharacterizationTest, BoxBoxRandomCommonPose) {
  // The same closed form seen from a frame that is turned at random and far away: rounding at
  // machine size.
  Row row{"box-box, random frame"};
  const Vector3d half_a(10, 20, 5);
  const Vector3d half_b(7, 3, 40);
  std::mt19937 random(2);
  std::uniform_real_distribution<double> uniform(-80, 80);
  for (int i = 0; i < 3000; ++i) {
    const Eigen::Isometry3d X_WF = RandomPose(random, 1500);
    const Vector3d offset(uniform(random), uniform(random), uniform(random));
    machine::TriangleMesh mesh_b = BoxMesh(offset - half_b, offset + half_b);
    for (Vector3d& v : mesh_b.vertices) v = X_WF * v;
    const FclMesh a(BoxMesh(-half_a, half_a));
    const FclMesh b(mesh_b);
    const double truth = BoxGap(half_a, half_b, offset);
    row.Add(Distance(a, b, X_WF, 1e9), truth);
    if (std::abs(truth) > 1e-9 && Collide(a, b, X_WF) != (truth < 0.0)) ++row.wrong_hits;
  }
  row.Check();
}

TEST(FclCharacterizationTest, PrismOverBox) {
  // A tessellated cylinder with its axis along the box's edge direction, over the face: the truth
  // is that of its lowest vertex. Lattice heights and turns about its own axis.
  Row row{"cylinder tessellation-box, aligned"};
  const machine::TriangleMesh cylinder = Tessellate(CylinderProfile(0, 60, 12), 60);
  const FclMesh a(cylinder);
  const FclMesh b(BoxMesh({-100, -100, -10}, {100, 100, 0}));
  for (int turn = 0; turn < 90; ++turn) {
    const Eigen::Matrix3d R = (Eigen::AngleAxisd(0.5 * 3.14159265358979323846, Vector3d::UnitX()) *
                               Eigen::AngleAxisd(turn * 0.01, Vector3d::UnitZ()))
                                  .toRotationMatrix();
    double lowest = 1e9;
    for (const Vector3d& v : cylinder.vertices) lowest = std::min(lowest, (R * v).z());
    for (double height : {0.001, 0.01, 1.0, 12.0, 100.0}) {
      Eigen::Isometry3d X = Eigen::Isometry3d::Identity();
      X.linear() = R;
      X.translation() = Vector3d(3, -7, height - lowest);
      row.Add(Distance(a, b, X, 1e9), height);
      if (Collide(a, b, X) != false) ++row.wrong_hits;
    }
  }
  row.Check();
}

TEST(FclCharacterizationTest, SkewAndParallelEdges) {
  // Box edges facing each other, turned by any angle about the common normal, 0 (parallel)
  // included.
  Row row{"edge-edge, skew and parallel"};
  const double h = 10.0;
  const FclMesh a(BoxMesh({-30, -h, -h}, {30, h, h}));
  const FclMesh b(BoxMesh({-30, -h, -h}, {30, h, h}));
  const Eigen::AngleAxisd eighth(0.25 * 3.14159265358979323846, Vector3d::UnitX());
  const double reach = h * std::sqrt(2.0);  // of an edge, from the centre
  for (int turn = 0; turn <= 90; ++turn) {
    for (double gap : {1e-4, 0.01, 0.5, 3.0, 250.0}) {
      machine::TriangleMesh lower = BoxMesh({-30, -h, -h}, {30, h, h});
      for (Vector3d& v : lower.vertices) v = eighth * v;
      const FclMesh fixed(lower);
      Eigen::Isometry3d X = Eigen::Isometry3d::Identity();
      X.linear() =
          (Eigen::AngleAxisd(turn * 3.14159265358979323846 / 180.0, Vector3d::UnitZ()) * eighth)
              .toRotationMatrix();
      X.translation() = Vector3d(0, 0, 2.0 * reach + gap);
      row.Add(Distance(a, fixed, X, 1e9), gap);
      if (Collide(a, fixed, X) != false) ++row.wrong_hits;
    }
  }
  row.Check();
}

TEST(FclCharacterizationTest, CutIsALowerBound) {
  const FclMesh a(SphereMesh({0, 0, 0}, 20, 12));
  const FclMesh b(SphereMesh({0, 0, 0}, 30, 12));
  std::mt19937 random(3);
  for (int i = 0; i < 500; ++i) {
    const Eigen::Isometry3d X = RandomPose(random, 90);
    const auto exact = Distance(a, b, X, 1e9);
    for (double cut : {0.5, 5.0, 50.0}) {
      const auto d = Distance(a, b, X, cut);
      ASSERT_TRUE(exact && d);
      EXPECT_NEAR(*d, std::min(*exact, cut), 1e-9);
    }
  }
}

TEST(FclCharacterizationTest, FailuresAreSaid) {
  const FclMesh empty{machine::TriangleMesh{}};
  const FclMesh box(BoxMesh({0, 0, 0}, {1, 1, 1}));
  EXPECT_FALSE(empty.ok());
  EXPECT_FALSE(Distance(empty, box, Eigen::Isometry3d::Identity(), 1.0).has_value());
  EXPECT_FALSE(Collide(box, empty, Eigen::Isometry3d::Identity()).has_value());
  Eigen::Isometry3d broken = Eigen::Isometry3d::Identity();
  broken.translation().x() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(Distance(box, box, broken, 1.0).has_value());
}

}  // namespace
}  // namespace ncsim::collision
