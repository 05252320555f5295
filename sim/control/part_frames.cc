// SPDX-License-Identifier: BSD-3-Clause
#include "sim/control/part_frames.h"

#include "sim/base/diagnostics.h"
#include "sim/control/frames.h"
#include "sim/machine/scene.h"

namespace ncsim::control {

AxisValues GaugeAtMount(const machine::Machine& machine) {
  if (!machine.five_axis) return {};
  motion::JointVector q = motion::JointVector::Zero(machine.tree.num_moving());
  machine.five_axis->SolveLinear(Eigen::Vector3d::Zero(), 0.0, &q);
  AxisValues values = AxisMap(machine).Values(q);
  values[kA] = values[kB] = values[kC] = 0.0;
  return values;
}

std::optional<AxisValues> JobOffset(const machine::Machine& machine, const machine::Job& job,
                                    const std::string& name) {
  Diagnostics unread;  // Whoever loaded the job has reported what is wrong with it.
  if (job.FindOffset(name) == nullptr) return std::nullopt;
  const auto by_letter = machine::OffsetValues(machine, job, name, &unread);
  if (!by_letter) return std::nullopt;
  AxisValues values{};
  for (std::size_t axis = 0; axis < kNumAxes; ++axis) {
    const auto found = by_letter->find(kLetters[axis]);
    if (found != by_letter->end()) values[axis] = found->second;
  }
  return values;
}

int PartFrames::Index(const std::string& name, const AxisValues& values) {
  const auto [found, is_new] =
      indices_.try_emplace({name, values}, static_cast<int>(frames_->size()));
  if (is_new) {
    std::map<char, double> by_letter;
    for (std::size_t axis = 0; axis < kNumAxes; ++axis) by_letter[kLetters[axis]] = values[axis];
    frames_->push_back({name, machine::OffsetFrame(*machine_, by_letter)});
  }
  return found->second;
}

}  // namespace ncsim::control
