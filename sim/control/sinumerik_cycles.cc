// SPDX-License-Identifier: BSD-3-Clause
// Cycles of the SINUMERIK (NC programming 12/2019, "Programming cycles externally").
#include <algorithm>
#include <cmath>
#include <string>

#include "sim/base/units.h"
#include "sim/control/sinumerik_interpreter.h"

namespace ncsim::control {

void SinumerikInterpreter::ExecuteCycle(const nc::SinumerikCommand& cycle,
                                        std::span<const nc::SinumerikValue> arguments,
                                        SourcePosition where) {
  if (cycle.name == "CYCLE832") return HighSpeedSettings(arguments, where);
  Unsupported(cycle.name, where, std::string(cycle.meaning));
}

/// CYCLE832(tolerance, type[, orientation tolerance]): units of the type 0 switch it off; tens 1:
/// the third parameter is the tolerance of the orientation, deg (p. 1108). Without parameters: off.
void SinumerikInterpreter::HighSpeedSettings(std::span<const nc::SinumerikValue> arguments,
                                             const SourcePosition& where) {
  const auto given = [&](std::size_t i) {
    return i < arguments.size() && !arguments[i].omitted && arguments[i].is_number();
  };
  contour_tolerance_ = orientation_tolerance_ = 0.0;
  const long type = given(1) ? std::lround(arguments[1].number) : 0;
  if (!given(0) || type % 10 == 0) return;
  contour_tolerance_ = std::max(0.0, arguments[0].number * mm_);
  if (type / 10 % 10 == 1 && given(2)) {
    orientation_tolerance_ = std::max(0.0, Radians(arguments[2].number));
  } else if (traori_) {
    Unsupported("CYCLE832 without an orientation tolerance under TRAORI", where,
                "SD55441 to SD55443 make it from the contour's");
  }
}

}  // namespace ncsim::control
