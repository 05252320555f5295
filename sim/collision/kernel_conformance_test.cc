// SPDX-License-Identifier: BSD-3-Clause
// Conformance of the kernel: a million random poses and more against distances that need no search
// (ball and capsule; cylinder and box on a lattice), against a brute force in double (bull nose,
// cone, stacked holder), and against FCL (circumscribed meshes of the tools).
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "sim/collision/closed_distances.h"
#include "sim/collision/fcl_backend.h"
#include "sim/collision/profile_distance.h"
#include "sim/collision/tessellate.h"
#include "sim/collision/test_shapes.h"

namespace ncsim::collision {
namespace {

using Eigen::Vector3d;
using Triangle = TriangleTree::Triangle;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// Goals in turn: as it comes, fine, loose, and with both stops.
DistanceGoal Goal(int i) {
  DistanceGoal goal;
  if (i % 5 == 1) goal.gap = 1e-6;
  if (i % 5 == 2) goal.relative_gap = 0.2;
  if (i % 5 == 3) goal.stop_above = 1.0;
  if (i % 5 == 4) goal.stop_below = 0.0;
  return goal;
}

/// What the poses of a table row came to.
struct Tally {
  int poses = 0, overlapping = 0, touching = 0, separated = 0;
  double over = -kInfinity;   ///< Greatest lower - truth, mm.
  double under = -kInfinity;  ///< Greatest truth - upper, mm.
  int unmet = 0;              ///< Poses whose goal was not met.

  void Add(const Interval& d, double truth, const DistanceGoal& goal) {
    over = std::max(over, d.lower - truth);
    under = std::max(under, truth - d.upper);
    Count(d, truth, goal);
  }

  void Count(const Interval& d, double truth, const DistanceGoal& goal) {
    ++poses;
    ++(truth < -1e-6 ? overlapping : truth < 1e-6 ? touching : separated);
    const double gap = std::max(goal.gap, goal.relative_gap * (d.lower - goal.floor));
    const double error = 3.0 * kKernelError;
    const bool met = d.upper - d.lower <= gap + error || d.lower >= goal.stop_above - error ||
                     d.upper < goal.stop_below + error;
    if (!met) ++unmet;
  }

