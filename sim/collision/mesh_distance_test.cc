// SPDX-License-Identifier: BSD-3-Clause
// Intervals against brute force in long double over all features of both meshes, closed forms, and
// FCL.
#include "sim/collision/mesh_distance.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <set>
#include <utility>
#include <vector>

#include "sim/collision/engine.h"
#include "sim/collision/fcl_backend.h"
#include "sim/collision/test_shapes.h"

namespace ncsim::collision {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;
using Real = long double;
using Point = Eigen::Matrix<Real, 3, 1>;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

struct Face {
  explicit Face(const std::array<Point, 3>& at) : corners(at) {
    normal = (at[1] - at[0]).cross(at[2] - at[0]).normalized();
    for (std::size_t k = 0; k < 3; ++k) sides[k] = normal.cross(at[(k + 1) % 3] - at[k]);
  }
  std::array<Point, 3> corners, sides;
  Point normal;
};

// A mesh's features where it stands.
struct Features {
  explicit Features(const machine::TriangleMesh& mesh, const Isometry3d& X) {
    const Eigen::Matrix<Real, 3, 3> R = X.linear().cast<Real>();
    const Point p = X.translation().cast<Real>();
    for (const Vector3d& v : mesh.vertices) points.push_back(R * v.cast<Real>() + p);
    std::set<std::pair<int, int>> unique;
    for (const auto& t : mesh.triangles) {
      faces.emplace_back(std::array<Point, 3>{At(t[0]), At(t[1]), At(t[2])});
      for (std::size_t k = 0; k < 3; ++k) unique.insert(std::minmax(t[k], t[(k + 1) % 3]));
    }
    for (const auto& [i, j] : unique) edges.push_back({At(i), At(j)});
  }
  const Point& At(int i) const { return points[static_cast<std::size_t>(i)]; }

  std::vector<Point> points;
  std::vector<std::array<Point, 2>> edges;
  std::vector<Face> faces;
};

Real Clamp(Real x) { return std::clamp<Real>(x, 0, 1); }

// To the foot of the perpendicular, where that is on the face: what lies nearest elsewhere is on an
// edge.
Real PointToFace(const Point& p, const Face& face) {
  for (std::size_t k = 0; k < 3; ++k) {
    if (face.sides[k].dot(p - face.corners[k]) < 0) return kInfinity;
  }
  return std::abs(face.normal.dot(p - face.corners[0]));
}

Real PointToEdge(const Point& p, const std::array<Point, 2>& e) {
  const Point d = e[1] - e[0];
  return (e[0] + Clamp(d.dot(p - e[0]) / d.squaredNorm()) * d - p).norm();
}

// The common perpendicular, where its feet are on the edges.
Real EdgeToEdge(const std::array<Point, 2>& e, const std::array<Point, 2>& f) {
  const Point d = e[1] - e[0];
  const Point g = f[1] - f[0];
  const Point n = d.cross(g);
  const Point r = f[0] - e[0];
  const Real squared = n.squaredNorm();
  const Real s = r.cross(g).dot(n);
  const Real t = r.cross(d).dot(n);
  if (!(s > 0 && s < squared && t > 0 && t < squared)) return kInfinity;
  return std::abs(r.dot(n)) / std::sqrt(squared);
}

bool Pierces(const std::array<Point, 2>& e, const Face& face) {
  const Real from = face.normal.dot(e[0] - face.corners[0]);
  const Real to = face.normal.dot(e[1] - face.corners[0]);
  if ((from > 0) == (to > 0)) return false;
  return PointToFace(e[0] + from / (from - to) * (e[1] - e[0]), face) < kInfinity;
}

Real BruteForce(const Features& a, const Features& b) {
  Real least = kInfinity;
  for (const auto* pair : {&a, &b}) {
    const Features& other = pair == &a ? b : a;
    for (const Face& face : other.faces) {
      for (const Point& p : pair->points) least = std::min(least, PointToFace(p, face));
    }
    for (const auto& e : other.edges) {
      for (const Point& p : pair->points) least = std::min(least, PointToEdge(p, e));
    }
  }
  for (const auto& e : a.edges) {
    for (const auto& f : b.edges) least = std::min(least, EdgeToEdge(e, f));
  }
  for (const auto* pair : {&a, &b}) {
    const Features& other = pair == &a ? b : a;
    for (const auto& e : pair->edges) {
      for (const Face& face : other.faces) {
        if (Pierces(e, face)) return 0;
      }
    }
  }
  return least;
}

machine::TriangleMesh Tetrahedron(std::mt19937& random, const Vector3d& centre) {
  std::uniform_real_distribution<double> uniform(-30.0, 30.0);
  machine::TriangleMesh mesh;
  for (int i = 0; i < 4; ++i) {
    mesh.vertices.emplace_back(centre +
                               Vector3d(uniform(random), uniform(random), uniform(random)));
  }
  mesh.triangles = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}};
  return mesh;
}

