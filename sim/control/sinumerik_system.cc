// SPDX-License-Identifier: BSD-3-Clause
#include "sim/control/sinumerik_system.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <optional>
#include <utility>

#include "sim/base/text.h"
#include "sim/base/units.h"
#include "sim/control/limits.h"
#include "sim/nc/sinumerik_token.h"

namespace ncsim::control {
namespace {

using nc::SinumerikValue;
using Access = SinumerikSystem::Access;

constexpr std::string_view kEdgeData = "$TC_DP";
constexpr int kMaxEdgeParameter = 35;
constexpr int kMaxTool = 32000;

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

/// What tool management keeps of tools, their monitoring and magazines, as a control writes it out.
bool IsOfToolManagement(std::string_view name) {
  for (const std::string_view family :
       {"$TC_TP", "$TC_TPC", "$TC_TPCS", "$TC_DPC", "$TC_DPCS", "$TC_MOP", "$TC_MOPC", "$TC_MOPCS",
        "$TC_MAP", "$TC_MAPC", "$TC_MAPCS", "$TC_MPP", "$TC_MPPC", "$TC_MPPCS", "$TC_MDP",
        "$TC_MTP", "$TC_MTPC", "$TC_MTPCS"}) {
    if (!name.starts_with(family) || name.size() == family.size()) continue;
    const std::string_view number = name.substr(family.size());
    if (std::all_of(number.begin(), number.end(), IsDigit)) return true;
  }
  return name == "$TC_DPCE" || name == "$TC_DPH" || name == "$TC_MLSR" || name == "$TC_MPTH";
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

/// A basic frame, or one of the system's that lie before the settable one. `indexed`: one of
/// several.
bool IsBasicFrame(std::string_view name, bool* indexed) {
  constexpr std::array<std::string_view, 4> kIndexed = {"$P_CHBFR", "$P_NCBFR", "$P_CHBFRAME",
                                                        "$P_NCBFRAME"};
  constexpr std::array<std::string_view, 5> kOne = {"$P_UBFR", "$P_BFRAME", "$P_ACTBFRAME",
                                                    "$P_SETFRAME", "$P_EXTFRAME"};
  *indexed = std::find(kIndexed.begin(), kIndexed.end(), name) != kIndexed.end();
  return *indexed || std::find(kOne.begin(), kOne.end(), name) != kOne.end();
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

double Sinumerik840dSystem::unit() const {
  return interpreter_ == nullptr ? 1.0 : interpreter_->system_unit();
}

void Sinumerik840dSystem::AssumeStated(int index, bool stated) {
  if (stated) return;
  log_->Assume("offset " + SinumerikRegisters::FrameName(index),
               "the program reads it and the job does not state it: the middle of the table", true);
}

/// $P_UIFR[n], $P_IFRAME, $P_PFRAME, $P_ACTFRAME: whole, or with an axis and a component behind.
Access Sinumerik840dSystem::ReadFrame(std::string_view name, Indices indices, SinumerikValue* value,
                                      std::string* message) {
  std::optional<SettableFrame> frame;
  if (name == "$P_UIFR") {
    const auto index = TakeFrameIndex(&indices);
    if (!index) return Fail(message, 17020, "$P_UIFR has the frames 0 to 99");
    frame = registers_->frame(*index);
    AssumeStated(*index, frame->stated);
  } else if (interpreter_ == nullptr) {
    return Access::kUnknown;
  } else {
    const SettableFrame& active = interpreter_->active_settable();
    AffineFrame whole = interpreter_->program_frame();
    if (name == "$P_PFRAME" && whole.fine != AxisValues{} && !settings_->fine_shift) {
      log_->Assume("MD24000", "1: $P_PFRAME shows the shift of ATRANS as the fine one", true);
    }
    if (name == "$P_ACTFRAME") whole = Chained(ToAffine(active), whole);
    const bool turned =
        name == "$P_ACTFRAME" && (interpreter_->tool_frame() || interpreter_->swivels());
    if (!turned) frame = name == "$P_IFRAME" ? active : ToSettable(whole);
    if (name != "$P_PFRAME") AssumeStated(interpreter_->settable_frame(), active.stated);
  }
  if (!frame) {
    *message = "reading " + std::string(name) +
               ", which is mirrored, distorted or turned by TOROT or CYCLE800, was not simulated";
    return Access::kUnknown;
  }
  if (indices.empty()) {
    *value = SinumerikValue::Frame(ToValue(*frame, unit()));
    return Access::kDone;
  }
  const int axis = AxisOf(indices[0]);
  if (indices.size() != 2 || axis < 0) {
    return Fail(message, 12080, std::string(name) + " takes an axis and TR, FI, RT, SC or MI");
  }
  *value = SinumerikValue::Real(
      Component(*frame, static_cast<std::size_t>(axis), indices[1].text, unit()));
  return Access::kDone;
}

/// Not simulated: they read as zero frames and may be set to one.
Access Sinumerik840dSystem::ReadBasicFrame(bool indexed, Indices indices, SinumerikValue* value,
                                           std::string* message) {
  log_->Assume("basic frame", "none: neither job nor program states one", false);
  if (indexed && !indices.empty()) indices.erase(indices.begin());
  const SettableFrame zero;
  if (indices.empty()) {
    *value = SinumerikValue::Frame(ToValue(zero, 1.0));
    return Access::kDone;
  }
  const int axis = AxisOf(indices[0]);
  if (indices.size() != 2 || axis < 0) {
    return Fail(message, 12080, "a frame takes an axis and TR, FI, RT, SC or MI");
  }
  *value =
      SinumerikValue::Real(Component(zero, static_cast<std::size_t>(axis), indices[1].text, 1.0));
  return Access::kDone;
}

Access Sinumerik840dSystem::WriteBasicFrame(std::string_view name, bool indexed, Indices indices,
                                            const SinumerikValue& value, std::string* message) {
  if (indexed && !indices.empty()) indices.erase(indices.begin());
  bool zero = false;
  if (indices.empty()) {
    const std::optional<AffineFrame> frame = ToAffine(value, 1.0);
    zero = value.type == nc::SinumerikType::kFrame && frame && frame->is_zero();
  } else if (indices.size() == 2 && value.is_number()) {
    zero = value.number == (indices[1].text == "SC" ? 1.0 : 0.0);
  }
  if (zero) return Access::kDone;
  *message = std::string(name) + " = another frame than CTRANS() was not simulated";
  return Access::kUnknown;
}

/// The n of $P_UIFR[n, ...], and takes it out.
std::optional<int> Sinumerik840dSystem::TakeFrameIndex(Indices* indices) {
  const auto index =
      indices->empty() ? std::nullopt : Whole((*indices)[0], 0, kNumSettableFrames - 1);
  if (index) indices->erase(indices->begin());
  return index;
}

Access Sinumerik840dSystem::WriteFrame(std::string_view name, Indices indices,
                                       const SinumerikValue& value, std::string* message) {
  SettableFrame* stored = nullptr;
  if (name == "$P_UIFR") {
    const auto index = TakeFrameIndex(&indices);
    if (!index) return Fail(message, 17020, "$P_UIFR has the frames 0 to 99");
    stored = registers_->MutableFrame(*index);
  } else if (interpreter_ == nullptr) {
    return Access::kUnknown;
  }
  const bool programmed = name == "$P_PFRAME";
  if (!indices.empty()) return WriteComponent(stored, name, indices, value, message);
  if (value.type != nc::SinumerikType::kFrame) {
    return Fail(message, 12150, std::string(name) + " needs a frame");
  }
  const std::optional<AffineFrame> affine = ToAffine(value, unit());
  if (!affine) return Fail(message, 12160, "a frame's factor of scale is above 0");
  if (programmed) {
    interpreter_->SetProgramFrame(*affine);
    return Access::kDone;
  }
  const std::optional<SettableFrame> frame = ToSettable(value, unit());
  if (!frame) {
    *message = "a chain of frames that mirrors or distorts, in " + std::string(name) +
               ", was not simulated";
    return Access::kUnknown;
  }
  if (stored == nullptr) {
    interpreter_->SetActiveSettable(*frame);
  } else {
    *stored = *frame;
  }
  return Access::kDone;
}

/// A program that sets one axis of an offset that nobody states leaves the others assumed.
Access Sinumerik840dSystem::WriteComponent(SettableFrame* stored, std::string_view name,
                                           const Indices& indices, const SinumerikValue& value,
                                           std::string* message) {
  std::optional<SettableFrame> frame;
  if (stored != nullptr) {
    frame = *stored;
  } else if (name == "$P_IFRAME") {
    frame = interpreter_->active_settable();
  } else {
    frame = ToSettable(interpreter_->program_frame());
  }
  if (!frame) {
    *message = "a component of " + std::string(name) +
               ", which is mirrored or distorted, was not simulated";
    return Access::kUnknown;
  }
  const int axis = indices.size() == 2 ? AxisOf(indices[0]) : -1;
  const bool known =
      axis >= 0 && value.is_number() &&
      SetComponent(&*frame, static_cast<std::size_t>(axis), indices[1].text, value.number, unit());
  if (!known) {
    return Fail(message, 12080,
                std::string(name) + " takes an axis, TR, FI, RT, SC or MI, and a number for it");
  }
  if (stored != nullptr) {
    *stored = *frame;
  } else if (name == "$P_IFRAME") {
    interpreter_->SetActiveSettable(*frame);
  } else {
    interpreter_->SetProgramFrame(ToAffine(*frame));
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
  double shown = i < kA ? at[i] / unit() : Degrees(at[i]);
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
  if (name == "$P_AXN1" || name == "$P_AXN2" || name == "$P_AXN3") {
    *value = SinumerikValue::Axis(std::string(1, "XYZ"[name.back() - '1']));
    return Access::kDone;
  }
  if (name == "$P_TOOLNO") return whole(now.tool());
  if (name == "$P_TOOLP") return whole(std::max(0, now.next_tool()));
  if (name == "$P_TOOL") return whole(now.edge());
  if (name == "$P_TOOLR" || name == "$AC_TOOLR_ACT") return real(now.tool_radius() / unit());
  if (name == "$P_TOOLL" && indices.size() == 1) {
    return real(indices[0].number == 1.0 ? now.tool_length() / unit() : 0.0);
  }
  if (name == "$P_UIFRNUM") return whole(now.settable_frame());
  if (name == "$P_TRAFO" || name == "$AC_TRAFO") return whole(now.transforms() ? 1 : 0);
  if (name == "$P_F") return real(now.feed_word());
  if (name == "$P_S" || name == "$AA_S") return real(now.spindle_rpm());
  if (name == "$P_SDIR") return whole(now.spindle() > 0 ? 3 : now.spindle() < 0 ? 4 : 5);
  return Access::kUnknown;
}

/// mm of a unit of $TC_DPn: lengths and radii, and their wear and bases.
double Sinumerik840dSystem::UnitOf(int parameter) const {
  const bool length = (parameter >= 3 && parameter <= 9) || (parameter >= 12 && parameter <= 18) ||
                      (parameter >= 21 && parameter <= 23);
  return length ? unit() : 1.0;
}

Access Sinumerik840dSystem::Read(std::string_view name, const Indices& indices,
                                 SinumerikValue* value, std::string* message) {
  for (const std::string_view frame : {"$P_UIFR", "$P_IFRAME", "$P_PFRAME", "$P_ACTFRAME"}) {
    if (name == frame) return ReadFrame(name, indices, value, message);
  }
  bool indexed = false;
  if (IsBasicFrame(name, &indexed)) return ReadBasicFrame(indexed, indices, value, message);
  if (const auto number = EdgeParameter(name)) {
    if (indices.size() != 2) return Fail(message, 17020, "$TC_DPn[tool, edge]");
    const auto tool = Whole(indices[0], 1, kMaxTool), edge = Whole(indices[1], 1, kMaxEdge);
    if (!tool || !edge) return Fail(message, 17020, "$TC_DPn[tool, edge]");
    *value = SinumerikValue::Real(registers_->Parameter(*number, *tool, *edge) / UnitOf(*number));
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
  for (const std::string_view frame : {"$P_UIFR", "$P_IFRAME", "$P_PFRAME"}) {
    if (name == frame) return WriteFrame(name, indices, value, message);
  }
  bool indexed = false;
  if (IsBasicFrame(name, &indexed)) {
    return WriteBasicFrame(name, indexed, indices, value, message);
  }
  const auto number = EdgeParameter(name);
  if (!number) {
    // Of all others, 0 and "" are what they hold anyway.
    const bool nothing = value.is_number()
                             ? value.number == 0.0
                             : value.type == nc::SinumerikType::kString && value.text.empty();
    const bool moves_nothing = name.starts_with("$TC_") && (nothing || IsOfToolManagement(name));
    return moves_nothing ? Access::kDone : Access::kUnknown;
  }
  const auto tool = indices.size() == 2 ? Whole(indices[0], 1, kMaxTool) : std::nullopt;
  const auto edge = indices.size() == 2 ? Whole(indices[1], 1, kMaxEdge) : std::nullopt;
  if (!tool || !edge || !value.is_number()) {
    return Fail(message, 17020, "$TC_DPn[tool, edge] needs a number");
  }
  registers_->SetParameter(*number, *tool, *edge, value.number * UnitOf(*number));
  // Lengths 2 and 3, base dimensions and their wear would shift the tip sideways.
  const bool aside = *number == 4 || *number == 5 || *number == 13 || *number == 14 ||
                     (*number >= 21 && *number <= 23);
  if (!aside || value.number == 0.0) return Access::kDone;
  *message = std::string(name) + " = another value than 0 was not simulated";
  return Access::kUnknown;
}

}  // namespace ncsim::control
