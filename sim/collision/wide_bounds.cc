// SPDX-License-Identifier: BSD-3-Clause
#include "sim/collision/wide_bounds.h"

#include "sim/base/processor.h"
#include "sim/collision/wide_bounds_lanes.h"

namespace ncsim::collision {

const WideBounds kWideBaseline = {WideKernel<4>::Boxes, WideKernel<4>::Triangles};

namespace {
const WideBounds& Best() {
  static const WideBounds best = HasAvx2() ? kWideAvx2 : kWideBaseline;
  return best;
}
}  // namespace

WideNear BoundBoxes(const WideBoxes& boxes, const WideSolid& solid, float enough, float* lower) {
  return Best().boxes(boxes, solid, enough, lower);
}

WideNear BoundTriangles(const WideTriangles& triangles, const WideSolid& solid, float enough,
                        float* lower) {
  return Best().triangles(triangles, solid, enough, lower);
}

}  // namespace ncsim::collision
