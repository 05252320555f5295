// SPDX-License-Identifier: BSD-3-Clause
// Moves with a turning table: tools and bodies whose clearance at a pose is a closed form, and a
// Lipschitz constant over the motion.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "tests/planted/families.h"

namespace ncsim::planted {

namespace {

using Eigen::AngleAxisd;
using Eigen::Isometry3d;
using Eigen::Translation3d;
using Eigen::Vector3d;
using motion::MotionKind;

constexpr double kPi = std::numbers::pi;

Cutter Capsule(Random* random, double z0) {
  Cutter capsule{z0, 0.0, random->Uniform(1.0, 6.0), 0.0, true};
  capsule.corner = capsule.radius;
  capsule.z1 = z0 + 2.0 * capsule.radius + random->Uniform(0.0, 60.0);
  return capsule;
}

double ReachOf(const Cutter& cutter) { return std::hypot(cutter.z1, cutter.radius); }

Isometry3d RandomOrientation(Random* random) { return Isometry3d(random->Pose(1.0).linear()); }

Solid RandomBox(Random* random, double greatest) {
  const Vector3d half(LogUniform(random, 0.05, greatest), LogUniform(random, 0.05, greatest),
                      LogUniform(random, 0.05, greatest));
  return Block(-half, half);
}

/// Direction in G across the way that point `height` of the axis goes at u, and across the axis.
Vector3d Across(const Course& course, double u, double height, Random* random) {
  const auto point = [&](double at) {
    const ToolPose pose = course.pose(at);
    return Vector3d(pose.tip + height * pose.axis);
  };
  const Vector3d way = point(std::min(1.0, u + 1e-4)) - point(std::max(0.0, u - 1e-4));
  const Vector3d axis = course.pose(u).axis;
  const Vector3d across = way.cross(axis);
  if (across.norm() < 1e-9) return axis.cross(random->Direction()).normalized();
  return across.normalized() * (random->Chance(0.5) ? 1.0 : -1.0);
}

bool Plant(const Solid& solid, const Isometry3d& X_BG, const std::vector<Course>& courses,
           const Vector3d& away, double target, Case* c) {
  const auto offset = Tune(c->cutter, courses, solid, away, target);
  if (offset.has_value()) c->AddBody(solid, X_BG, *offset, courses);
  return offset.has_value();
}

void Program(MotionKind kind, const AxisPose& from, const AxisPose& to, Case* c) {
  c->rig.Start(from.tip_M.x(), from.tip_M.y(), from.tip_M.z(), from.b_deg, from.c_deg);
  c->rig.Linear(kind, to.tip_M.x(), to.tip_M.y(), to.tip_M.z(), to.b_deg, to.c_deg);
}

struct Turn {
  Table table;
  AxisPose from, to;
  double u = 0.0;  // where on it the tool meets the body
};

/// The axis positions about those at u, where the tip is at `tip_M`.
void MoveThrough(const Vector3d& tip_M, const Vector3d& way, Turn* turn) {
  turn->from.tip_M = tip_M - turn->u * way;
  turn->to.tip_M = tip_M + (1.0 - turn->u) * way;
}

/// B at 0: the tool stays upright on the body. The body is `radius` from the C axis.
struct UprightTurn : Turn {
  Isometry3d X_BG;
  UprightTurn(Random* random, double c0_deg, double c1_deg, double radius, bool over,
              const Vector3d& way) {
    table.pivot_b = random->InBox(300.0);
    table.pivot_c = random->InBox(300.0);
    from.c_deg = c0_deg;
    to.c_deg = c1_deg;
    u = random->Uniform(0.0, 1.0);
    const double angle = random->Uniform(-kPi, kPi);
    const Vector3d p_B = table.pivot_c + radius * Vector3d(std::cos(angle), std::sin(angle), 0) +
                         Vector3d(0, 0, random->Uniform(-50.0, 50.0));
    X_BG = Translation3d(p_B) * AngleAxisd(random->Uniform(-3.0, 3.0), Vector3d::UnitZ());
    const Vector3d tip_B = p_B - Vector3d(0, 0, over ? 0.0 : 8.0);
    MoveThrough(table.InMachine(0.0, c0_deg + u * (c1_deg - c0_deg)) * tip_B, way, this);
  }
};

Solid RandomPost(Random* random) {
  const double size = LogUniform(random, 0.1, 10.0);
  if (random->Chance(0.5)) {
    return PrismSolid(RegularBase(3 + random->Below(22), size, random->Uniform(0.0, 6.0)), -30, 0);
  }
  return Block({-LogUniform(random, 0.025, 2.0), -size, -30}, {0, size, 0});
}

/// Planted on `planned`, run as `run` (which may turn elsewhere).
std::optional<Case> PlantUpright(const UprightTurn& planned, const UprightTurn& run, bool over,
                                 double target, Random* random) {
  Case c(run.table);
  c.SetTool(RandomCutter(random, 0.5, 8.0), RandomKind(random));
  Program(RandomMotion(random), run.from, run.to, &c);
  const auto course = [&c](const UprightTurn& turn) {
    return Proportional(turn.table, turn.X_BG, turn.from, turn.to, ReachOf(c.cutter));
  };
  const Vector3d away = over ? Vector3d(0, 0, -1) : Across(course(planned), planned.u, 0.0, random);
  const Solid post = RandomPost(random);
  const auto offset = Tune(c.cutter, {course(planned)}, post, away, target);
  if (!offset.has_value()) return std::nullopt;
  c.AddBody(post, run.X_BG, *offset, {course(run)});
  return c;
}

/// A sphere or capsule, B, C and the linear axes moving: any orientation.
std::optional<Case> FarTilted(Random* random, bool hit) {
  Turn turn;
  turn.table.pivot_b = random->Uniform(300.0, 900.0) * random->Direction();
  turn.table.pivot_c = turn.table.pivot_b + random->InBox(300.0);
  turn.u = random->Uniform(0.0, 1.0);
  turn.from.b_deg = random->Uniform(-60.0, 60.0);
  turn.to.b_deg = turn.from.b_deg + random->Uniform(-40.0, 40.0);
  turn.from.c_deg = random->Uniform(-180.0, 180.0);
  turn.to.c_deg = turn.from.c_deg + random->Uniform(-120.0, 120.0);
  MoveThrough(random->InBox(100.0), random->Chance(0.5) ? random->InBox(60.0) : Vector3d::Zero(),
              &turn);
  Case c(turn.table);
  c.SetTool(Capsule(random, random->Uniform(0.0, 40.0)), RandomKind(random));
  Program(RandomMotion(random), turn.from, turn.to, &c);
  const double reach = ReachOf(c.cutter);
  const Course in_table =
      Proportional(turn.table, Isometry3d::Identity(), turn.from, turn.to, reach);
  const ToolPose there = in_table.pose(turn.u);
  const double height = random->Uniform(c.cutter.z0, c.cutter.z1);
  const Isometry3d X_BG =
      Translation3d(there.tip + height * there.axis) * RandomOrientation(random);
  const Course course = Proportional(turn.table, X_BG, turn.from, turn.to, reach);
  const double target = RandomTarget(random, hit, 0.4 * c.cutter.radius);
  const Vector3d away = Across(course, turn.u, height, random);
  if (!Plant(RandomBox(random, 8.0), X_BG, {course}, away, target, &c)) return std::nullopt;
  return c;
}

struct TcpMove {
  Table table;
  AxisPose from, to;
  Vector3d p0_B, p1_B;

