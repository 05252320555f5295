// SPDX-License-Identifier: BSD-3-Clause
#include "tests/planted/planted_case.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace ncsim::planted {

namespace {

using Eigen::AngleAxisd;
using Eigen::Isometry3d;
using Eigen::Translation3d;
using Eigen::Vector3d;
using machine::BodyKind;

constexpr double kTolerance = 1e-3;  // mm, of a truth that is found by halving

double Lerp(double a, double b, double u) { return a + u * (b - a); }

Function ClearanceOn(const Cutter& cutter, const Course& course, const Part& part,
                     const Vector3d& offset) {
  return [&cutter, &course, &part, offset](double u) {
    ToolPose pose = course.pose(u);
    pose.tip -= offset;
    return Clearance(cutter, pose, part);
  };
}

}  // namespace

Isometry3d Table::InMachine(double b_deg, double c_deg) const {
  return Translation3d(pivot_b) * AngleAxisd(-Radians(b_deg), Vector3d::UnitY()) *
         Translation3d(pivot_c - pivot_b) * AngleAxisd(-Radians(c_deg), Vector3d::UnitZ()) *
         Translation3d(-pivot_c);
}

Bounds LeastClearance(const Cutter& cutter, const std::vector<Course>& courses, const Solid& solid,
                      const Vector3d& offset) {
  Bounds least{1e300, 1e300};
  for (const Course& course : courses) {
    for (const Part& part : solid.parts) {
      const Function f = ClearanceOn(cutter, course, part, offset);
      const Bounds bounds = course.straight
                                ? LeastOfConvex(f, course.lipschitz)
                                : Least(f, course.lipschitz, cutter.Floor(), kTolerance);
      least.lower = std::min(least.lower, bounds.lower);
      least.upper = std::min(least.upper, bounds.upper);
    }
  }
  return least;
}

std::optional<FirstContact> FirstHit(const Cutter& cutter, const std::vector<Course>& courses,
                                     const Solid& solid, const Vector3d& offset) {
  std::optional<FirstContact> first;
  for (const Course& course : courses) {
    for (const Part& part : solid.parts) {
      const Function f = ClearanceOn(cutter, course, part, offset);
      const std::optional<Bounds> touch = FirstAtOrBelow(f, course.lipschitz, 0.0);
      if (!touch.has_value()) continue;
      const double near = FirstAtOrBelow(f, course.lipschitz, kNearContact)->lower;
      const Bounds at{Lerp(course.begin, course.end, near),
                      Lerp(course.begin, course.end, touch->upper)};
      if (!first.has_value() ||
          std::pair(course.motion, at.upper) < std::pair(first->motion, first->at.upper)) {
        first = FirstContact{course.motion, at};
      }
    }
  }
  return first;
}

std::optional<Vector3d> Tune(const std::function<double(const Vector3d&)>& clearance_at,
                             const Vector3d& away, double target) {
  const double enough = std::max(1e-4, 0.05 * std::abs(target));
  double shift = 0.0;
  double value = clearance_at(Vector3d::Zero());
  double slope = 1.0;
  for (int i = 0; i < 40; ++i) {
    if (std::abs(value - target) <= enough) return shift * away;
    const double step = (target - value) / slope;
    const double next = clearance_at((shift + step) * away);
    slope = std::clamp((next - value) / step, 0.4, 2.0);
    shift += step;
    value = next;
  }
  return std::nullopt;
}

std::optional<Vector3d> Tune(const Cutter& cutter, const std::vector<Course>& courses,
                             const Solid& solid, const Vector3d& away, double target) {
  return Tune(
      [&](const Vector3d& offset) { return LeastClearance(cutter, courses, solid, offset).upper; },
      away, target);
}

void Case::SetTool(const Cutter& the_cutter, BodyKind kind, int number) {
  cutter = the_cutter;
  tool = number;
  machine::Tool& data = rig.AddTool(number, {}, {}, {});
  (kind == BodyKind::kFlutes  ? data.flutes
   : kind == BodyKind::kShank ? data.shank
                              : data.holder) = cutter.Profile();
  rig.facts().tool = number;
}

void Case::SetHead(const machine::TriangleMesh& head_S) {
  head = head_S;
  tool = 0;
  rig.facts().tool = 0;
  rig.AddBody("head", BodyKind::kMachine, head, rig.machine().spindle_link);
}

void Case::AddBody(const Solid& solid, const Isometry3d& X_BG, const Vector3d& offset,
                   const std::vector<Course>& courses) {
  PairTruth truth;
  truth.clearance = LeastClearance(cutter, courses, solid, offset);
  if (truth.clearance.upper <= 0.0) truth.first = FirstHit(cutter, courses, solid, offset);
  AddBody(solid, X_BG, offset, truth);
}

void Case::AddBody(const Solid& solid, const Isometry3d& X_BG, const Vector3d& offset,
                   const PairTruth& truth) {
  machine::TriangleMesh mesh = solid.mesh;
  for (Vector3d& v : mesh.vertices) v = X_BG * (v + offset);
  mesh.watertight = true;
  pairs.push_back(truth);
  pairs.back().body = "body_" + std::to_string(pairs.size());
  rig.AddBody(pairs.back().body, BodyKind::kFixture, std::move(mesh));
}

