// SPDX-License-Identifier: BSD-3-Clause
#include "tests/bench/impeller_path.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <string>

#include "sim/base/text.h"
#include "sim/base/units.h"
#include "tests/bench/bench_mesh.h"

namespace ncsim::bench {
namespace {

constexpr double kTwist = 0.56;  // rad over the height
constexpr int kSections = 5;     // of a channel, 48 feeds each
constexpr int kOffsets = 7;      // passes side by side
constexpr int kFeeds = 48;
constexpr double kStep = 0.3;            // mm
constexpr double kLowest = 9.0;          // mm, of a pass
constexpr double kSectionHeight = 12.0;  // mm
constexpr double kOff = 45.0;            // mm off the part between passes of a channel
constexpr double kFarOff = 150.0;        // and between channels
constexpr double kAbove = 1.5;           // mm above the start that a rapid ends

double Twist(double z) { return kTwist * z / Impeller::kHeight; }

std::string Words(const Eigen::Vector3d& p) {
  return " X" + Fixed(p.x(), 4) + " Y" + Fixed(p.y(), 4) + " Z" + Fixed(p.z(), 4);
}
std::string Turns(double b_deg, double c_deg) {
  return " B" + Fixed(b_deg, 4) + " C" + Fixed(c_deg, 4);
}

}  // namespace

double Impeller::Radius(double angle, double z) {
  const double t = z / kHeight;
  const double hub = 70.0 - 42.0 * t - 5.0 * std::sin(kPi * t);
  const double fin = std::pow(0.5 * (1.0 + std::cos(kFins * (angle - Twist(z)))), 6.0);
  return hub + (18.0 + 4.0 * t) * fin;
}

double Impeller::ChannelAngle(int channel, double z) {
  return Twist(z) + (2 * channel + 1) * kPi / kFins;
}

Eigen::Vector3d Impeller::Point(double angle, double z) {
  const double r = Radius(angle, z);
  return {r * std::cos(angle), r * std::sin(angle), z};
}

Eigen::Vector3d Impeller::Normal(double angle, double z) {
  constexpr double h = 1e-5;
  const Eigen::Vector3d along = Point(angle + h, z) - Point(angle - h, z);
  const Eigen::Vector3d up = Point(angle, z + h) - Point(angle, z - h);
  return along.cross(up).normalized();
}

machine::TriangleMesh Impeller::Mesh(int triangles) {
  // Rings: over the bottom, up the side, over the top.
  const int rings = std::max(8, static_cast<int>(std::sqrt(triangles / 3.0)));
  const int sides = std::max(3 * kFins, triangles / (2 * rings));
  const int cap = std::max(1, rings / 6);
  return GlobeMesh(rings, sides, {0, 0, 0}, {0, 0, kHeight}, [&](int ring, int side) {
    const double angle = 2.0 * kPi * side / sides;
    const int up = rings - 2 * cap;
    const double z = kHeight * std::clamp(static_cast<double>(ring - cap) / (up - 1), 0.0, 1.0);
    const int from_pole = std::min(ring, rings - 1 - ring);
    const double scale = std::min(1.0, (from_pole + 1.0) / (cap + 1.0));
    Eigen::Vector3d p = Point(angle, z);
    p.head<2>() *= scale;
    return p;
  });
}

double ImpellerPath::Uniform(double lower, double upper) {
  return lower + (upper - lower) * (static_cast<double>(random_()) / 4294967296.0);
}

ImpellerPath::Pass ImpellerPath::NextPass() {
  constexpr int kPassesPerChannel = kSections * kOffsets;
  const int in_channel = pass_ % kPassesPerChannel;
  const int turn = pass_ / kPassesPerChannel;
  Pass pass;
  // 0, 1 .. 6, 5 .. 1, 0 ..
  const int there_and_back = turn % (2 * Impeller::kFins - 2);
  pass.channel =
      there_and_back < Impeller::kFins ? there_and_back : 2 * Impeller::kFins - 2 - there_and_back;
  const int side = in_channel / kSections;
  pass.offset = (static_cast<double>(side) / (kOffsets - 1) - 0.5) * 0.37 + Uniform(-0.01, 0.01);
  const int section =
      side % 2 == 0 ? in_channel % kSections : kSections - 1 - in_channel % kSections;
  pass.z0 = kLowest + kSectionHeight * section + Uniform(-0.5, 0.5);
  pass.first_of_channel = in_channel == 0;
  ++pass_;
  return pass;
}

ImpellerPath::Pose ImpellerPath::At(const Pass& pass, double z) const {
  const double middle = Impeller::ChannelAngle(pass.channel, z);
  const double angle = middle + pass.offset;
  Pose pose;
  pose.b_deg = 62.0 - 12.0 * z / Impeller::kHeight;
  pose.c_deg = Degrees(middle + 0.5 * pass.offset);
  const double b = Radians(pose.b_deg);
  const double c = Radians(pose.c_deg);
  pose.axis = {std::sin(b) * std::cos(c), std::sin(b) * std::sin(c), std::cos(b)};
  const Eigen::Vector3d ball =
      Impeller::Point(angle, z) +
      (options_.ball_radius + options_.allowance) * Impeller::Normal(angle, z);
  pose.tip = ball - options_.ball_radius * pose.axis;
  return pose;
}

void ImpellerPath::WritePass(const Pass& pass, int* blocks_left, std::ostream& out) {
  const auto write = [&](const Pose& reached, const std::string& line) {
    if (*blocks_left <= 0) return;
    --*blocks_left;
    out << line << '\n';
    last_ = reached;
  };
  double z = pass.z0;
  Pose pose = At(pass, z);
  const double off = pass.first_of_channel ? kFarOff : kOff;
  if (pass_ > 1) write(last_, "G00" + Words(last_.tip + off * last_.axis));
  write(pose, "G00" + Words(pose.tip + off * pose.axis) + Turns(pose.b_deg, pose.c_deg));
  write(pose, "G00" + Words(pose.tip + kAbove * pose.axis));
  write(pose, "G01" + Words(pose.tip));
  for (int i = 0; i<kFeeds&& * blocks_left> 0; ++i) {
    constexpr double h = 1e-3;
    const double per_z = (At(pass, z + h).tip - pose.tip).norm() / h;
    // Mostly about kStep, some far shorter, as chord tolerances make them.
    const double step = kStep * (Uniform(0.0, 1.0) < 0.15 ? Uniform(0.2, 0.6) : Uniform(0.8, 1.25));
    z += step / per_z;
    pose = At(pass, z);
    write(pose, "G01" + Words(pose.tip) + Turns(pose.b_deg, pose.c_deg));
  }
}

void ImpellerPath::Write(int blocks, std::ostream& out) {
  Pass pass = NextPass();
  const Pose start = At(pass, pass.z0);
  out << "%\nO03001 (IMPELLER)\nG21 G17 G40 G49 G80 G90 G94\nG53 G00 Z0.\nT1 M06\nS8000 M03\nG54\n"
         "M11\nM13\nG00"
      << Turns(start.b_deg, start.c_deg) << "\nG53 G00 X-381. Y-254.\nG00 G234 H01"
      << Words(start.tip + kFarOff * start.axis) << "\nF1500.\n";
  int left = blocks;
  for (; left > 0; pass = NextPass()) WritePass(pass, &left, out);
  out << "G00" << Words(last_.tip + kFarOff * last_.axis)
      << "\nG53 G00 Z0.\nG49\nG53 G00 X-736.6 Y-203.2\nM05\nM30\n%\n";
}

}  // namespace ncsim::bench
