// SPDX-License-Identifier: BSD-3-Clause
#include "post/values.h"

#include <utility>

namespace ncsim::post {

std::string_view DefaultFormat(ValueKind kind) {
  switch (kind) {
    case ValueKind::kLength:
      return "length";
    case ValueKind::kAngle:
      return "angle";
    case ValueKind::kFeed:
      return "feed";
    case ValueKind::kSeconds:
      return "seconds";
    case ValueKind::kNumber:
      return "vector";
    case ValueKind::kText:
    case ValueKind::kCount:
      return "";
  }
  return "";
}

const std::vector<ValueInfo>& ValueTable() {
  static const std::vector<ValueInfo> table = {
#define NCSIM_VALUE(enumerator, name, kind, scopes) {name, ValueKind::kind, (scopes)},
#include "post/values.def"
#undef NCSIM_VALUE
  };
  return table;
}

const ValueInfo& Info(Value value) { return ValueTable()[static_cast<std::size_t>(value)]; }

std::optional<Value> ValueFromName(std::string_view name) {
  for (std::size_t i = 0; i < ValueTable().size(); ++i) {
    if (ValueTable()[i].name == name) return static_cast<Value>(i);
  }
  return std::nullopt;
}

bool IsPosition(Value value) {
  return (value >= Value::kX && value <= Value::kAxisZ) ||
         (value >= Value::kArcI && value <= Value::kArcK);
}

Values::Values() : numbers_(ValueTable().size()), texts_(ValueTable().size()) {}

void Values::Set(Value value, std::optional<double> number) {
  numbers_[static_cast<std::size_t>(value)] = number;
}
void Values::Set(Value value, std::string text) {
  texts_[static_cast<std::size_t>(value)] = std::move(text);
}
void Values::Clear(Value value) {
  numbers_[static_cast<std::size_t>(value)].reset();
  texts_[static_cast<std::size_t>(value)].clear();
}
const std::optional<double>& Values::number(Value value) const {
  return numbers_[static_cast<std::size_t>(value)];
}
const std::string& Values::text(Value value) const {
  return texts_[static_cast<std::size_t>(value)];
}

const std::array<GroupInfo, kGroups>& GroupTable() {
  static const std::array<GroupInfo, kGroups> table = {{
      {"motion", {"rapid", "line", "arc_cw", "arc_ccw"}, kMotion | kHole | kPosition},
      {"plane", {"xy", "zx", "yz"}, kMotion | kHole | kPosition},
      {"feed_mode", {"per_minute", "inverse_time", "per_revolution"}, kMotion | kHole | kPosition},
      {"comp", {"off", "left", "right"}, kMotion | kPosition},
      {"return", {"initial", "clearance"}, kHole},
      {"spindle", {"off", "clockwise", "counter_clockwise", "locked"}, kAll},
      {"coolant", {"off", "on", "flood", "mist", "tap", "through", "air"}, kAll},
      {"unit", {"mm", "inch"}, kAll},
  }};
  return table;
}

}  // namespace ncsim::post
