// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

#include "sim/collision/triangle_tree.h"

namespace ncsim::collision {

/// A point of each of two triangles.
struct NearPoints {
  Eigen::Vector3d a, b;
};

/// The nearest points of two triangles that do not meet, to rounding; of two that do, some points
/// of their edges and corners.
NearPoints NearestPoints(const TriangleTree::Triangle& a, const TriangleTree::Triangle& b);

}  // namespace ncsim::collision
