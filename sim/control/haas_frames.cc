// SPDX-License-Identifier: BSD-3-Clause
// Work offsets, tool length, TCPC, DWO, shifts and rotation: all that makes the frame of a command.
#include <cmath>
#include <utility>

#include "sim/base/text.h"
#include "sim/base/units.h"
#include "sim/control/haas_interpreter.h"
#include "sim/control/limits.h"

namespace ncsim::control {
namespace {

// rad, mm: an offset value that is entered as 0.
constexpr double kZero = 1e-9;

}  // namespace

// G54-G59, G110-G129 (= G154 P1-P20), G154 P1-P99.
bool HaasInterpreter::ApplyOffsetCode(const CodeUse& use) {
  const int code = use.spec->number_x10 / 10;
  int index = code - 54;
  if (code >= 110 && code <= 129) index = kFirstG154 + code - 109;
  if (code == 154) {
    if (!block_.Has('P')) {
      log_.Alarm(Rule::kControlAlarm, block_.WhereOf(*use.word), "G154 needs P");
      return false;
    }
    const std::optional<int> p = block_.Integer('P', 1, kNumWorkOffsets - 1 - kFirstG154);
    if (!p) return false;
    index = kFirstG154 + *p;
  }
  codes_[kGroupOffset] = use.spec->number_x10;
  if (index != offset_) frame_dirty_ = true;
  offset_ = index;
  return true;
}

bool HaasInterpreter::CheckHWord(int h) {
  if (h == 0 || h == tool_ || !settings_.h_t_agreement) return true;
  Alarm('H', "H" + std::to_string(h) + " while " +
                 (tool_ == 0 ? std::string("no tool") : "T" + std::to_string(tool_)) +
                 " is in the spindle (setting 15 is ON)");
  return false;
}

bool HaasInterpreter::CancelLength() {
  if (!IsSet(kGroupLength, 49)) frame_dirty_ = true;
  codes_[kGroupLength] = 490;
  return true;
}

// G43, G44, G49, G234 and H. G43, G44 and G49 cancel G234; G234 cancels G43 and its H, so H must
// stand beside it; H00 cancels (manual, G43/G44 and G234).
bool HaasInterpreter::ApplyLength() {
  const CodeUse* use = CodeOf(kGroupLength);
  const int code = use == nullptr ? group_code(kGroupLength) / 10 : use->spec->number_x10 / 10;
  std::optional<int> h;
  if (block_.Has('H')) {
    h = block_.Integer('H', 0, kMaxToolOffset);
    if (!h || !CheckHWord(*h)) return false;
  }
  if (use == nullptr && !h) return true;
  const int last_h = h_;
  if (h) h_ = *h;
  if (code == 49) {
    tcp_cancelled_ = false;
    return CancelLength();
  }
  if (code == 234 ? !ApplyTcp(use, h) : !ApplyPlainLength(use, h, last_h)) return false;
  if (IsSet(kGroupLength, 49) && h_ == 0) return true;  // H00 has cancelled.
  codes_[kGroupLength] = 10 * code;
  frame_dirty_ = true;
  length_checked_ = false;
  return true;
}

bool HaasInterpreter::ApplyTcp(const CodeUse* use, std::optional<int> h) {
  if (!h || *h == 0) {
    Alarm('H', use == nullptr ? "H00 while G234 is active" : "G234 needs an H that is not 0");
    return false;
  }
  if (!parts_.frames->can_rotate()) {
    Unsupported("G234 machine", block_.where(), "G234: this model has no five-axis kinematics");
  }
  tcp_on_ = use != nullptr;
  tcp_cancelled_ = false;
  return true;
}

// The manual wants an H that is not 0 with G43; posts also leave it out after G49, meaning the
// last.
bool HaasInterpreter::ApplyPlainLength(const CodeUse* use, std::optional<int> h, int last_h) {
  if (h && *h == 0) return CancelLength();
  if (use == nullptr) return true;
  const std::string name = CodeName('G', use->word->value);
  if (!h && last_h == 0) {
    log_.Alarm(Rule::kControlAlarm, block_.WhereOf(*use->word), name + " needs an H");
    return false;
  }
  if (!h && IsSet(kGroupLength, 49)) {
    Unsupported(
        name + " without H", block_.WhereOf(*use->word),
        name + " without H: the manual wants one; taken as the last, H" + std::to_string(last_h));
  }
  if (tcp()) tcp_cancelled_ = true;
  return true;
}

bool HaasInterpreter::ApplyDwo() {
  const CodeUse* use = CodeOf(kGroupDwo);
  if (use == nullptr || use->spec->number_x10 == group_code(kGroupDwo)) return true;
  codes_[kGroupDwo] = use->spec->number_x10;
  frame_dirty_ = true;
  length_checked_ = false;
  if (dwo() && !parts_.frames->can_rotate()) {
    Unsupported("G254 machine", block_.where(), "G254: this model has no five-axis kinematics");
  }
  return true;
}

// G234 and G254 exclude each other; the tilt axis of the work offset must be 0 with G254 (manual,
// G234 and G254). What the other rotary offsets do then is not settled by the manual.
bool HaasInterpreter::CheckRotationRules() {
  if (!tcp() && !dwo()) return true;
  const char* name = tcp() ? "G234" : "G254";
  if (tcp() && dwo()) {
    const CodeUse* second =
        CodeOf(kGroupLength) != nullptr && tcp_on_ ? CodeOf(kGroupLength) : CodeOf(kGroupDwo);
    log_.Alarm(Rule::kControlAlarm,
               second == nullptr ? block_.where() : block_.WhereOf(*second->word),
               tcp_on_ ? "G234 while G254 is active: cancel it with G255 first"
                       : "G254 while G234 is active");
    return false;
  }
  if (!frame_dirty_ || !parts_.frames->can_rotate()) return true;
  const AxisValues offset = MakeFrame().offset;
  const std::vector<int>& rotary = parts_.machine->five_axis->rotary();
  for (int axis = kA; axis < kNumAxes; ++axis) {
    const double value = offset[static_cast<std::size_t>(axis)];
    if (!axes_.has(axis) || std::abs(value) < kZero) continue;
    const std::string what = HaasRegisters::OffsetName(offset_) + " has " + "XYZABC"[axis] +
                             Short(Degrees(value)) + " with " + name;
    if (dwo() && !rotary.empty() && rotary.front() == axes_.joint(axis)) {
      log_.Alarm(Rule::kControlAlarm, block_.where(), what + ": it must be 0");
      return false;
    }
    Unsupported(what, block_.where(), what + ": the manual does not settle what the control does");
  }
  if (tcp() && g68_) {
    Unsupported("G68 G234", block_.where(), "G68 beside G234 is not settled by the manual");
  }
  return true;
}

Frame HaasInterpreter::MakeFrame() const {
  Frame frame;
  frame.offset = parts_.registers->WorkOffset(offset_);
  bool shifted = false;
  for (std::size_t axis = 0; axis < kNumAxes; ++axis) {
    const double shift = parts_.registers->g52[axis] + parts_.registers->g92[axis];
    frame.offset[axis] += shift;
    shifted = shifted || shift != 0.0;
  }
  frame.offset_index = parts_.part_frames->Index(
      HaasRegisters::OffsetName(offset_) + (shifted ? " shifted" : ""), frame.offset);
  const double length = parts_.registers->Tool(ToolRegister::kLength, h_) +
                        parts_.registers->Tool(ToolRegister::kLengthWear, h_);
  if (!IsSet(kGroupLength, 49)) frame.tool_length = IsSet(kGroupLength, 44) ? -length : length;
  if (parts_.frames->can_rotate()) {
    if (tcp()) frame.rotation = Frame::Rotation::kTcp;
    if (dwo()) frame.rotation = Frame::Rotation::kDwo;
  }
  if (g68_) frame.program = TurnInPlane();
  return frame;
}

// G68: the plane's two coordinates turn about the centre.
ProgramFrame HaasInterpreter::TurnInPlane() const {
  const PlaneAxes plane = AxesOf(g68_plane_);
  ProgramFrame turn;
  turn.active = true;
  const double cosine = std::cos(g68_angle_), sine = std::sin(g68_angle_);
  turn.linear(plane.first, plane.first) = turn.linear(plane.second, plane.second) = cosine;
  turn.linear(plane.first, plane.second) = -sine;
  turn.linear(plane.second, plane.first) = sine;
  turn.from[plane.first] = g68_centre_[0];
  turn.from[plane.second] = g68_centre_[1];
  turn.to = turn.from;
  return turn;
}

// A new frame moves nothing: the programmed position is worked out anew from where the machine
// stands. When G234 comes on, it is the plain readout (no turning) that the control takes over:
// Haas' TCPC sample (manual, G234) names Z alone on the G234 block, and X and Y keep their numbers.
void HaasInterpreter::RefreshFrame(bool tcp_on) {
  const AxisValues machine = MachinePosition(true);
  Frame frame = MakeFrame();
  if (tcp_on) {
    Frame plain = frame;
    plain.rotation = Frame::Rotation::kNone;
    position_ = parts_.frames->ToProgram(std::make_shared<const Frame>(plain), machine);
  }
  frame_ = std::make_shared<const Frame>(frame);
  if (frame.offset_index >= kMaxPartFrames) {
    log_.Alarm(Rule::kUnsupportedCode, block_.where(),
               "too many different work offsets in one run");
  }
  if (!tcp_on) position_ = parts_.frames->ToProgram(frame_, machine);
  contour_.SetPosition(position_);
  frame_dirty_ = false;
  offset_checked_ = false;
}

// G68 X Y R, G69. The values of the block itself are not rotated; the centre defaults to the
// position, the angle to setting 72 (manual, G68).
bool HaasInterpreter::ExecuteRotation() {
  const CodeUse* use = CodeOf(kGroupRotation);
  if (use == nullptr) return true;
  codes_[kGroupRotation] = use->spec->number_x10;
  if (IsSet(kGroupRotation, 69)) {
    if (g68_) {
      g68_ = false;
      RefreshFrame(false);
      UpdatePrototype();
    }
    return true;
  }
  const PlaneAxes plane = AxesOf(plane_);
  const int axes[2] = {plane.first, plane.second};
  const unsigned words = block_.AxisWords();
  for (int i = 0; i < 2; ++i) {
    const double here = position_[static_cast<std::size_t>(axes[i])];
    const bool named = (words & 1U << axes[i]) != 0;
    g68_centre_[i] = named ? block_.Axis(axes[i]) + (incremental() ? here : 0.0) : here;
  }
  const double angle = block_.Has('R') ? block_.Angle('R') : settings_.g68_angle;
  const bool adds = g68_ && incremental() && settings_.g68_incremental;
  g68_angle_ = adds ? g68_angle_ + angle : angle;
  g68_ = true;
  g68_plane_ = plane_;
  if (tcp()) {
    Unsupported("G68 G234", block_.where(), "G68 beside G234 is not settled by the manual");
  }
  RefreshFrame(false);
  UpdatePrototype();
  return true;
}

// G52 adds its values to every work offset (manual, G52).
bool HaasInterpreter::SetShift() {
  const unsigned words = block_.AxisWords();
  for (int axis = kX; axis < kNumAxes; ++axis) {
    if ((words & 1U << axis) == 0 || !axes_.has(axis)) continue;
    parts_.registers->g52[static_cast<std::size_t>(axis)] = block_.Axis(axis);
  }
  RegistersChanged();
  return true;
}

// G92 shifts every work offset so that the position reads the given values, and ends G52 for those
// axes (manual, G92).
bool HaasInterpreter::SetG92() {
  const AxisValues machine = MachinePosition(true);
  const unsigned words = block_.AxisWords();
  if (tcp() || dwo() || g68_) {
    Unsupported("G92 in a turned frame", block_.where(),
                "G92 while G68, G234 or G254 is active is not settled by the manual");
  }
  const AxisValues offset = parts_.registers->WorkOffset(offset_);
  for (int axis = kX; axis < kNumAxes; ++axis) {
    if ((words & 1U << axis) == 0 || !axes_.has(axis)) continue;
    const std::size_t i = static_cast<std::size_t>(axis);
    const double length = axis == kZ ? frame_->tool_length : 0.0;
    parts_.registers->g52[i] = 0.0;
    parts_.registers->g92[i] = machine[i] - offset[i] - length - block_.Axis(axis);
  }
  RegistersChanged();
  return true;
}

// G10 L2 P0-6, L20 P1-99, L1 L10-L13 P1-200 R. G91 adds (manual, G10).
bool HaasInterpreter::SetOffsets() {
  if (!block_.Has('L') || !block_.Has('P')) {
    Alarm('G', "G10 needs L and P");
    return false;
  }
  const std::optional<int> l = block_.Integer('L', 1, 20);
  if (!l) return false;
  if (*l != 2 && *l != 20) return SetToolRegister(*l);
  const std::optional<int> p = *l == 2 ? block_.Integer('P', 0, 6) : block_.Integer('P', 1, 99);
  if (!p) return false;
  const int index = *l == 2 ? *p - 1 : kFirstG154 + *p;
  const unsigned words = block_.AxisWords();
  for (int axis = kX; axis < kNumAxes; ++axis) {
    if ((words & 1U << axis) == 0 || !axes_.has(axis)) continue;
    const std::size_t i = static_cast<std::size_t>(axis);
    const double value = block_.Axis(axis);
    if (*l == 2 && *p == 0) {
      parts_.registers->g52[i] = value + (incremental() ? parts_.registers->g52[i] : 0.0);
      continue;
    }
    const double before = incremental() ? parts_.registers->WorkOffset(index)[i] : 0.0;
    if (!incremental() || parts_.registers->IsStated(index)) {
      parts_.registers->SetWorkOffset(index, axis, before + value);
    } else {
      Unsupported(
          "G10 G91", block_.where(),
          "G10 in G91 adds to " + HaasRegisters::OffsetName(index) + ", which nobody has stated");
    }
  }
  RegistersChanged();
  return true;
}

bool HaasInterpreter::SetToolRegister(int l) {
  ToolRegister which = ToolRegister::kLength;
  switch (l) {
    case 10:
      break;
    case 1:
    case 11:
      which = ToolRegister::kLengthWear;
      break;
    case 12:
      which = ToolRegister::kDiameter;
      break;
    case 13:
      which = ToolRegister::kDiameterWear;
      break;
    default:
      Alarm('L', "G10 has no L" + std::to_string(l));
      return false;
  }
  const std::optional<int> p = block_.Integer('P', 1, kMaxToolOffset);
  if (!p) return false;
  if (!block_.Has('R')) {
    Alarm('G', "G10 L" + std::to_string(l) + " needs R");
    return false;
  }
  const double value = block_.Length('R');
  parts_.registers->SetTool(which, *p,
                            value + (incremental() ? parts_.registers->Tool(which, *p) : 0.0));
  RegistersChanged();
  return true;
}

// Before the first motion of X, Y or Z in a frame: is its offset known, and does its length
// describe the metal? The length matters where Z moves, or all linear axes together.
void HaasInterpreter::BeforeLinearMotion(bool uses_length) {
  if (!offset_checked_) {
    offset_checked_ = true;
    if (!parts_.registers->IsStated(offset_)) {
      const std::string name = HaasRegisters::OffsetName(offset_);
      const AxisValues w = parts_.registers->WorkOffset(offset_);
      log_.Assume("offset " + name,
                  "the job does not state " + name + ": X" + Fixed(w[kX], 3) + " Y" +
                      Fixed(w[kY], 3) + " Z" + Fixed(w[kZ], 3) + ", the middle of the table",
                  true);
    }
  }
  if (uses_length && !length_checked_) CheckToolLength();
}

void HaasInterpreter::CheckToolLength() {
  length_checked_ = true;
  if (IsSet(kGroupLength, 49)) return;
  const double length = frame_->tool_length;
  const std::string h = "H" + std::to_string(h_);
  if (length < 0.0) {
    if (frame_->rotation == Frame::Rotation::kNone) return;  // Touched off on the machine.
    log_.ReportOnce("touched off " + h, Rule::kToolLength, block_.where(),
                    h + " is " + Fixed(length, 3) + " mm: " + (tcp() ? "G234" : "G254") +
                        " needs the length from the gauge line, not a touched-off one");
    return;
  }
  const machine::Tool* tool = parts_.tools->Find(tool_);
  if (tool == nullptr || std::abs(length - tool->length) <= kLengthTolerance) return;
  Finding finding = MakeFinding(Rule::kToolLength, block_.where(),
                                h + " is " + Fixed(length, 3) + " mm, T" + std::to_string(tool_) +
                                    " in the spindle is " + Fixed(tool->length, 3) +
                                    " mm from gauge line to tip");
  if (length > 0.0) finding.severity = Severity::kWarning;
  log_.ReportOnce("length " + h + " T" + std::to_string(tool_), std::move(finding));
}

}  // namespace ncsim::control
