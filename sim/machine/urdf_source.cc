// SPDX-License-Identifier: BSD-3-Clause
#include "sim/machine/urdf_source.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <map>
#include <set>

#include "kinematics/tree.h"
#include "sim/base/text.h"
#include "sim/machine/xml.h"

namespace ncsim::machine {
namespace {

using tinyxml2::XMLElement;

const XMLElement* OnlyChild(const xml::Reader& reader, const XMLElement& parent, const char* name,
                            bool required) {
  const XMLElement* child = parent.FirstChildElement(name);
  if (child == nullptr) {
    if (required) {
      reader.Error(parent, "<" + std::string(parent.Name()) + "> has no <" + name + ">");
    }
    return nullptr;
  }
  if (const XMLElement* second = child->NextSiblingElement(name)) {
    reader.Error(*second, "a second <" + std::string(name) + ">");
  }
  return child;
}

class Linter {
 public:
  Linter(const xml::Reader& reader, UrdfSource* source) : reader_(reader), source_(*source) {}

  void Robot(const XMLElement& robot) {
    source_.name = reader_.Name(robot, "name");
    if (source_.name.empty()) source_.broken = true;
    const char* version = robot.Attribute("version");
    if (version != nullptr && std::string(version) != "1.0") {
      Broken(robot, "URDF version " + std::string(version) + " is not read: only 1.0 is");
    }
    reader_.CheckChildren(robot, {"link", "joint", "material", "transmission", "gazebo", "sensor"});
    for (const auto* e = robot.FirstChildElement("link"); e; e = e->NextSiblingElement("link")) {
      Link(*e);
    }
    for (const auto* e = robot.FirstChildElement("joint"); e; e = e->NextSiblingElement("joint")) {
      Joint(*e);
    }
    Mimics(robot);
    Tree(robot);
  }

 private:
  void Broken(const XMLElement& at, const std::string& message) {
    reader_.Error(at, message);
    source_.broken = true;
  }

  void Origin(const XMLElement& parent) {
    const XMLElement* origin = OnlyChild(reader_, parent, "origin", false);
    if (origin == nullptr) return;
    for (const char* attribute : {"xyz", "rpy"}) {
      const bool stated = origin->Attribute(attribute) != nullptr;
      if (stated && !reader_.Numbers(*origin, attribute, 3, false)) source_.broken = true;
    }
  }

  void Positive(const XMLElement& shape, const char* attribute, std::size_t count) {
    const auto numbers = reader_.Numbers(shape, attribute, count, true);
    if (!numbers) return;
    for (const double number : *numbers) {
      if (number > 0.0) continue;
      reader_.Error(shape, "<" + std::string(shape.Name()) + " " + attribute +
                               "> must be greater than 0, not " + Short(number, 6));
      return;
    }
  }

  void Shape(const XMLElement& parent) {
    Origin(parent);
    const XMLElement* geometry = OnlyChild(reader_, parent, "geometry", true);
    if (geometry == nullptr) return;
    const XMLElement* shape = geometry->FirstChildElement();
    if (shape == nullptr) {
      reader_.Error(*geometry, "<geometry> is empty");
      return;
    }
    if (const XMLElement* second = shape->NextSiblingElement()) {
      reader_.Error(*second, "a second shape in one <geometry>: give it a <" +
                                 std::string(parent.Name()) + "> of its own");
    }
    const std::string type = shape->Name();
    if (type == "box") {
      Positive(*shape, "size", 3);
    } else if (type == "cylinder") {
      Positive(*shape, "radius", 1);
      Positive(*shape, "length", 1);
    } else if (type == "sphere") {
      Positive(*shape, "radius", 1);
    } else if (type == "mesh") {
      reader_.Name(*shape, "filename");
      const auto scale = reader_.Numbers(*shape, "scale", 3, false);
      if (scale && std::count(scale->begin(), scale->end(), 0.0) > 0) {
        reader_.Error(*shape, "<mesh scale> has a 0");
      }
    } else {
      reader_.Error(*shape, "<" + type + "> is no URDF geometry" +
                                DidYouMean(type, {"box", "cylinder", "sphere", "mesh"}) +
                                ": box, cylinder, sphere and mesh are");
    }
  }

