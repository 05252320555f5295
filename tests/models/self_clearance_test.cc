// SPDX-License-Identifier: BSD-3-Clause
// The metal of models/bc_table_840d keeps clear of itself over all of its travels. Proven by boxes
// and triangles alone, without the collision module: only rotary joints are cut into cells, and
// what a cell can do to a body is kinematics' bound.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <vector>

#include "kinematics/relative_bound.h"
#include "sim/machine/load.h"

namespace ncsim::machine {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

struct Box {
  Eigen::Vector3d lower = Eigen::Vector3d::Constant(kInfinity);
  Eigen::Vector3d upper = Eigen::Vector3d::Constant(-kInfinity);

  void Add(const Eigen::Vector3d& p) {
    lower = lower.cwiseMin(p);
    upper = upper.cwiseMax(p);
  }
  void Grow(const Eigen::Vector3d& by) {
    lower -= by;
    upper += by;
  }
  /// A lower bound of the distance; below 0 where they overlap.
  double Gap(const Box& other) const {
    return (lower - other.upper).cwiseMax(other.lower - upper).maxCoeff();
  }
};

kinematics::Extent ExtentOf(const LinkBody& body) {
  Box box;
  for (const Eigen::Vector3d& v : body.mesh.vertices) box.Add(v);
  return {body.link, 0.5 * (box.lower + box.upper), 0.5 * (box.upper - box.lower).norm()};
}

/// What rotary joint `axis` of the pair can be at: cells of `cell` rad around their middles.
std::vector<double> Cells(const Axis& axis, double* cell) {
  const double lower = std::isinf(axis.lower) ? 0.0 : axis.lower;
  const double upper = std::isinf(axis.lower) ? 2.0 * std::numbers::pi : axis.upper;
  const int count = 60;
  *cell = (upper - lower) / count;
  std::vector<double> middles;
  for (int i = 0; i < count; ++i) middles.push_back(lower + (i + 0.5) * *cell);
  return middles;
}

bool Turns(const Machine& machine, int link) {
  const std::vector<int> joints = machine.tree.MovingJointsTo(link);
  return std::any_of(joints.begin(), joints.end(), [&](int j) {
    return machine.tree.joints()[static_cast<std::size_t>(j)].type ==
           kinematics::JointType::kRevolute;
  });
}

/// A lower bound of the distance of the surfaces of `a` and `b`, which does not turn, over all
/// travels.
double LeastGap(const Machine& machine, const LinkBody& a, const LinkBody& b) {
  const kinematics::RelativePath path(machine.tree, b.link, a.link);
  std::vector<Box> triangles;
  for (const auto& triangle : b.mesh.triangles) {
    for (int i = 0; i < 3; ++i) {
      if (i == 0) triangles.emplace_back();
      triangles.back().Add(b.mesh.vertices[static_cast<std::size_t>(triangle[i])]);
    }
  }
  kinematics::JointVector middle = machine.Home();
  kinematics::JointVector half = kinematics::JointVector::Zero(middle.size());
  Eigen::Vector3d slide = Eigen::Vector3d::Zero();
  std::vector<const Axis*> rotary;
  for (std::size_t k = 0; k < path.joint_indices().size(); ++k) {
    for (const Axis& axis : machine.axes) {
      if (axis.joint != path.joint_indices()[k]) continue;
      if (axis.rotary) rotary.push_back(&axis);
      if (axis.rotary) continue;
      middle[axis.joint] = 0.5 * (axis.lower + axis.upper);
      slide[axis.letter - 'X'] = 0.5 * (axis.upper - axis.lower);
    }
  }
  double least = kInfinity;
  const auto look = [&] {
    const Eigen::Isometry3d X_BA = path.Pose(middle);
    Box box;
    for (const Eigen::Vector3d& v : a.mesh.vertices) box.Add(X_BA * v);
    const double turned = path.Bound(middle, ExtentOf(a), half);
    box.Grow(slide + Eigen::Vector3d::Constant(turned));
    for (const Box& triangle : triangles) least = std::min(least, box.Gap(triangle));
  };
  const std::function<void(std::size_t)> cells = [&](std::size_t k) {
    if (k == rotary.size()) return look();
    double cell = 0.0;
    for (const double at : Cells(*rotary[k], &cell)) {
      middle[rotary[k]->joint] = at;
      half[rotary[k]->joint] = 0.5 * cell;
      cells(k + 1);
    }
  };
  cells(0);
  return least;
}

/// A point of `a` is inside `b` at home (crossings of a ray that no edge of the model runs along).
bool Inside(const Machine& machine, const LinkBody& a, const LinkBody& b) {
  const kinematics::RelativePath path(machine.tree, b.link, a.link);
  const Eigen::Vector3d p = path.Pose(machine.Home()) * a.mesh.vertices.front();
  const Eigen::Vector3d ray(0.5318, 0.6127, 0.5846);
  int crossings = 0;
  for (const auto& triangle : b.mesh.triangles) {
    Eigen::Matrix3d m;
    const Eigen::Vector3d& v0 = b.mesh.vertices[static_cast<std::size_t>(triangle[0])];
    m.col(0) = b.mesh.vertices[static_cast<std::size_t>(triangle[1])] - v0;
    m.col(1) = b.mesh.vertices[static_cast<std::size_t>(triangle[2])] - v0;
    m.col(2) = -ray;
    const Eigen::Vector3d x = m.fullPivLu().solve(p - v0);
    if (x[0] >= 0.0 && x[1] >= 0.0 && x[0] + x[1] <= 1.0 && x[2] > 0.0) ++crossings;
  }
  return crossings % 2 != 0;
}

TEST(BcTableModel, KeepsClearOfItselfOverAllItsTravels) {
  Diagnostics diagnostics;
  const std::optional<Machine> machine = LoadMachine(
      std::string(NCSIM_SOURCE_DIR) + "/models/bc_table_840d/bc_table_840d.urdf", &diagnostics);
  ASSERT_TRUE(machine.has_value());
  double least = kInfinity;
  int pairs = 0;
  for (const LinkBody& first : machine->bodies) {
    for (const LinkBody& second : machine->bodies) {
      if (&first >= &second || machine->Disabled(first.link, second.link)) continue;
      if (kinematics::RelativePath(machine->tree, first.link, second.link).rigid()) continue;
      const bool turned = Turns(*machine, first.link);
      ASSERT_FALSE(turned && Turns(*machine, second.link));
      const LinkBody& a = turned ? first : second;
      const LinkBody& b = turned ? second : first;
      ++pairs;
      const double gap = LeastGap(*machine, a, b);
      EXPECT_GT(gap, 10.0) << a.name << " " << b.name;
      EXPECT_FALSE(Inside(*machine, a, b)) << a.name << " in " << b.name;
      EXPECT_FALSE(Inside(*machine, b, a)) << b.name << " in " << a.name;
      least = std::min(least, gap);
    }
  }
  RecordProperty("pairs", pairs);
  RecordProperty("least_gap_mm", std::to_string(least));
  EXPECT_GT(pairs, 40);
}

}  // namespace
}  // namespace ncsim::machine
