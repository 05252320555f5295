// SPDX-License-Identifier: BSD-3-Clause
#include "post/tool_curve.h"

#include <algorithm>
#include <cmath>

namespace ncsim::post {

ToolCurve::ToolCurve(const ClPose& start, const ClPose& end, const std::optional<ClArc>& arc)
    : start_(start), end_(end), arc_(arc) {
  turn_ = std::atan2(start.axis_M.cross(end.axis_M).norm(), start.axis_M.dot(end.axis_M));
  sideways_ = end.axis_M - start.axis_M.dot(end.axis_M) * start.axis_M;
  if (sideways_.norm() > 0.0) sideways_.normalize();
  length_ = (end.tip_M - start.tip_M).norm();
  if (!arc) return;
  e1_ = (start.tip_M - arc->centre_M).normalized();
  e2_ = arc->normal_M.cross(e1_);
  miss_.setZero();
  miss_ = end.tip_M - Tip(1.0);
  length_ = std::hypot(arc->radius * arc->sweep, arc->rise);
}

Eigen::Vector3d ToolCurve::Tip(double t) const {
  if (!arc_) return start_.tip_M + t * (end_.tip_M - start_.tip_M);
  const double angle = t * arc_->sweep;
  return arc_->centre_M + arc_->radius * (std::cos(angle) * e1_ + std::sin(angle) * e2_) +
         t * (arc_->rise * arc_->normal_M + miss_);
}

Eigen::Vector3d ToolCurve::Axis(double t) const {
  if (t <= 0.0) return start_.axis_M;
  if (t >= 1.0) return end_.axis_M;
  return (std::cos(t * turn_) * start_.axis_M + std::sin(t * turn_) * sideways_).normalized();
}

double ToolCurve::NearestTo(const Eigen::Vector3d& axis) const {
  if (turn_ <= 0.0) return 0.0;
  return std::clamp(std::atan2(sideways_.dot(axis), start_.axis_M.dot(axis)) / turn_, 0.0, 1.0);
}

ClPose Transformed(const Eigen::Isometry3d& X_PM, const ClPose& pose) {
  return {X_PM * pose.tip_M, X_PM.linear() * pose.axis_M};
}

ClArc Transformed(const Eigen::Isometry3d& X_PM, const ClArc& arc) {
  ClArc transformed = arc;
  transformed.centre_M = X_PM * arc.centre_M;
  transformed.normal_M = X_PM.linear() * arc.normal_M;
  return transformed;
}

}  // namespace ncsim::post
