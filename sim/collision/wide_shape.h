// SPDX-License-Identifier: BSD-3-Clause
// A solid of revolution in the single precision of wide_bounds.h.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "sim/collision/profile_shape.h"
#include "sim/collision/triangle_tree.h"
#include "sim/collision/wide_bounds.h"

namespace ncsim::collision {

class WideShape {
 public:
  explicit WideShape(const ProfileShape& shape);
  WideShape(const WideShape&) = delete;
  WideShape& operator=(const WideShape&) = delete;

  /// Puts the solid at p(z) = tip + z axis in the frame of a tree's mesh, from where it goes by
  /// `half_way` and back by as much. Valid until the next call.
  const WideSolid& Place(const Eigen::Vector3d& tip, const Eigen::Vector3d& axis,
                         const TriangleTree& tree,
                         const Eigen::Vector3d& half_way = Eigen::Vector3d::Zero());

 private:
  void Add(const ConvexProfile& profile);

  double middle_ = 0.0;  // z of the solid's origin
  std::vector<std::vector<WideLine>> lines_;
  std::vector<std::vector<WideRound>> rounds_;
  std::vector<WidePart> parts_;
  WideSolid solid_{};
};

}  // namespace ncsim::collision