// Goals as the sweep sets them, in turn.
DistanceGoal Goal(int i, Real truth) {
  DistanceGoal goal;
  if (i % 4 == 1) goal.relative_gap = 0.2;
  if (i % 4 == 2) goal.stop_above = 0.5 * static_cast<double>(truth) + 1.0;
  if (i % 4 == 3) {
    goal.gap = 1e-5;
    goal.stop_above = 10.0;
  }
  return goal;
}

void ExpectHolds(const Interval& d, const DistanceGoal& goal, Real truth, int i) {
  ASSERT_LE(d.lower, truth) << i;
  if (truth == 0.0) return;
  ASSERT_GE(d.upper, truth) << i;
  const double gap = std::max(goal.gap + 1e-8, goal.relative_gap * (d.lower - goal.floor));
  ASSERT_TRUE(d.upper - d.lower <= gap || d.lower >= goal.stop_above)
      << i << ": " << d.lower << " .. " << d.upper << ", truth " << truth;
}

// Poses about one another, with both meshes far off the origins of their frames: rounding is then
// at its worst.
void AgreeWithBruteForce(const machine::TriangleMesh& a, const machine::TriangleMesh& b,
                         const Vector3d& centre_a, const Vector3d& centre_b, int poses,
                         double reach, std::mt19937& random) {
  const BoxTree tree_a(a);
  const BoxTree tree_b(b);
  MeshDistance kernel(tree_a, tree_b);
  const Features still(b, Isometry3d::Identity());
  int hits = 0;
  for (int i = 0; i < poses; ++i) {
    Isometry3d X = RandomPose(random, reach);
    X.translation() += centre_b - X.linear() * centre_a;
    const Real truth = BruteForce(Features(a, X), still);
    const DistanceGoal goal = Goal(i, truth);
    ExpectHolds(kernel.Surface(X, goal), goal, truth, i);
    hits += truth == 0.0 ? 1 : 0;
  }
  EXPECT_GT(hits, poses / 100) << "the poses do not test contact";
  EXPECT_LT(hits, poses / 2) << "the poses do not test clearance";
}

TEST(MeshDistanceTest, BoxesAgreeWithBruteForce) {
  std::mt19937 random(41);
  const Vector3d centre_a(700, -1300, 400);
  const Vector3d centre_b(-2100, 300, 900);
  const Vector3d half_a(20, 30, 5);
  const Vector3d half_b(11, 7, 40);
  AgreeWithBruteForce(BoxMesh(centre_a - half_a, centre_a + half_a),
                      BoxMesh(centre_b - half_b, centre_b + half_b), centre_a, centre_b, 40000, 80,
                      random);
}

TEST(MeshDistanceTest, TetrahedraAgreeWithBruteForce) {
  std::mt19937 random(42);
  for (int i = 0; i < 300; ++i) {
    AgreeWithBruteForce(Tetrahedron(random, {500, 0, -900}), Tetrahedron(random, {0, 0, 0}),
                        {500, 0, -900}, {0, 0, 0}, 200, 40, random);
  }
}

