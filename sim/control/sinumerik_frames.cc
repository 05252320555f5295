// SPDX-License-Identifier: BSD-3-Clause
// Settable and programmable frames, TRAORI and TRAFOOF: all that makes the frame of a command (NC
// programming 12/2019, "Coordinate transformations (frames)").
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <utility>

#include "sim/base/text.h"
#include "sim/base/units.h"
#include "sim/control/arc.h"
#include "sim/control/limits.h"
#include "sim/control/sinumerik_interpreter.h"

namespace ncsim::control {
namespace {

bool IsIdentity(const Eigen::Matrix3d& linear) {
  return (linear - Eigen::Matrix3d::Identity()).isZero(0.0);
}

}  // namespace

void SinumerikInterpreter::SelectOffset(int index) {
  modal_.offset = std::max(0, index);
  modal_.settable = parts_.registers->frame(modal_.offset);
  cancelled_.clear();
  new_frame_ = true;
  frame_dirty_ = true;
}

/// $P_PFRAME = ...: at once.
void SinumerikInterpreter::SetProgramFrame(const AffineFrame& frame) {
  modal_.program = frame;
  new_frame_ = frame_dirty_ = true;
}

/// $P_IFRAME = ...: likewise, without a change of what $P_UIFR keeps.
void SinumerikInterpreter::SetActiveSettable(const SettableFrame& frame) {
  modal_.settable = frame;
  cancelled_.clear();
  new_frame_ = frame_dirty_ = true;
}

/// TRAORI and TRAFOOF move nothing; the frame goes by MD10602, the tool length is taken over.
void SinumerikInterpreter::CancelFrame(bool traori, const SourcePosition& where) {
  if (traori && !parts_.frames->can_rotate()) {
    Unsupported("TRAORI", where, "this model has no five-axis kinematics");
    return;
  }
  if (!Is(kSinComp, "G40")) {
    Unsupported("TRAORI or TRAFOOF under G41 or G42", where);
  }
  if (tool_frame()) Unsupported("TRAORI or TRAFOOF under TOROT", where);
  if (swivel_.active) Unsupported("TRAORI while CYCLE800 is active", where);
  swivel_ = {};
  std::string cancelled;
  const bool plain = modal_.program.is_zero();
  if (modal_.offset != 0) cancelled = SinumerikRegisters::FrameName(modal_.offset);
  if (!plain) cancelled += cancelled.empty() ? "the programmable frame" : " and its TRANS, ROT ...";
  if (settings_.frame_keeps_translations) {
    modal_.settable.turn = {};
    modal_.settable.scale = {1.0, 1.0, 1.0};
    modal_.settable.mirror = {};
    modal_.program.linear.setIdentity();
  } else if (!settings_.frame_stays) {
    modal_.codes[kSinOffset] = nc::FindSinumerikCommand("G500");
    SelectOffset(0);
    modal_.program = {};
    cancelled_ = std::move(cancelled);
  }
  traori_ = traori;
  carry_ = {};
  length_checked_ = false;
  // The numbers of the old coordinate system mean nothing in the new one.
  new_frame_ = new_length_ = false;
  frame_dirty_ = true;
}

Frame SinumerikInterpreter::MakeFrame() const {
  const AffineFrame& program = modal_.program;
  const Eigen::Matrix3d settable = modal_.settable.Linear();
  Frame frame;
  frame.offset = modal_.settable.shift();
  frame.offset_index =
      parts_.part_frames->Index(SinumerikRegisters::FrameName(modal_.offset), frame.offset);
  for (std::size_t i = 0; i < 3; ++i) frame.offset[kA + i] += program.rotary[i];
  const Eigen::Matrix3d inner = swivel_.plane.rotation * modal_.tool_turn;
  frame.program.linear = settable * inner * program.linear;
  frame.program.to = settable * (swivel_.plane.origin + inner * program.shift);
  if (swivel_.active) {
    const ProgramFrame turned = parts_.frames->OnTable(frame.offset, swivel_.tables);
    frame.program.to = turned.to + turned.linear * frame.program.to;
    frame.program.linear = turned.linear * frame.program.linear;
  }
  frame.program.active = !IsIdentity(frame.program.linear) || !frame.program.to.isZero(0.0);
  ApplyLength(&frame, active_.length);
  if (traori_) frame.rotation = Frame::Rotation::kTcp;
  return frame;
}

/// G53, G153, SUPA: no settable, no programmable frame; the tool length by MD10760.
Frame SinumerikInterpreter::SuppressedFrame() const {
  Frame frame;
  frame.offset_index = parts_.part_frames->Index(SinumerikRegisters::FrameName(0), frame.offset);
  const bool without_length = (settings_.suppress_length & 1) != 0 &&
                              ((settings_.suppress_length & 2) == 0 || !edge_in_block_);
  ApplyLength(&frame, without_length ? 0.0 : active_.length);
  if (traori_) frame.rotation = Frame::Rotation::kTcp;
  return frame;
}

/// Moves nothing: the programmed position is worked out anew from where the machine stands.
void SinumerikInterpreter::UseFrame(const Frame& frame) {
  const AxisValues machine = MachinePosition();
  frame_ = std::make_shared<const Frame>(frame);
  position_ = parts_.frames->ToProgram(frame_, machine);
  contour_.SetPosition(position_);
}

/// With SD42440 and SD42442 an incremental move starts from the numbers that held before, so that
/// it goes the shift as well.
void SinumerikInterpreter::RefreshFrame() {
  const AxisValues before = position_;
  const Eigen::Matrix3d linear = frame_->program.linear;
  UseFrame(MakeFrame());
  const bool turned = linear != frame_->program.linear;
  const bool carries = (new_frame_ && settings_.incremental_frame) ||
                       (new_length_ && !new_frame_ && settings_.incremental_tool);
  for (std::size_t axis = 0; axis < kNumAxes && carries; ++axis) {
    carry_[axis] += before[axis] - position_[axis];
    carry_turned_[axis] = carry_turned_[axis] || turned;
  }
  if (swivel_.active && !IsIdentity(modal_.settable.Linear())) {
    Unsupported("a turned work offset while CYCLE800 is active", step_->where);
  }
  if (frame_->offset_index >= kMaxPartFrames) {
    log_.Alarm(Rule::kUnsupportedCode, step_->where, "too many different work offsets in one run");
  }
  if (traori_ && frame_->program.linear.determinant() < 0.0) {
    Unsupported("mirroring under TRAORI", step_->where);
  }
  if (new_frame_) offset_checked_ = false;
  frame_dirty_ = new_frame_ = new_length_ = false;
}

/// TOROT, TOROTZ: Z along the tool, about the zero of the settable frame. Where X and Y then point
/// is another matter (SD42980), and asked for where they are programmed.
void SinumerikInterpreter::TurnToTool() {
  tool_frame_due_ = false;
  if (Is(kSinToolFrame, "TOROTOF")) {
    modal_.tool_turn.setIdentity();
  } else if (!traori_) {
    return Unsupported("TOROT without TRAORI", step_->where);
  } else {
    AxisValues machine = position_;
    for (std::size_t i = kA; i < kNumAxes; ++i) machine[i] += frame_->offset[i];
    Eigen::Vector3d p_B, u_B;
    parts_.frames->five_axis().TipInTable(axes_.Joints(machine), 0.0, &p_B, &u_B);
    const Eigen::Vector3d u = parts_.frames->InTable(frame_).inverse * u_B;
    const Eigen::Vector3d in_settable = modal_.tool_turn * modal_.program.linear * u;
    modal_.tool_turn =
        Eigen::Quaterniond::FromTwoVectors(Eigen::Vector3d::UnitZ(), in_settable.normalized())
            .toRotationMatrix();
  }
  RefreshFrame();
}

/// TRANS, ROT, SCALE, MIRROR delete what was programmed before; the A forms add to it.
void SinumerikInterpreter::ExecuteFrameStatement(const SinumerikItem& item) {
  std::string_view name = item.command->name;
  const bool replaces = name == "G58" || name == "G59";
  if (name[0] == 'G' && !replaces) return SetPole(name);
  const bool adds = name[0] == 'A';
  if (adds) name.remove_prefix(1);
  if (!adds && !replaces) {
    if (name == "TRANS") CheckFine(Where(item));
    modal_.program = {};
  }
  if (name == "TRANS") Translate(adds);
  if (replaces) ReplaceShift(name == "G59", Where(item));
  if (name == "ROT") Rotate(Where(item));
  if (name == "ROTS") RotateBySolidAngles(Where(item));
  if (name == "SCALE") Scale();
  if (name == "MIRROR") Mirror();
  if (log_.stopped()) return;
  new_frame_ = frame_dirty_ = true;
  RefreshFrame();
}

/// TRANS X..: where the control keeps fine shifts apart, does it leave them?
void SinumerikInterpreter::CheckFine(const SourcePosition& where) {
  if (modal_.program.fine == AxisValues{}) return;
  bool named = false;
  for (std::size_t i = 0; i < kNumAxes; ++i) named |= Peek(kLetters.substr(i, 1)) != nullptr;
  if (!named) return;
  fine_dropped_ = true;
  if (replaces_shift_ || settings_.fine_shift == true) {
    Unsupported("TRANS behind ATRANS or G59 with MD24000 = 1", where,
                "whether it deletes their shift is not clear; TRANS alone does");
  }
}

/// G58 replaces what TRANS has shifted the named axes by, G59 what ATRANS has.
void SinumerikInterpreter::ReplaceShift(bool fine, const SourcePosition& where) {
  if (settings_.fine_shift == false) {
    return Unsupported("G58 or G59 with MD24000 = 0", where, "the control does not have it then");
  }
  if (!settings_.fine_shift) {
    log_.Assume("MD24000", "1: the control has G58 and G59, and keeps the shift of ATRANS apart",
                false);
  }
  if (fine_dropped_) {
    Unsupported("G58 or G59 behind TRANS behind ATRANS", where,
                "whether TRANS has deleted the shift of ATRANS is not clear");
  }
  replaces_shift_ = true;
  AffineFrame& program = modal_.program;
  for (std::size_t i = 0; i < kNumAxes; ++i) {
    const std::string_view letter = kLetters.substr(i, 1);
    if (Peek(letter) == nullptr || !axes_.has(static_cast<int>(i))) continue;
    const SinumerikItem* word = Take(letter);
    if (word == nullptr) return;
    const double value = i < kA ? word->value * mm_ : Radians(word->value);
    double& whole = i < kA ? program.shift[static_cast<int>(i)] : program.rotary[i - kA];
    const double coarse = fine ? whole - program.fine[i] : value;
    if (fine) program.fine[i] = value;
    whole = coarse + program.fine[i];
  }
}

void SinumerikInterpreter::Translate(bool adds) {
  const AffineFrame before = modal_.program;
  Eigen::Vector3d shift = Eigen::Vector3d::Zero();
  for (std::size_t i = 0; i < kNumAxes; ++i) {
    const std::string_view letter = kLetters.substr(i, 1);
    if (Peek(letter) == nullptr || !axes_.has(static_cast<int>(i))) continue;
    const SinumerikItem* word = Take(letter);
    if (word == nullptr) return;
    if (i < kA) {
      shift[static_cast<int>(i)] = word->value * mm_;
    } else {
      modal_.program.rotary[i - kA] += Radians(word->value);
    }
  }
  modal_.program.shift += modal_.program.linear * shift;
  if (!adds || settings_.fine_shift == false) return;
  for (std::size_t i = 0; i < 3; ++i) {
    const int axis = static_cast<int>(i);
    modal_.program.fine[i] += modal_.program.shift[axis] - before.shift[axis];
    modal_.program.fine[i + kA] += modal_.program.rotary[i] - before.rotary[i];
  }
}

/// ROTS X Y, Z X or Y Z: an oblique plane by the lines in which it cuts the planes; one angle alone
/// is that of ROT.
void SinumerikInterpreter::RotateBySolidAngles(const SourcePosition& where) {
  std::array<double, 3> angles{};
  std::array<bool, 3> given{};
  for (std::size_t i = 0; i < 3; ++i) {
    given[i] = Peek(kLetters.substr(i, 1)) != nullptr;
    if (!given[i]) continue;
    const SinumerikItem* word = Take(kLetters.substr(i, 1));
    if (word == nullptr) return;
    angles[i] = Radians(word->value);
  }
  const auto count = std::count(given.begin(), given.end(), true);
  const std::optional<Eigen::Matrix3d> turn =
      count < 2 ? SinumerikRotation(angles) : SolidAngleRotation(angles, given);
  if (!turn) return Unsupported("ROTS with three angles, or one of 90 degrees or more", where);
  modal_.program.linear = modal_.program.linear * *turn;
}

void SinumerikInterpreter::Rotate(const SourcePosition& where) {
  std::array<double, 3> angles{};
  int given = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    if (Peek(kLetters.substr(i, 1)) == nullptr) continue;
    const SinumerikItem* word = Take(kLetters.substr(i, 1));
    if (word == nullptr) return;
    angles[i] = Radians(word->value);
    if (word->value != 0.0) ++given;
  }
  if (Peek("RPL") != nullptr) {
    const SinumerikItem* word = Take("RPL");
    if (word == nullptr) return;
    angles[static_cast<std::size_t>(AxesOf(plane_).normal)] = Radians(word->value);
    ++given;
  }
  if (given > 1 && !settings_.rpy) {
    Unsupported("ROT with more than one angle and MD10600 = 2", where);
  }
  modal_.program.linear = modal_.program.linear * SinumerikRotation(angles);
}

