// SPDX-License-Identifier: BSD-3-Clause
// Cycles of the SINUMERIK (NC programming 12/2019, "Programming cycles externally").
#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "sim/base/text.h"
#include "sim/base/units.h"
#include "sim/control/sinumerik_interpreter.h"

namespace ncsim::control {
namespace {

constexpr double kStandardFactor = 10.0;  // SD55441 to SD55444, standard value.

}  // namespace

void SinumerikInterpreter::ExecuteCycle(const nc::SinumerikCommand& cycle,
                                        std::span<const nc::SinumerikValue> arguments,
                                        SourcePosition where) {
  if (cycle.name == "CYCLE832") return HighSpeedSettings(arguments, where);
  Unsupported(cycle.name, where, std::string(cycle.meaning));
}

/// CYCLE832(tolerance, type[, orientation tolerance]): units of the type 0 switch it off; tens 1:
/// the third parameter is the tolerance of the orientation, deg; else it is the contour's, in mm,
/// times SD55441 to SD55444 (p. 1108). Without parameters: off.
void SinumerikInterpreter::HighSpeedSettings(std::span<const nc::SinumerikValue> arguments,
                                             const SourcePosition& where) {
  const auto given = [&](std::size_t i) {
    return i < arguments.size() && !arguments[i].omitted && arguments[i].is_number();
  };
  contour_tolerance_ = orientation_tolerance_ = 0.0;
  factor_name_ = {};
  constexpr double kMaxType = 1e8;
  const bool typed = given(1) && std::abs(arguments[1].number) < kMaxType;
  const long type = typed ? std::lround(arguments[1].number) : 0;
  const long units = type % 10;
  if (type / 100 % 10 != 0) {
    Unsupported("the hundreds of CYCLE832's type", where, "older software switches TRAORI by them");
  }
  if (!given(0) || units == 0) return;
  contour_tolerance_ = std::max(0.0, arguments[0].number * mm_);
  if (type / 10 % 10 == 1 && given(2)) {
    orientation_tolerance_ = std::max(0.0, Radians(arguments[2].number));
    return;
  }
  constexpr std::array<const char*, 5> kFactors = {"", "SD55443", "SD55442", "SD55441", "SD55444"};
  if (units < 0 || units >= static_cast<long>(kFactors.size())) {
    Unsupported("CYCLE832 of a type that it does not have", where);
    return;
  }
  const auto index = static_cast<std::size_t>(units);
  const std::optional<double>& stated = settings_.tolerance_factors[index];
  factor_name_ = kFactors[index];
  factor_ = stated.value_or(kStandardFactor);
  factor_stated_ = stated.has_value();
  orientation_tolerance_ = std::max(0.0, Radians(contour_tolerance_ * factor_));
}

/// Under TRAORI the tool leans by an orientation tolerance that a factor has made.
void SinumerikInterpreter::CheckToleranceFactor() {
  if (!traori_ || factor_name_.empty()) return;
  const std::string name(factor_name_);
  if (!(factor_ > 0.0)) {
    Unsupported("CYCLE832 with " + name + " = 0 under TRAORI", step_->where,
                "the tolerance of the rotary axes (MD33100) is not known");
  } else if (!factor_stated_) {
    log_.Assume(name,
                Short(factor_) +
                    ": deg of CYCLE832's orientation tolerance for each mm of its "
                    "contour tolerance",
                false);
  }
  factor_name_ = {};
}

}  // namespace ncsim::control
