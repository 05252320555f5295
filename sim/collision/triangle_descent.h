// SPDX-License-Identifier: BSD-3-Clause
// The step toward the point of a triangle that is nearest to a solid of revolution.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <array>

namespace ncsim::collision {

/// A quadratic model about the point `at` of a triangle: value + slope . d + 1/2 sum_i bend_i
/// (direction_i . d)^2 with bend >= 0.
struct QuadraticModel {
  Eigen::Vector3d slope;
  std::array<Eigen::Vector3d, 3> direction;
  std::array<double, 3> bend;
};

/// Newton's method within a triangle: works in its barycentric coordinates, so slivers are no
/// special case. It proposes points; it proves nothing.
class TriangleDescent {
 public:
  /// Starts at the centroid.
  explicit TriangleDescent(const std::array<Eigen::Vector3d, 3>& triangle)
      : corner_(triangle[0]), side_{triangle[1] - triangle[0], triangle[2] - triangle[0]} {}

  Eigen::Vector3d at() const { return corner_ + place_.x() * side_[0] + place_.y() * side_[1]; }

  /// To the least value of the model about at().
  void Step(const QuadraticModel& model) {
    Quadratic q;
    q.slope = {model.slope.dot(side_[0]), model.slope.dot(side_[1])};
    q.bend.setZero();
    for (std::size_t i = 0; i < 3; ++i) {
      const Eigen::Vector2d d(model.direction[i].dot(side_[0]), model.direction[i].dot(side_[1]));
      q.bend += model.bend[i] * d * d.transpose();
    }
    const double determinant = q.bend.determinant();
    if (determinant > 1e-12 * q.bend(0, 0) * q.bend(1, 1)) {
      const Eigen::Vector2d step(q.bend(0, 1) * q.slope.y() - q.bend(1, 1) * q.slope.x(),
                                 q.bend(0, 1) * q.slope.x() - q.bend(0, 0) * q.slope.y());
      const Eigen::Vector2d inner = place_ + step / determinant;
      if (inner.minCoeff() >= 0.0 && inner.sum() <= 1.0) {
        place_ = inner;
        return;
      }
    }
    place_ = LeastOnEdges(q);
  }

  /// Half of the way back.
  void Retreat(const TriangleDescent& to) { place_ = 0.5 * (place_ + to.place_); }

 private:
  struct Quadratic {
    Eigen::Vector2d slope;
    Eigen::Matrix2d bend;
  };

  Eigen::Vector2d LeastOnEdges(const Quadratic& q) const {
    static const std::array<Eigen::Vector2d, 3> kCorners = {
        Eigen::Vector2d(0, 0), Eigen::Vector2d(1, 0), Eigen::Vector2d(0, 1)};
    Eigen::Vector2d best = place_;
    double least = 0.0;
    for (std::size_t k = 0; k < 3; ++k) {
      const Eigen::Vector2d from = kCorners[k] - place_;
      const Eigen::Vector2d way = kCorners[(k + 1) % 3] - kCorners[k];
      const double slope = way.dot(q.slope + q.bend * from);
      const double bend = way.dot(q.bend * way);
      // Without a bend, to one of the ends.
      const double t = bend > 0.0 ? std::clamp(-slope / bend, 0.0, 1.0) : (slope < 0.0 ? 1.0 : 0.0);
      const Eigen::Vector2d d = from + t * way;
      const double value = d.dot(q.slope) + 0.5 * d.dot(q.bend * d);
      if (value < least) {
        least = value;
        best = place_ + d;
      }
    }
    return best;
  }

  Eigen::Vector3d corner_;
  std::array<Eigen::Vector3d, 2> side_;
  Eigen::Vector2d place_{1.0 / 3.0, 1.0 / 3.0};
};

}  // namespace ncsim::collision
