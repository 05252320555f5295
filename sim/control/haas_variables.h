// SPDX-License-Identifier: BSD-3-Clause
// System variables of a Haas NGC (Haas NGC Mill Operator's Manual 2017, "System Variables").
#pragma once

#include <vector>

#include "sim/control/flow.h"
#include "sim/control/haas_interpreter.h"

namespace ncsim::control {

/// Values are in the control's unit (setting 9) and degrees. A variable that the control has and a
/// simulation cannot know (inputs, clocks, probe positions) reads 0 and is `unsupported-code`.
class HaasVariables final : public SystemVariables {
 public:
  /// All outlive this.
  HaasVariables(const machine::Machine& machine, const HaasSettings& settings,
                const SettingSource& source, HaasRegisters* registers, HaasInterpreter* interpreter,
                RunLog* log)
      : machine_(&machine),
        settings_(&settings),
        source_(&source),
        registers_(registers),
        interpreter_(interpreter),
        log_(log) {}

  /// Where the last executed block stands: the place of a finding about a variable.
  void SetWhere(const SourcePosition& where) { where_ = where; }

  bool Read(long number, nc::MacroValue* value) override;
  bool Write(long number, nc::MacroValue value) override;
  void AssumeUndefined(long number) override;
  int length_decimals() const override { return settings_->inch ? 4 : 3; }

 private:
  double Out(int axis, double inside) const;
  double In(int axis, double outside) const;
  bool ReadToolRegister(long number, nc::MacroValue* value) const;
  bool ReadOffset(long number, nc::MacroValue* value) const;
  bool ReadPosition(long number, nc::MacroValue* value);
  bool ReadModal(long number, nc::MacroValue* value) const;
  bool ReadSetting(long number, nc::MacroValue* value);
  void Unknown(long number);

  const machine::Machine* machine_;
  const HaasSettings* settings_;
  const SettingSource* source_;
  HaasRegisters* registers_;
  HaasInterpreter* interpreter_;
  RunLog* log_;
  SourcePosition where_;
};

}  // namespace ncsim::control
