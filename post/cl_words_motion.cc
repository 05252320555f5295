// SPDX-License-Identifier: BSD-3-Clause
// Statements of motion, feed and coordinate systems.
#include <array>
#include <utility>

#include "post/cl_words.h"

namespace ncsim::post {
namespace {

constexpr int kMostTurns = 10'000;

template <class Record>
ClStatement PointAndAxis(ClArguments& arguments) {
  Record record;
  record.point = arguments.Vector("x, y, z");
  if (!arguments.done()) record.axis = arguments.Vector("i, j, k");
  return record;
}

}  // namespace

ClStatement ParseGoto(ClArguments& arguments) { return PointAndAxis<cl::Goto>(arguments); }

ClStatement ParsePoint(ClArguments& arguments) { return PointAndAxis<cl::Point>(arguments); }

ClStatement ParseFrom(ClArguments& arguments) { return PointAndAxis<cl::From>(arguments); }

ClStatement ParseRapid(ClArguments&) { return cl::Rapid{}; }

ClStatement ParseGoDelta(ClArguments& arguments) {
  cl::GoDelta delta{Eigen::Vector3d::Zero(), {}};
  if (arguments.left() == 1) {
    delta.along_axis = arguments.Number("a distance");
  } else {
    delta.delta = arguments.Vector("dx, dy, dz");
  }
  return delta;
}

ClStatement ParseGoHome(ClArguments& arguments) {
  cl::GoHome home;
  if (arguments.at_number()) {
    home.point = arguments.Vector("x, y, z");
    if (!arguments.done()) home.axis = arguments.Vector("i, j, k");
    return home;
  }
  while (!arguments.done()) {
    home.words += (home.words.empty() ? "" : ",") + arguments.TakeText();
  }
  return home;
}

ClStatement ParseCircle(ClArguments& arguments) {
  cl::Circle circle;
  circle.centre = arguments.Vector("the centre x, y, z");
  circle.normal = arguments.Vector("the axis i, j, k");
  if (arguments.at_number()) circle.radius = arguments.Number("a radius");
  // NX: total tolerance, its share inside, diameter and corner radius of the tool.
  for (int i = 0; i < 4 && arguments.at_number(); ++i) arguments.Number("a value");
  if (arguments.Take("TIMES")) circle.times = arguments.Integer("TIMES", 1, kMostTurns);
  return circle;
}

std::optional<ClFeedUnit> TakeFeedUnit(ClArguments& arguments) {
  constexpr std::array<std::pair<std::string_view, ClFeedUnit>, 6> kUnits = {
      {{"MMPM", ClFeedUnit::kMmPerMinute},
       {"IPM", ClFeedUnit::kInchPerMinute},
       {"MMPR", ClFeedUnit::kMmPerRev},
       {"IPR", ClFeedUnit::kInchPerRev},
       {"PERMIN", ClFeedUnit::kPerMinute},
       {"PERREV", ClFeedUnit::kPerRev}}};
  for (const auto& [word, unit] : kUnits) {
    if (arguments.Take(word)) return unit;
  }
  return std::nullopt;
}

ClStatement ParseFeed(ClArguments& arguments) {
  cl::Feed feed;
  feed.unit = TakeFeedUnit(arguments);
  feed.value = arguments.Number("a feed rate");
  if (!feed.unit) feed.unit = TakeFeedUnit(arguments);
  return feed;
}

ClStatement ParseDelay(ClArguments& arguments) {
  cl::Delay delay;
  delay.revolutions = arguments.Take("REV");
  delay.value = arguments.Number("a time");
  delay.revolutions = delay.revolutions || arguments.Take("REV");
  if (delay.value < 0.0) arguments.Error("DELAY of less than nothing");
  return delay;
}

ClStatement ParseMsys(ClArguments& arguments) {
  cl::Msys msys;
  msys.origin = arguments.Vector("the origin");
  msys.x = arguments.Vector("the X axis");
  msys.y = arguments.Vector("the Y axis");
  return msys;
}

ClStatement ParseCsys(ClArguments& arguments) {
  cl::Csys csys;
  for (double& value : csys.rows) value = arguments.Number("three rows of four values");
  return csys;
}

ClStatement ParseMultiAxis(ClArguments& arguments) {
  cl::MultiAxis multi;
  multi.on = !arguments.Take("OFF");
  if (multi.on) arguments.Take("ON");
  return multi;
}

ClStatement ParseUnits(ClArguments& arguments) {
  for (const std::string_view word : {"MM", "MILLIM"}) {
    if (arguments.Take(word)) return cl::Units{ClUnit::kMillimetre};
  }
  for (const std::string_view word : {"INCHES", "INCH", "IN"}) {
    if (arguments.Take(word)) return cl::Units{ClUnit::kInch};
  }
  arguments.Error(arguments.line().major + " knows MM and INCHES");
  return cl::Unknown{};
}

/// Names may have commas and slashes, so not by tokens.
ClStatement ParseOperationBegin(ClArguments& arguments) {
  constexpr std::string_view kTool = ",TOOL,";
  const std::string_view text = arguments.line().text;
  cl::OperationBegin begin;
  const std::size_t at = text.rfind(kTool);
  begin.name = text.substr(0, at);
  if (at != std::string_view::npos) begin.tool = text.substr(at + kTool.size());
  while (!arguments.done()) arguments.TakeText();
  if (begin.name.empty()) arguments.Error("TOOL PATH without the name of an operation");
  return begin;
}

}  // namespace ncsim::post
