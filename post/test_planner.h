// SPDX-License-Identifier: BSD-3-Clause
// What the planner makes of a cutter-location file on a shipped machine.
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <sstream>
#include <string>
#include <variant>
#include <vector>

#include "post/cl_path.h"
#include "post/planner.h"
#include "sim/base/units.h"
#include "sim/machine/load.h"
#include "sim/machine/scene.h"

namespace ncsim::post {

inline constexpr double kDeg = kPi / 180.0;
inline constexpr double kGrid = 0.001 * kDeg;

struct Steps : PlanSink {
  void OnStep(const PlanStep& step) override { steps.push_back(step); }
  template <typename What>
  std::vector<What> All() const {
    std::vector<What> found;
    for (const PlanStep& step : steps) {
      if (const auto* what = std::get_if<What>(&step.what)) found.push_back(*what);
    }
    return found;
  }
  std::vector<PlanStep> steps;
};

/// A plan for a shipped machine, from the text of an NX file.
class Plan {
 public:
  explicit Plan(const std::string& model)
      : machine_(
            *machine::LoadMachine(std::string(NCSIM_SOURCE_DIR "/models/") + model, &diagnostics)),
        geometry(machine_,
                 machine::OffsetFrame(machine_, {{'X', -10.0}, {'Y', 20.0}, {'Z', -200.0}}),
                 kGrid) {}

  /// The events of `path` (the lines between LOAD/TOOL and END-OF-PATH).
  const Steps& Make(const std::string& path) {
    std::string text = "TOOL PATH/OP1,TOOL,BALL\nTLDATA/MILL,10,5,75,0,0\nMSYS/0,0,0,1,0,0,0,1,0\n";
    text += "LOAD/TOOL,1\nFEDRAT/MMPM,600\n" + path + "END-OF-PATH\n";
    steps = Steps();
    Planner planner(geometry, options, "x.cls", &diagnostics, &steps);
    ClPath cl(nc::Program::FromText("x.cls", text), 0, {}, &diagnostics);
    for (ClEvent event; cl.Next(&event);) planner.Take(event);
    choices = planner.choices();
    return steps;
  }
  /// Of the modes tcp and axes, in P.
  Eigen::Vector3d TipAt(PlanMode mode, const PlanPose& pose) const {
    return mode == PlanMode::kTcp ? pose.xyz : geometry.TipOfAxes(pose.xyz, pose.rotary);
  }
  std::string FirstError() const {
    for (const Diagnostic& diagnostic : diagnostics.all()) {
      if (diagnostic.level == Diagnostic::Level::kError) return ToString(diagnostic);
    }
    return "";
  }

  Diagnostics diagnostics;

 private:
  machine::Machine machine_;

 public:
  PartGeometry geometry;
  PlanOptions options;
  Steps steps;
  std::vector<PlanChoice> choices;
};

inline Eigen::Vector3d AxisOf(double b, double c) {
  return {std::sin(b * kDeg) * std::cos(c * kDeg), std::sin(b * kDeg) * std::sin(c * kDeg),
          std::cos(b * kDeg)};
}

inline std::string Goto(const Eigen::Vector3d& tip, const Eigen::Vector3d& axis) {
  std::ostringstream text;
  text.precision(12);
  text << std::fixed << "GOTO/" << tip.x() << "," << tip.y() << "," << tip.z() << "," << axis.x()
       << "," << axis.y() << "," << axis.z() << "\n";
  return text.str();
}

}  // namespace ncsim::post
