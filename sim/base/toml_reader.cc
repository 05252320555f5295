// SPDX-License-Identifier: BSD-3-Clause
#include "sim/base/toml_reader.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "sim/base/text.h"

#define TOML_EXCEPTIONS 0
#define TOML_HEADER_ONLY 1
// With NDEBUG toml++ 3.3 turns its assertions into what the compiler may take for granted, and some
// do not hold for bad input ("[[[": parse_key); the code behind them copes.
#undef NDEBUG
#define TOML_ASSERT(expr) static_cast<void>(0)
#include <toml++/toml.h>

namespace ncsim {
namespace {

constexpr double kGreatestNumber = 1e9;

std::string_view KindName(TomlValue::Kind kind) {
  switch (kind) {
    case TomlValue::Kind::kTable:
      return "a table";
    case TomlValue::Kind::kArray:
      return "an array";
    case TomlValue::Kind::kString:
      return "a string";
    case TomlValue::Kind::kInteger:
    case TomlValue::Kind::kFloat:
      return "a number";
    case TomlValue::Kind::kBoolean:
      return "true or false";
    case TomlValue::Kind::kDate:
      return "a date";
  }
  return "";
}

TomlValue Convert(const toml::node& node) {
  TomlValue value;
  value.line = static_cast<int>(node.source().begin.line);
  value.column = static_cast<int>(node.source().begin.column);
  if (const toml::table* table = node.as_table()) {
    value.kind = TomlValue::Kind::kTable;
    for (const auto& [key, child] : *table) {
      value.children.push_back(Convert(child));
      value.children.back().key = std::string(key.str());
      value.children.back().key_line = static_cast<int>(key.source().begin.line);
      value.children.back().key_column = static_cast<int>(key.source().begin.column);
    }
    std::stable_sort(
        value.children.begin(), value.children.end(), [](const TomlValue& a, const TomlValue& b) {
          return std::pair(a.key_line, a.key_column) < std::pair(b.key_line, b.key_column);
        });
  } else if (const toml::array* array = node.as_array()) {
    value.kind = TomlValue::Kind::kArray;
    for (const toml::node& child : *array) value.children.push_back(Convert(child));
  } else if (const auto* text = node.as_string()) {
    value.kind = TomlValue::Kind::kString;
    value.text = text->get();
  } else if (const auto* integer = node.as_integer()) {
    value.kind = TomlValue::Kind::kInteger;
    value.integer = integer->get();
    value.number = static_cast<double>(value.integer);
  } else if (const auto* number = node.as_floating_point()) {
    value.kind = TomlValue::Kind::kFloat;
    value.number = number->get();
  } else if (const auto* boolean = node.as_boolean()) {
    value.kind = TomlValue::Kind::kBoolean;
    value.boolean = boolean->get();
  } else {
    value.kind = TomlValue::Kind::kDate;
  }
  return value;
}

std::string Quoted(std::string_view name) { return "'" + std::string(name) + "'"; }

std::string Listed(const std::vector<std::string>& words) {
  std::string text;
  for (std::size_t i = 0; i < words.size(); ++i) {
    if (i > 0) text += i + 1 == words.size() ? " or " : ", ";
    text += "\"" + words[i] + "\"";
  }
  return text;
}

}  // namespace

std::optional<TomlValue> ParseToml(std::string_view text, const std::string& file,
                                   Diagnostics* diagnostics) {
  const toml::parse_result result = toml::parse(text);
  if (!result) {
    const toml::parse_error& error = result.error();
    diagnostics->Error(file, static_cast<int>(error.source().begin.line),
                       static_cast<int>(error.source().begin.column),
                       "not TOML: " + std::string(error.description()));
    return std::nullopt;
  }
  return Convert(result.table());
}

const TomlValue* TomlValue::Find(std::string_view name) const {
  for (const TomlValue& child : children) {
    if (child.key == name) return &child;
  }
  return nullptr;
}

const TomlValue* TomlTable::Get(std::string_view key) {
  asked_.emplace_back(key);
  return value_->Find(key);
}

const TomlValue* TomlTable::Require(std::string_view key) {
  const TomlValue* value = Get(key);
  if (value == nullptr) ErrorAt(*value_, "the key " + Quoted(key) + " is missing");
  return value;
}

std::optional<TomlTable> TomlTable::WrongKind(const TomlValue& value, std::string_view name,
                                              std::string_view wanted) const {
  ErrorAt(value, Quoted(name) + " must be " + std::string(wanted) + ", not " +
                     std::string(KindName(value.kind)));
  return std::nullopt;
}

std::optional<double> TomlTable::AsNumber(const TomlValue& value, std::string_view name,
                                          NumberRule rule) const {
  if (!value.is_number()) {
    WrongKind(value, name, "a number");
    return std::nullopt;
  }
  const auto refuse = [&](const std::string& what) -> std::optional<double> {
    ErrorAt(value, Quoted(name) + what);
    return std::nullopt;
  };
  if (std::isnan(value.number)) return refuse(" is not a number (nan)");
  if (std::isinf(value.number)) return refuse(" is infinite");
  if (std::abs(value.number) > kGreatestNumber) return refuse(" is beyond 1000000000: absurd here");
  if (rule == NumberRule::kPositive && value.number <= 0.0) {
    return refuse(" must be greater than 0, not " + Short(value.number));
  }
  if (rule == NumberRule::kNotNegative && value.number < 0.0) {
    return refuse(" must not be negative, and is " + Short(value.number));
  }
  return value.number;
}

std::optional<TomlTable> TomlTable::AsTable(const TomlValue& value, std::string_view name) const {
  if (value.kind != TomlValue::Kind::kTable) return WrongKind(value, name, "a table");
  return TomlTable(value, file_, diagnostics_);
}

std::optional<double> TomlTable::Number(std::string_view key, NumberRule rule) {
  const TomlValue* value = Get(key);
  return value == nullptr ? std::nullopt : AsNumber(*value, key, rule);
}

std::optional<double> TomlTable::RequiredNumber(std::string_view key, NumberRule rule) {
  const TomlValue* value = Require(key);
  return value == nullptr ? std::nullopt : AsNumber(*value, key, rule);
}

std::optional<std::int64_t> TomlTable::Integer(std::string_view key, std::int64_t lowest,
                                               std::int64_t highest) {
  const TomlValue* value = Get(key);
  if (value == nullptr) return std::nullopt;
  if (value->kind != TomlValue::Kind::kInteger) {
    ErrorAt(*value, Quoted(key) + " must be a whole number");
    return std::nullopt;
  }
  if (value->integer < lowest || value->integer > highest) {
    ErrorAt(*value, Quoted(key) + " must be from " + std::to_string(lowest) + " to " +
                        std::to_string(highest) + ", not " + std::to_string(value->integer));
    return std::nullopt;
  }
  return value->integer;
}

std::optional<std::string> TomlTable::String(std::string_view key) {
  const TomlValue* value = Get(key);
  if (value == nullptr) return std::nullopt;
  if (value->kind != TomlValue::Kind::kString) {
    WrongKind(*value, key, "a string");
    return std::nullopt;
  }
  return value->text;
}

std::optional<std::string> TomlTable::RequiredString(std::string_view key) {
  return Require(key) == nullptr ? std::nullopt : String(key);
}

std::optional<bool> TomlTable::Boolean(std::string_view key) {
  const TomlValue* value = Get(key);
  if (value == nullptr) return std::nullopt;
  if (value->kind != TomlValue::Kind::kBoolean) {
    WrongKind(*value, key, "true or false");
    return std::nullopt;
  }
  return value->boolean;
}

std::optional<std::string> TomlTable::Word(std::string_view key,
                                           const std::vector<std::string>& words) {
  std::optional<std::string> word = String(key);
  if (!word || std::find(words.begin(), words.end(), *word) != words.end()) return word;
  ErrorAt(*value_->Find(key), Quoted(key) + " must be " + Listed(words) + ", not \"" + *word +
                                  "\"" + DidYouMean(*word, words));
  return std::nullopt;
}

std::optional<Eigen::Vector3d> TomlTable::Vector3(std::string_view key, NumberRule rule) {
  const TomlValue* value = Get(key);
  if (value == nullptr) return std::nullopt;
  if (value->kind != TomlValue::Kind::kArray || value->children.size() != 3) {
    ErrorAt(*value, Quoted(key) + " must be an array of three numbers");
    return std::nullopt;
  }
  Eigen::Vector3d vector;
  for (int i = 0; i < 3; ++i) {
    const std::optional<double> number =
        AsNumber(value->children[static_cast<std::size_t>(i)], key, rule);
    if (!number) return std::nullopt;
    vector[i] = *number;
  }
  return vector;
}

std::vector<std::string> TomlTable::Strings(std::string_view key) {
  std::vector<std::string> strings;
  const TomlValue* value = Get(key);
  if (value == nullptr) return strings;
  if (value->kind != TomlValue::Kind::kArray) {
    WrongKind(*value, key, "an array of strings");
    return strings;
  }
  for (const TomlValue& child : value->children) {
    if (child.kind == TomlValue::Kind::kString) {
      strings.push_back(child.text);
    } else {
      WrongKind(child, key, "an array of strings");
    }
  }
  return strings;
}

std::vector<int> TomlTable::Integers(std::string_view key, std::int64_t lowest,
                                     std::int64_t highest) {
  std::vector<int> integers;
  const TomlValue* value = Get(key);
  if (value == nullptr) return integers;
  if (value->kind != TomlValue::Kind::kArray) {
    WrongKind(*value, key, "an array of whole numbers");
    return integers;
  }
  for (const TomlValue& child : value->children) {
    if (child.kind == TomlValue::Kind::kInteger && child.integer >= lowest &&
        child.integer <= highest) {
      integers.push_back(static_cast<int>(child.integer));
    } else {
      ErrorAt(child, "an element of " + Quoted(key) + " must be a whole number from " +
                         std::to_string(lowest) + " to " + std::to_string(highest));
    }
  }
  return integers;
}

std::optional<TomlTable> TomlTable::Table(std::string_view key) {
  const TomlValue* value = Get(key);
  return value == nullptr ? std::nullopt : AsTable(*value, key);
}

std::vector<TomlTable> TomlTable::Tables(std::string_view key) {
  std::vector<TomlTable> tables;
  const TomlValue* value = Get(key);
  if (value == nullptr) return tables;
  if (value->kind != TomlValue::Kind::kArray) {
    WrongKind(*value, key, "an array of tables ([[" + std::string(key) + "]])");
    return tables;
  }
  for (const TomlValue& child : value->children) {
    if (std::optional<TomlTable> table = AsTable(child, key)) tables.push_back(std::move(*table));
  }
  return tables;
}

void TomlTable::Finish() const {
  for (const TomlValue& child : value_->children) {
    if (std::find(asked_.begin(), asked_.end(), child.key) != asked_.end()) continue;
    diagnostics_->Error(file_, child.key_line, child.key_column,
                        "unknown key " + Quoted(child.key) + DidYouMean(child.key, asked_));
  }
}

void TomlTable::ErrorAt(const TomlValue& where, std::string message) const {
  diagnostics_->Error(file_, where.line, where.column, std::move(message));
}

void TomlTable::WarningAt(const TomlValue& where, std::string message) const {
  diagnostics_->Warning(file_, where.line, where.column, std::move(message));
}

}  // namespace ncsim
