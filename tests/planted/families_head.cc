// SPDX-License-Identifier: BSD-3-Clause
// A machine body on the spindle against a body on the table: two meshes. Both are upright prisms,
// so that their distance is that of two convex polygons and two intervals.
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "tests/planted/families.h"

namespace ncsim::planted {

namespace {

using Eigen::AngleAxisd;
using Eigen::Isometry3d;
using Eigen::Translation3d;
using Eigen::Vector2d;
using Eigen::Vector3d;
using Polygon = std::vector<Vector2d>;

constexpr double kTolerance = 1e-3;  // mm

/// Greatest gap between the polygons along a normal of an edge of `a`: minus how deep they are in
/// each other where it is negative for both.
double Gap(const Polygon& a, const Polygon& b) {
  double greatest = -std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < a.size(); ++i) {
    const Vector2d edge = a[(i + 1) % a.size()] - a[i];
    const Vector2d normal = Vector2d(edge.y(), -edge.x()).normalized();
    double least = std::numeric_limits<double>::infinity();
    for (const Vector2d& p : b) least = std::min(least, normal.dot(p - a[i]));
    greatest = std::max(greatest, least);
  }
  return greatest;
}

double CornersToEdges(const Polygon& corners, const Polygon& edges) {
  double least = std::numeric_limits<double>::infinity();
  for (const Vector2d& p : corners) {
    for (std::size_t i = 0; i < edges.size(); ++i) {
      const Vector2d edge = edges[(i + 1) % edges.size()] - edges[i];
      const double along = std::clamp((p - edges[i]).dot(edge) / edge.squaredNorm(), 0.0, 1.0);
      least = std::min(least, (p - edges[i] - along * edge).norm());
    }
  }
  return least;
}

/// Distance, or minus the way to separate them.
double SignedDistance(const Polygon& a, const Polygon& b) {
  const double gap = std::max(Gap(a, b), Gap(b, a));
  return gap <= 0.0 ? gap : std::min(CornersToEdges(a, b), CornersToEdges(b, a));
}

/// A box about the spindle axis from 150 to 150 + height above the tip of the rig's tool.
struct Head {
  double x = 0.0, y = 0.0, height = 0.0;

  machine::TriangleMesh Mesh() const { return collision::BoxMesh({-x, -y, -height}, {x, y, 0.0}); }
  /// `X_GM`: G upright in the machine.
  double Clearance(const Isometry3d& X_GM, const Vector3d& tip_M, const Prism& prism) const {
    Polygon base;
    const double kCorners[4][2] = {{-x, -y}, {x, -y}, {x, y}, {-x, y}};
    for (const auto& corner : kCorners) {
      base.emplace_back((X_GM * Vector3d(tip_M + Vector3d(corner[0], corner[1], 0.0))).head<2>());
    }
    const double bottom = (X_GM * tip_M).z() + collision::Rig::kToolLength;
    const double across = SignedDistance(base, prism.base);
    const double up = std::max(bottom - prism.z1, prism.z0 - bottom - height);
    return std::max(across, up) <= 0.0 ? std::max(across, up)
                                       : std::hypot(std::max(across, 0.0), std::max(up, 0.0));
  }
};

/// B at 0; one motion.
struct Leg {
  AxisPose from, to;
};

struct Scene {
  Table table;
  Isometry3d X_BG = Isometry3d::Identity();
  Head head;
  std::vector<Leg> legs;

