// SPDX-License-Identifier: BSD-3-Clause
// The interpreting controller: Program + control data -> Motions and findings.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "sim/base/finding.h"
#include "sim/machine/job.h"
#include "sim/machine/machine.h"
#include "sim/motion/motion.h"
#include "sim/nc/program.h"

namespace ncsim::control {

/// A work offset as the motions refer to it (motion::Facts::offset): the part frame P, riding on
/// the table.
struct PartFrame {
  std::string name;                                        ///< "G54".
  Eigen::Isometry3d X_BP = Eigen::Isometry3d::Identity();  ///< By the metal.
};

struct RunSummary {
  std::uint64_t blocks = 0;  ///< Blocks executed.
  std::uint64_t motions = 0;
  double motion_time = 0.0;             ///< s.
  bool finished = false;                ///< The program was interpreted to its end.
  std::vector<Assumption> assumptions;  ///< By first use.
  std::vector<std::string> not_checked;
};

/// Receives what a run makes, in program order.
class RunSink {
 public:
  virtual ~RunSink() = default;
  virtual void OnMotion(const motion::Motion& motion) = 0;
  virtual void OnFinding(Finding finding) = 0;
};

/// Interprets `program` to its end or to the first alarm that stops the control. `tools` is the
/// table in force (job, else header, else assumed; see app/tool_source.h); `part_frames` grows
/// while motions are sent, before the first motion that refers to a new index. Throws nothing. One
/// call = one run from the job's start state.
RunSummary RunProgram(std::shared_ptr<const nc::Program> program, const machine::Machine& machine,
                      const machine::Job& job, const machine::ToolTable& tools, SourceFiles* files,
                      std::vector<PartFrame>* part_frames, RunSink* sink);

}  // namespace ncsim::control
