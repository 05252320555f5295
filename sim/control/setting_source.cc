// SPDX-License-Identifier: BSD-3-Clause
#include "sim/control/setting_source.h"

#include <charconv>

namespace ncsim::control {

std::optional<std::string> SettingSource::Text(std::string_view name) const {
  const std::string key(name);
  if (const auto found = job_->control.find(key); found != job_->control.end()) {
    return found->second;
  }
  const auto& settings = machine_->control.settings;
  if (const auto found = settings.find(key); found != settings.end()) return found->second;
  return std::nullopt;
}

std::optional<double> SettingSource::Number(std::string_view name) const {
  const auto text = Text(name);
  if (!text) return std::nullopt;
  double value = 0.0;
  const auto [end, error] = std::from_chars(text->data(), text->data() + text->size(), value);
  if (error != std::errc() || end != text->data() + text->size()) return std::nullopt;
  return value;
}

std::optional<bool> SettingSource::Switch(std::string_view name) const {
  const auto text = Text(name);
  if (!text) return std::nullopt;
  return *text == "on" || *text == "true";
}

}  // namespace ncsim::control