// Boxes with parallel faces, at places of a lattice: corner to corner, edge along edge, face on
// face, touching in each of them, and one inside the other. The truth is the distance of two
// intervals on each axis.
TEST(MeshDistanceTest, LatticeOfBoxes) {
  const Vector3d half_a(4, 3, 2);
  const Vector3d half_b(10, 12, 14);
  const BoxTree tree_a(BoxMesh(-half_a, half_a));
  const BoxTree tree_b(BoxMesh(-half_b, half_b));
  MeshDistance kernel(tree_a, tree_b);
  for (int place = 0; place < 33 * 33 * 33; ++place) {
    const Vector3d p = Eigen::Vector3i(place % 33, place / 33 % 33, place / 1089).cast<double>() -
                       Vector3d::Constant(16.0);
    for (int turn = 0; turn < 4; ++turn) {
      Isometry3d X = Isometry3d::Identity();
      X.linear() << (turn == 0 ? 1 : 0), (turn == 1 ? -1 : 0), 0, (turn == 1 ? 1 : 0),
          (turn == 0 ? 1 : 0), 0, 0, 0, 1;
      if (turn > 1) {
        X.linear() << 0, 0, (turn == 2 ? 1 : -1), 0, 1, 0, (turn == 2 ? -1 : 1), 0, 0;
      }
      X.translation() = p;
      const Vector3d half = X.linear().cwiseAbs() * half_a;
      const Vector3d apart = (p.cwiseAbs() - half - half_b).cwiseMax(0.0);
      const Vector3d inside = half_b - half - p.cwiseAbs();
      const double truth = inside.minCoeff() > 0.0 ? inside.minCoeff() : apart.norm();
      const Interval d = kernel.Surface(X, {});
      ASSERT_LE(d.lower, truth) << p.transpose() << " turn " << turn;
      if (truth > 0.0) {
        ASSERT_GE(d.upper, truth) << p.transpose();
        ASSERT_LT(d.upper - d.lower, 0.0021) << p.transpose();
      }
    }
  }
}

TEST(MeshDistanceTest, SpheresAgreeWithTheirCentresAndFcl) {
  std::mt19937 random(43);
  const machine::TriangleMesh a = SphereMesh({5, 0, 0}, 25, 16);
  const machine::TriangleMesh b = SphereMesh({0, -7, 0}, 60, 24);
  const BoxTree tree_a(a);
  const BoxTree tree_b(b);
  const FclMesh fcl_a(a);
  const FclMesh fcl_b(b);
  MeshDistance kernel(tree_a, tree_b);
  // Between the sphere and its mesh: half a facet's diagonal at the centre's angle.
  const double sag = 25 * (1 - std::cos(0.14)) + 60 * (1 - std::cos(0.093));
  int clear = 0;
  for (int i = 0; i < 2000; ++i) {
    const Isometry3d X = RandomPose(random, 110);
    const double centres = (X * Vector3d(5, 0, 0) - Vector3d(0, -7, 0)).norm();
    const double spheres = std::max(centres - 85, 35 - centres);  // beside, or inside
    const DistanceGoal goal = Goal(i, std::max(0.0, spheres));
    const Interval d = kernel.Surface(X, goal);
    EXPECT_LE(d.lower, std::max(0.0, spheres + sag));
    if (spheres <= sag) continue;
    ++clear;
    EXPECT_GE(d.upper, spheres - sag);
    const auto fcl = Distance(fcl_a, fcl_b, X, 1e9);
    ASSERT_TRUE(fcl.has_value());
    if (centres < 10) continue;  // all of both is about as near: the search may give up
    ExpectHolds({d.lower, d.upper + 1e-9}, goal, *fcl, i);
  }
  EXPECT_GT(clear, 1000);
}

// Flat on flat, turned against each other: every pair of facets is as near as the next.
TEST(MeshDistanceTest, FlatOnFlat) {
  const BoxTree tree(BoxMesh({-500, -500, -20}, {500, 500, 0}));
  const BoxTree on_top(BoxMesh({-300, -200, 0}, {300, 200, 50}));
  MeshDistance kernel(on_top, tree);
  for (const double gap : {1e-9, 1e-6, 0.001, 0.05, 3.0, 700.0}) {
    Isometry3d X = Isometry3d::Identity();
    X.rotate(Eigen::AngleAxisd(0.7, Vector3d::UnitZ()));
    X.translation() = Vector3d(20, 30, gap);
    const Interval d = kernel.Surface(X, {});
    EXPECT_LE(d.lower, gap);
    EXPECT_GE(d.upper, gap);
    EXPECT_LT(d.upper - d.lower, 0.0021);
  }
}

