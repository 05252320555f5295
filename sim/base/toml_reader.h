// SPDX-License-Identifier: BSD-3-Clause
// A strict reader of TOML: everything has line and column, a key that nobody asks for is an error,
// a value of the wrong type or without sense (NaN, infinite, negative where that cannot be) is an
// error. toml++ stays behind it.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "sim/base/diagnostics.h"

namespace ncsim {

/// A value as the file has it. Containers keep the order of the file.
struct TomlValue {
  enum class Kind { kTable, kArray, kString, kInteger, kFloat, kBoolean, kDate };
  Kind kind = Kind::kTable;
  int line = 0, column = 0;          ///< Of the value.
  int key_line = 0, key_column = 0;  ///< Of its key; 0 for an element of an array.
  std::string key;
  std::string text;                 ///< kString.
  double number = 0.0;              ///< kInteger, kFloat.
  std::int64_t integer = 0;         ///< kInteger.
  bool boolean = false;             ///< kBoolean.
  std::vector<TomlValue> children;  ///< kArray: the elements; kTable: the values with their keys.

  bool is_number() const { return kind == Kind::kInteger || kind == Kind::kFloat; }
  const TomlValue* Find(std::string_view name) const;
};

/// What a number may be. All must be finite and within +-1e9.
enum class NumberRule { kAny, kNotNegative, kPositive };

/// A table being read. Getters remember the keys that were asked for; Finish() reports the others.
class TomlTable {
 public:
  /// `value` (a table) and `diagnostics` must outlive this.
  TomlTable(const TomlValue& value, std::string file, Diagnostics* diagnostics)
      : value_(&value), file_(std::move(file)), diagnostics_(diagnostics) {}

  /// The value, of any type, or nullptr. Counts as asked for.
  const TomlValue* Get(std::string_view key);
  /// As Get(); an absent key is an error at the table.
  const TomlValue* Require(std::string_view key);

  /// nullopt where the key is absent, or where its value is wrong (reported).
  std::optional<double> Number(std::string_view key, NumberRule rule = NumberRule::kAny);
  std::optional<double> RequiredNumber(std::string_view key, NumberRule rule = NumberRule::kAny);
  std::optional<std::int64_t> Integer(std::string_view key, std::int64_t lowest,
                                      std::int64_t highest);
  std::optional<std::string> String(std::string_view key);
  std::optional<std::string> RequiredString(std::string_view key);
  std::optional<bool> Boolean(std::string_view key);
  /// One of `words`; another one is an error that names them.
  std::optional<std::string> Word(std::string_view key, const std::vector<std::string>& words);
  std::optional<Eigen::Vector3d> Vector3(std::string_view key, NumberRule rule = NumberRule::kAny);
  std::vector<std::string> Strings(std::string_view key);
  std::vector<int> Integers(std::string_view key, std::int64_t lowest, std::int64_t highest);
  std::optional<TomlTable> Table(std::string_view key);
  /// An array of tables; empty where the key is absent.
  std::vector<TomlTable> Tables(std::string_view key);

  /// Reports every key that was not asked for, with its position and the nearest key that was.
  void Finish() const;

  /// A number out of `value`, by the same rules; nullopt and an error otherwise. `name` is for the
  /// message.
  std::optional<double> AsNumber(const TomlValue& value, std::string_view name,
                                 NumberRule rule = NumberRule::kAny) const;
  std::optional<TomlTable> AsTable(const TomlValue& value, std::string_view name) const;

  const TomlValue& value() const { return *value_; }
  const std::string& file() const { return file_; }
  Diagnostics* diagnostics() const { return diagnostics_; }
  void ErrorAt(const TomlValue& where, std::string message) const;
  void WarningAt(const TomlValue& where, std::string message) const;

 private:
  std::optional<TomlTable> WrongKind(const TomlValue& value, std::string_view name,
                                     std::string_view wanted) const;

  const TomlValue* value_;
  std::string file_;
  Diagnostics* diagnostics_;
  std::vector<std::string> asked_;
};

/// Parses `text`; `file` is for the messages. nullopt (reported) when it is not TOML: bad syntax, a
/// key stated twice.
std::optional<TomlValue> ParseToml(std::string_view text, const std::string& file,
                                   Diagnostics* diagnostics);

}  // namespace ncsim
