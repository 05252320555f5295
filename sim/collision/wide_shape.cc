// SPDX-License-Identifier: BSD-3-Clause
#include "sim/collision/wide_shape.h"

#include <algorithm>
#include <cmath>

namespace ncsim::collision {

namespace {

float Narrowed(double value) { return static_cast<float>(value); }

}  // namespace

WideShape::WideShape(const ProfileShape& shape) : middle_(0.5 * (shape.z_min() + shape.z_max())) {
  for (const ConvexProfile& part : shape.parts()) Add(part);
  solid_.part_count = static_cast<int>(parts_.size());
  if (!shape.convex()) Add(shape.hull());
  solid_.parts = parts_.data();
  solid_.hull = shape.convex() ? nullptr : &parts_.back();
}

void WideShape::Add(const ConvexProfile& profile) {
  std::vector<WideLine>& lines = lines_.emplace_back();
  for (const ConvexProfile::Line& line : profile.lines()) {
    lines.push_back({Narrowed(line.normal.x()), Narrowed(line.normal.y()),
                     Narrowed(line.offset - line.normal.x() * middle_)});
    solid_.reach = std::max(solid_.reach, std::abs(lines.back().offset));
  }
  std::vector<WideRound>& rounds = rounds_.emplace_back();
  for (const ConvexProfile::Round& round : profile.rounds()) {
    rounds.push_back({Narrowed(round.centre.x() - middle_), Narrowed(round.centre.y()),
                      Narrowed(round.radius), Narrowed(round.from.x()), Narrowed(round.from.y()),
                      Narrowed(round.to.x()), Narrowed(round.to.y())});
    const WideRound& added = rounds.back();
    solid_.reach = std::max({solid_.reach, std::abs(added.z), std::abs(added.r), added.radius});
  }
  parts_.push_back({lines.data(), static_cast<int>(lines.size()), rounds.data(),
                    static_cast<int>(rounds.size())});
}

const WideSolid& WideShape::Place(const Eigen::Vector3d& tip, const Eigen::Vector3d& axis,
                                  const TriangleTree& tree, const Eigen::Vector3d& half_way) {
  const Eigen::Vector3d origin = tip + middle_ * axis - tree.origin();
  for (int k = 0; k < 3; ++k) {
    solid_.origin[k] = Narrowed(origin[k]);
    solid_.axis[k] = Narrowed(axis[k]);
    solid_.half_way[k] = Narrowed(half_way[k]);
  }
  // Twice the rounding (6e-8) of each coordinate of the origin, of a leaf's corner and of the way.
  solid_.rounding = Narrowed(
      2.5e-7 * (origin.cwiseAbs().maxCoeff() + tree.reach() + half_way.cwiseAbs().maxCoeff()));
  return solid_;
}

}  // namespace ncsim::collision
