// SPDX-License-Identifier: BSD-3-Clause
// Rapids whose axes run each at its own rate. At infinite acceleration the tip goes along a
// polyline: exact. With the stated acceleration every path from that polyline to the stated one's
// counts: the least over time and acceleration.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "tests/planted/families.h"

namespace ncsim::planted {

namespace {

using Eigen::Vector3d;

constexpr double kRate = collision::Rig::kRapidRate;
constexpr double kTolerance = 3e-3;  // mm

/// X runs further than Y, and Z less than both or not at all.
struct DogLegMove {
  Eigen::Isometry3d X_MG;
  Vector3d from_M, way_M;
  Vector3d corner_M;   // where Y has arrived
  Vector3d outward_G;  // from the straight line to the corner
  double apart = 0.0;  // the corner from the straight line

  DogLegMove(const Upright& place, Random* random, bool with_z) : X_MG(place.X_MG) {
    const double x = random->Uniform(150.0, 300.0);
    const double y = random->Uniform(50.0, 0.5 * x);
    const double z = with_z ? random->Uniform(-6.0, 6.0) : 0.0;
    const double sx = random->Chance(0.5) ? 1.0 : -1.0;
    const double sy = random->Chance(0.5) ? 1.0 : -1.0;
    way_M = Vector3d(sx * x, sy * y, z);
    corner_M = X_MG * Vector3d(0, 0, -8.0);
    from_M = corner_M - Vector3d(sx * y, sy * y, z);
    Vector3d out = Vector3d(-way_M.y(), way_M.x(), 0.0).normalized();
    apart = (corner_M - from_M).dot(out);
    if (apart < 0.0) out = -out;
    apart = std::abs(apart);
    outward_G = X_MG.linear().transpose() * out;
  }

  /// Pieces on which the axes that still run run at the same rate.
  std::vector<Course> Polyline() const {
    const double time = way_M.cwiseAbs().maxCoeff();
    std::vector<double> corners{0.0, std::abs(way_M.z()), std::abs(way_M.y()), time};
    std::vector<Course> courses;
    for (std::size_t i = 0; i + 1 < corners.size(); ++i) {
      if (corners[i + 1] <= corners[i]) continue;
      courses.push_back(Straight(Tip(corners[i]), Tip(corners[i + 1])));
      courses.back().begin = corners[i] / time;
      courses.back().end = corners[i + 1] / time;
    }
    return courses;
  }
  Course Line() const {
    return Straight(X_MG.inverse() * from_M, X_MG.inverse() * Vector3d(from_M + way_M));
  }

