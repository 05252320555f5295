// SPDX-License-Identifier: BSD-3-Clause
#include "sim/report/json_values.h"

#include <array>
#include <cmath>
#include <string>

namespace ncsim::report {

Json Number(double value, int decimals) {
  if (!std::isfinite(value)) return nullptr;
  const double scale = std::pow(10.0, decimals);
  const double scaled = std::round(value * scale);
  return std::isfinite(scaled) ? scaled / scale + 0.0 : value;
}

void AddDetails(const Finding& finding, Json* json) {
  Json& details = *json;
  if (!finding.bodies.empty()) {
    details["bodies"] = finding.bodies;
    details["clearance_mm"] =
        finding.clearance_mm ? Number(*finding.clearance_mm, 2) : Json(nullptr);
  }
  if (!finding.axes.empty()) {
    Json& axes = details["axes"] = Json::object();
    for (const auto& [letter, value] : finding.axes) {
      axes[std::string(1, letter)] = Number(value, 4);
    }
  }
  if (!finding.points.empty()) {
    details["points_mm"] = Array(finding.points, [](const std::array<double, 3>& p) {
      return Json{Number(p[0], 3), Number(p[1], 3), Number(p[2], 3)};
    });
  }
  if (finding.time_s) details["time_s"] = Number(*finding.time_s, 3);
}

}  // namespace ncsim::report
