// SPDX-License-Identifier: BSD-3-Clause
// What reports in JSON share. Only their own sources include this.
#pragma once

#include <nlohmann/json.hpp>

#include "sim/base/finding.h"

namespace ncsim::report {

using Json = nlohmann::ordered_json;

/// Rounded to `decimals`; null for what is not a finite number; never -0.
Json Number(double value, int decimals);

template <typename Items, typename Convert>
Json Array(const Items& items, const Convert& convert) {
  Json array = Json::array();
  for (const auto& item : items) array.push_back(convert(item));
  return array;
}

/// bodies, clearance_mm, axes, points_mm, time_s: docs/json.md. What is not known is left out.
void AddDetails(const Finding& finding, Json* json);

}  // namespace ncsim::report
