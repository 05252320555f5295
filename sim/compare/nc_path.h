// SPDX-License-Identifier: BSD-3-Clause
// The Toolpath of an NC program, from the motions that its control makes.
#pragma once

#include <string>
#include <vector>

#include "sim/compare/toolpath.h"
#include "sim/control/controller.h"
#include "sim/machine/tool.h"

namespace ncsim::compare {

/// How the tip and the axis of a tool of this length go in the table frame B during a motion (not a
/// dog-leg), by the metal's kinematics. The motion must outlive the curve.
Curve CurveInTable(const kinematics::FiveAxis& metal, const motion::Motion& motion, double length);

/// Collects what a run sends. The pecks of a canned cycle count as one feed to its depth.
class NcPath : public control::RunSink {
 public:
  /// All outlive this; the machine must have five_axis. `increment`: what the program's coordinates
  /// are rounded to, mm.
  NcPath(const machine::Machine& machine, const machine::ToolTable& tools,
         const std::vector<control::PartFrame>& part_frames, const Distance& chord_error,
         double increment);

  void OnMotion(const motion::Motion& motion) override;
  /// Errors and what is not proven are kept; warnings are `check`'s matter.
  void OnFinding(Finding finding) override;

  /// In the part frame of the first feed, which is one for the whole program: so a wrong change of
  /// the work offset shows.
  Toolpath Take();
  std::vector<Finding> TakeFindings() { return std::move(findings_); }
  std::uint64_t motions() const { return motions_; }
  /// Name of the work offset of the first feed; "" without one.
  std::string frame() const;

 private:
  void AddFeed(const motion::Motion& motion, double length);
  double CycleBegin(const motion::Motion& motion, const Curve& curve);

  const machine::Machine* machine_;
  const machine::ToolTable* tools_;
  const std::vector<control::PartFrame>* part_frames_;
  ToolpathBuilder builder_;
  double increment_;
  std::vector<Finding> findings_;
  std::uint64_t motions_ = 0;
  int frame_ = -1;
  // The hole of the cycle that is running: where its first feed starts, and how deep it has gone.
  int cycle_ = 0;
  Pose entry_;
  double depth_ = 0.0;
};

}  // namespace ncsim::compare
