// SPDX-License-Identifier: BSD-3-Clause
#include "sim/control/macro_variables.h"

namespace ncsim::control {
namespace {

/// "10000 is added to 3-digit macro variables" (manual 2017, "Macro Variable Display Page"), in the
/// three legacy ranges.
long WithoutAlias(long number) {
  const bool legacy = (number >= 100 && number <= 199) || (number >= 500 && number <= 699) ||
                      (number >= 800 && number <= 999);
  return legacy ? number + 10000 : number;
}

}  // namespace

MacroVariables::MacroVariables(const FlowOptions& options, SystemVariables* system)
    : options_(options), system_(system) {}

bool MacroVariables::Read(long number, nc::MacroValue* value) {
  if (number >= 1 && number <= 33) {
    *value = locals_.back()[static_cast<std::size_t>(number)];
    return true;
  }
  const long common = WithoutAlias(number) - kFirstCommon;
  if (common >= 0 && common < static_cast<long>(kCommons)) {
    const auto index = static_cast<std::size_t>(common);
    if (!known_[index]) {
      known_[index] = true;
      system_->AssumeUndefined(number);
    }
    *value = commons_[index];
    return true;
  }
  switch (number) {
    case 0:
      value->reset();
      return true;
    case 3003:
      *value = single_block_suppress_;
      return true;
    case 3004:
      *value = override_control_;
      return true;
    case 3030:
      *value = 0.0;
      return true;
    case 3032:
      *value = options_.block_delete ? 1.0 : 0.0;
      return true;
    case 3033:
      *value = options_.optional_stop ? 1.0 : 0.0;
      return true;
    default:
      return system_->Read(number, value);
  }
}

bool MacroVariables::Write(long number, nc::MacroValue value) {
  if (number >= 1 && number <= 33) {
    locals_.back()[static_cast<std::size_t>(number)] = value;
    return true;
  }
  const long common = WithoutAlias(number) - kFirstCommon;
  if (common >= 0 && common < static_cast<long>(kCommons)) {
    const auto index = static_cast<std::size_t>(common);
    known_[index] = true;
    commons_[index] = value;
    return true;
  }
  switch (number) {
    case 0:
    case 3030:
    case 3032:
    case 3033:
      return false;
    case 3003:
      single_block_suppress_ = value;
      return true;
    case 3004:
      override_control_ = value;
      return true;
    default:
      return system_->Write(number, value);
  }
}

void MacroVariables::SetAddress(char address) {
  decimals_ = address == 0 ? 4 : DecimalsOf(address);
}

int MacroVariables::DecimalsOf(char address) const {
  switch (address) {
    case 'A':
    case 'B':
    case 'C':
    case 'P':  // G04: milliseconds.
      return 3;
    case 'G':
    case 'M':
      return 1;  // A code that is no whole number stays visible as one that is not listed.
    case 'D':
    case 'H':
    case 'L':
    case 'N':
    case 'O':
    case 'S':
    case 'T':
      return 0;
    default:
      return system_->length_decimals();
  }
}

}  // namespace ncsim::control