  void Link(const XMLElement& element) {
    UrdfSource::Link link{reader_.Name(element, "name"), element.GetLineNum(), {}, {}, false};
    if (link.name.empty()) {
      source_.broken = true;
      return;
    }
    if (links_.contains(link.name)) {
      Broken(element, "a second link '" + link.name + "'; the first is on line " +
                          std::to_string(links_[link.name]));
      return;
    }
    links_[link.name] = link.line;
    elements_["link " + link.name] = &element;
    const int errors = reader_.errors();
    reader_.CheckChildren(element, {"inertial", "visual", "collision"});
    const auto shapes = [&](const char* name, std::vector<int>* lines) {
      for (const auto* e = element.FirstChildElement(name); e; e = e->NextSiblingElement(name)) {
        reader_.CheckChildren(*e, {"origin", "geometry", "material"});
        Shape(*e);
        lines->push_back(e->GetLineNum());
      }
    };
    shapes("visual", &link.visual_lines);
    shapes("collision", &link.collision_lines);
    link.faulty = reader_.errors() > errors;
    source_.links.push_back(std::move(link));
  }

  void Axis(const XMLElement& joint, const std::string& name) {
    const XMLElement* axis = OnlyChild(reader_, joint, "axis", false);
    if (axis == nullptr) {
      reader_.Warning(joint, "joint '" + name + "' has no <axis>: URDF means 1 0 0");
      return;
    }
    const auto xyz = reader_.Numbers(*axis, "xyz", 3, true);
    if (!xyz) {
      source_.broken = true;
      return;
    }
    const double length = std::hypot((*xyz)[0], (*xyz)[1], (*xyz)[2]);
    if (length < 1e-9) {
      Broken(*axis, "the axis of joint '" + name + "' has no length");
    } else if (std::abs(length - 1.0) > 1e-4) {
      reader_.Warning(*axis, "the axis of joint '" + name + "' is not a unit vector (length " +
                                 Short(length, 6) + "): normalised");
    }
  }

  void Limits(const XMLElement& joint, const std::string& name, bool has_range) {
    const XMLElement* limit = OnlyChild(reader_, joint, "limit", false);
    if (limit == nullptr) {
      if (has_range) Broken(joint, "joint '" + name + "' has no <limit>");
      return;
    }
    for (const char* attribute : {"effort", "velocity"}) {
      const auto number = reader_.Numbers(*limit, attribute, 1, true);
      if (!number) {
        source_.broken = true;
      } else if (number->front() < 0.0) {
        reader_.Error(*limit, "joint '" + name + "': " + attribute + " is negative");
      }
    }
    std::array<double, 2> range{};
    for (std::size_t i = 0; i < 2; ++i) {
      const char* attribute = i == 0 ? "lower" : "upper";
      if (limit->Attribute(attribute) == nullptr) continue;
      const auto number = reader_.Numbers(*limit, attribute, 1, false);
      if (!number) {
        source_.broken = true;
        return;
      }
      range[i] = number->front();
    }
    if (has_range && range[0] > range[1]) {
      reader_.Error(*limit, "joint '" + name + "': lower " + Short(range[0], 6) +
                                " is above upper " + Short(range[1], 6));
    } else if (has_range && range[0] == range[1]) {
      reader_.Error(
          *limit, "joint '" + name + "' has no travel: lower and upper are " + Short(range[0], 6));
    } else if (!has_range && (range[0] != 0.0 || range[1] != 0.0)) {
      reader_.Warning(*limit, "joint '" + name + "' is continuous: lower and upper are ignored");
    }
  }

  std::string LinkOf(const XMLElement& joint, const char* tag) {
    const XMLElement* element = OnlyChild(reader_, joint, tag, true);
    const std::string link = element == nullptr ? "" : reader_.Name(*element, "link");
    if (link.empty()) {
      source_.broken = true;
    } else if (!links_.contains(link)) {
      Broken(*element, "there is no link '" + link + "'" + DidYouMean(link, LinkNames()));
      return "";
    }
    return link;
  }