 private:
  /// Where the tip is when each axis has run `run` or has arrived.
  Vector3d Tip(double run) const {
    Vector3d p = from_M;
    for (int i = 0; i < 3; ++i) p[i] += std::clamp(way_M[i], -run, run);
    return X_MG.inverse() * p;
  }
};

/// Constant acceleration, constant rate, constant deceleration; way at full rate takes `duration`
/// >= `ramp`. Part of the way done at t.
double Trapezoid(double duration, double ramp, double t) {
  const double end = duration + ramp;
  if (t <= 0.0) return 0.0;
  if (t >= end) return 1.0;
  if (t < ramp) return t * t / (2.0 * ramp * duration);
  if (t <= duration) return (t - 0.5 * ramp) / duration;
  return 1.0 - (end - t) * (end - t) / (2.0 * ramp * duration);
}

/// By how much an axis can go from where it is in the middle of a cell of (tau, lag), tau = t - lag
/// ramp / 2: with tau and with lag, mm. From the formulas above: it goes at its rate at most, and
/// its place changes with lag by at most rate * ramp / 8; not at all at full rate, at rest, or when
/// it has arrived. With v left of its braking time, it goes at rate * v / (lag ramp), and changes
/// by at most rate * v / (2 lag).
Eigen::Vector2d AxisReach(double duration, double ramp, const Cell& c) {
  const double half = 0.5 * c.t1 * ramp;
  const double tau = 0.5 * (c.s1 - c.s0) * kRate;
  const double lag = 0.5 * (c.t1 - c.t0) * kRate;
  if (c.s0 >= duration + half) return {0.0, 0.0};
  if (c.s0 >= half && c.s1 <= duration - half) return {tau, 0.0};
  const double left = duration + half - c.s0;
  if (c.s0 < duration - 0.5 * c.t0 * ramp || c.t0 <= 0.0) return {tau, lag * ramp / 8.0};
  return {tau * std::min(1.0, left / (c.t0 * ramp)),
          lag * std::min(ramp / 8.0, left / (2.0 * c.t0))};
}

/// The least over all tau and lag.
Bounds AcceleratedClearance(const DogLegMove& move, double ramp, const Cutter& cutter,
                            const Solid& solid, const Vector3d& offset) {
  const Vector3d duration = move.way_M.cwiseAbs() / kRate;
  const Eigen::Isometry3d X_GM = move.X_MG.inverse();
  const auto f = [&](double tau, double lag) {
    Vector3d p = move.from_M;
    for (int i = 0; i < 2; ++i) {
      p[i] += move.way_M[i] * Trapezoid(duration[i], lag * ramp, tau + 0.5 * lag * ramp);
    }
    return Clearance(cutter, {X_GM * p - offset, Vector3d::UnitZ()}, solid.parts.front());
  };
  const auto reach = [&](const Cell& c) {
    const Eigen::Vector2d x = AxisReach(duration.x(), ramp, c);
    const Eigen::Vector2d y = AxisReach(duration.y(), ramp, c);
    return Eigen::Vector2d(std::hypot(x[0], y[0]), std::hypot(x[1], y[1]));
  };
  return Least(
      f, {-0.5 * ramp, duration.maxCoeff() + 0.5 * ramp, 0.0, 1.0},
      [&](const Cell& c) { return reach(c)[0]; }, [&](const Cell& c) { return reach(c)[1]; },
      cutter.Floor(), kTolerance);
}

Upright UntiltedPlace(Random* random) {
  Upright place(random);
  place.b_deg = place.c_deg = 0.0;
  return place;
}

Case Make(const Upright& place, const DogLegMove& move, const Cutter& cutter, double ramp,
          Random* random) {
  Case c(place.table);
  c.SetTool(cutter, RandomKind(random));
  const Vector3d to = move.from_M + move.way_M;
  c.rig.Start(move.from_M.x(), move.from_M.y(), move.from_M.z());
  c.rig.DogLeg(to.x(), to.y(), to.z(), ramp);
  return c;
}

Solid Post(Random* random, double size) {
  return PrismSolid(RegularBase(3 + random->Below(22), size, random->Uniform(0.0, 6.0)), -30.0,
                    random->Uniform(-2.0, 10.0));
}

}  // namespace

// A hit stands outside the corner, clear of the straight line; a near miss there too, or inside,
// where the straight line would hit it.
std::optional<Case> DogLegPolyline(Random* random, bool hit) {
  const Upright place = UntiltedPlace(random);
  const DogLegMove move(place, random, random->Chance(0.5));
  const Cutter cutter = RandomCutter(random, 0.5, 5.0);
  const bool inside = !hit && random->Chance(0.6);
  const Solid post = Post(random, inside ? 0.55 * move.apart : random->Uniform(0.3, 8.0));
  const std::vector<Course> courses = move.Polyline();
  const Vector3d away = inside ? Vector3d(-move.outward_G) : move.outward_G;
  const double target = RandomTarget(random, hit, 0.4 * cutter.radius);
  const auto offset = Tune(cutter, courses, post, away, target);
  if (!offset.has_value()) return std::nullopt;
  const double line = LeastClearance(cutter, {move.Line()}, post, *offset).upper;
  if (inside ? line > -0.1 : line < 0.1) return std::nullopt;
  Case c = Make(place, move, cutter, 0.0, random);
  c.AddBody(post, place.InTable(), *offset, courses);
  return c;
}

std::optional<Case> DogLegAccelerated(Random* random, bool hit) {
  const Upright place = UntiltedPlace(random);
  const DogLegMove move(place, random, false);
  const Cutter cutter = RandomCutter(random, 0.5, 5.0);
  const double ramp = random->Uniform(0.02, 0.12);
  const Solid post = Post(random, random->Uniform(0.3, 8.0));
  const Vector3d away = random->Chance(0.5) ? Vector3d(-move.outward_G) : move.outward_G;
  const double target = hit ? -LogUniform(random, 0.01, std::min(1.0, 0.4 * cutter.radius))
                            : LogUniform(random, 0.025, 2.0);
  const auto clearance = [&](const Vector3d& offset) {
    return AcceleratedClearance(move, ramp, cutter, post, offset);
  };
  const auto offset = Tune([&](const Vector3d& o) { return clearance(o).upper; }, away, target);
  if (!offset.has_value()) return std::nullopt;
  Case c = Make(place, move, cutter, ramp, random);
  PairTruth truth;
  truth.accelerated = true;
  truth.clearance = clearance(*offset);
  c.AddBody(post, place.InTable(), *offset, truth);
  return c;
}

}  // namespace ncsim::planted
