// SPDX-License-Identifier: BSD-3-Clause
// The tool against the part at one instant, and how far two such may lie apart.
#pragma once

#include <Eigen/Core>
#include <algorithm>

namespace ncsim::compare {

/// Tip (mm) and tool axis (unit vector, tip to holder) in the part frame P.
struct Pose {
  Eigen::Vector3d p = Eigen::Vector3d::Zero();
  Eigen::Vector3d u = Eigen::Vector3d::UnitZ();
};

inline Pose Lerp(const Pose& a, const Pose& b, double s) {
  return {a.p + s * (b.p - a.p), a.u + s * (b.u - a.u)};
}

/// Distances of tips (mm) and of axis vectors: |u1 - u2| = 2 sin(angle / 2).
struct Distance {
  double position = 0.0;
  double axis = 0.0;
};

inline Distance Between(const Pose& a, const Pose& b) {
  return {(a.p - b.p).norm(), (a.u - b.u).norm()};
}

/// The greatest distances at which two poses count as the same.
struct Radii {
  double position = 0.0;  ///< mm
  double axis = 0.0;      ///< Of axis vectors.
};

/// How many times the radii: at most 1 within them.
inline double Ratio(const Distance& d, const Radii& r) {
  return std::max(d.position / r.position, d.axis / r.axis);
}
inline bool Within(const Pose& a, const Pose& b, const Radii& r) {
  return Ratio(Between(a, b), r) <= 1.0;
}

}  // namespace ncsim::compare