  void Joint(const XMLElement& element) {
    UrdfSource::Joint joint;
    joint.name = reader_.Name(element, "name");
    joint.line = element.GetLineNum();
    const std::string type = reader_.Name(element, "type");
    if (joint.name.empty() || type.empty()) source_.broken = true;
    if (!joint_lines_.emplace(joint.name, joint.line).second) {
      Broken(element, "a second joint '" + joint.name + "'; the first is on line " +
                          std::to_string(joint_lines_[joint.name]));
    }
    reader_.CheckChildren(element, {"origin", "parent", "child", "axis", "limit", "mimic",
                                    "dynamics", "calibration", "safety_controller"});
    Origin(element);
    joint.parent = LinkOf(element, "parent");
    joint.child = LinkOf(element, "child");
    const std::vector<std::string> known = {"fixed", "prismatic", "revolute", "continuous"};
    if (std::find(known.begin(), known.end(), type) == known.end()) {
      if (!type.empty()) {
        Broken(element, "joint '" + joint.name + "': type '" + type +
                            "' is not supported: fixed, prismatic, revolute and continuous are");
      }
    } else if (type != "fixed") {
      Axis(element, joint.name);
      Limits(element, joint.name, type != "continuous");
      if (++moving_ == kinematics::kMaxJoints + 1) {
        Broken(element, "more than " + std::to_string(kinematics::kMaxJoints) + " joints move");
      }
    }
    elements_["joint " + joint.name] = &element;
    source_.joints.push_back(std::move(joint));
  }

  void Mimics(const XMLElement& robot) {
    for (const auto* e = robot.FirstChildElement("joint"); e; e = e->NextSiblingElement("joint")) {
      const XMLElement* mimic = e->FirstChildElement("mimic");
      if (mimic == nullptr) continue;
      const std::string of = reader_.Name(*mimic, "joint");
      if (of.empty()) continue;
      reader_.Error(*mimic, joint_lines_.contains(of)
                                ? "mimic joints are not supported"
                                : "mimics joint '" + of + "', which is not there");
    }
  }

  /// One root, each link the child of at most one joint, no cycle.
  void Tree(const XMLElement& robot) {
    std::map<std::string, int> parents;
    for (const UrdfSource::Joint& joint : source_.joints) {
      if (joint.child.empty() || joint.parent.empty()) return;
      if (++parents[joint.child] == 2) {
        Broken(*elements_.at("joint " + joint.name),
               "link '" + joint.child + "' is the child of two joints");
      }
    }
    std::vector<std::string> reached;
    for (const UrdfSource::Link& link : source_.links) {
      if (!parents.contains(link.name)) reached.push_back(link.name);
    }
    if (reached.size() > 1) {
      Broken(*elements_.at("link " + reached[1]), "a machine has one root link; '" + reached[0] +
                                                      "' and '" + reached[1] +
                                                      "' are both nobody's child");
      return;
    }
    for (std::size_t i = 0; i < reached.size() && !source_.broken; ++i) {
      for (const UrdfSource::Joint& joint : source_.joints) {
        if (joint.parent == reached[i]) reached.push_back(joint.child);
      }
    }
    if (source_.links.empty()) {
      Broken(robot, "there is no link");
    } else if (!source_.broken && reached.size() != source_.links.size()) {
      Broken(robot, "the joints form a loop: not all links hang on the root");
    }
  }

  std::vector<std::string> LinkNames() const {
    std::vector<std::string> names;
    for (const auto& [name, line] : links_) names.push_back(name);
    return names;
  }

  const xml::Reader& reader_;
  UrdfSource& source_;
  std::map<std::string, int> links_;
  std::map<std::string, int> joint_lines_;
  std::map<std::string, const XMLElement*> elements_;  // "link a", "joint X"
  int moving_ = 0;
};

}  // namespace

std::optional<UrdfSource> ReadUrdfSource(const std::string& text, const std::string& file,
                                         Diagnostics* diagnostics) {
  xml::Reader reader(file, diagnostics);
  const XMLElement* robot = reader.Parse(text);
  if (robot == nullptr) return std::nullopt;
  UrdfSource source;
  Linter(reader, &source).Robot(*robot);
  return source;
}

}  // namespace ncsim::machine
