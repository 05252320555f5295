// SPDX-License-Identifier: BSD-3-Clause
// System variables of the SINUMERIK that programs read and write (List Manual, system variables).
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "sim/control/run_log.h"
#include "sim/control/sinumerik_flow.h"
#include "sim/control/sinumerik_interpreter.h"
#include "sim/control/sinumerik_registers.h"
#include "sim/machine/machine.h"

namespace ncsim::control {

class Sinumerik840dSystem : public SinumerikSystem {
 public:
  /// All outlive this.
  Sinumerik840dSystem(const machine::Machine& machine, const SinumerikSettings& settings,
                      SinumerikRegisters* registers, RunLog* log)
      : machine_(&machine), settings_(&settings), registers_(registers), log_(log) {}
  /// Until then (files of offsets are run before the program) there are no positions.
  void SetInterpreter(SinumerikInterpreter* interpreter) { interpreter_ = interpreter; }

  bool IsAxis(std::string_view name) const override;
  Access Read(std::string_view name, const std::vector<nc::SinumerikValue>& indices,
              nc::SinumerikValue* value, std::string* message) override;
  Access Write(std::string_view name, const std::vector<nc::SinumerikValue>& indices,
               const nc::SinumerikValue& value, std::string* message) override;
  void AssumeZero(const std::string& name) override;

 private:
  using Indices = std::vector<nc::SinumerikValue>;
  Access ReadState(std::string_view name, const Indices& indices, nc::SinumerikValue* value);
  Access ReadPosition(std::string_view name, const Indices& indices, nc::SinumerikValue* value);
  Access ReadBasicFrame(bool indexed, Indices indices, nc::SinumerikValue* value,
                        std::string* message);
  static Access WriteBasicFrame(std::string_view name, bool indexed, Indices indices,
                                const nc::SinumerikValue& value, std::string* message);
  Access ReadFrame(std::string_view name, Indices indices, nc::SinumerikValue* value,
                   std::string* message);
  Access WriteFrame(std::string_view name, Indices indices, const nc::SinumerikValue& value,
                    std::string* message);
  Access WriteComponent(SettableFrame* stored, std::string_view name, const Indices& indices,
                        const nc::SinumerikValue& value, std::string* message);
  static std::optional<int> TakeFrameIndex(Indices* indices);
  void AssumeStated(int index, bool stated);
  double unit() const;
  double UnitOf(int parameter) const;
  int AxisOf(const nc::SinumerikValue& name) const;

  const machine::Machine* machine_;
  const SinumerikSettings* settings_;
  SinumerikRegisters* registers_;
  RunLog* log_;
  SinumerikInterpreter* interpreter_ = nullptr;
};

}  // namespace ncsim::control
