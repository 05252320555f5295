// SPDX-License-Identifier: BSD-3-Clause
// Puts URDF, SRDF and TOML together.
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <utility>

#include "sim/base/file.h"
#include "sim/base/text.h"
#include "sim/base/units.h"
#include "sim/machine/load.h"
#include "sim/machine/margins.h"
#include "sim/machine/model_toml.h"
#include "sim/machine/rotary_centre.h"
#include "sim/machine/settings.h"
#include "sim/machine/srdf.h"
#include "sim/machine/trafo_type.h"
#include "sim/machine/urdf.h"

namespace ncsim::machine {
namespace {

namespace fs = std::filesystem;
using kinematics::Joint;
using kinematics::JointType;

/// Taken where neither TOML nor URDF say: low enough for any machining centre.
constexpr double kDefaultLinearAcceleration = 2000.0;  // mm/s^2
constexpr double kDefaultRotaryAcceleration = Radians(500.0);
constexpr double kDefaultLinearRapid = 10000.0 / 60.0;  // mm/s
constexpr double kDefaultRotaryRapid = Radians(20.0);

/// The file beside the URDF with another extension; "" (a warning) if there is none.
std::string Beside(const std::string& urdf_path, const char* extension, const char* lacks,
                   Diagnostics* diagnostics) {
  const std::string path = fs::path(urdf_path).replace_extension(extension).string();
  if (IsThere(path)) return path;
  diagnostics->Warning(path, 0, 0, std::string("no such file: ") + lacks);
  return "";
}

/// The link of a frame, or -1 (reported).
int FrameLink(const ModelToml::Frame& frame, const char* what, const ModelToml& model,
              const Machine& machine, Diagnostics* diagnostics) {
  const int link = machine.tree.FindLink(frame.link);
  if (link >= 0) return link;
  std::vector<std::string> names;
  for (const kinematics::Link& known : machine.tree.links()) names.push_back(known.name);
  diagnostics->Error(frame.line > 0 ? model.file : machine.path, frame.line, frame.column,
                     "there is no link '" + frame.link + "', the " + what + " frame" +
                         DidYouMean(frame.link, names));
  return -1;
}

/// Finds both frames, and the path between them; without a frame, the root stands in for it.
void AddFrames(const ModelToml& model, Machine* machine, Diagnostics* diagnostics) {
  const int spindle = FrameLink(model.spindle, "spindle", model, *machine, diagnostics);
  const int table = FrameLink(model.table, "table", model, *machine, diagnostics);
  machine->spindle_link = std::max(spindle, 0);
  machine->table_link = std::max(table, 0);
  if (spindle < 0 || table < 0) return;
  machine->five_axis = kinematics::FiveAxis::Make(machine->tree, spindle, table);
  if (machine->five_axis) return;
  diagnostics->Error(machine->path, 0, 0,
                     "between spindle and table there are not three independent linear axes and at "
                     "most two rotary ones: no program can be checked");
}

/// A table-side axis must point the negative way, a tool-side one the positive way (ISO 841): a
/// warning otherwise.
void CheckSense(const Axis& axis, const Joint& joint, const Machine& machine, int line,
                Diagnostics* diagnostics) {
  const auto carries = [&](int link) {
    const std::vector<int> joints = machine.tree.MovingJointsTo(link);
    return std::any_of(joints.begin(), joints.end(), [&](int j) {
      return machine.tree.joints()[static_cast<std::size_t>(j)].index == axis.joint;
    });
  };
  const bool tool_side = carries(machine.spindle_link), table_side = carries(machine.table_link);
  if (tool_side == table_side) return;
  const kinematics::JointVector q = kinematics::JointVector::Zero(machine.tree.num_moving());
  const Eigen::Vector3d axis_M = machine.tree.Pose(joint.child_link, q).linear() * joint.axis;
  const double along = axis_M[(axis.letter - (axis.rotary ? 'A' : 'X'))];
  if (std::abs(along) < 0.5 || (along > 0.0) == tool_side) return;
  diagnostics->Warning(machine.path, line, 0,
                       std::string("axis ") + axis.letter + " points the wrong way for the " +
                           (tool_side ? "tool" : "table") +
                           " side: plus must mean that the tool moves plus against the part");
}

/// Adds one axis; false (reported) when its joint cannot be one.
bool AddAxis(char letter, const ModelToml::AxisData& data, const Urdf& urdf, const ModelToml& model,
             Machine* machine, Diagnostics* diagnostics) {
  const auto error = [&](const std::string& message) {
    diagnostics->Error(model.file, data.line, data.column, message);
    return false;
  };
  const std::string name = std::string("axis ") + letter + ": ";
  const int found = machine->tree.FindJoint(data.joint);
  if (found < 0) {
    std::vector<std::string> names;
    for (const Joint& known : machine->tree.joints()) names.push_back(known.name);
    return error(name + "there is no joint '" + data.joint + "' in the URDF" +
                 DidYouMean(data.joint, names));
  }
  const Joint& joint = machine->tree.joints()[static_cast<std::size_t>(found)];
  Axis axis;
  axis.letter = letter;
  axis.joint = joint.index;
  axis.rotary = IsRotaryLetter(letter);
  if (joint.type != (axis.rotary ? JointType::kRevolute : JointType::kPrismatic)) {
    return error(name + "joint '" + data.joint + "' is not " +
                 (axis.rotary ? "revolute or continuous" : "prismatic"));
  }
  for (const Axis& other : machine->axes) {
    if (other.joint == axis.joint) {
      return error(name + "joint '" + data.joint + "' is axis " + other.letter + " already");
    }
  }
  axis.lower = joint.lower;
  axis.upper = joint.upper;
  axis.home = data.home;
  if (axis.home < axis.lower || axis.home > axis.upper) error(name + "home is outside the limits");
  const double velocity = urdf.velocity.at(joint.name);
  const double fallback = axis.rotary ? kDefaultRotaryRapid : kDefaultLinearRapid;
  axis.rapid = data.rapid.value_or(velocity > 0.0 ? velocity : fallback);
  if (!data.rapid && velocity <= 0.0) {
    diagnostics->Warning(
        machine->path, urdf.joint_lines.at(joint.name), 0,
        name + "no rapid rate is stated: " + (axis.rotary ? "20 deg/s" : "10 m/min") + " is taken");
  }
  axis.acceleration = data.acceleration.value_or(axis.rotary ? kDefaultRotaryAcceleration
                                                             : kDefaultLinearAcceleration);
  if (!data.acceleration) {
    diagnostics->Warning(model.file.empty() ? machine->path : model.file, data.line, data.column,
                         name + "no acceleration is stated: " +
                             (axis.rotary ? "500 deg/s2" : "2000 mm/s2") + " is taken");
  }
  machine->axes.push_back(axis);
  CheckSense(axis, joint, *machine, urdf.joint_lines.at(joint.name), diagnostics);
  return true;
}

void AddAxes(const Urdf& urdf, const ModelToml& model, Machine* machine, Diagnostics* diagnostics) {
  for (const char letter : kAxisLetters) {
    const std::string name(1, letter);
    const auto stated = model.axes.find(letter);
    if (stated != model.axes.end()) {
      AddAxis(letter, stated->second, urdf, model, machine, diagnostics);
    } else if (model.axes.empty() && urdf.velocity.contains(name)) {
      ModelToml::AxisData data;
      data.joint = name;
      AddAxis(letter, data, urdf, model, machine, diagnostics);
    }
  }
  for (const int j : machine->tree.moving_joints()) {
    const Joint& joint = machine->tree.joints()[static_cast<std::size_t>(j)];
    const bool known = std::any_of(machine->axes.begin(), machine->axes.end(),
                                   [&](const Axis& axis) { return axis.joint == joint.index; });
    if (known) continue;
    const bool zero_inside = joint.lower <= 0.0 && joint.upper >= 0.0;
    diagnostics->Warning(machine->path, urdf.joint_lines.at(joint.name), 0,
                         "joint '" + joint.name + "' is no axis of the control: it stays at 0" +
                             (zero_inside ? "" : ", which is outside its limits"));
  }
}

void AddPoses(const Srdf& srdf, Machine* machine) {
  const auto home = srdf.poses.find("home");
  if (home != srdf.poses.end()) {
    for (Axis& axis : machine->axes) {
      const auto value = home->second.find(axis.joint);
      if (value != home->second.end()) axis.home = value->second;
    }
  }
  machine->named_poses["home"] = machine->Home();
  for (const auto& [name, values] : srdf.poses) {
    kinematics::JointVector q = machine->Home();
    for (const auto& [joint, value] : values) q[joint] = value;
    machine->named_poses[name] = q;
  }
}

void CheckToolChange(const ModelToml& model, const Machine& machine, Diagnostics* diagnostics) {
  for (const auto& [letter, value] : machine.control.tool_change_pose) {
    const Axis* axis = machine.FindAxis(letter);
    const std::string name = std::string("tool change: axis ") + letter;
    if (axis == nullptr) {
      diagnostics->Error(model.file, model.tool_change_line, model.tool_change_column,
                         name + " is not there");
    } else if (value < axis->lower - 1e-6 || value > axis->upper + 1e-6) {
      diagnostics->Error(model.file, model.tool_change_line, model.tool_change_column,
                         name + " is outside its limits");
    }
  }
}

void CheckTrafoType(const ModelToml& model, const Machine& machine, Diagnostics* diagnostics) {
  const auto type = machine.control.numbers.find("MD24100");
  if (type == machine.control.numbers.end()) return;
  const std::string fault = TrafoTypeFault(machine, static_cast<int>(type->second));
  if (!fault.empty()) diagnostics->Error(model.file, 0, 0, fault);
}

}  // namespace

std::optional<Machine> LoadMachine(const std::string& urdf_path, Diagnostics* diagnostics) {
  std::optional<Urdf> urdf = ReadUrdf(urdf_path, diagnostics);
  if (!urdf) return std::nullopt;
  const std::string toml_path =
      Beside(urdf_path, ".toml", "the model says nothing about its control", diagnostics);
  const std::string srdf_path =
      Beside(urdf_path, ".srdf", "every pair of links is checked, adjacent ones too", diagnostics);
  ModelToml model;
  if (!toml_path.empty()) model = ReadModelToml(toml_path, diagnostics).value_or(ModelToml());

  Machine machine;
  machine.name = model.name.empty() ? urdf->name : model.name;
  machine.path = urdf_path;
  machine.tree = urdf->tree;
  machine.nominal_shapes = model.nominal_shapes;
  AddFrames(model, &machine, diagnostics);
  machine.control = std::move(model.control);
  AddAxes(*urdf, model, &machine, diagnostics);
  machine.control.rotary_centre = RotaryCentre(machine);
  ApplySettings(model.settings, &machine.control);
  CheckTrafoType(model, machine, diagnostics);
  CheckToolChange(model, machine, diagnostics);

  Srdf srdf;
  if (!srdf_path.empty()) srdf = ReadSrdf(srdf_path, machine.tree, diagnostics);
  machine.disabled_pairs = std::move(srdf.disabled_pairs);
  AddPoses(srdf, &machine);
  machine.margins = std::move(srdf.margins);
  machine.bodies = MakeBodies(*urdf, urdf_path, diagnostics);
  CheckMargins(machine, srdf_path, diagnostics);
  return machine;
}

std::vector<Visual> LoadVisuals(const Machine& machine, Diagnostics* diagnostics) {
  Diagnostics known;  // LoadMachine has reported them.
  const std::optional<Urdf> urdf = ReadUrdf(machine.path, &known);
  return urdf ? MakeVisuals(*urdf, machine.path, diagnostics) : std::vector<Visual>();
}

}  // namespace ncsim::machine