TEST(MeshDistanceTest, FewEvaluationsAreStillRight) {
  std::mt19937 random(44);
  const BoxTree a(SphereMesh({0, 0, 0}, 25, 16));
  const BoxTree b(SphereMesh({0, 0, 0}, 60, 24));
  MeshDistance fine(a, b);
  for (int i = 0; i < 1000; ++i) {
    const Isometry3d X = RandomPose(random, 150);
    const Interval truth = fine.Surface(X, {});
    MeshDistance coarse(a, b);
    DistanceGoal goal;
    goal.max_evaluations = i % 50;
    Interval d = coarse.Surface(X, goal);
    EXPECT_LE(d.lower, truth.upper);
    EXPECT_GE(d.upper, truth.lower);
    goal = {};
    goal.stop_below = truth.upper + 5.0;
    d = coarse.Surface(X, goal);
    EXPECT_LE(d.lower, truth.upper);
    EXPECT_LT(d.upper, goal.stop_below);
  }
}

// A pose that is no rotation by some rounding still has bounds of what it makes of the mesh.
TEST(MeshDistanceTest, LackOfOrthogonality) {
  std::mt19937 random(45);
  std::uniform_real_distribution<double> uniform(-1e-7, 1e-7);
  const machine::TriangleMesh a = BoxMesh({600, 600, 600}, {640, 620, 650});
  const machine::TriangleMesh b = BoxMesh({0, 0, 0}, {30, 30, 30});
  const BoxTree tree_a(a);
  const BoxTree tree_b(b);
  MeshDistance kernel(tree_a, tree_b);
  for (int i = 0; i < 2000; ++i) {
    Isometry3d X = RandomPose(random, 100);
    X.linear() += Eigen::Matrix3d::NullaryExpr([&] { return uniform(random); });
    X.translation() -= X.linear() * Vector3d(620, 610, 625);
    const Real truth = BruteForce(Features(a, X), Features(b, Isometry3d::Identity()));
    EXPECT_LE(kernel.Surface(X, {}).lower, truth);
  }
}

TEST(MeshDistanceTest, BoxesApart) {
  const BoxTree a(BoxMesh({-1, -1, -1}, {1, 1, 1}));
  const BoxTree b(BoxMesh({-10, -10, -10}, {10, 10, 10}));
  MeshDistance kernel(a, b);
  Isometry3d X = Isometry3d::Identity();
  EXPECT_FALSE(kernel.BoxesApart(X));
  X.translation() = Vector3d(0, 10.9, 0);
  EXPECT_FALSE(kernel.BoxesApart(X));
  X.translation() = Vector3d(0, 11.1, 0);
  EXPECT_TRUE(kernel.BoxesApart(X));
}

std::shared_ptr<const MeshBody> Body(machine::TriangleMesh mesh) {
  machine::SceneBody body;
  body.mesh = std::move(mesh);
  return std::make_shared<const MeshBody>(body);
}

TEST(MeshEngineTest, ClearMeetingInsideAndUnknown) {
  const auto engine =
      MakeEngine(Body(BoxMesh({-1, -1, -1}, {1, 1, 1})), Body(BoxMesh({-9, -9, -9}, {9, 9, 9})));
  Isometry3d X = Isometry3d::Identity();
  EXPECT_TRUE(engine->Contained(X));
  EXPECT_TRUE(engine->Confirms(X));
  EXPECT_NEAR(engine->Clearance(X, {})->lower, 8.0, 0.002);  // of the surfaces
  EXPECT_EQ(engine->Solid(X, {})->upper, 0.0);
  // Through a face, and face on face.
  for (const double at : {9.3, 10.0}) {
    X.translation() = Vector3d(at, 0.2, 0.1);
    EXPECT_LE(engine->Clearance(X, {})->lower, 0.0);
    EXPECT_LE(engine->Clearance(X, {})->upper, 0.0);
    EXPECT_TRUE(engine->Confirms(X));
  }
  X.translation() = Vector3d(10.5, 0, 0);
  EXPECT_NEAR(engine->Clearance(X, {})->lower, 0.5, 0.002);
  EXPECT_FALSE(engine->Contained(X));
  EXPECT_FALSE(engine->Confirms(X));
  X.translation().x() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(engine->Clearance(X, {}).has_value());
  const auto empty = MakeEngine(Body({}), Body(BoxMesh({-9, -9, -9}, {9, 9, 9})));
  EXPECT_FALSE(empty->Clearance(Isometry3d::Identity(), {}).has_value());
}

}  // namespace
}  // namespace ncsim::collision
