// SPDX-License-Identifier: BSD-3-Clause
#include "sim/app/nominal.h"

#include <algorithm>
#include <string>

#include "sim/base/text.h"

namespace ncsim::app {
namespace {

/// Different poses that are looked at; a program that changes tools in more places repeats itself.
constexpr std::size_t kMaxPoses = 200;

bool IsMachineBody(const machine::Scene& scene, const std::string& name) {
  return std::any_of(scene.bodies.begin(), scene.bodies.end(), [&](const machine::SceneBody& body) {
    return body.kind == machine::BodyKind::kMachine && body.name == name;
  });
}

/// The nearest of the clearances that `concerns`, if nearer than the margin.
template <typename Concerns>
const collision::PairClearance* NearestWithinMargin(
    const std::vector<collision::PairClearance>& clearances, const Concerns& concerns) {
  const collision::PairClearance* nearest = nullptr;
  for (const collision::PairClearance& clearance : clearances) {
    // Written so that a number that is not known counts as near.
    if (clearance.proven_mm >= machine::kNominalMargin || !concerns(clearance)) continue;
    if (nearest == nullptr || clearance.seen_mm < nearest->seen_mm) nearest = &clearance;
  }
  return nearest;
}

std::string Where(const collision::PairClearance& clearance) {
  std::string text;
  for (const std::string& body : clearance.bodies) text += (text.empty() ? "" : " and ") + body;
  return text + " come within " + Fixed(std::max(0.0, clearance.seen_mm), 2) + " mm at line " +
         std::to_string(clearance.where.line);
}

}  // namespace

std::vector<Assumption> NominalShapes(const machine::Machine& machine, const machine::Scene& scene,
                                      const std::vector<collision::PairClearance>& clearances) {
  if (!machine.nominal_shapes) return {};
  const collision::PairClearance* nearest =
      NearestWithinMargin(clearances, [&](const collision::PairClearance& clearance) {
        return std::any_of(clearance.bodies.begin(), clearance.bodies.end(),
                           [&](const std::string& name) { return IsMachineBody(scene, name); });
      });
  if (nearest == nullptr) return {};
  return {{"nominal shapes",
           "the shapes of " + machine.name + " are nominal, not measured, and " + Where(*nearest),
           true, false}};
}

void ToolChangePoses::OnMotion(const motion::Motion& motion) {
  if (motion.kind == motion::MotionKind::kToolChange) {
    change_ = motion;
    waiting_ = true;
    Add(change_, motion.facts.tool);
  } else if (waiting_) {
    waiting_ = false;
    if (motion.facts.tool != change_.facts.tool) Add(change_, motion.facts.tool);
  }
}

void ToolChangePoses::Add(const motion::Motion& change, int tool) {
  const bool known =
      std::any_of(poses_.motions.begin(), poses_.motions.end(), [&](const motion::Motion& pose) {
        return pose.facts.tool == tool && (pose.q1() - change.q1()).cwiseAbs().maxCoeff() < 1e-9;
      });
  if (known || poses_.motions.size() >= kMaxPoses) return;
  motion::Motion pose = change;
  pose.path = motion::AxisLinear{change.q1(), change.q1()};
  pose.facts.tool = tool;
  poses_.motions.push_back(std::move(pose));
}

std::vector<Assumption> NominalToolChange(const machine::Machine& machine,
                                          const machine::Scene& scene,
                                          const machine::ToolTable& tools,
                                          const ToolChangePoses& poses) {
  if (!machine.control.tool_change_nominal || poses.poses().motions.empty()) return {};
  if (machine.control.tool_change_pose.empty()) return {};
  machine::CheckSettings settings;
  settings.clearance = machine::kNominalMargin;
  collision::CollisionChecker checker(machine, scene, tools, settings);
  checker.Check(poses.poses());
  const collision::CollisionResult result = checker.Finish();
  // Two bodies of the machine are where they are in any pose near this one: not the pose's doing.
  const collision::PairClearance* nearest =
      NearestWithinMargin(result.clearances, [&](const collision::PairClearance& clearance) {
        return !std::all_of(clearance.bodies.begin(), clearance.bodies.end(),
                            [&](const std::string& name) { return IsMachineBody(scene, name); });
      });
  if (nearest == nullptr) return {};
  return {{"tool-change pose",
           "the place where the machine changes tools is nominal, not measured, and there " +
               Where(*nearest),
           true, false}};
}

}  // namespace ncsim::app
