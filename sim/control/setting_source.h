// SPDX-License-Identifier: BSD-3-Clause
// Settings of a control by the control's own names: what job and model state. Neutral of dialect.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "sim/machine/job.h"
#include "sim/machine/machine.h"

namespace ncsim::control {

/// Looks settings up by the control's own name: the job first, then the model. A value is text in
/// the model format's normal form (docs/model-format.md): lengths in mm, angles in degrees.
class SettingSource {
 public:
  SettingSource(const machine::Machine& machine, const machine::Job& job)
      : machine_(&machine), job_(&job) {}
  std::optional<std::string> Text(std::string_view name) const;
  std::optional<double> Number(std::string_view name) const;
  std::optional<bool> Switch(std::string_view name) const;

 private:
  const machine::Machine* machine_;
  const machine::Job* job_;
};

}  // namespace ncsim::control
