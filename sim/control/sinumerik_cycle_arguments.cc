// SPDX-License-Identifier: BSD-3-Clause
#include "sim/control/sinumerik_cycle_arguments.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "sim/nc/sinumerik_token.h"

namespace ncsim::control {
namespace {

constexpr std::array<std::string_view, 5> kTexts = {"_TC", "_HIDE", "_PITM", "_PTAB", "_PTABA"};

/// Takes the next word off a list with blanks between; "" at its end.
std::string_view NextWord(std::string_view* list) {
  const std::size_t end = std::min(list->find(' '), list->size());
  const std::string_view word = list->substr(0, end);
  list->remove_prefix(std::min(end + 1, list->size()));
  return word;
}

}  // namespace

std::string SinumerikCycleArguments::Error() const {
  std::string_view names = cycle_->parameters;
  for (const nc::SinumerikValue& value : values_) {
    const std::string_view name = NextWord(&names);
    if (name.empty()) {
      return nc::AlarmText(12340, "the call of " + std::string(cycle_->name) + " has " +
                                      std::to_string(values_.size()) + " arguments, too many");
    }
    const bool text = std::find(kTexts.begin(), kTexts.end(), name) != kTexts.end();
    const bool is_text = value.type == nc::SinumerikType::kString;
    if (value.omitted || (text ? is_text : value.is_number())) continue;
    return nc::AlarmText(12150, std::string(cycle_->name) + ": " + std::string(name) + " needs a " +
                                    (text ? "text" : "number"));
  }
  return "";
}

bool SinumerikCycleArguments::empty() const {
  return std::all_of(values_.begin(), values_.end(),
                     [](const nc::SinumerikValue& value) { return value.omitted; });
}

const nc::SinumerikValue* SinumerikCycleArguments::Find(std::string_view parameter) const {
  std::string_view names = cycle_->parameters;
  for (const nc::SinumerikValue& value : values_) {
    if (NextWord(&names) == parameter) return value.omitted ? nullptr : &value;
  }
  return nullptr;
}

double SinumerikCycleArguments::Number(std::string_view parameter) const {
  const nc::SinumerikValue* value = Find(parameter);
  return value == nullptr ? 0.0 : value->number;
}

long SinumerikCycleArguments::Whole(std::string_view parameter) const {
  constexpr double kLargest = std::numeric_limits<std::int32_t>::max();
  return std::lround(std::clamp(Number(parameter), -kLargest, kLargest));
}

std::string_view SinumerikCycleArguments::Text(std::string_view parameter) const {
  const nc::SinumerikValue* value = Find(parameter);
  return value == nullptr ? std::string_view() : std::string_view(value->text);
}

int Digit(long value, int place) {
  for (; place > 0; --place) value /= 10;
  return static_cast<int>(std::abs(value % 10));
}

}  // namespace ncsim::control
