// SPDX-License-Identifier: BSD-3-Clause
// Local and common macro variables of the control (Haas NGC Mill Operator's Manual 2017, "Macro
// Variables").
#pragma once

#include <array>
#include <bitset>
#include <cstddef>
#include <vector>

#include "sim/control/flow.h"
#include "sim/nc/expression.h"

namespace ncsim::control {

/// #1 to #33.
using LocalVariables = std::array<nc::MacroValue, 34>;

/// Locals of the G65 level in force, commons with their legacy numbers (#100 = #10100), the flow's
/// own system variables; everything else goes to the controller's.
class MacroVariables final : public nc::VariableReader {
 public:
  MacroVariables(const FlowOptions& options, SystemVariables* system);

  bool Read(long number, nc::MacroValue* value) override;
  int address_decimals() const override { return decimals_; }
  /// False: not a variable of the control, or one that cannot be written.
  bool Write(long number, nc::MacroValue value);

  /// The word that is being computed; 0 outside words.
  void SetAddress(char address);
  /// Places of a word of that address: its least significant digit ("Address Substitution").
  int DecimalsOf(char address) const;

  /// G65 saves the locals and starts a new set; its M99 restores them.
  void PushLocals(const LocalVariables& arguments) { locals_.push_back(arguments); }
  void PopLocals() { locals_.pop_back(); }
  std::size_t levels() const { return locals_.size(); }

 private:
  static constexpr long kFirstCommon = 10000;
  static constexpr std::size_t kCommons = 1000;

  const FlowOptions& options_;
  SystemVariables* system_;
  std::vector<LocalVariables> locals_{1};
  std::array<nc::MacroValue, kCommons> commons_{};
  std::bitset<kCommons> known_;                 ///< Set by the program, or assumed to be undefined.
  nc::MacroValue single_block_suppress_ = 0.0;  ///< #3003
  nc::MacroValue override_control_ = 0.0;       ///< #3004
  int decimals_ = 4;
};

}  // namespace ncsim::control
