// SPDX-License-Identifier: BSD-3-Clause
#include "sim/machine/margins.h"

#include <algorithm>
#include <array>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "kinematics/relative_bound.h"
#include "sim/base/text.h"

namespace ncsim::machine {
namespace {

struct ToolPart {
  BodyKind kind;
  const char* name;
  Profile Tool::*profile;
};
constexpr std::array<ToolPart, 3> kToolParts = {{{BodyKind::kFlutes, "flutes", &Tool::flutes},
                                                 {BodyKind::kShank, "shank", &Tool::shank},
                                                 {BodyKind::kHolder, "holder", &Tool::holder}}};

bool OfTool(const MarginBody& body) {
  return body.kind == BodyKind::kFlutes || body.kind == BodyKind::kShank ||
         body.kind == BodyKind::kHolder;
}

/// 2: the body's own name; 1: a name that fits others too; 0: does not fit.
int Fit(const Machine& machine, const std::string& name, const MarginBody& body) {
  if (name == body.name) return 2;
  if (body.kind == BodyKind::kMachine) return machine.tree.FindLink(name) == body.link ? 1 : 0;
  for (const ToolPart& part : kToolParts) {
    if (part.kind == body.kind && name == part.name) return 1;
  }
  return 0;
}

/// The sum of both names' fits; 0 unless both do.
int Fit(const Machine& machine, const PairMargin& margin, const MarginBody& a,
        const MarginBody& b) {
  const auto both = [&](const MarginBody& first, const MarginBody& second) {
    const int f = Fit(machine, margin.bodies[0].name, first);
    const int s = Fit(machine, margin.bodies[1].name, second);
    return f > 0 && s > 0 ? f + s : 0;
  };
  return std::max(both(a, b), both(b, a));
}

/// Why a clearance of the two is never judged; "" where it is.
std::string WhyNotJudged(const Machine& machine, const MarginBody& a, const MarginBody& b) {
  const std::string pair = "'" + std::string(a.name) + "' and '" + std::string(b.name) + "'";
  if (a.kind == BodyKind::kMachine && b.kind == BodyKind::kMachine &&
      machine.Disabled(a.link, b.link)) {
    return "the model says that " + pair + " need no check";
  }
  if (kinematics::RelativePath(machine.tree, b.link, a.link).rigid()) {
    return pair + " do not move against each other";
  }
  const bool part = b.kind == BodyKind::kPart || b.kind == BodyKind::kStock;
  if (a.kind == BodyKind::kFlutes && part) return pair + " are judged by depth, not by clearance";
  return "";
}

/// Everything that a margin of a job can name.
class Bodies {
 public:
  Bodies(const Machine& machine, const Scene& scene, const ToolTable& tools) : machine_(machine) {
    std::set<std::string> candidates;
    for (const kinematics::Link& link : machine.tree.links()) candidates.insert(link.name);
    for (const SceneBody& body : scene.bodies) {
      all_.push_back({body.name, body.kind, body.link});
      candidates.insert(body.name);
    }
    for (const ToolPart& part : kToolParts) candidates.insert(part.name);
    for (const Tool& tool : tools.tools) {
      for (const ToolPart& part : kToolParts) {
        if ((tool.*part.profile).empty()) continue;
        const auto name = candidates.insert(ToolBodyName(tool.number, part.name)).first;
        tool_names_.push_back(*name);
        tool_kinds_.push_back(part.kind);
      }
    }
    for (std::size_t i = 0; i < tool_names_.size(); ++i) {
      all_.push_back({tool_names_[i], tool_kinds_[i], machine.spindle_link});
    }
    candidates_.assign(candidates.begin(), candidates.end());
  }

  /// "", or what is wrong with the name.
  std::string Complaint(const std::string& name) const {
    if (!Named(name).empty() || IsToolPart(name)) return "";
    if (machine_.tree.FindLink(name) >= 0) return "link '" + name + "' has no shape";
    return "there is no body '" + name + "' in the scene or among the tools" +
           DidYouMean(name, candidates_);
  }

  std::vector<MarginBody> Named(const std::string& name) const {
    std::vector<MarginBody> named;
    for (const MarginBody& body : all_) {
      if (Fit(machine_, name, body) > 0) named.push_back(body);
    }
    return named;
  }

