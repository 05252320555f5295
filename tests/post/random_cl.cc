// SPDX-License-Identifier: BSD-3-Clause
#include "tests/post/random_cl.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <random>

#include "sim/base/text.h"
#include "sim/base/units.h"

namespace ncsim::posting {
namespace {

using Eigen::Vector3d;

constexpr double kMostTilt = 88.0;  // deg

class Writer {
 public:
  Writer(std::uint64_t seed, const RandomMotion& motion) : motion_(motion), random_(seed) {}

  std::string Text() {
    for (int i = 1; i <= motion_.operations; ++i) Operation(i);
    return text_;
  }

 private:
  // The engine's values are the standard's; its distributions are a library's own.
  double Between(double low, double high) {
    return low + (high - low) * static_cast<double>(random_() >> 11) * 0x1p-53;
  }
  double Scale(double low, double high) { return std::exp(Between(std::log(low), std::log(high))); }
  bool Chance(double share) { return Between(0.0, 1.0) < share; }
  int Pick(int count) { return static_cast<int>(Between(0.0, count)); }
  Vector3d Direction() {
    while (true) {
      const Vector3d v(Between(-1, 1), Between(-1, 1), Between(-1, 1));
      if (v.norm() > 0.1 && v.norm() < 1.0) return v.normalized();
    }
  }
  static Vector3d AxisAt(double tilt, double azimuth) {
    const double t = Radians(tilt), a = Radians(azimuth);
    return {std::sin(t) * std::cos(a), std::sin(t) * std::sin(a), std::cos(t)};
  }
  static bool Inside(const Vector3d& p) {
    return p.head<2>().cwiseAbs().maxCoeff() < 60.0 && p.z() > 15.0 && p.z() < 95.0;
  }

  void Line(const std::string& line) { text_ += line + "\n"; }
  static std::string Numbers(const Vector3d& v, int decimals) {
    return Fixed(v.x(), decimals) + "," + Fixed(v.y(), decimals) + "," + Fixed(v.z(), decimals);
  }
  static Vector3d Printed(const Vector3d& v, double decimals) {
    const double scale = std::pow(10.0, decimals);
    return (v * scale).array().round().matrix() / scale;
  }
  void Goto(const Vector3d& p, const Vector3d& u) {
    const bool turned = u != axis_ || Chance(0.1);
    Line("GOTO/" + Numbers(p, 4) + (turned ? "," + Numbers(u, 7) : ""));
    tip_ = Printed(p, 4);
    axis_ = u;
  }

  Vector3d AnyAxis() {
    if (!motion_.tilts) return Vector3d::UnitZ();
    switch (Pick(8)) {
      case 0:
        return Vector3d::UnitZ();
      case 1:
        if (!motion_.beside_pole) break;
        return AxisAt(Scale(1e-5, 1.0), Between(-180, 180));
      case 2:
        return AxisAt(Between(0, kMostTilt), 90.0 * Pick(4));
      default:
        break;
    }
    return AxisAt(Between(0, kMostTilt), Between(-180, 180));
  }
  double Tilt() const { return Degrees(std::atan2(axis_.head<2>().norm(), axis_.z())); }
  double Azimuth() const { return Degrees(std::atan2(axis_.y(), axis_.x())); }

  /// Another axis for the end of a feed.
  Vector3d NextAxis() {
    if (!motion_.turns) return axis_;
    const double tilt = Tilt(), azimuth = Azimuth();
    switch (Pick(9)) {
      case 0:
        if (!motion_.poles) return axis_;
        return Vector3d::UnitZ();
      case 1:  // Through the pole.
        if (!motion_.poles) return axis_;
        return AxisAt(std::min(tilt, 60.0), azimuth + 180.0);
      case 2:  // Beside it.
        if (!motion_.beside_pole) return axis_;
        return AxisAt(Scale(1e-6, 0.5), Between(-180, 180));
      case 3:  // Close by it.
        if (!motion_.beside_pole) return axis_;
        return AxisAt(std::min(tilt, 60.0), azimuth + 180.0 + Scale(1e-4, 5.0));
      case 4:
        return AxisAt(tilt, azimuth + Between(-60, 60));
      case 5:
        return AxisAt(std::min(kMostTilt, tilt + Scale(0.001, 10.0)), azimuth + Between(-3, 3));
      case 6:
        return AxisAt(Between(0, kMostTilt), azimuth + Between(-100, 100));
      default:
        return axis_;
    }
  }

  void Feedrate() {
    if (Chance(0.3)) Line("FEDRAT/MMPM," + Fixed(Scale(0.1, 1.0) * motion_.feed, 4));
  }

  void Straight() {
    const Vector3d axis = NextAxis();
    for (int tries = 0; tries < 50; ++tries) {
      const double length = axis == axis_ ? Scale(0.0005, 60.0) : Scale(2.0, 60.0);
      const Vector3d p = tip_ + length * Direction();
      if (!Inside(p)) continue;
      Feedrate();
      Goto(p, axis);
      return;
    }
  }

