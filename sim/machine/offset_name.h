// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace ncsim::machine {

/// The one spelling of a work offset's name: "g154 p03" -> "G154 P3". nullopt for what is none:
/// G54-G59, G59.1-G59.3, G110-G129, G154 P1-P99, G54.1 P1-P300, G500 and G505-G599 are.
std::optional<std::string> OffsetName(std::string_view text);

/// The other name of the same offset: G110-G129 are G154 P1-P20 (Haas NGC Mill Operator's Manual
/// 2017, G154); "" if it has none.
std::string TwinOffset(const std::string& name);

}  // namespace ncsim::machine