void SinumerikInterpreter::Scale() {
  for (int i = 0; i < 3; ++i) {
    const std::string_view letter = kLetters.substr(static_cast<std::size_t>(i), 1);
    if (Peek(letter) == nullptr) continue;
    const SinumerikItem* word = Take(letter);
    if (word == nullptr) return;
    if (!(word->value > 0.0)) {
      Alarm(Where(*word), 12160, "SCALE needs a factor above 0");
      return;
    }
    modal_.program.linear.col(i) *= word->value;
  }
}

/// The value of the word means nothing.
void SinumerikInterpreter::Mirror() {
  for (int i = 0; i < 3; ++i) {
    const std::string_view letter = kLetters.substr(static_cast<std::size_t>(i), 1);
    if (Peek(letter) != nullptr && Take(letter) != nullptr) modal_.program.linear.col(i) *= -1.0;
  }
}

/// G110, G111, G112: the pole of AP and RP, from the position, the zero, the last pole.
void SinumerikInterpreter::SetPole(std::string_view name) {
  const PlaneAxes plane = AxesOf(plane_);
  const int axes[2] = {plane.first, plane.second};
  Eigen::Vector2d from = Eigen::Vector2d::Zero();
  if (name == "G110") {
    from = {position_[static_cast<std::size_t>(axes[0])],
            position_[static_cast<std::size_t>(axes[1])]};
  }
  if (name == "G112") from = pole_;
  if (Peek("RP") != nullptr && Peek("AP") != nullptr) {
    const SinumerikItem* radius = Take("RP");
    const SinumerikItem* angle = Take("AP");
    if (radius == nullptr || angle == nullptr) return;
    const double a = Radians(angle->value);
    pole_ = from + radius->value * mm_ * Eigen::Vector2d(std::cos(a), std::sin(a));
    return;
  }
  pole_ = from;
  for (int i = 0; i < 2; ++i) {
    const std::string_view letter = kLetters.substr(static_cast<std::size_t>(axes[i]), 1);
    if (Peek(letter) == nullptr) continue;
    const SinumerikItem* word = Take(letter);
    if (word != nullptr) pole_[i] += word->value * mm_;
  }
}

/// Before a motion of X, Y or Z that frames act on: is the offset known, and still there?
void SinumerikInterpreter::BeforeLinearMotion() {
  if (suppress_ != nullptr) return;
  if (!cancelled_.empty()) {
    log_.Alarm(Rule::kFrameCancelled, step_->where,
               std::string(traori_ ? "TRAORI" : "TRAFOOF") + " has cancelled " + cancelled_ +
                   " (MD10602), and nothing was selected since: X Y Z would be machine "
                   "coordinates; the program was not followed any further");
    return;
  }
  if (!offset_checked_) {
    offset_checked_ = true;
    if (!modal_.settable.stated) {
      const std::string name = SinumerikRegisters::FrameName(modal_.offset);
      const AxisValues w = modal_.settable.shift();
      log_.Assume("offset " + name,
                  "the job does not state " + name + ": X" + Fixed(w[kX], 3) + " Y" +
                      Fixed(w[kY], 3) + " Z" + Fixed(w[kZ], 3) + ", the middle of the table",
                  true);
    }
  }
  if (!length_checked_) CheckToolLength();
}

}  // namespace ncsim::control
