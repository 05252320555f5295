// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>

#include "sim/base/run_finding.h"
#include "sim/base/text.h"
#include "sim/base/units.h"
#include "sim/checks/check.h"

namespace ncsim::checks {
namespace {

constexpr double kCone = Radians(1.0);
constexpr double kSwing = Radians(90.0);
/// rad: rounding of a turn that was programmed as exactly 90 degrees.
constexpr double kRounding = 1e-9;

class SingularityCheck : public Check {
 public:
  explicit SingularityCheck(const machine::Machine& machine) : machine_(&machine) {}

  void OnMotion(const motion::Motion& motion, std::vector<Finding>* findings) override {
    if (!IsFeed(motion)) return;
    const machine::Axis* swinging = motion.facts.tcp ? Swinging(motion) : nullptr;
    if (swinging == nullptr) {
      run_.Close(findings);
      return;
    }
    if (!run_.open()) {
      const double turn = motion.q1()[swinging->joint] - motion.q0()[swinging->joint];
      run_.Start(FindingAt(
          *machine_, Rule::kSingularity, motion, 0.0,
          std::string("axis ") + swinging->letter + " turns " + Fixed(Degrees(std::abs(turn)), 3) +
              " deg in a feed under TCP with the tool " +
              Fixed(Degrees(LeastAngle(motion, *swinging)), 3) + " deg from that axis"));
    }
    run_.Add(motion.where);
  }

  void Finish(std::vector<Finding>* findings) override { run_.Close(findings); }

 private:
  const machine::Axis* Swinging(const motion::Motion& motion) const {
    for (const machine::Axis& axis : machine_->axes) {
      if (!axis.rotary) continue;
      const double turn = motion.q1()[axis.joint] - motion.q0()[axis.joint];
      if (std::abs(turn) > kSwing + kRounding && LeastAngle(motion, axis) < kCone) return &axis;
    }
    return nullptr;
  }

  /// Cosine of the angle between the tool axis and the axis of rotation of `axis`, at q.
  double Cosine(const machine::Axis& axis, const motion::JointVector& q) const {
    const kinematics::KinematicTree& tree = machine_->tree;
    const kinematics::Joint& joint =
        tree.joints().at(tree.moving_joints().at(static_cast<std::size_t>(axis.joint)));
    const Eigen::Vector3d turning = tree.Pose(joint.child_link, q).linear() * joint.axis;
    const Eigen::Vector3d tool = tree.Pose(machine_->spindle_link, q).linear().col(2);
    return turning.dot(tool);
  }

  /// Least angle (rad) between the two lines in the whole motion. Turning about `axis` leaves the
  /// cosine alone; in the angle t of the other rotary axis it is a + b cos t + c sin t, whose
  /// extremes are at the ends or where the sinusoid peaks.
  double LeastAngle(const motion::Motion& motion, const machine::Axis& axis) const {
    const machine::Axis* other = nullptr;
    for (const machine::Axis& candidate : machine_->axes) {
      if (candidate.rotary && candidate.joint != axis.joint) other = &candidate;
    }
    motion::JointVector q = motion.q0();
    double nearest = std::abs(Cosine(axis, q));
    if (other != nullptr) {
      const auto at = [&](double t) {
        q[other->joint] = t;
        return Cosine(axis, q);
      };
      const double at_0 = at(0.0), at_90 = at(kPi / 2.0), at_180 = at(kPi);
      const double a = (at_0 + at_180) / 2.0;
      const double peak = std::atan2(at_90 - a, at_0 - a);
      // A great circle leads the other axis beyond what it is at the ends.
      const motion::JointBox box = motion::Box(motion, motion::Whole(motion));
      const double t0 = box.lower[other->joint], t1 = box.upper[other->joint];
      nearest = std::max({nearest, std::abs(at(t0)), std::abs(at(t1))});
      for (double t = peak + kPi * std::ceil((t0 - peak) / kPi); t <= t1; t += kPi) {
        nearest = std::max(nearest, std::abs(at(t)));
      }
    }
    return std::acos(std::min(1.0, nearest));
  }

  const machine::Machine* machine_;
  RunFinding run_;
};

}  // namespace

std::unique_ptr<Check> Singularity(const machine::Machine& machine) {
  return std::make_unique<SingularityCheck>(machine);
}

}  // namespace ncsim::checks
