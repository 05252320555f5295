// SPDX-License-Identifier: BSD-3-Clause
#include "sim/machine/srdf.h"

#include <algorithm>
#include <optional>
#include <utility>

#include "sim/base/file.h"
#include "sim/base/text.h"
#include "sim/base/units.h"
#include "sim/machine/xml.h"

namespace ncsim::machine {
namespace {

using tinyxml2::XMLElement;

constexpr const char* kMargin = "ncsim:margin";
constexpr std::uint64_t kMaxSrdfBytes = std::uint64_t{1} << 24;

/// The link's index, or -1 (reported).
int FindLink(const xml::Reader& reader, const XMLElement& element, const char* attribute,
             const kinematics::KinematicTree& tree) {
  const std::string name = reader.Name(element, attribute);
  if (name.empty()) return -1;
  const int link = tree.FindLink(name);
  if (link < 0) {
    std::vector<std::string> names;
    for (const kinematics::Link& known : tree.links()) names.push_back(known.name);
    reader.Error(element, "there is no link '" + name + "' in the URDF" + DidYouMean(name, names));
  }
  return link;
}

std::string PairName(const std::pair<int, int>& links, const kinematics::KinematicTree& tree) {
  return "'" + tree.links()[static_cast<std::size_t>(links.first)].name + "' and '" +
         tree.links()[static_cast<std::size_t>(links.second)].name + "'";
}

/// link1 and link2, the lesser index first; nullopt (reported) where they are no pair.
std::optional<std::pair<int, int>> FindLinks(const xml::Reader& reader, const XMLElement& element,
                                             const kinematics::KinematicTree& tree) {
  const int a = FindLink(reader, element, "link1", tree);
  const int b = FindLink(reader, element, "link2", tree);
  if (a < 0 || b < 0) return std::nullopt;
  if (a != b) return std::minmax({a, b});
  reader.Error(element, "a link is no pair with itself");
  return std::nullopt;
}

void ReadPair(const xml::Reader& reader, const XMLElement& element,
              const kinematics::KinematicTree& tree, Srdf* srdf) {
  const auto links = FindLinks(reader, element, tree);
  if (!links) return;
  const char* stated = element.Attribute("reason");
  const std::string reason = stated == nullptr ? "" : stated;
  const std::string pair = PairName(*links, tree);
  if (reason == "Never" || reason == "Default") {
    reader.Warning(element, "reason " + reason + " comes from sampling: " + pair + " stay checked");
    return;
  }
  if (reason.empty()) {
    reader.Warning(element, "no reason why " + pair + " need no check: taken as User");
  } else if (reason != "Adjacent" && reason != "User" && reason != "Always") {
    reader.Error(element, "reason \"" + reason + "\" is not known: Adjacent, User and Always are" +
                              DidYouMean(reason, {"Adjacent", "User", "Always"}));
    return;
  }
  srdf->disabled_pairs.push_back({links->first, links->second, reason.empty() ? "User" : reason});
}

void ReadMargin(const xml::Reader& reader, const XMLElement& element,
                const kinematics::KinematicTree& tree, Srdf* srdf) {
  const auto links = FindLinks(reader, element, tree);
  const auto value = reader.Numbers(element, "clearance", 1, true);
  if (!links || !value) return;
  const double clearance = value->front() * kMmPerMetre;
  const bool twice =
      std::any_of(srdf->margins.begin(), srdf->margins.end(), [&](const LinkMargin& other) {
        return other.link_a == links->first && other.link_b == links->second;
      });
  if (clearance < 0.0) {
    reader.Error(element, "a clearance must not be negative");
  } else if (clearance > kGreatestMargin) {
    reader.Error(element, "a clearance of " + Short(value->front()) +
                              " m is absurd: the greatest is 1 m (an SRDF is in metres)");
  } else if (twice) {
    reader.Error(element, "a second margin of " + PairName(*links, tree));
  } else {
    srdf->margins.push_back({links->first, links->second, clearance, element.GetLineNum()});
  }
}

void ReadPose(const xml::Reader& reader, const XMLElement& element,
              const kinematics::KinematicTree& tree, Srdf* srdf) {
  const std::string pose = reader.Name(element, "name");
  if (pose.empty()) return;
  if (srdf->poses.contains(pose)) {
    reader.Error(element, "a second pose '" + pose + "'");
    return;
  }
  reader.CheckChildren(element, {"joint"});
  std::map<int, double> values;
  for (const auto* e = element.FirstChildElement("joint"); e; e = e->NextSiblingElement("joint")) {
    const std::string name = reader.Name(*e, "name");
    const auto value = reader.Numbers(*e, "value", 1, true);
    if (name.empty() || !value) continue;
    const int found = tree.FindJoint(name);
    if (found < 0) {
      std::vector<std::string> names;
      for (const kinematics::Joint& known : tree.joints()) names.push_back(known.name);
      reader.Error(*e, "there is no joint '" + name + "' in the URDF" + DidYouMean(name, names));
      continue;
    }
    const kinematics::Joint& joint = tree.joints()[static_cast<std::size_t>(found)];
    if (joint.index < 0) {
      reader.Error(*e, "joint '" + name + "' is fixed");
      continue;
    }
    const bool prismatic = joint.type == kinematics::JointType::kPrismatic;
    const double position = value->front() * (prismatic ? kMmPerMetre : 1.0);
    constexpr double kRounding = 1e-6;
    if (position < joint.lower - kRounding || position > joint.upper + kRounding) {
      reader.Error(*e, "pose '" + pose + "' puts joint '" + name + "' outside its limits");
    }
    values[joint.index] = position;
  }
  srdf->poses[pose] = std::move(values);
}

}  // namespace

Srdf ReadSrdf(const std::string& path, const kinematics::KinematicTree& tree,
              Diagnostics* diagnostics) {
  Srdf srdf;
  std::string reason;
  const std::optional<std::string> text = ReadFile(path, kMaxSrdfBytes, &reason);
  if (!text) {
    diagnostics->Error(path, 0, 0, reason);
    return srdf;
  }
  xml::Reader reader(path, diagnostics);
  const XMLElement* robot = reader.Parse(*text);
  if (robot == nullptr) return srdf;
  reader.CheckChildren(*robot, {"disable_collisions", "group_state", "group", "virtual_joint",
                                "end_effector", "passive_joint", kMargin});
  for (const auto* e = robot->FirstChildElement("disable_collisions"); e;
       e = e->NextSiblingElement("disable_collisions")) {
    ReadPair(reader, *e, tree, &srdf);
  }
  for (const auto* e = robot->FirstChildElement(kMargin); e; e = e->NextSiblingElement(kMargin)) {
    ReadMargin(reader, *e, tree, &srdf);
  }
  for (const auto* e = robot->FirstChildElement("group_state"); e;
       e = e->NextSiblingElement("group_state")) {
    ReadPose(reader, *e, tree, &srdf);
  }
  return srdf;
}

}  // namespace ncsim::machine
