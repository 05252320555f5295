// SPDX-License-Identifier: BSD-3-Clause
// For tests of what makes or takes commands.
#pragma once

#include <string>
#include <vector>

#include "sim/base/text.h"
#include "sim/control/arc.h"
#include "sim/control/command.h"

namespace ncsim::control {

/// "rapid X0 Y0 Z5", "feed ... F10", "cw ... about I J K", "dwell 0.5"; mm, mm/s, s.
inline std::string ToText(const Command& command) {
  const auto point = [](double x, double y, double z) {
    return " X" + Short(x) + " Y" + Short(y) + " Z" + Short(z);
  };
  const std::string end = point(command.end[kX], command.end[kY], command.end[kZ]);
  switch (command.kind) {
    case CommandKind::kRapid:
      return "rapid" + end;
    case CommandKind::kFeed:
      return "feed" + end + " F" + Short(command.feed);
    case CommandKind::kArc:
      return (command.clockwise ? "cw" : "ccw") + std::string(command.full_circle ? " full" : "") +
             end + " about" + point(command.centre.x(), command.centre.y(), command.centre.z());
    case CommandKind::kDwell:
      return "dwell " + Short(command.dwell);
    case CommandKind::kMachineRapid:
    case CommandKind::kMachineFeed:
      return "machine" + end;
    case CommandKind::kToolChange:
      return "toolchange";
  }
  return "?";
}

inline std::vector<std::string> ToText(const std::vector<Command>& commands) {
  std::vector<std::string> text;
  text.reserve(commands.size());
  for (const Command& command : commands) text.push_back(ToText(command));
  return text;
}

inline AxisValues At(double x, double y, double z) { return {x, y, z, 0.0, 0.0, 0.0}; }

inline Command FeedTo(double x, double y, double z = 0.0) {
  Command command;
  command.kind = CommandKind::kFeed;
  command.end = At(x, y, z);
  command.feed = 10.0;
  command.named = 1U << kX | 1U << kY;
  return command;
}

inline Command RapidTo(double x, double y, double z = 0.0) {
  Command command = FeedTo(x, y, z);
  command.kind = CommandKind::kRapid;
  return command;
}

/// In the XY plane, from the last command's end.
inline Command ArcTo(double x, double y, double centre_x, double centre_y, bool clockwise,
                     bool full_circle = false) {
  Command command = FeedTo(x, y);
  command.kind = CommandKind::kArc;
  command.centre = {centre_x, centre_y, 0.0};
  command.clockwise = clockwise;
  command.full_circle = full_circle;
  return command;
}

}  // namespace ncsim::control
