// SPDX-License-Identifier: BSD-3-Clause
// Random motions of every kind, for property tests.
#pragma once

#include <cmath>
#include <memory>
#include <string>
#include <utility>

#include "kinematics/test_machines.h"
#include "sim/motion/motion.h"

namespace ncsim::motion {

using kinematics::Random;
using kinematics::TestMachine;

inline Motion MakeMotion(Path path) {
  Motion motion;
  motion.path = std::move(path);
  return motion;
}

/// Copies the arc's words that AxisArc and TcpCurve share: a random circle or helix of up to a turn
/// and a half.
template <class Curve>
void MakeArc(Random* random, double scale, Curve* curve) {
  curve->e1 = random->Direction();
  curve->e2 = curve->e1.cross(random->Direction()).normalized();
  curve->centre = random->InBox(200.0);
  curve->radius = random->Uniform(1.0, 150.0);
  curve->phi0 = random->Uniform(-4.0, 4.0);
  curve->sweep = scale * random->Uniform(-9.0, 9.0);
  curve->pitch = scale * random->Uniform(-50.0, 50.0) * curve->e1.cross(curve->e2);
  curve->end_error = scale * random->InBox(0.05);
}

inline JointVector Nudge(Random* random, const kinematics::KinematicTree& tree,
                         const JointVector& q0, double scale) {
  JointVector q1(q0.size());
  for (int i = 0; i < tree.num_moving(); ++i) {
    q1[i] = q0[i];
    if (random->Chance(0.2)) continue;
    const bool revolute =
        tree.joints()[tree.moving_joints()[i]].type == kinematics::JointType::kRevolute;
    q1[i] += scale * random->Uniform(-1.0, 1.0) * (revolute ? 2.0 : 300.0);
  }
  return q1;
}

inline DogLeg RandomDogLeg(Random* random, const kinematics::KinematicTree& tree, JointVector q0,
                           JointVector q1) {
  DogLeg path;
  const Eigen::Index count = q0.size();
  path.duration = JointVector::Zero(count);
  path.ramp = JointVector::Zero(count);
  const bool alike = random->Chance(0.5);  // linear axes of one rate and acceleration
  const double common_rate = random->Uniform(50.0, 500.0);
  const double common_ramp = random->Uniform(0.0, 0.5);
  for (int i = 0; i < tree.num_moving(); ++i) {
    const bool revolute =
        tree.joints()[tree.moving_joints()[i]].type == kinematics::JointType::kRevolute;
    const bool own = revolute || !alike;
    const double own_rate = revolute ? random->Uniform(0.3, 3.0) : random->Uniform(50.0, 500.0);
    path.ramp[i] = own ? random->Uniform(0.0, 0.5) : common_ramp;
    path.duration[i] = std::abs(q1[i] - q0[i]) / (own ? own_rate : common_rate);
  }
  path.q0 = std::move(q0);
  path.q1 = std::move(q1);
  return path;
}

enum class PathKind { kAxisLinear, kDogLeg, kAxisArc, kTcpLine, kTcpArc, kTcpCircle };
inline constexpr PathKind kPathKinds[] = {PathKind::kAxisLinear, PathKind::kDogLeg,
                                          PathKind::kAxisArc,    PathKind::kTcpLine,
                                          PathKind::kTcpArc,     PathKind::kTcpCircle};

inline std::string ToString(PathKind kind) {
  switch (kind) {
    case PathKind::kAxisLinear:
      return "AxisLinear";
    case PathKind::kDogLeg:
      return "DogLeg";
    case PathKind::kAxisArc:
      return "AxisArc";
    case PathKind::kTcpLine:
      return "TcpLine";
    case PathKind::kTcpArc:
      return "TcpArc";
    case PathKind::kTcpCircle:
      return "TcpGreatCircle";
  }
  return "";
}

/// Leads the tool axis along the great circle from q0 towards q1; a curve that cannot be led so is
/// left as it is.
inline void MakeGreatCircle(TcpCurve* curve) {
  const std::vector<int>& rotary = curve->frame->control.rotary();
  auto circle = std::make_shared<kinematics::GreatCircle>();
  const auto fault = kinematics::GreatCircle::Make(
      curve->frame->control, {curve->q0[rotary[0]], curve->q0[rotary[1]]},
      {curve->q1[rotary[0]], curve->q1[rotary[1]]}, circle.get());
  if (fault != kinematics::GreatCircle::Fault::kNone) return;
  for (std::size_t k = 0; k < 2; ++k) {
    curve->q0[rotary[k]] = circle->start()[k];
    curve->q1[rotary[k]] = circle->end()[k];
  }
  curve->great_circle = std::move(circle);
}

/// `scale` 1: up to some hundred mm and 2 rad. TCP curves are computed by `control`.
inline Motion RandomMotion(Random* random, PathKind kind, const TestMachine& machine,
                           const std::shared_ptr<const TcpFrame>& frame, double scale) {
  const JointVector q0 = RandomPosition(random, machine.tree);
  const JointVector q1 = Nudge(random, machine.tree, q0, scale);
  if (kind == PathKind::kAxisLinear) return MakeMotion(AxisLinear{q0, q1});
  if (kind == PathKind::kDogLeg) {
    return MakeMotion(RandomDogLeg(random, machine.tree, q0, q1));
  }
  if (kind == PathKind::kAxisArc) {
    AxisArc arc;
    arc.q0 = q0;
    arc.q1 = q1;
    MakeArc(random, scale, &arc);
    for (std::size_t i = 0; i < 3; ++i) arc.linear[i] = frame->control.linear()[i];
    Motion motion = MakeMotion(arc);
    auto& path = std::get<AxisArc>(motion.path);
    const JointVector begin = motion.At(0.0);
    path.q1 = motion.At(1.0);
    path.q0 = begin;
    return motion;
  }
  TcpCurve curve;
  curve.frame = frame;
  curve.q0 = q0;
  curve.q1 = q1;
  curve.arc = kind == PathKind::kTcpArc || (kind == PathKind::kTcpCircle && random->Chance(0.5));
  if (kind == PathKind::kTcpCircle) MakeGreatCircle(&curve);
  MakeArc(random, scale, &curve);
  curve.p0_B = random->InBox(200.0);
  curve.p1_B = curve.p0_B + scale * random->InBox(100.0);
  Motion motion = MakeMotion(curve);
  auto& path = std::get<TcpCurve>(motion.path);
  const JointVector begin = motion.At(0.0);
  path.q1 = motion.At(1.0);
  path.q0 = begin;
  return motion;
}

/// Part of the whole motion; a point of it now and then.
inline Span RandomSpan(Random* random, const Motion& motion) {
  Span span = Whole(motion);
  const auto part = [&](double* lower, double* upper) {
    const double width = (*upper - *lower) * std::pow(10.0, random->Uniform(-3.0, 0.0));
    *lower = random->Uniform(*lower, *upper - width);
    *upper = *lower + width;
  };
  if (random->Chance(0.8)) part(&span.s0, &span.s1);
  if (random->Chance(0.8)) part(&span.lag0, &span.lag1);
  return span;
}

}  // namespace ncsim::motion
