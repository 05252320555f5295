// SPDX-License-Identifier: BSD-3-Clause
// From a CIRCLE statement and the points about it to centre, sense and sweep. mm, rad.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "post/cl_event.h"

namespace ncsim::post {

/// A circle or helix while its points come in. The first is the start; the last will be the end,
/// what lies between (Creo) lies on it and says how often it goes round.
class ClArcBuilder {
 public:
  /// `normal_M`: the motion is by the right hand about it; unit. `radius`: as the file says.
  /// `times`: as many turns are begun (NX: TIMES); without, as few as lead through the points.
  ClArcBuilder(const Eigen::Vector3d& start_M, const Eigen::Vector3d& centre_M,
               const Eigen::Vector3d& normal_M, std::optional<double> radius,
               std::optional<int> times);

  /// False with `error` in words where the point is not on the cylinder of the circle.
  bool Add(const Eigen::Vector3d& point_M, std::string* error);
  /// To the last point. Nothing with `error` in words where the points make no circle.
  std::optional<ClArc> Finish(std::string* error) const;

 private:
  Eigen::Vector3d InPlane(const Eigen::Vector3d& point_M) const;

  Eigen::Vector3d start_M_, last_M_;
  std::optional<double> stated_radius_;
  std::optional<int> times_;
  ClArc arc_;
  struct Passed {
    double sweep, rise;
  };
  std::vector<Passed> points_;
};

}  // namespace ncsim::post