  explicit TcpMove(Random* random) {
    table.pivot_b = random->InBox(200.0);
    table.pivot_c = random->InBox(200.0);
    from.b_deg = random->Uniform(-70.0, 70.0);
    to.b_deg = std::clamp(from.b_deg + random->Uniform(-60.0, 60.0), -80.0, 80.0);
    from.c_deg = random->Uniform(-180.0, 180.0);
    to.c_deg = from.c_deg + (random->Chance(0.7) ? random->Uniform(-90.0, 90.0) : 0.0);
    p0_B = random->InBox(150.0);
    p1_B = p0_B + (random->Chance(0.7) ? random->InBox(40.0) : Vector3d::Zero());
  }
  Course In(const Isometry3d& X_BG, const Cutter& cutter) const {
    return TcpStraight(X_BG, p0_B, p1_B, from, to, ReachOf(cutter));
  }
  void Program(Case* c) const {
    c->rig.Tcp(p0_B, p1_B, from.b_deg, from.c_deg, to.b_deg, to.c_deg);
  }
};

/// The rim of a cylindrical holder over a plate.
std::optional<Case> TcpOverPlate(const TcpMove& move, Random* random, bool hit) {
  Case c(move.table);
  Cutter holder{random->Uniform(20.0, 70.0), 0.0, random->Uniform(8.0, 30.0), 0.0, false};
  holder.z1 = holder.z0 + random->Uniform(20.0, 60.0);
  c.SetTool(holder, machine::BodyKind::kHolder);
  move.Program(&c);
  const Vector3d axis = move.In(Isometry3d::Identity(), holder).pose(random->Uniform(0, 1)).axis;
  const Vector3d tilt = axis.cross(random->Direction()).normalized();
  const Vector3d normal = AngleAxisd(Radians(random->Uniform(20.0, 75.0)), tilt) * axis;
  Isometry3d X_BG = Isometry3d::Identity();
  X_BG.linear() = Eigen::Quaterniond::FromTwoVectors(Vector3d::UnitZ(), normal).toRotationMatrix();
  X_BG.translation() = move.p0_B;
  const double target = RandomTarget(random, hit, 2.0);
  if (!Plant(Plate(600.0, 30.0), X_BG, {move.In(X_BG, holder)}, {0, 0, -1}, target, &c)) {
    return std::nullopt;
  }
  return c;
}

}  // namespace

std::optional<Case> TcpDip(Random* random, bool hit) {
  const TcpMove move(random);
  if (random->Chance(0.4)) return TcpOverPlate(move, random, hit);
  Case c(move.table);
  c.SetTool(Capsule(random, random->Uniform(20.0, 80.0)), RandomKind(random));
  move.Program(&c);
  const double u = random->Uniform(0.0, 1.0);
  const double height = random->Uniform(c.cutter.z0, c.cutter.z1);
  const ToolPose there = move.In(Isometry3d::Identity(), c.cutter).pose(u);
  const Isometry3d X_BG =
      Translation3d(there.tip + height * there.axis) * RandomOrientation(random);
  const Course course = move.In(X_BG, c.cutter);
  const double target = RandomTarget(random, hit, 0.4 * c.cutter.radius);
  const Vector3d away = Across(course, u, height, random);
  if (!Plant(RandomBox(random, 20.0), X_BG, {course}, away, target, &c)) return std::nullopt;
  return c;
}

std::optional<Case> FarRotation(Random* random, bool hit) {
  if (random->Chance(0.5)) return FarTilted(random, hit);
  const double c0 = random->Uniform(-180.0, 180.0);
  const double sweep = random->Uniform(5.0, 180.0) * (random->Chance(0.5) ? 1.0 : -1.0);
  const bool over = random->Chance(0.4);
  const Vector3d way = random->Chance(0.5)
                           ? Vector3d(random->Uniform(-60, 60), random->Uniform(-60, 60), 0)
                           : Vector3d::Zero();
  const double radius = random->Uniform(200.0, 900.0);
  const UprightTurn turn(random, c0, c0 + sweep, radius, over, way);
  return PlantUpright(turn, turn, over, RandomTarget(random, hit, 0.2), random);
}

// C over the wrap: the short way and the long way round between the same directions. A near miss of
// the short way may be a hit of the long one.
std::optional<Case> WrapAt360(Random* random, bool hit) {
  const double near = random->Uniform(0.5, 3.0);
  const double sign = random->Chance(0.5) ? 1.0 : -1.0;
  const double turns = 360.0 * random->Below(2);
  const double c0 = turns - sign * near;
  const double c_short = turns + sign * near;
  const double c_long = c_short - sign * 360.0;
  const bool over = random->Chance(0.3);
  const double radius = random->Uniform(20.0, 300.0);
  const int kind = random->Below(3);
  if (hit || kind > 0) {
    const UprightTurn turn(random, c0, kind == 1 ? c_short : c_long, radius, over,
                           Vector3d::Zero());
    return PlantUpright(turn, turn, over, RandomTarget(random, hit, 0.2), random);
  }
  const UprightTurn planned(random, c0, c_long, radius, over, Vector3d::Zero());
  UprightTurn run = planned;
  run.to.c_deg = c_short;
  std::optional<Case> c = PlantUpright(planned, run, over, -0.1, random);
  if (c.has_value() && c->pairs.front().clearance.lower <= 0.0) return std::nullopt;
  return c;
}

}  // namespace ncsim::planted
