// SPDX-License-Identifier: BSD-3-Clause
#include "sim/machine/trafo_type.h"

#include <algorithm>
#include <array>

namespace ncsim::machine {
namespace {

constexpr int kToolCarrier = 72;
/// The type less its group; 8 is the generic one, of any axes.
constexpr int kGeneric = 8;
constexpr std::array<const char*, 6> kSequences = {"AB", "AC", "BA", "BC", "CA", "CB"};

enum Group { kHead = 16, kTable = 32, kMixed = 48 };

const char* Name(Group group) {
  if (group == kHead) return "head";
  return group == kTable ? "table" : "head and table";
}

}  // namespace

std::string TrafoTypeFault(const Machine& machine, int type) {
  if (type == kToolCarrier) return "";
  const std::string says = "MD24100 = " + std::to_string(type) + " ";
  if (!machine.five_axis || machine.five_axis->rotary().size() != 2) {
    return says + "is a five-axis transformation: the URDF has not two rotary axes";
  }
  // rotary() runs from the spindle to the table, a sequence from what carries to what is carried.
  std::string sequence;
  std::array<bool, 2> on_table{};
  const std::vector<int> table_side = machine.tree.MovingJointsTo(machine.table_link);
  for (std::size_t k = 0; k < 2; ++k) {
    const int index = machine.five_axis->rotary()[k];
    on_table[k] = std::any_of(table_side.begin(), table_side.end(), [&](int joint) {
      return machine.tree.joints()[static_cast<std::size_t>(joint)].index == index;
    });
    for (const Axis& axis : machine.axes) {
      if (axis.joint == index) sequence += axis.letter;
    }
  }
  Group group = kMixed;
  if (on_table[0] == on_table[1]) group = on_table[0] ? kTable : kHead;
  if (group == kHead) std::reverse(sequence.begin(), sequence.end());
  const int low = type % 16;
  const auto known = std::find(kSequences.begin(), kSequences.end(), sequence);
  const bool fits = type - low == group &&
                    (low == kGeneric || (known != kSequences.end() &&
                                         low == static_cast<int>(known - kSequences.begin())));
  if (fits) return "";
  return says + "does not fit the URDF: a " + Name(group) + " machine, " + sequence + ", is " +
         (known == kSequences.end()
              ? ""
              : std::to_string(group + static_cast<int>(known - kSequences.begin())) + " or ") +
         std::to_string(group + kGeneric);
}

}  // namespace ncsim::machine
