// SPDX-License-Identifier: BSD-3-Clause
// The machine in words.
#include <algorithm>
#include <cmath>

#include "sim/base/text.h"
#include "sim/base/units.h"
#include "sim/machine/load.h"
#include "sim/machine/mesh_check.h"
#include "sim/machine/rotary_centre.h"

namespace ncsim::machine {
namespace {

using kinematics::Joint;

std::string LinkName(const Machine& machine, int link) {
  return machine.tree.links()[static_cast<std::size_t>(link)].name;
}

/// "base_link -> X x_slide -> ... ": moving joints by axis letter (or joint name), fixed ones
/// without.
std::string Chain(const Machine& machine, int link) {
  std::string text;
  for (int at = link; at >= 0;) {
    const int parent = machine.tree.links()[static_cast<std::size_t>(at)].parent_joint;
    if (parent < 0) return LinkName(machine, at) + text;
    const Joint& joint = machine.tree.joints()[static_cast<std::size_t>(parent)];
    std::string step = " -> ";
    if (joint.index >= 0) {
      std::string axis_name = joint.name;
      for (const Axis& axis : machine.axes) {
        if (axis.joint == joint.index) axis_name = std::string(1, axis.letter);
      }
      step += "[" + axis_name + "] ";
    }
    text = step + LinkName(machine, at) + text;
    at = joint.parent_link;
  }
  return text;
}

std::string Vector(const Eigen::Vector3d& v, int decimals) {
  return Short(v.x(), decimals) + " " + Short(v.y(), decimals) + " " + Short(v.z(), decimals);
}

std::string AxisLine(const Axis& axis) {
  const double unit = axis.rotary ? Degrees(1.0) : 1.0;
  const std::string name = axis.rotary ? " deg" : " mm";
  std::string text = std::string("  ") + axis.letter + "  ";
  if (std::isinf(axis.lower) || std::isinf(axis.upper)) {
    text += "endless";
  } else {
    text += Short(axis.lower * unit) + " to " + Short(axis.upper * unit) + name;
  }
  text += axis.rotary ? ", rapid " + Short(Degrees(axis.rapid)) + " deg/s"
                      : ", rapid " + Short(axis.rapid * 60.0 / kMmPerMetre) + " m/min";
  text += ", acceleration " + Short(axis.acceleration * unit) + name + "/s2";
  return text + ", home " + Short(axis.home * unit) + name + "\n";
}

std::string PoseLine(const Machine& machine, const kinematics::JointVector& q) {
  std::string text;
  for (const Axis& axis : machine.axes) {
    text += std::string(text.empty() ? "" : " ") + axis.letter +
            Short(axis.rotary ? Degrees(q[axis.joint]) : q[axis.joint], 3);
  }
  return text;
}

std::string Bodies(const Machine& machine) {
  std::string text = "bodies (collision shapes; size at home in link axes, mm)\n";
  for (const LinkBody& body : machine.bodies) {
    Eigen::Vector3d lower, upper;
    BoundingBox(body.mesh, &lower, &upper);
    text += "  " + body.name + ": " + std::to_string(body.mesh.triangles.size()) + " triangles, " +
            Short(upper.x() - lower.x(), 1) + " x " + Short(upper.y() - lower.y(), 1) + " x " +
            Short(upper.z() - lower.z(), 1);
    text += body.mesh.watertight ? ", closed" : ", not closed";
    text += (body.defect.empty() ? "" : ", NOT TRUSTED: " + body.defect) + "\n";
  }
  for (std::size_t i = 0; i < machine.tree.links().size(); ++i) {
    const bool has_body =
        std::any_of(machine.bodies.begin(), machine.bodies.end(),
                    [&](const LinkBody& b) { return b.link == static_cast<int>(i); });
    if (!has_body) text += "  " + LinkName(machine, static_cast<int>(i)) + ": a frame, no shape\n";
  }
  return text;
}

std::string Pairs(const Machine& machine) {
  if (machine.disabled_pairs.empty()) return "pairs not checked: none\n";
  std::string text = "pairs not checked\n";
  for (const LinkPair& pair : machine.disabled_pairs) {
    text += "  " + LinkName(machine, pair.link_a) + ", " + LinkName(machine, pair.link_b) + ": " +
            pair.reason + "\n";
  }
  return text;
}

/// Nothing where the model has none.
std::string Margins(const Machine& machine) {
  std::string text = machine.margins.empty() ? "" : "margins of pairs\n";
  for (const LinkMargin& margin : machine.margins) {
    text += "  " + LinkName(machine, margin.link_a) + ", " + LinkName(machine, margin.link_b) +
            ": " + Short(margin.clearance) + " mm\n";
  }
  return text;
}

std::string Control(const Machine& machine) {
  const ControlData& control = machine.control;
  std::string text =
      "control: " + (control.dialect.empty() ? std::string("not stated") : control.dialect) + "\n";
  const std::vector<std::string>& nominal = control.nominal_settings;
  for (const auto& [name, value] : control.settings) {
    const bool confirmed = std::find(nominal.begin(), nominal.end(), name) == nominal.end();
    text += "  " + name + " = " + value + (confirmed ? "\n" : ", nominal\n");
  }
  if (control.rotary_centre) {
    text += "  rotary centre (gauge line at the pivot): X Y Z " + Vector(*control.rotary_centre, 3);
    const std::optional<Eigen::Vector3d> metal = RotaryCentre(machine);
    if (metal && (*metal - *control.rotary_centre).norm() > 1e-3) {
      text += "; by the URDF " + Vector(*metal, 3);
    }
    text += "\n";
  }
  if (!control.tool_change_pose.empty()) {
    text += "  tool change:";
    for (const auto& [letter, value] : control.tool_change_pose) {
      const bool rotary = letter < 'X';
      text += std::string(" ") + letter + Short(rotary ? Degrees(value) : value, 3);
    }
    text += ", order";
    for (const std::string& step : control.tool_change_order) text += " " + step;
    text += control.tool_change_nominal ? ", nominal\n" : ", measured\n";
  }
  if (control.tool_pockets > 0) {
    text += "  tool pockets: " + std::to_string(control.tool_pockets) + "\n";
  }
  return text;
}

}  // namespace

std::string Inspect(const Machine& machine, const Diagnostics& diagnostics) {
  std::string text = "machine: " + machine.name + " (" + machine.path + ")\n";
  text += "tool side:  " + Chain(machine, machine.spindle_link) + "\n";
  text += "table side: " + Chain(machine, machine.table_link) + "\n";
  text += "axes\n";
  for (const Axis& axis : machine.axes) text += AxisLine(axis);
  const kinematics::JointVector home = machine.Home();
  text += "frames (at home, in machine axes, mm)\n";
  for (const int link : {machine.spindle_link, machine.table_link}) {
    text += "  " + LinkName(machine, link) + ": " +
            Vector(machine.tree.Pose(link, home).translation(), 3) + "\n";
  }
  text += Bodies(machine);
  text += std::string("shapes: ") + (machine.nominal_shapes ? "nominal" : "measured") + "\n";
  text += Pairs(machine) + Margins(machine);
  text += "named poses\n";
  for (const auto& [name, q] : machine.named_poses) {
    text += "  " + name + ": " + PoseLine(machine, q) + "\n";
  }
  text += Control(machine);
  if (diagnostics.all().empty()) return text + "lint: nothing found\n";
  text += "lint\n";
  for (const Diagnostic& diagnostic : diagnostics.all()) text += "  " + ToString(diagnostic) + "\n";
  return text;
}

}  // namespace ncsim::machine
