// SPDX-License-Identifier: BSD-3-Clause
#include "sim/control/sinumerik_variables.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "sim/base/text.h"
#include "sim/nc/sinumerik_token.h"

namespace ncsim::control {
namespace {

using nc::SinumerikType;
using nc::SinumerikValue;

std::size_t Elements(const SinumerikScope& scope) {
  std::size_t count = 0;
  for (const auto& [name, variable] : scope) count += variable->size();
  return count;
}

const nc::SinumerikFrame::Axis* FindAxis(const SinumerikValue& frame, std::string_view axis) {
  if (!frame.frame || frame.frame->chain.empty()) return nullptr;
  for (const nc::SinumerikFrame::Axis& candidate : frame.frame->chain.front()) {
    if (candidate.name == axis) return &candidate;
  }
  return nullptr;
}

bool IsSingle(const SinumerikValue& frame) { return !frame.frame || frame.frame->chain.size() < 2; }

}  // namespace

SinumerikVariable::SinumerikVariable(SinumerikType type, std::vector<std::size_t> sizes,
                                     std::size_t text_length)
    : type_(type), sizes_(std::move(sizes)), count_(1), text_length_(text_length) {
  for (const std::size_t size : sizes_) count_ *= size;
  values_.assign(count_, SinumerikValue::Default(type));
}

SinumerikVariable::SinumerikVariable(std::shared_ptr<SinumerikVariable> base, std::size_t offset)
    : type_(base->type_),
      count_(1),
      text_length_(base->text_length_),
      base_(std::move(base)),
      base_offset_(offset) {}

const SinumerikValue& SinumerikVariable::value(std::size_t offset) const {
  return base_ ? base_->value(base_offset_) : values_[offset];
}

std::string SinumerikVariable::Set(std::size_t offset, const SinumerikValue& value) {
  if (base_) return base_->Set(base_offset_, value);
  SinumerikValue converted;
  std::string error = nc::Convert(value, type_, &converted);
  if (!error.empty()) return error;
  if (type_ == SinumerikType::kString && converted.text.size() > text_length_) {
    return nc::AlarmText(12210, "the string is longer than its variable");
  }
  values_[offset] = std::move(converted);
  return "";
}

std::string SinumerikVariable::OffsetOf(const std::vector<SinumerikValue>& indices,
                                        std::size_t* offset) const {
  if (indices.size() != sizes_.size()) {
    return nc::AlarmText(12400, indices.size() < sizes_.size() ? "an index of the array is missing"
                                                               : "more indices than the array has");
  }
  *offset = 0;
  for (std::size_t i = 0; i < indices.size(); ++i) {
    if (!indices[i].is_number()) return nc::AlarmText(12410, "an index must be a number");
    const double index = std::round(indices[i].number);
    if (!(index >= 0.0 && index < static_cast<double>(sizes_[i]))) {
      return nc::AlarmText(
          17020 + 10 * static_cast<int>(i),
          "index " + std::to_string(i + 1) + " is beyond 0 to " + std::to_string(sizes_[i] - 1));
    }
    *offset = *offset * sizes_[i] + static_cast<std::size_t>(index);
  }
  return "";
}

long RParameterNumber(std::string_view name) {
  if (!name.empty() && name[0] == '$') name.remove_prefix(1);
  if (name.size() < 2 || name.size() > 7 || Upper(name[0]) != 'R') return -1;
  long number = 0;
  for (const char c : name.substr(1)) {
    if (!IsDigit(c)) return -1;
    number = number * 10 + (c - '0');
  }
  return number;
}

bool IsGlobalRParameter(std::string_view name) {
  if (!name.empty() && name[0] == '$') name.remove_prefix(1);
  return name.size() > 2 && nc::SameName(name.substr(0, 2), "RG") &&
         std::all_of(name.begin() + 2, name.end(), IsDigit);
}

bool IsFrameComponent(std::string_view name) {
  for (const std::string_view component : {"TR", "FI", "RT", "SC", "MI"}) {
    if (nc::SameName(name, component)) return true;
  }
  return false;
}

std::string ReadFrameComponent(const SinumerikValue& frame, std::string_view axis,
                               std::string_view component, SinumerikValue* value) {
  if (!IsSingle(frame)) return "a component of frames that are chained was not simulated";
  const nc::SinumerikFrame::Axis* found = FindAxis(frame, axis);
  const nc::SinumerikFrame::Axis zero;
  if (found == nullptr) found = &zero;
  if (nc::SameName(component, "MI")) {
    *value = SinumerikValue::Bool(found->mi);
  } else {
    *value = SinumerikValue::Real(nc::SameName(component, "TR")   ? found->tr
                                  : nc::SameName(component, "FI") ? found->fi
                                  : nc::SameName(component, "RT") ? found->rt
                                                                  : found->sc);
  }
  return "";
}

std::string WriteFrameComponent(SinumerikValue* frame, std::string_view axis,
                                std::string_view component, const SinumerikValue& value) {
  constexpr std::size_t kMaxAxes = 40;
  if (!IsSingle(*frame)) return "a component of frames that are chained was not simulated";
  if (!value.is_number()) return nc::AlarmText(12150, "a component of a frame is a number");
  nc::SinumerikFrame changed;
  if (frame->frame) changed = *frame->frame;
  if (changed.chain.empty()) changed.chain.emplace_back();
  nc::SinumerikFrame::Part& part = changed.chain.front();
  auto found = std::find_if(part.begin(), part.end(),
                            [&](const auto& candidate) { return candidate.name == axis; });
  if (found == part.end()) {
    if (part.size() == kMaxAxes) return nc::AlarmText(12430, "more axes than a frame has");
    part.emplace_back();
    found = part.end() - 1;
    found->name = axis;
  }
  if (nc::SameName(component, "MI")) {
    found->mi = value.number != 0.0;
  } else {
    double& target = nc::SameName(component, "TR")   ? found->tr
                     : nc::SameName(component, "FI") ? found->fi
                     : nc::SameName(component, "RT") ? found->rt
                                                     : found->sc;
    target = value.number;
  }
  *frame = SinumerikValue::Frame(std::move(changed));
  return "";
}

SinumerikVariables::SinumerikVariables(std::size_t r_parameters)
    : r_(std::make_shared<SinumerikVariable>(SinumerikType::kReal,
                                             std::vector<std::size_t>{r_parameters}, 0)),
      r_set_(r_parameters, false) {}

bool SinumerikVariables::TakeUnset(std::size_t index) {
  if (r_set_[index]) return false;
  r_set_[index] = true;
  return true;
}

std::shared_ptr<SinumerikVariable> SinumerikVariables::Find(std::string_view name) const {
  std::string key = nc::UpperName(name);
  const auto local = levels_.back().find(key);
  if (local != levels_.back().end()) return local->second;
  const auto global = globals_.find(key);
  return global != globals_.end() ? global->second : nullptr;
}

std::string SinumerikVariables::Define(std::string_view name,
                                       std::shared_ptr<SinumerikVariable> variable,
                                       bool is_global) {
  SinumerikScope& scope = is_global ? globals_ : levels_.back();
  if (variable->size() > free_elements()) {
    return nc::AlarmText(12380, "there is no memory left for this variable");
  }
  const std::size_t size = variable->size();
  const bool added = scope.emplace(nc::UpperName(name), std::move(variable)).second;
  if (!added) {
    return nc::AlarmText(12170, "the name " + std::string(name) + " is defined already");
  }
  used_ += size;
  return "";
}

void SinumerikVariables::PushLevel(SinumerikScope scope) {
  used_ += Elements(scope);
  levels_.push_back(std::move(scope));
}

void SinumerikVariables::PopLevel() {
  used_ -= std::min(used_, Elements(levels_.back()));
  levels_.pop_back();
}

void SinumerikVariables::ResetLevel(SinumerikScope scope) {
  PopLevel();
  PushLevel(std::move(scope));
}

}  // namespace ncsim::control
