// SPDX-License-Identifier: BSD-3-Clause
#include "sim/control/run_start.h"

#include "sim/base/text.h"
#include "sim/base/units.h"
#include "sim/control/frames.h"

namespace ncsim::control {

AxisValues StartPosition(const machine::Machine& machine, const machine::Job& job, RunLog* log) {
  AxisValues start = AxisMap(machine).Values(machine.Home());
  for (std::size_t axis = 0; axis < kNumAxes; ++axis) {
    const auto found = job.start.find("XYZABC"[axis]);
    if (found != job.start.end()) start[axis] = found->second;
  }
  if (job.start.empty()) log->Assume("start position", "every axis stands at home", false);
  return start;
}

void AssumeRates(const machine::Machine& machine, RunLog* log) {
  std::string text = "the model's:";
  for (const machine::Axis& axis : machine.axes) {
    text += std::string(" ") + axis.letter + " " +
            (axis.rotary ? Short(Degrees(axis.rapid), 1) + " deg/s"
                         : Short(axis.rapid * 0.06, 2) + " m/min");
  }
  log->Assume("rapid rates", text, false);
}

std::vector<int> MotionlessCodes(const machine::Machine& machine, const machine::Job& job) {
  std::vector<int> codes = machine.control.m_codes_without_motion;
  codes.insert(codes.end(), job.m_codes_without_motion.begin(), job.m_codes_without_motion.end());
  return codes;
}

std::vector<std::string> SubprogramFolders(const machine::Machine& machine,
                                           const machine::Job& job) {
  std::vector<std::string> folders = job.subprogram_folders;
  const auto& shipped = machine.control.subprogram_folders;
  folders.insert(folders.end(), shipped.begin(), shipped.end());
  return folders;
}

}  // namespace ncsim::control