  static bool IsToolPart(const std::string& name) {
    return std::any_of(kToolParts.begin(), kToolParts.end(),
                       [&](const ToolPart& part) { return name == part.name; });
  }

 private:
  const Machine& machine_;
  std::vector<std::string> tool_names_;
  std::vector<BodyKind> tool_kinds_;
  std::vector<MarginBody> all_;  // refers to the scene and to tool_names_
  std::vector<std::string> candidates_;
};

/// Why the margin judges no pair; "" where it judges one.
std::string WhyIdle(const Machine& machine, const Bodies& bodies, const PairMargin& margin) {
  const std::vector<MarginBody> first = bodies.Named(margin.bodies[0].name);
  const std::vector<MarginBody> second = bodies.Named(margin.bodies[1].name);
  std::string why;
  for (const MarginBody& a : first) {
    for (const MarginBody& b : second) {
      const std::string reason =
          OfTool(b) ? WhyNotJudged(machine, b, a) : WhyNotJudged(machine, a, b);
      if (reason.empty()) return "";
      if (why.empty()) why = reason;
    }
  }
  if (!why.empty()) return why;
  return "no tool has a " + margin.bodies[first.empty() ? 0 : 1].name;
}

}  // namespace

double NearMissClearance(const Machine& machine, const CheckSettings& settings, const MarginBody& a,
                         const MarginBody& b) {
  std::pair<int, double> best{0, settings.clearance};
  for (const PairMargin& margin : settings.margins) {
    const int fit = Fit(machine, margin, a, b);
    if (fit > 0) best = std::max(best, std::pair(fit, margin.clearance));
  }
  if (best.first > 0 || a.kind != BodyKind::kMachine || b.kind != BodyKind::kMachine) {
    return best.second;
  }
  for (const LinkMargin& margin : machine.margins) {
    const auto [low, high] = std::minmax(a.link, b.link);
    if (margin.link_a == low && margin.link_b == high) return margin.clearance;
  }
  return settings.clearance;
}

void CheckMargins(const Machine& machine, const Job& job, const Scene& scene,
                  const ToolTable& tools, Diagnostics* diagnostics) {
  const Bodies bodies(machine, scene, tools);
  for (const PairMargin& margin : job.check.margins) {
    bool known = true;
    for (const PairMargin::Body& body : margin.bodies) {
      const std::string complaint = bodies.Complaint(body.name);
      if (complaint.empty()) continue;
      known = false;
      diagnostics->Error(job.path, body.line, body.column, complaint);
    }
    if (!known) continue;
    const auto tool_only = [&](const PairMargin::Body& body) {
      const std::vector<MarginBody> named = bodies.Named(body.name);
      return std::all_of(named.begin(), named.end(), OfTool);
    };
    const PairMargin::Body& where = margin.bodies[1];
    if (tool_only(margin.bodies[0]) && tool_only(where)) {
      diagnostics->Error(job.path, where.line, where.column,
                         "bodies of tools are not checked against each other");
      continue;
    }
    const std::string why = WhyIdle(machine, bodies, margin);
    if (why.empty()) continue;
    diagnostics->Warning(job.path, margin.bodies[0].line, margin.bodies[0].column,
                         why + ": this margin judges nothing");
  }
}

void CheckMargins(const Machine& machine, const std::string& file, Diagnostics* diagnostics) {
  const auto body_of = [&](int link) {
    return MarginBody{machine.tree.links()[static_cast<std::size_t>(link)].name, BodyKind::kMachine,
                      link};
  };
  for (const LinkMargin& margin : machine.margins) {
    std::string why = WhyNotJudged(machine, body_of(margin.link_a), body_of(margin.link_b));
    for (const int link : {margin.link_a, margin.link_b}) {
      const bool has_shape = std::any_of(machine.bodies.begin(), machine.bodies.end(),
                                         [&](const LinkBody& body) { return body.link == link; });
      if (!has_shape) why = "link '" + std::string(body_of(link).name) + "' has no shape";
    }
    if (why.empty()) continue;
    diagnostics->Warning(file, margin.line, 0, why + ": this margin judges nothing");
  }
}

}  // namespace ncsim::machine
