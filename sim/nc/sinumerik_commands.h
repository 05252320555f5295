// SPDX-License-Identifier: BSD-3-Clause
// Words of the SINUMERIK 840D sl as data: one row a G code, M function, address, predefined
// subprogram or cycle. Drives interpretation, documentation and findings.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "sim/nc/code_table.h"

namespace ncsim::nc {

enum class SinumerikCommandKind : unsigned char { kGCode, kMCode, kAddress, kProcedure, kCycle };

struct SinumerikCommand {
  std::string_view name;  ///< Upper case, without leading zeros: "G0", "TRAORI", "CYCLE83".
  SinumerikCommandKind kind;
  int group;        ///< G group, 1 to 64; 0 for what is no G code.
  bool is_default;  ///< Start state of its group (MD20150).
  int last;  ///< The row stands for its number up to this one (G505 to G599); 0 for it alone.
  Support support;
  std::string_view parameters;  ///< Of a cycle, in order, with blanks between.
  std::string_view meaning;     ///< The manual's words, short.
  std::string_view note;        ///< What the simulator does with it; "" for as stated.
};

/// Groups of which at most one member may stand in a block, with the addresses that belong to it:
/// "syntax-defining" G codes (NC programming 12/2019, G groups 2 and 3).
constexpr bool IsSyntaxGroup(int group) { return group == 2 || group == 3; }

std::span<const SinumerikCommand> Sinumerik840dGCodes();
std::span<const SinumerikCommand> Sinumerik840dNames();

/// By name, in any case, leading zeros of a G or M number dropped; null for none. A name that is
/// both G code and something else is the G code.
const SinumerikCommand* FindSinumerikCommand(std::string_view name);
/// G0 to G999; null where the control has none.
const SinumerikCommand* FindSinumerikG(double number);
/// The value of a constant that cycles know by name (`_ORI_ROUGH` of CYCLE832); null for none.
const double* FindSinumerikConstant(std::string_view name);
/// Every name, for "did you mean".
const std::vector<std::string>& SinumerikCommandNames();

}  // namespace ncsim::nc
