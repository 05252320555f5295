// SPDX-License-Identifier: BSD-3-Clause
#include "sim/control/sinumerik_system.h"

#include <charconv>
#include <cmath>
#include <optional>
#include <utility>

#include "sim/base/units.h"
#include "sim/nc/sinumerik_token.h"

namespace ncsim::control {
namespace {

using nc::SinumerikFrame;
using nc::SinumerikValue;
using Access = SinumerikSystem::Access;

constexpr std::string_view kLetters = "XYZABC";
constexpr std::string_view kEdgeData = "$TC_DP";
constexpr int kMaxEdgeParameter = 35;
constexpr int kMaxTool = 32000, kMaxEdge = 12;

/// The n of $TC_DPn.
std::optional<int> EdgeParameter(std::string_view name) {
  if (!name.starts_with(kEdgeData)) return std::nullopt;
  name.remove_prefix(kEdgeData.size());
  int number = 0;
  const auto [end, error] = std::from_chars(name.data(), name.data() + name.size(), number);
  const bool whole = error == std::errc() && end == name.data() + name.size();
  if (!whole || number < 1 || number > kMaxEdgeParameter) return std::nullopt;
  return number;
}

std::optional<int> Whole(const SinumerikValue& value, int lowest, int highest) {
  if (!value.is_number() || value.number != std::floor(value.number)) return std::nullopt;
  if (!(value.number >= lowest && value.number <= highest)) return std::nullopt;
  return static_cast<int>(value.number);
}

Access Fail(std::string* message, int alarm, std::string text) {
  *message = nc::AlarmText(alarm, std::move(text));
  return Access::kAlarm;
}

/// mm or rad of a component as programs see it.
double UnitOf(std::size_t axis) { return axis < kA ? 1.0 : kPi / 180.0; }

SinumerikFrame ToValue(const SettableFrame& frame) {
  SinumerikFrame::Part part;
  for (std::size_t i = 0; i < kNumAxes; ++i) {
    SinumerikFrame::Axis axis;
    axis.name = kLetters.substr(i, 1);
    axis.tr = frame.coarse[i] / UnitOf(i);
    axis.fi = frame.fine[i] / UnitOf(i);
    if (i < 3) {
      axis.rt = Degrees(frame.turn[i]);
      axis.sc = frame.scale[i];
      axis.mi = frame.mirror[i];
    }
    part.push_back(std::move(axis));
  }
  return SinumerikFrame{{std::move(part)}};
}

/// One component; false: there is none of that name for this axis.
bool SetComponent(SettableFrame* frame, std::size_t i, std::string_view component, double value) {
  if (component == "TR") {
    frame->coarse[i] = value * UnitOf(i);
  } else if (component == "FI") {
    frame->fine[i] = value * UnitOf(i);
  } else if (i < 3 && component == "RT") {
    frame->turn[i] = Radians(value);
  } else if (i < 3 && component == "SC") {
    frame->scale[i] = value;
  } else if (i < 3 && component == "MI") {
    frame->mirror[i] = value != 0.0;
  } else {
    return false;
  }
  return true;
}

double Component(const SettableFrame& frame, std::size_t i, std::string_view component) {
  if (component == "TR") return frame.coarse[i] / UnitOf(i);
  if (component == "FI") return frame.fine[i] / UnitOf(i);
  if (i >= 3) return component == "SC" ? 1.0 : 0.0;
  if (component == "RT") return Degrees(frame.turn[i]);
  if (component == "SC") return frame.scale[i];
  return frame.mirror[i] ? 1.0 : 0.0;
}

}  // namespace

bool Sinumerik840dSystem::IsAxis(std::string_view name) const {
  return name.size() == 1 && machine_->FindAxis(name[0]) != nullptr;
}

void Sinumerik840dSystem::AssumeZero(const std::string& name) {
  log_->Assume(name, "0: the program reads it before it sets it", false);
}

int Sinumerik840dSystem::AxisOf(const SinumerikValue& name) const {
  if (name.is_number() || name.text.empty()) return -1;
  // X1 is the machine axis of X.
  const bool plain = name.text.size() == 1 || (name.text.size() == 2 && name.text[1] == '1');
  const std::size_t axis = kLetters.find(name.text[0]);
  if (!plain || axis >= kNumAxes || machine_->FindAxis(name.text[0]) == nullptr) return -1;
  return static_cast<int>(axis);
}

bool Sinumerik840dSystem::FrameIndex(const Indices& indices, int* index,
                                     std::string* message) const {
  const auto number = indices.empty() ? std::nullopt : Whole(indices[0], 0, kNumSettableFrames - 1);
  if (!number) {
    *message = nc::AlarmText(17020, "$P_UIFR has the frames 0 to 99");
    return false;
  }
  *index = *number;
  return true;
}

Access Sinumerik840dSystem::ReadFrame(const Indices& indices, SinumerikValue* value,
                                      std::string* message) {
  int index = 0;
  if (!FrameIndex(indices, &index, message)) return Access::kAlarm;
  const SettableFrame& frame = registers_->frame(index);
  if (!frame.stated) {
    log_->Assume("offset " + SinumerikRegisters::FrameName(index),
                 "the program reads it and the job does not state it: the middle of the table",
                 true);
  }
  if (indices.size() == 1) {
    *value = SinumerikValue::Frame(ToValue(frame));
    return Access::kDone;
  }
  const int axis = AxisOf(indices[1]);
  if (indices.size() != 3 || axis < 0) return Fail(message, 12080, "$P_UIFR[n, axis, component]");
  const std::string& component = indices[2].text;
  *value = SinumerikValue::Real(Component(frame, static_cast<std::size_t>(axis), component));
  return Access::kDone;
}

Access Sinumerik840dSystem::WriteFrame(const Indices& indices, const SinumerikValue& value,
                                       std::string* message) {
  int index = 0;
  if (!FrameIndex(indices, &index, message)) return Access::kAlarm;
  SettableFrame* frame = registers_->MutableFrame(index);
  if (indices.size() == 3) {
    const int axis = AxisOf(indices[1]);
    const bool known =
        axis >= 0 && value.is_number() &&
        SetComponent(frame, static_cast<std::size_t>(axis), indices[2].text, value.number);
    if (!known) return Fail(message, 12080, "$P_UIFR[n, axis, component] needs a number");
    // A program that sets one axis of an offset that nobody states leaves the others assumed.
    return Access::kDone;
  }
  if (indices.size() != 1 || value.type != nc::SinumerikType::kFrame) {
    return Fail(message, 12150, "$P_UIFR[n] needs a frame");
  }
  if (value.frame != nullptr && value.frame->chain.size() > 1) {
    *message = "a chain of frames in $P_UIFR was not simulated";
    return Access::kUnknown;
  }
  *frame = SettableFrame();
  if (value.frame == nullptr || value.frame->chain.empty()) return Access::kDone;
  for (const SinumerikFrame::Axis& axis : value.frame->chain.front()) {
    const int i = AxisOf(SinumerikValue::Axis(axis.name));
    if (i < 0) continue;
    const std::size_t at = static_cast<std::size_t>(i);
    SetComponent(frame, at, "TR", axis.tr);
    SetComponent(frame, at, "FI", axis.fi);
    SetComponent(frame, at, "RT", axis.rt);
    SetComponent(frame, at, "SC", axis.sc);
    SetComponent(frame, at, "MI", axis.mi ? 1.0 : 0.0);
  }
  return Access::kDone;
}

Access Sinumerik840dSystem::ReadPosition(std::string_view name, const Indices& indices,
                                         SinumerikValue* value) {
  const int axis = indices.size() == 1 ? AxisOf(indices[0]) : -1;
  if (axis < 0) return Access::kUnknown;
  const std::size_t i = static_cast<std::size_t>(axis);
  const AxisValues at =
      name == "$AA_IM" ? interpreter_->MachinePosition() : interpreter_->program_position();
  double shown = at[i] / UnitOf(i);
  if (i >= kA && settings_->rotary[i - kA].modulo) {
    constexpr double kTurn = 360.0;
    shown -= kTurn * std::floor(shown / kTurn);
  }
  *value = SinumerikValue::Real(shown);
  return Access::kDone;
}

Access Sinumerik840dSystem::ReadState(std::string_view name, const Indices& indices,
                                      SinumerikValue* value) {
  const SinumerikInterpreter& now = *interpreter_;
  const auto whole = [&](int number) {
    *value = SinumerikValue::Int(number);
    return Access::kDone;
  };
  const auto real = [&](double number) {
    *value = SinumerikValue::Real(number);
    return Access::kDone;
  };
  if (name == "$P_TOOLNO") return whole(now.tool());
  if (name == "$P_TOOLP") return whole(std::max(0, now.next_tool()));
  if (name == "$P_TOOL") return whole(now.edge());
  if (name == "$P_TOOLR" || name == "$AC_TOOLR_ACT") return real(now.tool_radius());
  if (name == "$P_TOOLL" && indices.size() == 1) {
    return real(indices[0].number == 1.0 ? now.frame().tool_length : 0.0);
  }
  if (name == "$P_UIFRNUM") return whole(now.settable_frame());
  if (name == "$P_TRAFO" || name == "$AC_TRAFO") return whole(now.transforms() ? 1 : 0);
  if (name == "$P_F") return real(now.feed_word());
  if (name == "$P_S" || name == "$AA_S") return real(now.spindle_rpm());
  if (name == "$P_SDIR") return whole(now.spindle() > 0 ? 3 : now.spindle() < 0 ? 4 : 5);
  return Access::kUnknown;
}

Access Sinumerik840dSystem::Read(std::string_view name, const Indices& indices,
                                 SinumerikValue* value, std::string* message) {
  if (name == "$P_UIFR") return ReadFrame(indices, value, message);
  if (const auto number = EdgeParameter(name)) {
    if (indices.size() != 2) return Fail(message, 17020, "$TC_DPn[tool, edge]");
    const auto tool = Whole(indices[0], 1, kMaxTool), edge = Whole(indices[1], 1, kMaxEdge);
    if (!tool || !edge) return Fail(message, 17020, "$TC_DPn[tool, edge]");
    *value = SinumerikValue::Real(registers_->Parameter(*number, *tool, *edge));
    return Access::kDone;
  }
  // The program really runs: no simulation, test or block search.
  for (const std::string_view off : {"$P_SIM", "$P_DRYRUN", "$P_ISTEST", "$P_SEARCH"}) {
    if (name != off) continue;
    *value = SinumerikValue::Bool(false);
    return Access::kDone;
  }
  if (interpreter_ == nullptr) return Access::kUnknown;
  if (name == "$AA_IM" || name == "$AA_IW" || name == "$P_EP") {
    return ReadPosition(name, indices, value);
  }
  return ReadState(name, indices, value);
}

Access Sinumerik840dSystem::Write(std::string_view name, const Indices& indices,
                                  const SinumerikValue& value, std::string* message) {
  if (name == "$P_UIFR") return WriteFrame(indices, value, message);
  const auto number = EdgeParameter(name);
  if (!number) return Access::kUnknown;
  const auto tool = indices.size() == 2 ? Whole(indices[0], 1, kMaxTool) : std::nullopt;
  const auto edge = indices.size() == 2 ? Whole(indices[1], 1, kMaxEdge) : std::nullopt;
  if (!tool || !edge || !value.is_number()) {
    return Fail(message, 17020, "$TC_DPn[tool, edge] needs a number");
  }
  registers_->SetParameter(*number, *tool, *edge, value.number);
  // Lengths 2 and 3, base dimensions and their wear would shift the tip sideways.
  const bool aside = *number == 4 || *number == 5 || *number == 13 || *number == 14 ||
                     (*number >= 21 && *number <= 23);
  if (!aside || value.number == 0.0) return Access::kDone;
  *message = std::string(name) + " = another value than 0 was not simulated";
  return Access::kUnknown;
}

}  // namespace ncsim::control
