// SPDX-License-Identifier: BSD-3-Clause
#include "sim/nc/sinumerik_commands.h"

#include <array>
#include <cmath>
#include <map>
#include <utility>

#include "sim/base/text.h"
#include "sim/nc/sinumerik_token.h"

namespace ncsim::nc {
namespace {

constexpr std::size_t kHighestG = 999;

using ByName = std::map<std::string, const SinumerikCommand*, std::less<>>;

/// The letters of "G505", and its number.
std::pair<std::string, int> SplitName(std::string_view name) {
  const std::size_t digits = name.find_last_not_of("0123456789") + 1;
  int number = -1;
  for (std::size_t i = digits; i < name.size(); ++i) {
    number = (number < 0 ? 0 : number) * 10 + (name[i] - '0');
  }
  return {std::string(name.substr(0, digits)), number};
}

ByName MakeNames() {
  ByName names;
  for (const std::span<const SinumerikCommand> rows :
       {Sinumerik840dGCodes(), Sinumerik840dNames()}) {
    for (const SinumerikCommand& row : rows) {
      const auto [letters, first] = SplitName(row.name);
      names.emplace(std::string(row.name), &row);
      for (int i = first + 1; i <= row.last; ++i) names.emplace(letters + std::to_string(i), &row);
    }
  }
  return names;
}

const ByName& Names() {
  static const ByName names = MakeNames();
  return names;
}

std::array<const SinumerikCommand*, kHighestG + 1> MakeGNumbers() {
  std::array<const SinumerikCommand*, kHighestG + 1> numbers{};
  for (std::size_t i = 0; i <= kHighestG; ++i) {
    const auto found = Names().find("G" + std::to_string(i));
    if (found != Names().end()) numbers[i] = found->second;
  }
  return numbers;
}

struct Constant {
  std::string_view name;
  double value;
};
/// NC programming 12/2019, p. 1108 and cycle definitions of Operate: CYCLE832. The values of the
/// names with _ORI_ follow from the digits of the parameter.
constexpr std::array<Constant, 9> kConstants = {{
    {"_FINISH", 1.0},
    {"_OFF", 0.0},
    {"_ORI_FINISH", 11.0},
    {"_ORI_PRECISION", 14.0},
    {"_ORI_ROUGH", 13.0},
    {"_ORI_SEMIFIN", 12.0},
    {"_PRECISION", 4.0},
    {"_ROUGH", 3.0},
    {"_SEMIFIN", 2.0},
}};

}  // namespace

const SinumerikCommand* FindSinumerikCommand(std::string_view name) {
  std::string key = UpperName(name);
  if (key.size() > 2 && (key[0] == 'G' || key[0] == 'M') && IsDigit(key[1])) {
    while (key.size() > 2 && key[1] == '0') key.erase(1, 1);
  }
  const auto found = Names().find(key);
  return found == Names().end() ? nullptr : found->second;
}

const SinumerikCommand* FindSinumerikG(double number) {
  static const auto numbers = MakeGNumbers();
  if (!(number >= 0.0 && number <= static_cast<double>(kHighestG))) return nullptr;
  const auto index = static_cast<std::size_t>(number);
  return static_cast<double>(index) == number ? numbers[index] : nullptr;
}

const double* FindSinumerikConstant(std::string_view name) {
  for (const Constant& constant : kConstants) {
    if (SameName(name, constant.name)) return &constant.value;
  }
  return nullptr;
}

const std::vector<std::string>& SinumerikCommandNames() {
  static const std::vector<std::string> list = [] {
    std::vector<std::string> names;
    for (const auto& [name, row] : Names()) names.push_back(name);
    return names;
  }();
  return list;
}

}  // namespace ncsim::nc
