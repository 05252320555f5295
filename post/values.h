// SPDX-License-Identifier: BSD-3-Clause
// The values that blocks of a post can print, and the blocks that have them. docs/post.md says what
// each is.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace ncsim::post {

/// What kind of block a template is for.
enum Scope : unsigned {
  kGeneral = 1U << 0,  ///< Start, end, operation, spindle, stop.
  kToolChange = 1U << 1,
  kMotion = 1U << 2,
  kHole = 1U << 3,
  kPosition = 1U << 4,  ///< Index and rewind.
  kDwellBlock = 1U << 5,
  kTextBlock = 1U << 6,
  kCodeBlock = 1U << 7,
  kFunction = 1U << 8,
  kToolTable = 1U << 9,  ///< A row of it.
  kAll = (1U << 10) - 1,
};

enum class ValueKind : std::uint8_t {
  kText,
  kCount,    ///< Prints as it is where no format is stated.
  kLength,   ///< mm or inch; format "length".
  kAngle,    ///< Degrees; format "angle".
  kFeed,     ///< Format "feed".
  kSeconds,  ///< Format "seconds".
  kNumber,   ///< Format "vector".
};
/// Of [formats]; "" for texts and counts.
std::string_view DefaultFormat(ValueKind kind);

enum class Value : std::uint8_t {
#define NCSIM_VALUE(enumerator, name, kind, scopes) enumerator,
#include "post/values.def"
#undef NCSIM_VALUE
};

struct ValueInfo {
  std::string_view name;
  ValueKind kind;
  unsigned scopes;
};
/// In the order of Value.
const std::vector<ValueInfo>& ValueTable();
const ValueInfo& Info(Value value);
std::optional<Value> ValueFromName(std::string_view name);
/// A coordinate of the tool: a block of motion that prints none is no motion.
bool IsPosition(Value value);

/// The values as they are. Numbers are in the program's unit, degrees and minutes.
class Values {
 public:
  Values();
  void Set(Value value, std::optional<double> number);
  void Set(Value value, std::string text);
  void Clear(Value value);
  const std::optional<double>& number(Value value) const;
  const std::string& text(Value value) const;

 private:
  std::vector<std::optional<double>> numbers_;
  std::vector<std::string> texts_;
};

/// Codes that are modal in groups.
enum class Group : std::uint8_t {
  kMotion,
  kPlane,
  kFeedMode,
  kComp,
  kReturn,
  kSpindle,
  kCoolant,
  kUnit
};
inline constexpr int kGroups = 8;
struct GroupInfo {
  std::string_view name;               ///< In [codes], and in templates.
  std::vector<std::string_view> keys;  ///< What it can be.
  unsigned scopes;
};
const std::array<GroupInfo, kGroups>& GroupTable();

}  // namespace ncsim::post
