// SPDX-License-Identifier: BSD-3-Clause
#include "post/cl_arc.h"

#include <Eigen/Geometry>
#include <cmath>

#include "sim/base/text.h"
#include "sim/base/units.h"

namespace ncsim::post {
namespace {

constexpr double kSamePoint = 1e-9;        // mm: the same text
constexpr double kPrintedRounding = 2e-4;  // mm: one place may be printed so, with four decimals

}  // namespace

ClArcBuilder::ClArcBuilder(const Eigen::Vector3d& start_M, const Eigen::Vector3d& centre_M,
                           const Eigen::Vector3d& normal_M, std::optional<double> radius,
                           std::optional<int> times)
    : start_M_(start_M), last_M_(start_M), stated_radius_(radius), times_(times) {
  arc_.normal_M = normal_M;
  // NX gives the centre of a helix in the plane of its end.
  arc_.centre_M = centre_M + normal_M * normal_M.dot(start_M - centre_M);
  arc_.radius = (start_M - arc_.centre_M).norm();
}

Eigen::Vector3d ClArcBuilder::InPlane(const Eigen::Vector3d& point_M) const {
  const Eigen::Vector3d arm = point_M - arc_.centre_M;
  return arm - arc_.normal_M * arc_.normal_M.dot(arm);
}

bool ClArcBuilder::Add(const Eigen::Vector3d& point_M, std::string* error) {
  const Eigen::Vector3d from = InPlane(last_M_), to = InPlane(point_M);
  const double radius = to.norm();
  const auto fail = [&](const std::string& message) {
    *error = message;
    return false;
  };
  if (arc_.radius <= kClArcTolerance) return fail("a circle about the point where the tool stands");
  if (stated_radius_ && std::abs(*stated_radius_ - arc_.radius) > kClArcTolerance) {
    return fail("the circle does not meet its start: its radius is " + Short(*stated_radius_) +
                " mm, the start is " + Short(arc_.radius) + " mm from its centre");
  }
  if (std::abs(radius - arc_.radius) > kClArcTolerance) {
    return fail("the circle does not meet its end: its radius is " + Short(arc_.radius) +
                " mm, the point is " + Short(radius) + " mm from its centre");
  }
  const double apart = (to - from).norm();
  double angle = std::atan2(arc_.normal_M.dot(from.cross(to)), from.dot(to));
  if (!points_.empty() && apart <= kPrintedRounding) {
    // The same point twice in a list: no turn.
  } else if (apart <= kSamePoint) {
    angle = kTurn;
  } else if (apart <= kPrintedRounding) {
    return fail("start and end of the circle lie " + Fixed(apart, 6) +
                " mm apart: a whole turn or none may be meant");
  } else if (angle <= 0.0) {
    angle += kTurn;
  }
  arc_.sweep += angle;
  arc_.rise = arc_.normal_M.dot(point_M - start_M_);
  last_M_ = point_M;
  points_.push_back({arc_.sweep, arc_.rise});
  return true;
}

std::optional<ClArc> ClArcBuilder::Finish(std::string* error) const {
  const auto fail = [&](const std::string& message) {
    *error = message;
    return std::optional<ClArc>();
  };
  ClArc arc = arc_;
  if (times_ && points_.size() > 1) return fail("TIMES with a list of points is not supported");
  if (times_) arc.sweep += kTurn * (*times_ - 1);
  const bool flat = std::abs(arc.rise) <= kClArcTolerance;
  if (!times_ && flat && arc.sweep > kTurn + kPrintedRounding / arc.radius) {
    return fail("the points of the circle do not follow each other in its sense");
  }
  for (const Passed& point : points_) {
    const double share = times_ ? 1.0 : point.sweep / arc.sweep;
    if (std::abs(point.rise - share * arc.rise) > kClArcTolerance) {
      return fail("the points of the helix do not rise with the angle");
    }
  }
  return arc;
}

}  // namespace ncsim::post