  /// `error`: of the truth, mm.
  void Expect(const std::string& name, double error) const {
    SCOPED_TRACE(name + ", " + std::to_string(poses) + " poses");
    // kKernelError is taken off the lower bound, so it is below the truth itself.
    EXPECT_LE(over, error);
    EXPECT_LE(under, error);
    EXPECT_EQ(unmet, 0);
    EXPECT_GT(separated, poses / 20);
    EXPECT_GT(overlapping, poses / 20);
  }
};

/// Twelve big triangles; long slivers around two hubs; small triangles, curved.
struct NamedMesh {
  const char* name;
  machine::TriangleMesh mesh;
};

machine::TriangleMesh FanMesh(double radius, double thickness, int slices) {
  machine::TriangleMesh mesh;
  mesh.vertices = {Vector3d(0, 0, 0), Vector3d(0, 0, thickness)};
  for (int i = 0; i < slices; ++i) {
    const double angle = 2.0 * 3.14159265358979 * i / slices;
    for (double z : {0.0, thickness}) {
      mesh.vertices.emplace_back(radius * std::cos(angle), radius * std::sin(angle), z);
    }
  }
  for (int i = 0; i < slices; ++i) {
    const int a = 2 + 2 * i;
    const int b = 2 + 2 * ((i + 1) % slices);
    mesh.triangles.push_back({0, b, a});
    mesh.triangles.push_back({1, a + 1, b + 1});
    mesh.triangles.push_back({a, b, b + 1});
    mesh.triangles.push_back({a, b + 1, a + 1});
  }
  mesh.watertight = true;
  return mesh;
}

std::vector<NamedMesh> Meshes() {
  return {{"box", BoxMesh({-30, -20, -10}, {30, 20, 10})},
          {"fan", FanMesh(30, 2, 40)},
          {"sphere", SphereMesh({3, -2, 1}, 25, 8)}};
}

std::vector<Triangle> Triangles(const machine::TriangleMesh& mesh) {
  const TriangleTree tree(mesh);
  std::vector<Triangle> triangles;
  for (int i = 0; i < tree.size(); ++i) triangles.push_back(tree.triangle(i));
  return triangles;
}

/// A random pose; every third on a lattice: along an axis, at half millimetres.
RevolvedPose AnyPose(std::mt19937& random, int i, double reach) {
  const Eigen::Isometry3d X = RandomPose(random, reach);
  if (i % 3 != 0) return {X.translation(), X.linear().col(2)};
  const Vector3d axis = (i % 2 == 0 ? 1.0 : -1.0) * Vector3d::Unit(i / 6 % 3);
  return {(2.0 * X.translation()).array().round() / 2.0, axis};
}

/// Every fourth separated pose is moved along `way`, its shortest way, until it touches.
bool Touches(int i, double truth) { return i % 4 == 1 && truth > 0.0; }

machine::Profile Sphere(double radius) {
  machine::Profile profile;
  profile.elements.push_back({{0, 0}, {2.0 * radius, 0}, true, {radius, 0}});
  return profile;
}

TEST(KernelConformanceTest, Ball) {
  constexpr int kPoses = 210'000;
  constexpr double kRadius = 4.0;
  const ProfileShape shape(Sphere(kRadius));
  for (const NamedMesh& named : Meshes()) {
    const TriangleTree tree(named.mesh);
    const std::vector<Triangle> triangles = Triangles(named.mesh);
    ProfileDistance kernel(shape, tree);
    std::mt19937 random(21);
    Tally tally;
    for (int i = 0; i < kPoses; ++i) {
      RevolvedPose pose = AnyPose(random, i, 36.0);
      const Vector3d centre = pose.tip + kRadius * pose.axis;
      Vector3d way = Vector3d::Constant(1e9);
      for (const Triangle& t : triangles) {
        const Vector3d w = closed::NearestOnTriangle(centre, t) - centre;
        if (w.squaredNorm() < way.squaredNorm()) way = w;
      }
      double truth = way.norm() - kRadius;
      if (Touches(i, truth)) {
        pose.tip += truth * way.normalized();
        truth = 0.0;
      }
      const DistanceGoal goal = Goal(i);
      tally.Add(kernel.Surface(pose, goal), truth, goal);
    }
    tally.Expect(std::string("ball and ") + named.name, 1e-12);
    EXPECT_GT(tally.touching, kPoses / 20);
  }
}

TEST(KernelConformanceTest, Capsule) {
  constexpr double kRadius = 3.0;
  constexpr double kLength = 25.0;
  machine::Profile profile;
  profile.elements.push_back({{-kRadius, 0}, {0, kRadius}, true, {0, 0}});
  profile.elements.push_back({{0, kRadius}, {kLength, kRadius}, false, {0, 0}});
  profile.elements.push_back({{kLength, kRadius}, {kLength + kRadius, 0}, true, {kLength, 0}});
  const ProfileShape shape(profile);
  ASSERT_TRUE(shape.convex());
  const std::vector<NamedMesh> meshes = Meshes();
  const std::array<int, 3> poses = {150'000, 15'000, 15'000};
  for (std::size_t m = 0; m < meshes.size(); ++m) {
    const TriangleTree tree(meshes[m].mesh);
    const std::vector<Triangle> triangles = Triangles(meshes[m].mesh);
    ProfileDistance kernel(shape, tree);
    std::mt19937 random(22);
    Tally tally;
    for (int i = 0; i < poses[m]; ++i) {
      const RevolvedPose pose = AnyPose(random, i, 45.0);
      double truth = kInfinity;
      for (const Triangle& t : triangles) {
        truth = std::min(
            truth, closed::SegmentTriangle(pose.tip, pose.tip + kLength * pose.axis, t) - kRadius);
      }
      const DistanceGoal goal = Goal(i);
      tally.Add(kernel.Surface(pose, goal), truth, goal);
    }
    tally.Expect(std::string("capsule and ") + meshes[m].name, 1e-9);
  }
}

// Cylinder and box along the axes, on a lattice: faces, edges and corners meet exactly.
TEST(KernelConformanceTest, CylinderAndBoxOnALattice) {
  constexpr double kRadius = 5.0;
  constexpr double kHeight = 20.0;
  const Vector3d half(30, 20, 10);
  const TriangleTree tree(BoxMesh(-half, half));
  const ProfileShape shape(CylinderProfile(0, kHeight, kRadius));
  ProfileDistance kernel(shape, tree);
  std::mt19937 random(23);
  std::uniform_int_distribution<int> lattice(-45, 45);
  Tally tally;
  for (int i = 0; i < 220'000; ++i) {
    const int along = i % 3;
    const double sign = i % 2 == 0 ? 1.0 : -1.0;
    const RevolvedPose pose{Vector3d(lattice(random), lattice(random), lattice(random)),
                            sign * Vector3d::Unit(along)};
    const double middle = pose.tip[along] + 0.5 * sign * kHeight;
    const double axial = std::abs(middle) - 0.5 * kHeight - half[along];
    const int u = (along + 1) % 3;
    const int v = (along + 2) % 3;
    const double du = std::abs(pose.tip[u]) - half[u];
    const double dv = std::abs(pose.tip[v]) - half[v];
    const double across = std::hypot(std::max(du, 0.0), std::max(dv, 0.0)) - kRadius;
    const DistanceGoal goal = Goal(i);
    const Interval d = kernel.Surface(pose, goal);
    if (axial >= 0.0 || across >= 0.0) {
      tally.Add(d, std::hypot(std::max(axial, 0.0), std::max(across, 0.0)), goal);
      continue;
    }
    // The cylinder within the box: what is left to the nearest face. Else their surfaces meet.
    const double room = -std::max({axial + kHeight, du + kRadius, dv + kRadius});
    if (room >= 0.0) {
      tally.Add(d, room, goal);
    } else {
      tally.Count(d, -kRadius, goal);
      EXPECT_LE(d.lower, 0.0);
      EXPECT_LE(d.upper, kKernelError + goal.gap);
    }
  }
  tally.Expect("cylinder and box on a lattice", 1e-12);
  EXPECT_GT(tally.touching, 500);
}

/// Golden section.
template <typename Function>
double Least(const Function& f, double lower, double upper) {
  constexpr double kSection = 0.6180339887498949;
  double a = upper - kSection * (upper - lower);
  double b = lower + kSection * (upper - lower);
  double fa = f(a);
  double fb = f(b);
  for (int i = 0; i < 48; ++i) {
    const bool left = fa < fb;
    (left ? upper : lower) = left ? b : a;
    (left ? b : a) = left ? a : b;
    (left ? fb : fa) = left ? fa : fb;
    const double x = left ? upper - kSection * (upper - lower) : lower + kSection * (upper - lower);
    (left ? a : b) = x;
    (left ? fa : fb) = f(x);
  }
  return std::min({fa, fb, f(lower), f(upper)});
}

using PlaneDistance = std::function<double(double z, double r)>;

/// Least distance of a convex solid over triangles, by golden sections within golden sections.
double BruteForce(const std::vector<Triangle>& triangles, const RevolvedPose& pose,
                  const PlaneDistance& convex) {
  const auto distance = [&](const Vector3d& p) {
    const double z = (p - pose.tip).dot(pose.axis);
    return convex(z, (p - pose.tip - z * pose.axis).norm());
  };
  double least = kInfinity;
  for (const Triangle& t : triangles) {
    for (const Vector3d& v : t) least = std::min(least, distance(v));
  }
  for (const Triangle& t : triangles) {
    const Vector3d centre = (t[0] + t[1] + t[2]) / 3.0;
    double radius = 0.0;
    for (const Vector3d& v : t) radius = std::max(radius, (v - centre).norm());
    if (distance(centre) - radius >= least) continue;
    least = std::min(least, Least(
                                [&](double a) {
                                  const Vector3d p = t[0] + a * (t[1] - t[0]);
                                  const Vector3d q = t[0] + a * (t[2] - t[0]);
                                  return Least([&](double b) { return distance(p + b * (q - p)); },
                                               0.0, 1.0);
                                },
                                0.0, 1.0));
  }
  return least;
}

/// A tool as the union of convex solids with closed distances.
struct NamedTool {
  const char* name;
  machine::Profile profile;
  std::vector<PlaneDistance> parts;
};

std::vector<NamedTool> Tools() {
  machine::Profile bull;
  bull.elements.push_back({{0, 0}, {0, 4}, false, {0, 0}});
  bull.elements.push_back({{0, 4}, {2, 6}, true, {2, 4}});
  bull.elements.push_back({{2, 6}, {18, 6}, false, {0, 0}});
  bull.elements.push_back({{18, 6}, {20, 4}, true, {18, 4}});
  bull.elements.push_back({{20, 4}, {20, 0}, false, {0, 0}});
  const PlaneDistance torus = [](double z, double r) {
    return closed::Cylinder(z, r, 2, 18, 4) - 2.0;
  };
  const PlaneDistance cone = [](double z, double r) { return closed::Cone(z, r, 20, 9); };
  std::vector<PlaneDistance> stack;
  const std::array<std::array<double, 3>, 4> steps = {
      {{0, 8, 5}, {8, 12, 11}, {12, 15, 7.5}, {15, 25, 9}}};
  machine::Profile holder;
  for (const auto& [z0, z1, radius] : steps) {
    holder.elements.push_back({{z0, radius}, {z1, radius}, false, {0, 0}});
    stack.emplace_back([z0 = z0, z1 = z1, radius = radius](double z, double r) {
      return closed::Cylinder(z, r, z0, z1, radius);
    });
  }
  for (std::size_t i = holder.elements.size() - 1; i > 0; --i) {
    const machine::ProfileElement face{
        holder.elements[i - 1].end, holder.elements[i].start, false, {0, 0}};
    holder.elements.insert(holder.elements.begin() + static_cast<std::ptrdiff_t>(i), face);
  }
  return {{"bull nose", bull, {torus}},
          {"cone", PolyProfile({{0, 0}, {20, 9}, {20, 0}}), {cone}},
          {"stacked holder", holder, stack}};
}

// The parts' least is the union's distance where it is not negative, and above it where it is.
TEST(KernelConformanceTest, BruteForceInDouble) {
  for (const NamedTool& tool : Tools()) {
    const ProfileShape shape(tool.profile);
    for (const NamedMesh& named : Meshes()) {
      const TriangleTree tree(named.mesh);
      const std::vector<Triangle> triangles = Triangles(named.mesh);
      ProfileDistance kernel(shape, tree);
      std::mt19937 random(24);
      Tally tally;
      const int poses = triangles.size() > 20 ? 100 : 500;
      for (int i = 0; i < poses; ++i) {
        const RevolvedPose pose = AnyPose(random, i, 40.0);
        double truth = kInfinity;
        for (const PlaneDistance& part : tool.parts) {
          truth = std::min(truth, BruteForce(triangles, pose, part));
        }
        // Inside a solid that is not convex only halving helps: the finest goal is not for it.
        DistanceGoal goal = Goal(i);
        if (tool.parts.size() > 1) goal.gap = std::max(goal.gap, 2e-3);
        const Interval d = kernel.Surface(pose, goal);
        // Between two parts, where none is nearer than 0, it may be deep in their union.
        if (truth > 1e-9 || tool.parts.size() == 1) {
          tally.Add(d, truth, goal);
        } else {
          tally.Count(d, truth, goal);
          EXPECT_LE(d.lower, truth) << tool.name << " and " << named.name;
          EXPECT_LE(d.upper, kKernelError + goal.gap);
        }
      }
      tally.Expect(std::string(tool.name) + " and " + named.name, 1e-8);
    }
  }
}

/// Random poses: [lower, upper] holds FCL's distance to the circumscribed mesh, up to the sagitta.
void AgreeWithFcl(const machine::Profile& profile, const machine::TriangleMesh& mesh, int poses,
                  double reach, unsigned seed) {
  constexpr double kLength = 100.0;
  const ProfileShape shape(profile);
  const TriangleTree tree(mesh);
  ProfileDistance kernel(shape, tree);
  const FclMesh fcl_tool(Tessellate(profile, kLength));
  const FclMesh fcl_mesh(mesh);
  std::mt19937 random(seed);
  int hits = 0;
  for (int i = 0; i < poses; ++i) {
    const Eigen::Isometry3d X = RandomPose(random, reach);
    const Interval d = kernel.Surface(ToolPose(X, kLength), {});
    ASSERT_LE(d.lower, d.upper);
    ASSERT_LT(d.upper - d.lower, 0.0021);
    const auto fcl = Distance(fcl_tool, fcl_mesh, X, 1e9);
    const auto hit = Collide(fcl_tool, fcl_mesh, X);
    ASSERT_TRUE(fcl && hit);
    if (d.upper > 0.0) {
      EXPECT_LE(*fcl, d.upper + 1e-6) << i;
      EXPECT_GE(*fcl, d.lower - kSagitta - 1e-6) << i;
    }
    if (d.lower > kSagitta) {
      EXPECT_FALSE(*hit) << i;
    }
    // A mesh that is wholly inside the tool does not meet its surface.
    if (d.upper < -1e-6) ++hits;
    if (d.upper < -1e-6 && d.upper > -0.5) {
      EXPECT_TRUE(*hit) << i;
    }
  }
  EXPECT_GT(hits, poses / 200) << "the poses do not test contact";
}

TEST(KernelConformanceTest, FclBallOnSphere) {
  AgreeWithFcl(BallProfile(6, 60), SphereMesh({0, 0, 0}, 40, 20), 1500, 150, 11);
}
TEST(KernelConformanceTest, FclHolderOnBox) {
  AgreeWithFcl(
      PolyProfile(
          {{20, 0}, {20, 20}, {50, 25}, {50, 31.5}, {60, 31.5}, {60, 22}, {100, 34.9}, {100, 0}}),
      BoxMesh({-30, -60, -20}, {30, 60, 20}), 1500, 120, 12);
}
TEST(KernelConformanceTest, FclConeOnSphere) {
  AgreeWithFcl(PolyProfile({{0, 0}, {40, 25}, {40, 0}}), SphereMesh({5, 0, 0}, 30, 14), 1000, 120,
               13);
}
TEST(KernelConformanceTest, FclBullNoseOnFan) {
  AgreeWithFcl(Tools().front().profile, FanMesh(30, 2, 40), 500, 100, 14);
}

}  // namespace
}  // namespace ncsim::collision
