// SPDX-License-Identifier: BSD-3-Clause
// Least value of a convex function over a triangle, with a certificate.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

namespace ncsim::collision {

struct ConvexMinimum {
  double lower = -std::numeric_limits<double>::infinity();
  double upper = std::numeric_limits<double>::infinity();
  Eigen::Vector3d at = Eigen::Vector3d::Zero();  ///< Where the function is `upper`.
};

struct ConvexSample {
  double value = 0.0;
  Eigen::Vector3d gradient;  ///< Or any subgradient.
};

/// The part of a triangle where a minimum may still be: a convex polygon in the triangle's plane.
class CutPolygon {
 public:
  explicit CutPolygon(const std::array<Eigen::Vector3d, 3>& triangle) : origin_(triangle[0]) {
    const Eigen::Vector3d a = triangle[1] - origin_;
    const Eigen::Vector3d b = triangle[2] - origin_;
    const bool first = a.squaredNorm() >= b.squaredNorm();
    e1_ = (first ? a : b).normalized();
    e2_ = first ? b : a;
    // Again, for a sliver: what rounding leaves of e1 would lift points off the triangle.
    for (int i = 0; i < 3; ++i) {
      e2_ -= e2_.dot(e1_) * e1_;
      if (e2_.norm() > 0.0) e2_.normalize();
    }
    count_ = 3;
    points_[0].setZero();
    points_[1] = {a.dot(e1_), a.dot(e2_)};
    points_[2] = {b.dot(e1_), b.dot(e2_)};
  }

  bool empty() const { return count_ == 0; }
  bool full() const { return count_ + 1 >= points_.size(); }

  Eigen::Vector2d Centroid() const {
    Eigen::Vector2d sum = Eigen::Vector2d::Zero();
    Eigen::Vector2d mean = Eigen::Vector2d::Zero();
    double area = 0.0;
    double extent = 0.0;
    for (std::size_t i = 0; i < count_; ++i) mean += points_[i];
    mean /= static_cast<double>(count_);
    for (std::size_t i = 0; i < count_; ++i) {
      const Eigen::Vector2d p = points_[i] - mean;
      const Eigen::Vector2d q = points_[(i + 1) % count_] - mean;
      const double cross = p.x() * q.y() - p.y() * q.x();
      area += cross;
      sum += cross * (p + q);
      extent = std::max(extent, p.squaredNorm());
    }
    // A sliver's area is rounding; the mean of its corners is as good.
    return std::abs(area) > 1e-9 * extent ? Eigen::Vector2d(mean + sum / (3.0 * area)) : mean;
  }

  Eigen::Vector3d Lift(const Eigen::Vector2d& p) const {
    return origin_ + p.x() * e1_ + p.y() * e2_;
  }
  Eigen::Vector2d Flatten(const Eigen::Vector3d& gradient) const {
    return {gradient.dot(e1_), gradient.dot(e2_)};
  }

  /// Least g . (p - x) over the polygon.
  double LeastLinear(const Eigen::Vector2d& g, const Eigen::Vector2d& x) const {
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < count_; ++i) least = std::min(least, g.dot(points_[i] - x));
    return least;
  }

  /// Keeps g . (p - x) <= limit.
  void Cut(const Eigen::Vector2d& g, const Eigen::Vector2d& x, double limit) {
    std::array<Eigen::Vector2d, 32> kept;
    std::size_t kept_count = 0;
    for (std::size_t i = 0; i < count_; ++i) {
      // Rounding on a degenerate polygon; left as it is, it still holds what it must.
      if (kept_count + 2 > kept.size()) return;
      const Eigen::Vector2d& p = points_[i];
      const Eigen::Vector2d& q = points_[(i + 1) % count_];
      const double at_p = g.dot(p - x) - limit;
      const double at_q = g.dot(q - x) - limit;
      if (at_p <= 0.0) kept[kept_count++] = p;
      if ((at_p < 0.0 && at_q > 0.0) || (at_p > 0.0 && at_q < 0.0)) {
        kept[kept_count++] = p + at_p / (at_p - at_q) * (q - p);
      }
    }
    points_ = kept;
    count_ = kept_count;
  }

 private:
  Eigen::Vector3d origin_, e1_, e2_;
  std::array<Eigen::Vector2d, 32> points_;
  std::size_t count_ = 0;
};

/// Cutting planes through the centroid (Levin, "On an algorithm for the minimization of convex
/// functions", Soviet Math. Dokl. 6, 1965): what a cut takes away lies above the best value found,
/// what is left shrinks by a third of its area or more, and the tangent plane bounds the function
/// on it. Stops when upper - lower <= gap, or when lower >= enough, or after a fixed number of
/// cuts; the bounds hold in any case.
template <typename Function>
ConvexMinimum MinimiseOverTriangle(const std::array<Eigen::Vector3d, 3>& triangle,
                                   const Function& function, double enough, double gap) {
  constexpr int kCuts = 80;
  CutPolygon polygon(triangle);
  ConvexMinimum result;
  double planes = -std::numeric_limits<double>::infinity();
  for (int i = 0; i < kCuts; ++i) {
    const Eigen::Vector2d x = polygon.Centroid();
    const Eigen::Vector3d p = polygon.Lift(x);
    const ConvexSample sample = function(p);
    if (sample.value < result.upper) {
      result.upper = sample.value;
      result.at = p;
    }
    const Eigen::Vector2d g = polygon.Flatten(sample.gradient);
    planes = std::max(planes, sample.value + polygon.LeastLinear(g, x));
    result.lower = std::min(result.upper, planes);
    if (result.lower >= enough || result.upper - result.lower <= gap || polygon.full()) break;
    polygon.Cut(g, x, result.upper - sample.value);
    if (polygon.empty()) {
      result.lower = result.upper;
      break;
    }
  }
  return result;
}

}  // namespace ncsim::collision
