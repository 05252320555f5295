// SPDX-License-Identifier: BSD-3-Clause
// Two triangles: how near, and how far apart at least.
#pragma once

#include <Eigen/Core>

#include "sim/collision/box_tree.h"

namespace ncsim::collision {

/// A point of each of two triangles.
struct NearPoints {
  Eigen::Vector3d a, b;
};

/// The nearest points of two triangles that do not meet, to rounding; of two that do, some points
/// of their edges and corners.
NearPoints NearestPoints(const BoxTree::Triangle& a, const BoxTree::Triangle& b);

/// How far apart the shadows of `a` (up the line) and `b` are on a line with a unit direction;
/// negative where they overlap. Never more than the distance.
double ShadowGap(const Eigen::Vector3d& direction, const BoxTree::Triangle& a,
                 const BoxTree::Triangle& b);

/// The best shadow gap of a few lines that lead toward the best of all; no further than `enough`.
/// Dearer than one line, and far cheaper than the nearest points.
double SearchedGap(const BoxTree::Triangle& a, const BoxTree::Triangle& b, double enough);

}  // namespace ncsim::collision
