// SPDX-License-Identifier: BSD-3-Clause
// An impeller-like part and the five-axis program that finishes its channels with a ball mill. The
// same bytes every time for the same numbers.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <ostream>
#include <random>

#include "sim/machine/mesh.h"

namespace ncsim::bench {

/// A conical hub with twisted fins: in the part frame (mm, Z the axis of the table), r(angle, z).
struct Impeller {
  static constexpr double kHeight = 80.0;
  static constexpr int kFins = 7;

  static double Radius(double angle, double z);
  /// Angle of the middle of a channel at height z; channels count on over a whole turn.
  static double ChannelAngle(int channel, double z);
  static Eigen::Vector3d Point(double angle, double z);
  /// Unit, outward.
  static Eigen::Vector3d Normal(double angle, double z);
  /// Closed, of `triangles` triangles within a few percent.
  static machine::TriangleMesh Mesh(int triangles);
};

/// Ball mill passes along the channels: 48 feeds of about 0.3 mm, then off, over and down in
/// rapids. Channels are taken to and fro, so that C does not wind up.
class ImpellerPath {
 public:
  struct Options {
    double ball_radius = 4.0;
    double allowance = 0.5;  ///< mm left between the ball and the part.
    std::uint32_t seed = 1;
  };
  explicit ImpellerPath(const Options& options) : options_(options), random_(options.seed) {}

  /// Writes a Haas program of `blocks` motions under G234 and a few before and after.
  void Write(int blocks, std::ostream& out);

 private:
  struct Place {
    double angle = 0.0, z = 0.0;  // of the point of the channel's floor
  };
  struct Pose {
    Eigen::Vector3d tip = Eigen::Vector3d::Zero();
    Eigen::Vector3d axis = Eigen::Vector3d::UnitZ();  // tip -> holder
    double b_deg = 0.0, c_deg = 0.0;
  };
  struct Pass {
    int channel = 0;
    double offset = 0.0;  // rad, from the middle of the channel
    double z0 = 0.0;
    bool first_of_channel = false;
  };

  double Uniform(double lower, double upper);
  Pass NextPass();
  Pose At(const Pass& pass, double z) const;
  void WritePass(const Pass& pass, int* blocks_left, std::ostream& out);

  Options options_;
  std::mt19937 random_;
  Pose last_;
  int pass_ = 0;
};

}  // namespace ncsim::bench
