// SPDX-License-Identifier: BSD-3-Clause
// Statements of tool, spindle, coolant, compensation and codes of the machine.
#include <array>
#include <utility>

#include "post/cl_words.h"

namespace ncsim::post {
namespace {

constexpr int kMostTool = 99'999'999;
constexpr int kMostRegister = 9999;
constexpr double kMetrePerFoot = 0.3048;

template <class Value, std::size_t kSize>
bool TakeOneOf(ClArguments& arguments,
               const std::array<std::pair<std::string_view, Value>, kSize>& words, Value* value) {
  for (const auto& [word, meaning] : words) {
    if (!arguments.Take(word)) continue;
    *value = meaning;
    return true;
  }
  return false;
}

ClStatement Code(char letter, ClArguments& arguments) {
  cl::Code code;
  code.letter = letter;
  code.number = arguments.Number("a code");
  if (!arguments.Take("NOW")) code.with_next = arguments.Take("NEXT");
  return code;
}

bool TakeSpindleRange(ClArguments& arguments, cl::Spindle* spindle) {
  const bool range = arguments.Take("RANGE");
  if (range && arguments.at_number()) {
    spindle->range = arguments.TakeText();
    return true;
  }
  for (const std::string_view word : {"LOW", "MEDIUM", "HIGH"}) {
    if (!arguments.Take(word)) continue;
    spindle->range = word;
    return true;
  }
  return false;
}

}  // namespace

ClStatement ParseToolData(ClArguments& arguments) {
  cl::ToolShape shape;
  while (!arguments.done() && !arguments.at_number()) {
    shape.kind += (shape.kind.empty() ? "" : ",") + arguments.Peek();
    arguments.TakeText();
  }
  shape.values = arguments.Numbers();
  if (shape.values.empty()) arguments.Error("TLDATA without a diameter");
  return shape;
}

ClStatement ParseCutter(ClArguments& arguments) {
  cl::ToolShape shape{"CUTTER", arguments.Numbers()};
  if (shape.values.empty()) arguments.Error("CUTTER without a diameter");
  return shape;
}

ClStatement ParseLoadTool(ClArguments& arguments) {
  cl::LoadTool load;
  load.number = arguments.Integer("a tool number", 0, kMostTool);
  while (arguments.ok()) {
    if (arguments.Take("ADJUST") || arguments.Take("OSETNO")) {
      load.length_register = arguments.Integer("a length register", 0, kMostRegister);
    } else if (arguments.Take("LENGTH")) {
      load.length = arguments.Number("a length");
    } else {
      break;
    }
  }
  return load;
}

ClStatement ParseLoad(ClArguments& arguments) {
  if (arguments.Take("TOOL")) return ParseLoadTool(arguments);
  arguments.Error("LOAD knows TOOL");
  return cl::Unknown{};
}

ClStatement ParseSelect(ClArguments& arguments) {
  if (!arguments.Take("TOOL")) arguments.Error("SELECT knows TOOL");
  return cl::SelectTool{arguments.Integer("a tool number", 0, kMostTool)};
}

ClStatement ParseSpindle(ClArguments& arguments) {
  using Mode = cl::Spindle::Mode;
  cl::Spindle spindle;
  bool speed = false, said = false, feet = false;
  spindle.mode = Mode::kOn;
  while (arguments.ok() && !arguments.done()) {
    if (arguments.Take("OFF")) {
      spindle.mode = Mode::kOff;
    } else if (arguments.Take("RPM")) {
      spindle.mode = Mode::kRpm;
    } else if (arguments.Take("SMM")) {
      spindle.mode = Mode::kSurface;
    } else if (arguments.Take("SFM")) {
      feet = true;
      spindle.mode = Mode::kSurface;
    } else if (arguments.Take("LOCK")) {
      spindle.mode = Mode::kLocked;
    } else if (arguments.Take("CLW")) {
      spindle.clockwise = true;
    } else if (arguments.Take("CCLW")) {
      spindle.clockwise = false;
    } else if (arguments.at_number() && !speed) {
      spindle.speed = arguments.Number("a speed");
      speed = true;
      if (spindle.mode == Mode::kOn) spindle.mode = Mode::kRpm;
    } else if (!arguments.Take("ON") && !TakeSpindleRange(arguments, &spindle)) {
      break;
    }
    said = true;
  }
  if (feet) spindle.speed *= kMetrePerFoot;
  if (!said) arguments.Error("SPINDL without a speed, ON or OFF");
  if ((spindle.mode == Mode::kRpm || spindle.mode == Mode::kSurface) &&
      !(speed && spindle.speed > 0.0)) {
    arguments.Error("SPINDL without a speed above 0");
  }
  return spindle;
}

ClStatement ParseCoolant(ClArguments& arguments) {
  using Mode = cl::Coolant::Mode;
  constexpr std::array<std::pair<std::string_view, Mode>, 9> kModes = {{{"OFF", Mode::kOff},
                                                                        {"ON", Mode::kOn},
                                                                        {"FLOOD", Mode::kFlood},
                                                                        {"MIST", Mode::kMist},
                                                                        {"TAP", Mode::kTap},
                                                                        {"TAPKUL", Mode::kTap},
                                                                        {"THRU", Mode::kThrough},
                                                                        {"THROUGH", Mode::kThrough},
                                                                        {"AIR", Mode::kAir}}};
  cl::Coolant coolant;
  if (arguments.done()) {
    coolant.mode = Mode::kOn;
  } else if (!TakeOneOf(arguments, kModes, &coolant.mode)) {
    arguments.Error(Quoted(arguments.Peek()) + " is not known in COOLNT");
  }
  return coolant;
}

ClStatement ParseCutterComp(ClArguments& arguments) {
  using Comp = cl::CutterComp;
  constexpr std::array<std::pair<std::string_view, Comp::Side>, 4> kSides = {
      {{"OFF", Comp::Side::kOff},
       {"LEFT", Comp::Side::kLeft},
       {"RIGHT", Comp::Side::kRight},
       {"ON", Comp::Side::kOn}}};
  constexpr std::array<std::pair<std::string_view, Comp::Plane>, 3> kPlanes = {
      {{"XYPLAN", Comp::Plane::kXY}, {"YZPLAN", Comp::Plane::kYZ}, {"ZXPLAN", Comp::Plane::kZX}}};
  Comp comp;
  if (!TakeOneOf(arguments, kSides, &comp.side)) {
    arguments.Error("CUTCOM knows LEFT, RIGHT, ON and OFF");
  }
  while (arguments.ok() && !arguments.done()) {
    if (arguments.at_number() && !comp.diameter_register) {
      comp.diameter_register = arguments.Integer("a register", 0, kMostRegister);
    } else if (!TakeOneOf(arguments, kPlanes, &comp.plane)) {
      break;
    }
  }
  return comp;
}

ClStatement ParseAuxiliary(ClArguments& arguments) { return Code('M', arguments); }

ClStatement ParsePreparatory(ClArguments& arguments) { return Code('G', arguments); }

}  // namespace ncsim::post
