// SPDX-License-Identifier: BSD-3-Clause
// Work offsets as frames on the table. Neutral of dialect.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "sim/control/command.h"
#include "sim/control/controller.h"
#include "sim/machine/job.h"
#include "sim/machine/machine.h"

namespace ncsim::control {

/// The gauge line on the table's mount, rotary axes at 0: what an offset is that nobody states.
AxisValues GaugeAtMount(const machine::Machine& machine);

/// The values of an offset that the job states; what it does not name is 0.
std::optional<AxisValues> JobOffset(const machine::Machine& machine, const machine::Job& job,
                                    const std::string& name);

/// The part frames that motions refer to: one for each set of values that was in force.
class PartFrames {
 public:
  PartFrames(const machine::Machine& machine, std::vector<PartFrame>* frames)
      : machine_(&machine), frames_(frames) {}
  /// Index of the frame with these machine values; made when it is new.
  int Index(const std::string& name, const AxisValues& values);

 private:
  const machine::Machine* machine_;
  std::vector<PartFrame>* frames_;
  std::map<std::pair<std::string, AxisValues>, int> indices_;
};

}  // namespace ncsim::control
