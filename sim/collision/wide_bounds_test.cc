// SPDX-License-Identifier: BSD-3-Clause
// The bounds of eight boxes and triangles at once: the same bytes from both kinds of processor, and
// never above the signed distance of any point (ProfileChain, checked by profile_shape_test).
#include "sim/collision/wide_bounds.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstring>
#include <functional>
#include <utility>
#include <vector>

#include "sim/base/processor.h"
#include "sim/collision/test_shapes.h"
#include "sim/collision/triangle_tree.h"
#include "sim/collision/wide_shape.h"

namespace ncsim::collision {
namespace {

using Eigen::Vector3d;

constexpr float kEverything = 1e30F;  // no bound is enough: take every step

// A ball mill, a bull nose, a cone, a holder.
std::vector<machine::Profile> Profiles() {
  machine::Profile bull;
  bull.elements.push_back({{0, 0}, {0, 4}, false, Eigen::Vector2d::Zero()});
  bull.elements.push_back({{0, 4}, {2, 6}, true, {2, 4}});
  bull.elements.push_back({{2, 6}, {40, 6}, false, Eigen::Vector2d::Zero()});
  return {BallProfile(3, 30), bull, PolyProfile({{0, 0}, {40, 25}, {40, 0}}),
          PolyProfile({{20, 0}, {20, 20}, {50, 25}, {50, 31.5}, {60, 31.5}, {60, 22}, {90, 30}})};
}

// Boxes and triangles as the search meets them, with the solid far, near, and inside; and lattice
// poses, where centres lie on the axis.
template <typename Visit>
void VisitPoses(const Visit& visit) {
  const TriangleTree tree(SphereMesh({5, -3, 40}, 40, 12));
  std::mt19937 random(3);
  for (const machine::Profile& profile : Profiles()) {
    const ProfileShape shape(profile);
    WideShape wide(shape);
    for (int i = 0; i < 400; ++i) {
      Eigen::Isometry3d X = RandomPose(random, 100);
      if (i % 4 == 0) {
        X.linear().setIdentity();
        X.translation() = (0.1 * X.translation()).array().round();
      }
      const Vector3d axis = X.linear().col(2);
      // Every third solid moves.
      const Vector3d half_way =
          i % 3 == 0 ? Vector3d(30 * X.linear().col(i % 2)) : Vector3d::Zero();
      visit(tree, shape, X.translation(), axis, wide.Place(X.translation(), axis, tree, half_way));
    }
  }
}

// What the bounds themselves say of which are near.
void ExpectNear(const std::array<float, kWide>& lower, float enough, const WideNear& near) {
  float passed = 1e30F;
  for (std::size_t lane = 0; lane < kWide; ++lane) {
    const bool is_near = lower[lane] < enough;
    EXPECT_EQ((near.lanes >> lane & 1) != 0, is_near) << lane;
    if (!is_near) passed = std::min(passed, lower[lane]);
  }
  EXPECT_EQ(near.lanes >> kWide, 0);
  EXPECT_EQ(near.passed, passed);
}

TEST(WideBoundsTest, EveryProcessorGivesTheSameBytes) {
  if (!HasAvx2()) GTEST_SKIP() << "this processor has no AVX2";
  int compared = 0;
  VisitPoses([&compared](const TriangleTree& tree, const ProfileShape&, const Vector3d&,
                         const Vector3d&, const WideSolid& solid) {
    for (float enough : {kEverything, 1.0F, -1.0F}) {
      std::array<float, kWide> a{};
      std::array<float, kWide> b{};
      ExpectNear(a, enough, kWideBaseline.boxes(tree.node(0).boxes, solid, enough, a.data()));
      ExpectNear(b, enough, kWideAvx2.boxes(tree.node(0).boxes, solid, enough, b.data()));
      ASSERT_EQ(std::memcmp(a.data(), b.data(), sizeof(a)), 0);
      for (int leaf = 0; leaf * kWide < tree.size(); leaf += 7) {
        ExpectNear(a, enough, kWideBaseline.triangles(tree.leaf(leaf), solid, enough, a.data()));
        ExpectNear(b, enough, kWideAvx2.triangles(tree.leaf(leaf), solid, enough, b.data()));
        ASSERT_EQ(std::memcmp(a.data(), b.data(), sizeof(a)), 0);
        ++compared;
      }
    }
  });
  EXPECT_GT(compared, 20000);
}

TEST(WideBoundsTest, NoPointIsNearer) {
  std::mt19937 random(4);
  std::uniform_real_distribution<double> unit(0, 1);
  double closest = 1e9;
  VisitPoses([&](const TriangleTree& tree, const ProfileShape& shape, const Vector3d& tip,
                 const Vector3d& axis, const WideSolid& solid) {
    const Vector3d half_way = Eigen::Map<const Eigen::Vector3f>(solid.half_way).cast<double>();
    // Of the solid anywhere on its way; at its ends as often as between.
    const auto distance = [&](const Vector3d& p) {
      const double t =
          unit(random) < 0.5 ? 2.0 * unit(random) - 1.0 : (unit(random) < 0.5 ? -1 : 1);
      const Vector3d v = p - tip - t * half_way;
      const double z = v.dot(axis);
      return shape.exact().Distance(z, (v - z * axis).norm());
    };
    std::array<float, kWide> lower{};
    const WideBoxes& boxes = tree.node(0).boxes;
    BoundBoxes(boxes, solid, kEverything, lower.data());
    for (std::size_t lane = 0; lane < kWide; ++lane) {
      for (int i = 0; i < 30; ++i) {
        Vector3d p = tree.origin();
        for (int k = 0; k < 3; ++k) p[k] += static_cast<double>(boxes.centre[k][lane]);
        for (const auto& half : boxes.half) {
          // Corners as often as inner points.
          const double at = i % 2 == 0 ? 2.0 * unit(random) - 1.0 : (unit(random) < 0.5 ? -1 : 1);
          for (int k = 0; k < 3; ++k) p[k] += at * static_cast<double>(half[k][lane]);
        }
        ASSERT_GE(distance(p), static_cast<double>(lower[lane]));
      }
    }
    const int leaf = static_cast<int>(random()) & 31;
    BoundTriangles(tree.leaf(leaf), solid, kEverything, lower.data());
    for (int lane = 0; lane < tree.leaf_size(leaf); ++lane) {
      const TriangleTree::Triangle& t = tree.triangle(kWide * leaf + lane);
      for (int i = 0; i < 30; ++i) {
        const double a = i < 3 ? (i == 0 ? 1.0 : 0.0) : unit(random);
        const double b = i < 3 ? (i == 1 ? 1.0 : 0.0) : unit(random) * (1.0 - a);
        const double d = distance(a * t[0] + b * t[1] + (1.0 - a - b) * t[2]);
        const auto bound = static_cast<double>(lower[static_cast<std::size_t>(lane)]);
        ASSERT_GE(d, bound);
        closest = std::min(closest, d - bound);
      }
    }
  });
  EXPECT_LT(closest, 1e-3) << "the bounds of triangles are not tight";
}

// Slivers along the axis, so near that the direction from it to them is mostly rounding: deep
// inside a long cylinder the distance is r - 2.
TEST(WideBoundsTest, SliversAlongTheAxis) {
  const ProfileShape shape(CylinderProfile(0, 400, 2));
  WideShape wide(shape);
  std::mt19937 random(6);
  std::uniform_real_distribution<double> unit(0, 1);
  for (int i = 0; i < 3000; ++i) {
    const Eigen::Isometry3d X = RandomPose(random, 100);
    machine::TriangleMesh mesh;
    for (int k = 0; k < 3 * kWide; ++k) {
      const double r = std::pow(10.0, -5.0 + 4.0 * unit(random));
      const double angle = unit(random);
      mesh.vertices.push_back(
          X * Vector3d(r * std::cos(angle), r * std::sin(angle), 200.0 + 40.0 * unit(random)));
      if (k % 3 == 2) mesh.triangles.push_back({k - 2, k - 1, k});
    }
    const TriangleTree tree(mesh);
    const Vector3d axis = X.linear().col(2);
    std::array<float, kWide> lower{};
    BoundTriangles(tree.leaf(0), wide.Place(X.translation(), axis, tree), kEverything,
                   lower.data());
    for (std::size_t lane = 0; lane < kWide; ++lane) {
      for (const Vector3d& p : tree.triangle(static_cast<int>(lane))) {
        const double r = (X.inverse() * p).head<2>().norm();
        ASSERT_LE(static_cast<double>(lower[lane]), r - 2.0);
      }
    }
  }
}

// Every triangle is in the boxes above it.
TEST(WideBoundsTest, BoxesHoldWhatIsBelow) {
  const TriangleTree tree(SphereMesh({400, -300, 40}, 40, 16));
  const auto holds = [&tree](const WideBoxes& boxes, std::size_t lane, const Vector3d& p) {
    Eigen::Matrix3d half;
    Vector3d centre = tree.origin();
    for (int k = 0; k < 3; ++k) {
      centre[k] += static_cast<double>(boxes.centre[k][lane]);
      for (int i = 0; i < 3; ++i) half(k, i) = static_cast<double>(boxes.half[i][k][lane]);
    }
    return (half.inverse() * (p - centre)).cwiseAbs().maxCoeff() <= 1.0;
  };
  int seen = 0;
  const std::function<void(int, std::vector<std::pair<const WideBoxes*, std::size_t>>)> visit =
      [&](int index, std::vector<std::pair<const WideBoxes*, std::size_t>> above) {
        const TriangleTree::Node& node = tree.node(index);
        for (std::size_t lane = 0; lane < static_cast<std::size_t>(node.count); ++lane) {
          above.emplace_back(&node.boxes, lane);
          const int leaf = ~node.child[lane];
          if (leaf < 0) visit(node.child[lane], above);
          for (int i = 0; leaf >= 0 && i < tree.leaf_size(leaf); ++i, ++seen) {
            for (const Vector3d& p : tree.triangle(kWide * leaf + i)) {
              for (const auto& [boxes, at] : above) ASSERT_TRUE(holds(*boxes, at, p));
            }
          }
          above.pop_back();
        }
      };
  visit(0, {});
  EXPECT_EQ(seen, tree.size());
}

}  // namespace
}  // namespace ncsim::collision
