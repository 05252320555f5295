// SPDX-License-Identifier: BSD-3-Clause
// The tool centre of a compensated closed contour is nowhere nearer to the programmed one than the
// radius, and comes as near as the radius beside every move that it can reach.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <random>

#include "sim/base/units.h"
#include "sim/control/command_test_util.h"
#include "sim/control/contour.h"
#include "sim/control/plane_curve.h"

namespace ncsim::control {
namespace {

Curve CurveOf(const AxisValues& from, const Command& command) {
  const Point a(from[kX], from[kY]), b(command.end[kX], command.end[kY]);
  if (command.kind != CommandKind::kArc) return Curve::Line(a, b);
  return Curve::Arc(a, b, {command.centre.x(), command.centre.y()}, ArcOf(from, command).sweep);
}

// By sampling, so that the test does not lean on the code under test.
std::vector<Point> Sample(const Curve& curve, int count) {
  std::vector<Point> points;
  for (int n = 0; n <= count; ++n) {
    const double s = static_cast<double>(n) / count;
    if (!curve.arc) {
      points.push_back(curve.start + s * (curve.end - curve.start));
      continue;
    }
    const Point r = curve.start - curve.centre;
    const double a = std::atan2(r.y(), r.x()) + s * curve.sweep;
    points.push_back(curve.centre + r.norm() * Point(std::cos(a), std::sin(a)));
  }
  return points;
}

double DistanceTo(const Curve& curve, const Point& p) {
  if (!curve.arc) {
    const Point d = curve.end - curve.start;
    const double s = std::clamp((p - curve.start).dot(d) / d.squaredNorm(), 0.0, 1.0);
    return (p - curve.start - s * d).norm();
  }
  const Point r0 = curve.start - curve.centre, r = p - curve.centre;
  double angle = std::atan2(r.y(), r.x()) - std::atan2(r0.y(), r0.x());
  if (curve.sweep < 0.0) angle = -angle;
  angle = std::fmod(angle + 4.0 * kPi, 2.0 * kPi);
  if (angle <= std::abs(curve.sweep)) return std::abs(r.norm() - r0.norm());
  return std::min((p - curve.start).norm(), (p - curve.end).norm());
}

struct Shape {
  AxisValues start{};            // The middle of the first side.
  std::vector<Command> contour;  // Back to `start`; sharp and rounded corners.
};

// A polygon around the origin, counter-clockwise; `dent` 0 is convex. Every second corner is
// rounded by ,R where asked.
Shape MakeShape(std::mt19937* random, double dent, bool rounded) {
  std::uniform_real_distribution<double> jitter(-0.25, 0.25);
  const int corners = 5 + static_cast<int>((*random)() % 6);
  std::vector<Point> points;
  for (int n = 0; n < corners; ++n) {
    const double angle = 2.0 * kPi * (n + 0.5 * jitter(*random)) / corners;
    const double radius = n % 2 == 0 ? 100.0 : 100.0 * (1.0 - dent * (0.7 + jitter(*random)));
    points.emplace_back(radius * std::cos(angle), radius * std::sin(angle));
  }
  Shape shape;
  const Point middle = 0.5 * (points.front() + points.back());
  shape.start = At(middle.x(), middle.y(), 0);
  for (std::size_t n = 0; n < points.size(); ++n) {
    shape.contour.push_back(FeedTo(points[n].x(), points[n].y()));
    if (rounded && n % 2 == 0) shape.contour.back().corner_radius = 9.0;
  }
  shape.contour.push_back(FeedTo(middle.x(), middle.y()));
  return shape;
}

struct Path {
  std::vector<Curve> programmed;  // With its corners rounded.
  std::vector<Curve> tool;        // Without entry and exit.
  std::vector<std::string> findings;
};

std::vector<Curve> Chain(AxisValues at, const std::vector<Command>& commands) {
  std::vector<Curve> curves;
  for (const Command& command : commands) {
    curves.push_back(CurveOf(at, command));
    at = command.end;
  }
  return curves;
}

Path Follow(const Shape& shape, Command::Comp side, double radius, bool fanuc) {
  Path path;
  ContourOptions options;
  options.fanuc_corners = fanuc;
  std::vector<Command> out;
  const auto report = [&](const Finding& f) { path.findings.push_back(f.message); };
  {
    Contour plain(
        options, [&](const Command& c) { out.push_back(c); }, report);
    plain.SetPosition(shape.start);
    for (const Command& command : shape.contour) plain.Push(command);
    path.programmed = Chain(shape.start, out);
  }
  out.clear();
  Contour contour(
      options, [&](const Command& c) { out.push_back(c); }, report);
  // Square onto the first side from the tool's side of it, and off again.
  const Curve& first = path.programmed.front();
  const double left = side == Command::Comp::kLeft ? 1.0 : -1.0;
  const Point away = first.start + 3.0 * radius * left * Left(first.start_tangent());
  contour.SetPosition(At(away.x(), away.y(), 0));
  const auto push = [&](Command command) {
    command.comp = side;
    command.comp_radius = radius;
    contour.Push(command);
  };
  push(FeedTo(first.start.x(), first.start.y()));
  for (const Command& command : shape.contour) push(command);
  contour.Push(FeedTo(away.x(), away.y()));
  const AxisValues entered = out.front().end;
  out.erase(out.begin());
  out.pop_back();
  path.tool = Chain(entered, out);
  return path;
}

class CutterCompProperty : public ::testing::TestWithParam<std::tuple<bool, bool, bool, bool>> {};

TEST_P(CutterCompProperty, TheToolKeepsItsRadius) {
  const auto [right, dented, rounded, fanuc] = GetParam();
  std::mt19937 random(7);
  for (int n = 0; n < 40; ++n) {
    const Shape shape = MakeShape(&random, dented ? 0.3 : 0.0, rounded);
    const double radius = 0.5 + 0.2 * n;
    const Path path =
        Follow(shape, right ? Command::Comp::kRight : Command::Comp::kLeft, radius, fanuc);
    ASSERT_TRUE(path.findings.empty()) << path.findings.front();
    std::vector<double> nearest(path.programmed.size(), 1e9);
    for (const Curve& tool : path.tool) {
      for (const Point& point : Sample(tool, 60)) {
        for (std::size_t i = 0; i < path.programmed.size(); ++i) {
          const double distance = DistanceTo(path.programmed[i], point);
          ASSERT_GE(distance, radius - 1e-6) << "shape " << n;
          nearest[i] = std::min(nearest[i], distance);
        }
      }
    }
    for (const double distance : nearest) EXPECT_NEAR(distance, radius, 1e-6) << "shape " << n;
  }
}

// Whatever a program says, what goes on to the machine is finite.
TEST(CutterCompRandom, NoProgramBreaksIt) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> at(-10.0, 10.0);
  for (int program = 0; program < 2000; ++program) {
    int alarms = 0;
    ContourOptions options;
    options.type_b = random() % 2 == 0;
    options.fanuc_corners = random() % 2 == 0;
    Contour contour(
        options,
        [](const Command& command) {
          for (const double value : command.end) ASSERT_TRUE(std::isfinite(value));
        },
        [&](const Finding& finding) { alarms += finding.rule == Rule::kControlAlarm ? 1 : 0; });
    AxisValues position{};
    for (int n = 0; n < 30; ++n) {
      // Coarse points, so that moves repeat, reverse and touch.
      Command command = FeedTo(std::round(at(random)), std::round(at(random)));
      if (random() % 5 == 0) command = FeedTo(position[kX], position[kY], 1);
      if (random() % 3 == 0) {
        const Point middle(0.5 * (position[kX] + command.end[kX]),
                           0.5 * (position[kY] + command.end[kY]));
        const bool full = random() % 4 == 0;
        if (full) command.end = position;
        command = ArcTo(command.end[kX], command.end[kY], middle.x(), middle.y(), random() % 2 == 0,
                        full);
      }
      if (random() % 8 == 0) command.corner_radius = std::abs(at(random));
      const unsigned side = random() % 8;
      if (side > 1) command.comp = side > 2 ? Command::Comp::kLeft : Command::Comp::kRight;
      command.comp_radius = random() % 16 == 0 ? 0.0 : 1.5;
      contour.Push(command);
      position = command.end;
      if (random() % 20 == 0) contour.Flush();
    }
    contour.Stop({}, true);
    EXPECT_LE(alarms, 31);
  }
}

INSTANTIATE_TEST_SUITE_P(Shapes, CutterCompProperty,
                         ::testing::Combine(::testing::Bool(), ::testing::Bool(), ::testing::Bool(),
                                            ::testing::Bool()));

}  // namespace
}  // namespace ncsim::control
