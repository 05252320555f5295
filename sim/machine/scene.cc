// SPDX-License-Identifier: BSD-3-Clause
#include "sim/machine/scene.h"

#include <algorithm>
#include <iterator>
#include <set>
#include <utility>

#include "sim/base/text.h"
#include "sim/machine/model_toml.h"
#include "sim/machine/offset_name.h"
#include "sim/machine/settings.h"

namespace ncsim::machine {
namespace {

using kinematics::JointType;
using kinematics::JointVector;

/// A frame that rides on a link.
struct Frame {
  int link = 0;
  Eigen::Isometry3d X_LF = Eigen::Isometry3d::Identity();
};

/// Joint positions at these axis values; what is not named is at 0.
JointVector Positions(const Machine& machine, const std::map<char, double>& values) {
  JointVector q = JointVector::Zero(machine.tree.num_moving());
  for (const Axis& axis : machine.axes) {
    const auto it = values.find(axis.letter);
    if (it != values.end()) q[axis.joint] = it->second;
  }
  return q;
}

/// Follows placements, through fixtures and offsets, to a link.
class Resolver {
 public:
  Resolver(const Machine& machine, const Job& job, Diagnostics* diagnostics)
      : machine_(machine), job_(job), diagnostics_(diagnostics) {}

  std::optional<Frame> Resolve(const Placement& placement) {
    if (std::find(open_.begin(), open_.end(), &placement) != open_.end()) {
      return Error(placement, "'" + placement.on + "' is placed on itself, through others");
    }
    open_.push_back(&placement);
    std::optional<Frame> frame = ResolveParent(placement);
    open_.pop_back();
    if (frame) frame->X_LF = frame->X_LF * placement.X_OG;
    return frame;
  }

  /// As OffsetValues().
  std::optional<std::map<char, double>> Values(const WorkOffset& offset) {
    std::map<char, double> values;
    for (const char letter : kAxisLetters) values[letter] = 0.0;
    for (const auto& [letter, value] : offset.values) values[letter] = value;
    if (!offset.placement) return values;
    const Placement& placement = *offset.placement;
    if (!machine_.five_axis) {
      Error(placement,
            "this machine has no frame that " + offset.name + " could be worked out for");
      return std::nullopt;
    }
    const std::optional<Frame> frame = Resolve(placement);
    if (!frame) return std::nullopt;
    if (LinearBetween(frame->link, machine_.table_link)) {
      Error(placement, "'" + placement.on + "' does not ride on the table: " + offset.name +
                           " cannot be placed on it");
      return std::nullopt;
    }
    JointVector q = Positions(machine_, values);
    const Eigen::Vector3d p_M = (machine_.tree.Pose(frame->link, q) * frame->X_LF).translation();
    const Eigen::Isometry3d X_MB = machine_.tree.Pose(machine_.table_link, q);
    machine_.five_axis->SolveLinear(X_MB.inverse(Eigen::Isometry) * p_M, 0.0, &q);
    for (const Axis& axis : machine_.axes) {
      if (!axis.rotary) values[axis.letter] = q[axis.joint];
    }
    return values;
  }

 private:
  std::optional<Frame> Error(const Placement& at, const std::string& message) {
    diagnostics_->Error(job_.path, at.line, at.column, message);
    return std::nullopt;
  }

  bool LinearBetween(int link_a, int link_b) const {
    std::vector<int> a = machine_.tree.MovingJointsTo(link_a);
    std::vector<int> b = machine_.tree.MovingJointsTo(link_b);
    std::sort(a.begin(), a.end());
    std::sort(b.begin(), b.end());
    std::vector<int> between;
    std::set_symmetric_difference(a.begin(), a.end(), b.begin(), b.end(),
                                  std::back_inserter(between));
    return std::any_of(between.begin(), between.end(), [&](int j) {
      return machine_.tree.joints()[static_cast<std::size_t>(j)].type == JointType::kPrismatic;
    });
  }

  std::optional<Frame> ResolveParent(const Placement& placement) {
    if (OffsetName(placement.on)) return OnOffset(placement);
    for (const PlacedBody& body : job_.bodies) {
      if (body.name == placement.on) return Resolve(body.at);
    }
    const int link = machine_.tree.FindLink(placement.on);
    if (link >= 0) return Frame{link, Eigen::Isometry3d::Identity()};
    std::vector<std::string> names;
    for (const kinematics::Link& known : machine_.tree.links()) names.push_back(known.name);
    for (const PlacedBody& body : job_.bodies) names.push_back(body.name);
    for (const auto& [name, offset] : job_.offsets) names.push_back(name);
    return Error(placement, "there is no link, fixture or work offset '" + placement.on + "'" +
                                DidYouMean(placement.on, names));
  }

