// SPDX-License-Identifier: BSD-3-Clause
// Built with -mavx2 (CMakeLists.txt); includes nothing that the rest of the program shares.
#include "sim/collision/wide_bounds_lanes.h"

namespace ncsim::collision {

const WideBounds kWideAvx2 = {WideKernel<8>::Boxes, WideKernel<8>::Triangles};

}  // namespace ncsim::collision
