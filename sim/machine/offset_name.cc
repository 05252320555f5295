// SPDX-License-Identifier: BSD-3-Clause
#include "sim/machine/offset_name.h"

#include <charconv>

#include "sim/machine/job.h"

namespace ncsim::machine {
namespace {

std::optional<int> Whole(std::string_view digits, int lowest, int highest) {
  int value = 0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
  if (error != std::errc() || end != digits.data() + digits.size()) return std::nullopt;
  return value >= lowest && value <= highest ? std::optional<int>(value) : std::nullopt;
}

}  // namespace

std::optional<std::string> OffsetName(std::string_view text) {
  std::string name;
  for (const char c : text) {
    if (c == ' ' || c == '\t') continue;
    name += c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c;
  }
  if (name.empty() || name[0] != 'G') return std::nullopt;
  const std::string_view all = std::string_view(name).substr(1);
  const std::size_t p = all.find('P');
  const std::string_view code = all.substr(0, p);
  if (p != std::string_view::npos) {
    const std::optional<int> row = Whole(all.substr(p + 1), 1, code == "154" ? 99 : 300);
    if (!row || (code != "154" && code != "54.1")) return std::nullopt;
    return "G" + std::string(code) + " P" + std::to_string(*row);
  }
  if (code == "59.1" || code == "59.2" || code == "59.3") return "G" + std::string(code);
  for (const auto& [lowest, highest] : {std::pair(54, 59), {110, 129}, {500, 500}, {505, 599}}) {
    if (const auto number = Whole(code, lowest, highest)) return "G" + std::to_string(*number);
  }
  return std::nullopt;
}

std::string TwinOffset(const std::string& name) {
  constexpr std::string_view kExtended = "G154 P";
  if (name.starts_with(kExtended)) {
    const auto row = Whole(std::string_view(name).substr(kExtended.size()), 1, 20);
    return row ? "G" + std::to_string(109 + *row) : "";
  }
  const auto number = Whole(std::string_view(name).substr(name.empty() ? 0 : 1), 110, 129);
  return number ? std::string(kExtended) + std::to_string(*number - 109) : "";
}

const WorkOffset* Job::FindOffset(std::string_view name) const {
  const std::string spelled = OffsetName(name).value_or(std::string(name));
  auto it = offsets.find(spelled);
  if (it == offsets.end()) it = offsets.find(TwinOffset(spelled));
  return it == offsets.end() ? nullptr : &it->second;
}

}  // namespace ncsim::machine