  std::optional<Frame> OnOffset(const Placement& placement) {
    const WorkOffset* offset = job_.FindOffset(placement.on);
    if (offset == nullptr) {
      return Error(placement, "the job states no work offset " + placement.on);
    }
    if (!offset->placement) {
      for (const Tool& tool : job_.tools) {
        if (tool.h_geometry >= 0.0) continue;
        return Error(placement, "nothing can be placed on " + placement.on + ": T" +
                                    std::to_string(tool.number) + " has a touch-off length (" +
                                    Short(tool.h_geometry) +
                                    "), so the offset's Z is not where the part is");
      }
    }
    const auto values = Values(*offset);
    if (!values) return std::nullopt;
    return Frame{machine_.table_link, OffsetFrame(machine_, *values)};
  }

  const Machine& machine_;
  const Job& job_;
  Diagnostics* diagnostics_;
  std::vector<const Placement*> open_;
};

/// What the job says to another control than the machine's would be ignored in silence.
void CheckDialect(const Machine& machine, const Job& job, Diagnostics* diagnostics) {
  const std::string& dialect = machine.control.dialect;
  if (dialect.empty()) return;
  const std::vector<Setting>& known = SettingsOf(dialect);
  for (const auto& entry : job.control) {
    if (std::any_of(known.begin(), known.end(),
                    [&](const Setting& setting) { return setting.name == entry.first; })) {
      continue;
    }
    diagnostics->Error(job.path, 0, 0,
                       "'" + entry.first + "' is no setting of the machine's control, " + dialect);
  }
  if (dialect == "sinumerik-840d") return;
  if (!job.data_files.empty()) {
    diagnostics->Error(job.path, 0, 0,
                       "'data_files' are not for the machine's control, " + dialect);
  }
  for (const Tool& tool : job.tools) {
    if (tool.edges.empty()) continue;
    diagnostics->Error(job.path, 0, 0,
                       "T" + std::to_string(tool.number) +
                           ": 'edges' are not for the machine's control, " + dialect);
  }
}

}  // namespace

std::optional<std::map<char, double>> OffsetValues(const Machine& machine, const Job& job,
                                                   const std::string& name,
                                                   Diagnostics* diagnostics) {
  const WorkOffset* offset = job.FindOffset(name);
  if (offset == nullptr) return std::nullopt;
  return Resolver(machine, job, diagnostics).Values(*offset);
}

Eigen::Isometry3d OffsetFrame(const Machine& machine, const std::map<char, double>& values) {
  const JointVector q = Positions(machine, values);
  const Eigen::Isometry3d X_BM = machine.tree.Pose(machine.table_link, q).inverse(Eigen::Isometry);
  Eigen::Isometry3d X_BP = Eigen::Isometry3d::Identity();
  X_BP.linear() = X_BM.linear();
  X_BP.translation() = X_BM * machine.tree.Pose(machine.spindle_link, q).translation();
  return X_BP;
}

Scene BuildScene(const Machine& machine, const Job& job, Diagnostics* diagnostics) {
  CheckDialect(machine, job, diagnostics);
  Scene scene;
  std::set<std::string> names;
  for (const LinkBody& body : machine.bodies) {
    names.insert(body.name);
    scene.bodies.push_back({body.name, BodyKind::kMachine, body.link, body.mesh, body.defect});
  }
  Resolver resolver(machine, job, diagnostics);
  for (const PlacedBody& body : job.bodies) {
    if (!names.insert(body.name).second || machine.tree.FindLink(body.name) >= 0) {
      diagnostics->Error(job.path, body.at.line, body.at.column,
                         "'" + body.name + "' is the name of a part of the machine");
      continue;
    }
    const std::optional<Frame> frame = resolver.Resolve(body.at);
    if (!frame) continue;
    SceneBody placed{body.name, body.kind, frame->link, body.mesh, body.defect};
    for (Eigen::Vector3d& vertex : placed.mesh.vertices) vertex = frame->X_LF * vertex;
    scene.bodies.push_back(std::move(placed));
  }
  return scene;
}

}  // namespace ncsim::machine