  void Arc() {
    for (int tries = 0; tries < 50; ++tries) {
      Vector3d normal = axis_;
      if (Chance(0.4)) normal = Chance(0.5) ? Vector3d::Unit(Pick(3)) : Direction();
      if (Chance(0.5)) normal = -normal;
      normal = Printed(normal, 7).normalized();
      const Vector3d out = normal.cross(Direction()).normalized();
      const double radius = Scale(0.05, 30.0);
      const int turns = Chance(0.15) ? 1 + Pick(3) : 0;  // Whole ones, before the last.
      const bool circle = turns == 0 && Chance(0.15);
      const double sweep = circle ? 2.0 * kPi : Between(0.05, 6.2);
      if (radius * std::min(sweep, 2.0 * kPi - sweep) < 0.02 && !circle) continue;
      const double all = sweep + 2.0 * kPi * turns;
      const bool rises = turns > 0 || (!circle && Chance(0.3));
      const double rise = rises ? (Chance(0.5) ? 1.0 : -1.0) * Scale(0.01, 8.0) : 0.0;
      const Vector3d centre = tip_ + radius * out;
      const Vector3d end =
          centre + Eigen::AngleAxisd(all, normal) * (tip_ - centre) + rise * normal;
      if (!Inside(end)) continue;
      Feedrate();
      // NX turns by the right hand about the other end of the axis.
      Line("CIRCLE/" + Numbers(centre, 4) + "," + Numbers(-normal, 7) + "," + Fixed(radius, 4) +
           ",0.0060,0.5000,10.0000,0.0000" +
           (turns > 0 ? ",TIMES," + std::to_string(turns + 1) : ""));
      Goto(circle ? tip_ : end, axis_);
      return;
    }
  }

  void Rapid(bool turns) {
    Line("RAPID");
    Goto({Between(-50, 50), Between(-50, 50), Between(60, 90)}, turns ? AnyAxis() : axis_);
  }

  void Holes() {
    const double depth = Scale(0.5, 12.0);
    Line("CYCLE/DRILL,RAPTO,2.0000,FEDTO," + Fixed(-depth, 4) + ",RTRCTO,5.0000,MMPM," +
         Fixed(Scale(0.1, 1.0) * motion_.feed, 4));
    for (int i = 1 + Pick(3); i > 0; --i) {
      Goto({Between(-50, 50), Between(-50, 50), Between(30, 60)}, axis_);
    }
    Line("CYCLE/OFF");
    Rapid(false);
  }

  /// Forty turns of the tool axis about Z, four points each.
  void Wind() {
    const double tilt = Between(20.0, 70.0), sense = Chance(0.5) ? 1.0 : -1.0;
    const double from = Between(-180, 180);
    for (int i = 0; i < 165; ++i) {
      const double azimuth = from + sense * 90.0 * i;
      const Vector3d u = AxisAt(tilt, azimuth);
      Goto(Vector3d(20.0 * u.x(), 20.0 * u.y(), 40.0 + 0.1 * i), u);
    }
  }

  void Operation(int number) {
    const std::string tool = std::to_string(Chance(0.7) ? number : 1);
    Line("TOOL PATH/OP" + std::to_string(number) + ",TOOL,MILL_" + tool);
    Line("TLDATA/MILL,10.0000,0.0000,75.0000,0.0000,0.0000");
    if (number == 1 || Chance(0.7))
      origin_ = {0.0, 0.0, 0.0};
    else
      origin_ = {Between(-5, 5), Between(-5, 5), Between(-5, 5)};
    const double c = Radians(number == 1 || Chance(0.8) ? 0.0 : Between(-180, 180));
    Line("MSYS/" + Numbers(origin_, 4) + "," + Numbers({std::cos(c), std::sin(c), 0.0}, 7) + "," +
         Numbers({-std::sin(c), std::cos(c), 0.0}, 7));
    Line("LOAD/TOOL," + tool);
    Line("SPINDL/RPM,3000,CLW");
    axis_ = Vector3d::Constant(2.0);  // None: the first point says its own.
    Line("RAPID");
    Goto({Between(-50, 50), Between(-50, 50), Between(60, 90)}, AnyAxis());
    Line("FEDRAT/MMPM," + Fixed(Scale(0.1, 1.0) * motion_.feed, 4));
    if (motion_.winds) Wind();
    for (int i = 0; i < motion_.moves; ++i) {
      switch (Pick(10)) {
        case 0:
          Rapid(motion_.tilts && Chance(0.5));
          break;
        case 1:
          if (motion_.holes) Holes();
          break;
        case 2:
        case 3:
        case 4:
          Arc();
          break;
        default:
          Straight();
      }
    }
    Rapid(false);
    Line("END-OF-PATH");
  }

  const RandomMotion motion_;
  std::mt19937_64 random_;
  std::string text_;
  Vector3d origin_ = Vector3d::Zero();
  Vector3d tip_ = Vector3d::Zero(), axis_ = Vector3d::UnitZ();
};

}  // namespace

std::string RandomCl(std::uint64_t seed, const RandomMotion& motion) {
  return Writer(seed, motion).Text();
}

}  // namespace ncsim::posting
