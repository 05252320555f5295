// SPDX-License-Identifier: BSD-3-Clause
// What a call of a SINUMERIK cycle says, by the names of the table's parameters (sim/nc).
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "sim/nc/sinumerik_commands.h"
#include "sim/nc/sinumerik_value.h"

namespace ncsim::control {

/// Views of the call's values; both outlive this. What is left out counts as 0 or "", as the cycles
/// themselves take it.
class SinumerikCycleArguments {
 public:
  /// `mm`: of a unit of length as programmed.
  SinumerikCycleArguments(const nc::SinumerikCommand& cycle,
                          std::span<const nc::SinumerikValue> values, double mm)
      : cycle_(&cycle), values_(values), mm_(mm) {}

  /// "" or why the control would not take the call, with the alarm.
  std::string Error() const;
  /// Nothing at all is given.
  bool empty() const;
  bool given(std::string_view parameter) const { return Find(parameter) != nullptr; }
  double Number(std::string_view parameter) const;
  double Length(std::string_view parameter) const { return Number(parameter) * mm_; }
  /// Rounded, as INT parameters are.
  long Whole(std::string_view parameter) const;
  std::string_view Text(std::string_view parameter) const;
  double mm() const { return mm_; }
  const nc::SinumerikCommand& cycle() const { return *cycle_; }

 private:
  const nc::SinumerikValue* Find(std::string_view parameter) const;

  const nc::SinumerikCommand* cycle_;
  std::span<const nc::SinumerikValue> values_;
  double mm_;
};

/// A decimal digit of a parameter that is read digit by digit: 0 the units.
int Digit(long value, int place);

}  // namespace ncsim::control