  Function Clearance(const Leg& leg, const Prism& prism, const Vector3d& offset) const {
    return [this, &leg, &prism, offset](double u) {
      const double c = leg.from.c_deg + u * (leg.to.c_deg - leg.from.c_deg);
      const Isometry3d X_GM = Translation3d(-offset) * (table.InMachine(0.0, c) * X_BG).inverse();
      return head.Clearance(X_GM, leg.from.tip_M + u * (leg.to.tip_M - leg.from.tip_M), prism);
    };
  }
  double Lipschitz(const Leg& leg) const {
    const double reach = std::hypot(head.x, head.y);
    return Proportional(table, X_BG, leg.from, leg.to, reach).lipschitz;
  }
  /// The gap between the heights, which is linear in u, is never more than the clearance.
  double LeastHeightGap(const Leg& leg, const Prism& prism, const Vector3d& offset) const {
    const double low = std::min(leg.from.tip_M.z(), leg.to.tip_M.z());
    const double underside = low + collision::Rig::kToolLength;
    return underside - (X_BG.translation().z() + offset.z() + prism.z1);
  }
  Bounds Least(const Prism& prism, const Vector3d& offset) const {
    Bounds least{1e300, 1e300};
    for (const Leg& leg : legs) {
      const Function f = Clearance(leg, prism, offset);
      const double floor = std::max(-head.height, LeastHeightGap(leg, prism, offset));
      const Bounds bounds = leg.from.c_deg == leg.to.c_deg
                                ? LeastOfConvex(f, Lipschitz(leg))
                                : planted::Least(f, Lipschitz(leg), floor, kTolerance);
      least.lower = std::min(least.lower, bounds.lower);
      least.upper = std::min(least.upper, bounds.upper);
    }
    return least;
  }
  PairTruth Truth(const Prism& prism, const Vector3d& offset) const {
    PairTruth truth;
    truth.has_depth = false;
    truth.clearance = Least(prism, offset);
    if (truth.clearance.upper > 0.0) return truth;
    for (std::size_t i = 0; i < legs.size() && !truth.first.has_value(); ++i) {
      const Function f = Clearance(legs[i], prism, offset);
      const double lipschitz = Lipschitz(legs[i]);
      const std::optional<Bounds> touch = FirstAtOrBelow(f, lipschitz, 0.0);
      if (!touch.has_value()) continue;
      const double near = FirstAtOrBelow(f, lipschitz, kNearContact)->lower;
      truth.first = FirstContact{static_cast<int>(i), {near, touch->upper}};
    }
    return truth;
  }
};

/// In, C turns, out; the head comes over the body or beside it in the middle of one of them.
Scene RandomScene(Random* random, bool over, bool inside) {
  Scene scene;
  scene.table.pivot_b = random->InBox(200.0);
  scene.table.pivot_c = random->InBox(200.0);
  scene.head = {random->Uniform(10.0, 60.0), random->Uniform(10.0, 60.0),
                random->Uniform(20.0, 80.0)};
  const double angle = random->Uniform(0.0, 2.0 * std::numbers::pi);
  const Vector3d arm = random->Uniform(50.0, 300.0) * Vector3d(std::cos(angle), std::sin(angle), 0);
  scene.X_BG = Translation3d(scene.table.pivot_c + arm) *
               AngleAxisd(random->Uniform(-3.0, 3.0), Vector3d::UnitZ());
  const double c0 = random->Uniform(-180.0, 180.0);
  const double c1 = c0 + random->Uniform(-60.0, 60.0);
  // The tip where the head's underside is at the body's top, or below it, at some C.
  const double meet = random->Chance(0.5) ? c0 : c0 + random->Uniform(0.0, 1.0) * (c1 - c0);
  Vector3d tip = scene.table.InMachine(0.0, meet) * scene.X_BG.translation();
  tip.z() -= collision::Rig::kToolLength + (over ? 0.0 : 5.0) + (inside ? 30.0 : 0.0);
  const double clear = inside ? 0.0 : random->Uniform(100.0, 200.0);
  const AxisPose above{tip + Vector3d(0, 0, clear), 0.0, c0};
  const Vector3d drift = Vector3d(random->Uniform(-50, 50), random->Uniform(-50, 50), 0.0);
  const AxisPose start{tip - drift, 0.0, c0};
  const AxisPose there{tip, 0.0, c0};
  const AxisPose turned{tip, 0.0, c1};
  const AxisPose away{above.tip_M, 0.0, c1};
  scene.legs = {{above, start}, {start, there}, {there, turned}, {turned, away}};
  return scene;
}

}  // namespace

std::optional<Case> HeadOverTable(Random* random, bool hit) {
  const bool inside = hit && random->Chance(0.15);
  const bool over = !inside && random->Chance(0.5);
  const Scene scene = RandomScene(random, over, inside);
  Solid body;
  Vector3d offset = Vector3d::Zero();
  if (inside) {
    body = Block({-400, -400, -100}, {400, 400, 150});
  } else {
    const int sides = 3 + random->Below(12);
    const double size = LogUniform(random, 0.1, 40.0);
    body = PrismSolid(RegularBase(sides, size, random->Uniform(0.0, 6.0)), -40.0, 0.0);
    const Prism& prism = std::get<Prism>(body.parts.front());
    const double turn = random->Uniform(-3.0, 3.0);
    const Vector3d away = over ? Vector3d(0, 0, -1) : Vector3d(std::cos(turn), std::sin(turn), 0);
    const auto tuned = Tune([&](const Vector3d& o) { return scene.Least(prism, o).upper; }, away,
                            RandomTarget(random, hit));
    if (!tuned.has_value()) return std::nullopt;
    offset = *tuned;
  }
  Case c(scene.table);
  c.SetHead(scene.head.Mesh());
  const AxisPose& first = scene.legs.front().from;
  c.rig.Start(first.tip_M.x(), first.tip_M.y(), first.tip_M.z(), 0.0, first.c_deg);
  for (const Leg& leg : scene.legs) {
    const Vector3d& p = leg.to.tip_M;
    c.rig.Linear(motion::MotionKind::kRapid, p.x(), p.y(), p.z(), 0.0, leg.to.c_deg);
  }
  c.AddBody(body, scene.X_BG, offset, scene.Truth(std::get<Prism>(body.parts.front()), offset));
  return c;
}

}  // namespace ncsim::planted