Upright::Upright(Random* random) {
  table.pivot_b = random->InBox(200.0);
  table.pivot_c = random->InBox(200.0);
  b_deg = random->Uniform(-110.0, 110.0);
  c_deg = random->Uniform(-360.0, 360.0);
  X_MG = Translation3d(random->InBox(300.0)) *
         AngleAxisd(random->Uniform(-3.0, 3.0), Vector3d::UnitZ());
}

void Upright::Start(Case* c, const Vector3d& tip_G) const {
  const Vector3d p = X_MG * tip_G;
  c->rig.Start(p.x(), p.y(), p.z(), b_deg, c_deg);
}

void Upright::Go(Case* c, motion::MotionKind kind, const Vector3d& tip_G) const {
  const Vector3d p = X_MG * tip_G;
  c->rig.Linear(kind, p.x(), p.y(), p.z(), b_deg, c_deg);
}

Course Straight(const Vector3d& tip0_G, const Vector3d& tip1_G, int motion) {
  Course course;
  course.pose = [tip0_G, tip1_G](double u) {
    return ToolPose{tip0_G + u * (tip1_G - tip0_G), Vector3d::UnitZ()};
  };
  course.lipschitz = (tip1_G - tip0_G).norm();
  course.straight = true;
  course.motion = motion;
  return course;
}

Course Proportional(const Table& table, const Isometry3d& X_BG, const AxisPose& from,
                    const AxisPose& to, double reach) {
  const Isometry3d X_GB = X_BG.inverse();
  const bool upright = from.b_deg == 0.0 && to.b_deg == 0.0 &&
                       (X_BG.linear().col(2) - Vector3d::UnitZ()).norm() < 1e-12;
  Course course;
  course.pose = [=](double u) {
    const Isometry3d X_GM =
        X_GB *
        table.InMachine(Lerp(from.b_deg, to.b_deg, u), Lerp(from.c_deg, to.c_deg, u)).inverse();
    ToolPose pose;
    pose.tip = X_GM * Vector3d(from.tip_M + u * (to.tip_M - from.tip_M));
    if (!upright) pose.axis = X_GM.linear() * Vector3d::UnitZ();
    return pose;
  };
  // A point of the tool is at most this far from the B axis, and `between` further from the C axis.
  const double arm =
      std::max((from.tip_M - table.pivot_b).norm(), (to.tip_M - table.pivot_b).norm()) + reach;
  const double between = (table.pivot_c - table.pivot_b).norm();
  course.lipschitz = (to.tip_M - from.tip_M).norm() +
                     std::abs(Radians(to.b_deg - from.b_deg)) * arm +
                     std::abs(Radians(to.c_deg - from.c_deg)) * (arm + between);
  return course;
}

Course TcpStraight(const Isometry3d& X_BG, const Vector3d& p0_B, const Vector3d& p1_B,
                   const AxisPose& from, const AxisPose& to, double reach) {
  const Isometry3d X_GB = X_BG.inverse();
  Course course;
  course.pose = [=](double u) {
    const double b = Radians(Lerp(from.b_deg, to.b_deg, u));
    const double c = Radians(Lerp(from.c_deg, to.c_deg, u));
    const Vector3d axis_B(std::cos(c) * std::sin(b), std::sin(c) * std::sin(b), std::cos(b));
    return ToolPose{X_GB * Vector3d(p0_B + u * (p1_B - p0_B)), X_GB.linear() * axis_B};
  };
  // |d axis / du| <= hypot(db, dc): spherical coordinates.
  course.lipschitz = (p1_B - p0_B).norm() + reach * std::hypot(Radians(to.b_deg - from.b_deg),
                                                               Radians(to.c_deg - from.c_deg));
  return course;
}

double LogUniform(Random* random, double lower, double upper) {
  return std::exp(random->Uniform(std::log(lower), std::log(upper)));
}

double RandomTarget(Random* random, bool hit, double deepest) {
  if (hit) return -LogUniform(random, 0.001, deepest);
  return random->Chance(0.05) ? random->Uniform(0.002, 0.0195) : LogUniform(random, 0.0215, 2.0);
}

Cutter RandomCutter(Random* random, double least_radius, double greatest_radius) {
  Cutter cutter;
  cutter.radius = random->Uniform(least_radius, greatest_radius);
  cutter.z1 = random->Uniform(30.0, 90.0);
  const int type = random->Below(4);
  if (type == 1) cutter.corner = random->Uniform(0.1, 0.9) * cutter.radius;
  if (type == 2) cutter.corner = cutter.radius;
  return cutter;
}

BodyKind RandomKind(Random* random) {
  constexpr BodyKind kKinds[] = {BodyKind::kFlutes, BodyKind::kShank, BodyKind::kHolder};
  return kKinds[random->Below(3)];
}

motion::MotionKind RandomMotion(Random* random) {
  return random->Chance(0.5) ? motion::MotionKind::kFeed : motion::MotionKind::kRapid;
}

}  // namespace ncsim::planted
