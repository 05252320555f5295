// SPDX-License-Identifier: BSD-3-Clause
// The planes of arcs and cycles.
#pragma once

#include <string_view>

#include "post/plan.h"

namespace ncsim::post {

/// Indices of the coordinates: the plane's axes by the right hand, and its normal.
struct PlaneAxes {
  int first, second, normal;
};

constexpr PlaneAxes AxesOf(PlanPlane plane) {
  switch (plane) {
    case PlanPlane::kXY:
      return {0, 1, 2};
    case PlanPlane::kZX:
      return {2, 0, 1};
    case PlanPlane::kYZ:
      return {1, 2, 0};
  }
  return {0, 1, 2};
}

/// Of Group::kPlane.
constexpr std::string_view KeyOf(PlanPlane plane) {
  switch (plane) {
    case PlanPlane::kXY:
      return "xy";
    case PlanPlane::kZX:
      return "zx";
    case PlanPlane::kYZ:
      return "yz";
  }
  return "";
}

}  // namespace ncsim::post
