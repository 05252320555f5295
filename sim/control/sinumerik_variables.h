// SPDX-License-Identifier: BSD-3-Clause
// The user's variables of a SINUMERIK program: R parameters, what DEF and PROC define (NC
// programming 12/2019, "User variables").
#pragma once

#include <array>
#include <cstddef>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "sim/nc/sinumerik_value.h"

namespace ncsim::control {

/// A variable or array, or a part of one that a VAR parameter stands for.
class SinumerikVariable {
 public:
  /// Elements of an array of these sizes; none for a single value. `text_length`: of STRING[n].
  SinumerikVariable(nc::SinumerikType type, std::vector<std::size_t> sizes,
                    std::size_t text_length);
  /// Element `offset` of `base`, as a variable of its own.
  SinumerikVariable(std::shared_ptr<SinumerikVariable> base, std::size_t offset);

  nc::SinumerikType type() const { return type_; }
  const std::vector<std::size_t>& sizes() const { return sizes_; }
  std::size_t size() const { return count_; }
  const nc::SinumerikValue& value(std::size_t offset) const;
  /// Converts to the variable's type. Returns "" or why not, with the alarm.
  std::string Set(std::size_t offset, const nc::SinumerikValue& value);
  /// The place of the element with these indices; a FRAME also takes an axis and a component, which
  /// are left out here. Returns "" or why not.
  std::string OffsetOf(const std::vector<nc::SinumerikValue>& indices, std::size_t* offset) const;

 private:
  nc::SinumerikType type_;
  std::vector<std::size_t> sizes_;
  std::size_t count_;
  std::size_t text_length_;
  std::vector<nc::SinumerikValue> values_;  ///< Empty for a part of another variable.
  std::shared_ptr<SinumerikVariable> base_;
  std::size_t base_offset_ = 0;
};

/// Names of one program level, upper case.
using SinumerikScope = std::map<std::string, std::shared_ptr<SinumerikVariable>, std::less<>>;

/// 12 of `R12` and `$R12`; -1 of what is no R parameter.
long RParameterNumber(std::string_view name);
/// `RG12`, `$RG12`: an R parameter of the whole control, which is not simulated.
bool IsGlobalRParameter(std::string_view name);

/// A component of a frame, `[X,TR]`: TR, FI, RT, SC or MI. Nullopt-like "" where the name is none.
bool IsFrameComponent(std::string_view name);
/// Reads one; returns "" or why not. A chain of several frames has components only when it is
/// computed, which is not done here.
std::string ReadFrameComponent(const nc::SinumerikValue& frame, std::string_view axis,
                               std::string_view component, nc::SinumerikValue* value);
std::string WriteFrameComponent(nc::SinumerikValue* frame, std::string_view axis,
                                std::string_view component, const nc::SinumerikValue& value);

class SinumerikVariables {
 public:
  /// `r_parameters`: how many the channel has (MD28050).
  explicit SinumerikVariables(std::size_t r_parameters);

  /// R0, R1 ... as one array.
  const std::shared_ptr<SinumerikVariable>& r_parameters() const { return r_; }
  /// True once, if R`index` has not been set: the control keeps it over power-off.
  bool TakeUnset(std::size_t index);
  void MarkSet(std::size_t index) { r_set_[index] = true; }

  /// In the present level, then among the global ones; null for none.
  std::shared_ptr<SinumerikVariable> Find(std::string_view name) const;
  /// Returns "" or why not, with the alarm.
  std::string Define(std::string_view name, std::shared_ptr<SinumerikVariable> variable,
                     bool is_global);
  /// Elements that are still free, of all levels.
  std::size_t free_elements() const { return kMaxElements - used_; }

  void PushLevel(SinumerikScope scope);
  void PopLevel();
  const SinumerikScope& level() const { return levels_.back(); }
  void ResetLevel(SinumerikScope scope);

 private:
  static constexpr std::size_t kMaxElements = 200'000;

  std::shared_ptr<SinumerikVariable> r_;
  std::vector<bool> r_set_;
  SinumerikScope globals_;
  std::vector<SinumerikScope> levels_{1};
  std::size_t used_ = 0;
};

}  // namespace ncsim::control
