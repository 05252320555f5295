// SPDX-License-Identifier: BSD-3-Clause
#include "post/writer.h"

#include <cmath>
#include <utility>

#include "sim/base/text.h"
#include "sim/base/units.h"

namespace ncsim::post {
namespace {

constexpr std::array<Value, 6> kWordValues = {Value::kWord1, Value::kWord2, Value::kWord3,
                                              Value::kWord4, Value::kWord5, Value::kWord6};

std::string_view KeyOf(cl::Coolant::Mode mode) {
  switch (mode) {
    case cl::Coolant::Mode::kOff:
      return "off";
    case cl::Coolant::Mode::kOn:
      return "on";
    case cl::Coolant::Mode::kFlood:
      return "flood";
    case cl::Coolant::Mode::kMist:
      return "mist";
    case cl::Coolant::Mode::kTap:
      return "tap";
    case cl::Coolant::Mode::kThrough:
      return "through";
    case cl::Coolant::Mode::kAir:
      return "air";
  }
  return "";
}

/// G04 P1., M08, G0X1.Y-2: letters with a number each.
bool AreWords(std::string_view text) {
  std::size_t i = 0;
  while (i < text.size()) {
    if (text[i] == ' ') {
      ++i;
      continue;
    }
    if (text[i] < 'A' || text[i] > 'Z') return false;
    ++i;
    if (i < text.size() && (text[i] == '-' || text[i] == '+')) ++i;
    const std::size_t begin = i;
    while (i < text.size() && ((text[i] >= '0' && text[i] <= '9') || text[i] == '.')) ++i;
    if (i == begin) return false;
  }
  return !text.empty();
}

}  // namespace

NcWriter::NcWriter(const PostData& data, ProgramInfo info, Diagnostics* diagnostics,
                   std::ostream* main, OpenFile open_operation)
    : data_(data),
      info_(std::move(info)),
      diagnostics_(diagnostics),
      main_(main),
      open_operation_(std::move(open_operation)),
      printer_(data),
      output_(data.numbers) {
  output_.To(main);
}

void NcWriter::OnStep(const PlanStep& step) {
  where_ = step.where;
  if (step.modal != modal_) {
    modal_ = step.modal;
    TakeModal(*modal_);
  }
  if (!started_) Start();
  std::visit([this](const auto& what) { Handle(what); }, step.what);
}

bool NcWriter::Emit(Block block, BlockPrinter::Counts counts) {
  const BlockTemplate* found = data_.Find(block, mode_);
  return found != nullptr && EmitTemplate(*found, counts);
}

bool NcWriter::EmitTemplate(const BlockTemplate& block, BlockPrinter::Counts counts) {
  std::vector<std::string> problems;
  const std::vector<std::string> lines = printer_.Print(block, values_, wanted_, counts, &problems);
  for (const std::string& line : lines) output_.Write(line);
  for (const std::string& problem : problems) Problem(problem);
  return !lines.empty();
}

void NcWriter::Want(Group group, std::string_view key) {
  const auto g = static_cast<std::size_t>(group);
  const GroupInfo& info = GroupTable()[g];
  for (std::size_t k = 0; k < info.keys.size(); ++k) {
    if (info.keys[k] != key) continue;
    if (data_.codes[g][k]) {
      wanted_[g] = &*data_.codes[g][k];
      return;
    }
  }
  Problem("the post has no code for " + std::string(info.name) + " " + std::string(key) +
          " (codes." + std::string(info.name) + ")");
}

void NcWriter::Problem(const std::string& message) {
  if (!reported_.insert(message).second) return;
  diagnostics_->Error(info_.source, where_.line, where_.column, message);
}

void NcWriter::TakeTool(const ClTool& tool) {
  const double unit = data_.unit_mm();
  const auto length = [&](const std::optional<double>& mm) -> std::optional<double> {
    if (!mm) return std::nullopt;
    return *mm / unit;
  };
  const auto count = [](const std::optional<int>& n) -> std::optional<double> {
    if (!n) return std::nullopt;
    return static_cast<double>(*n);
  };
  values_.Set(Value::kToolNumber, count(tool.number));
  values_.Set(Value::kToolName, tool.name);
  values_.Set(Value::kToolKind, tool.kind);
  values_.Set(Value::kToolDiameter, length(tool.diameter));
  values_.Set(Value::kToolCornerRadius, length(tool.corner_radius));
  values_.Set(Value::kToolLength, length(tool.length));
  // ADJUST 0 and none: the tool's own register.
  const bool stated = tool.length_register.value_or(0) > 0;
  values_.Set(Value::kToolRegister, count(stated ? tool.length_register : tool.number));
}

void NcWriter::TakeSpindle(const cl::Spindle& spindle) {
  using Mode = cl::Spindle::Mode;
  values_.Clear(Value::kSpeed);
  values_.Clear(Value::kSpindleAngle);
  switch (spindle.mode) {
    case Mode::kOff:
      Want(Group::kSpindle, "off");
      return;
    case Mode::kLocked:
      values_.Set(Value::kSpindleAngle, spindle.speed);
      Want(Group::kSpindle, "locked");
      return;
    case Mode::kSurface:
      Problem("a constant surface speed has no words in the post");
      return;
    case Mode::kOn:
    case Mode::kRpm:
      values_.Set(Value::kSpeed, spindle.speed);
      Want(Group::kSpindle, spindle.clockwise.value_or(true) ? "clockwise" : "counter_clockwise");
      return;
  }
}

void NcWriter::TakeModal(const ClModal& modal) {
  TakeTool(*modal.tool);
  values_.Set(Value::kOperationNumber, static_cast<double>(modal.operation->index));
  values_.Set(Value::kOperationName, modal.operation->name);
  TakeSpindle(modal.spindle);
  Want(Group::kCoolant, KeyOf(modal.coolant.mode));
  const cl::CutterComp& comp = modal.comp;
  using Side = cl::CutterComp::Side;
  values_.Clear(Value::kCompRegister);
  if (comp.side == Side::kOff) {
    const auto& off = data_.codes[static_cast<std::size_t>(Group::kComp)].front();
    wanted_[static_cast<std::size_t>(Group::kComp)] = off ? &*off : nullptr;
  } else {
    const std::optional<int> number =
        comp.diameter_register.value_or(0) > 0 ? comp.diameter_register : modal.tool->number;
    if (number) values_.Set(Value::kCompRegister, static_cast<double>(*number));
    if (comp.side == Side::kOn) {
      Problem("CUTCOM/ON does not say which side");
    } else {
      Want(Group::kComp, comp.side == Side::kLeft ? "left" : "right");
    }
  }
}

void NcWriter::Start() {
  started_ = true;
  values_.Set(Value::kProgramName, info_.name);
  if (info_.number) values_.Set(Value::kProgramNumber, static_cast<double>(*info_.number));
  // Without its folder: the same file gives the same program anywhere.
  values_.Set(Value::kProgramSource, info_.source.substr(info_.source.find_last_of("/\\") + 1));
  values_.Set(Value::kProgramMode, info_.mode);
  Want(Group::kUnit, data_.unit == ClUnit::kInch ? "inch" : "mm");
  Emit(Block::kProgramStart);
  WriteToolTable();
  printer_.SwitchedOff();
}

void NcWriter::WriteToolTable() {
  if (info_.tools.empty()) return;
  Emit(Block::kToolTableHead);
  for (const ToolUse& use : info_.tools) {
    TakeTool(use.tool);
    if (use.compensated) values_.Set(Value::kToolCompensation, "WEAR");
    Emit(Block::kToolTableRow);
    values_.Clear(Value::kToolCompensation);
  }
  if (modal_) TakeTool(*modal_->tool);
  Emit(Block::kToolTableFoot);
}

void NcWriter::BeginFile() {
  const std::string name =
      info_.name + "_" + Fixed(values_.number(Value::kOperationNumber).value_or(0.0), 0);
  values_.Set(Value::kOperationFile, name);
  if (!Emit(Block::kCallOperation)) {
    Problem("the post writes one file: it has no block 'call_operation'");
    return;
  }
  main_number_ = output_.next_number();
  std::ostream* file = open_operation_(name + data_.extension);
  if (file == nullptr) {
    Problem("cannot write " + name + data_.extension);
    return;
  }
  in_file_ = true;
  output_.To(file);
  printer_.ForgetAll();
  printer_.SwitchedOff();
  Emit(Block::kFileStart);
}

void NcWriter::EndFile() {
  if (!in_file_) return;
  Emit(Block::kFileEnd);
  in_file_ = false;
  output_.Resume(main_, main_number_);
}

void NcWriter::Leave() {
  EndCycle();
  if (!positioned_) return;
  Emit(Block::kLeave);
  printer_.ForgetPositions();
  positioned_ = false;
}

void NcWriter::Handle(const PlanOperation& operation) {
  EndCycle();
  const PostMode* mode = data_.Mode(operation.mode, info_.mode);
  if (mode == nullptr) Problem("the post has no mode of the kind that this operation needs");
  // Else it goes on where the last one has left the tool.
  const bool anew = operation.tool_change || mode != mode_ || !positioned_ || open_operation_;
  if (anew) {
    Leave();
    EndFile();
    printer_.ForgetAll();
    mode_ = mode;
    if (open_operation_) BeginFile();
  }
  Emit(Block::kOperationStart);
  if (anew) Emit(Block::kSafeStart);
  if (!operation.tool_change) return;
  if (!values_.number(Value::kToolNumber)) Problem("a tool change without a tool number");
  values_.Clear(Value::kNextTool);
  if (operation.next_tool) {
    values_.Set(Value::kNextTool, static_cast<double>(*operation.next_tool));
  }
  Emit(Block::kToolChange);
  printer_.ForgetPositions();
  printer_.ForgetFeeds();
  printer_.SwitchedOff();
}

void NcWriter::Handle(const ClOperationEnd&) {
  EndCycle();
  Emit(Block::kOperationEnd);
}

void NcWriter::SetPlaneAngles(const Eigen::Matrix3d& plane_P) {
  const Eigen::Matrix3d& r = plane_P;
  constexpr double kGimbal = 1e-9;
  // R = Rx Ry Rz: CYCLE800, axis by axis in the order X, Y, Z.
  double cosine = std::hypot(r(0, 0), r(0, 1));
  values_.Set(Value::kPlaneXyzY, Degrees(std::atan2(r(0, 2), cosine)));
  const bool xyz = cosine > kGimbal;
  values_.Set(Value::kPlaneXyzX,
              Degrees(xyz ? std::atan2(-r(1, 2), r(2, 2)) : std::atan2(r(2, 1), r(1, 1))));
  values_.Set(Value::kPlaneXyzZ, xyz ? Degrees(std::atan2(-r(0, 1), r(0, 0))) : 0.0);
  // R = Rz Ry Rx: ROT with RPY angles.
  cosine = std::hypot(r(0, 0), r(1, 0));
  values_.Set(Value::kPlaneZyxY, Degrees(std::atan2(-r(2, 0), cosine)));
  const bool zyx = cosine > kGimbal;
  values_.Set(Value::kPlaneZyxX,
              Degrees(zyx ? std::atan2(r(2, 1), r(2, 2)) : std::atan2(-r(1, 2), r(1, 1))));
  values_.Set(Value::kPlaneZyxZ, zyx ? Degrees(std::atan2(r(1, 0), r(0, 0))) : 0.0);
}

void NcWriter::Handle(const PlanIndex& index) {
  const bool rewind = index.why == PlanIndex::Why::kRewind;
  if (rewind) {
    EndCycle();
    if (mode_ == nullptr || data_.Find(Block::kRewind, mode_) == nullptr) {
      Problem("the post has no block 'rewind'");
      return;
    }
  } else {
    Leave();
    mode_ = data_.Mode(index.mode, info_.mode);
    if (mode_ == nullptr) {
      Problem("the post has no mode of the kind that this motion needs");
      return;
    }
  }
  const bool turns = Degrees(std::hypot(index.rotary[0], index.rotary[1])) > 1e-9;
  if (turns && mode_->frame == PostMode::Frame::kFixed && mode_->kind == PlanMode::kIndexed) {
    Problem("mode '" + mode_->name + "' turns no rotary axis, and the tool axis needs it");
  }
  PlanPose pose = index.approach;
  pose.rotary = index.rotary;
  SetPose(pose);
  SetPlaneAngles(index.plane_P);
  values_.Set(Value::kPlaneDirection, index.rotary[0] < 0.0 ? -1.0 : 1.0);
  const Eigen::Vector3d turned = index.plane_P.transpose() * pose.xyz / data_.unit_mm();
  values_.Set(Value::kTurnedX, turned.x());
  values_.Set(Value::kTurnedY, turned.y());
  values_.Set(Value::kTurnedZ, turned.z());
  Want(Group::kMotion, "rapid");
  Want(Group::kPlane, "xy");
  Want(Group::kFeedMode, "per_minute");
  Emit(rewind ? Block::kRewind : Block::kIndex);
  printer_.AxisIs(values_);
  positioned_ = true;
  Arrive(pose);
}

void NcWriter::Handle(const ClHome&) {
  Leave();
  if (!Emit(Block::kHome)) Problem("GOHOME has no words in the post (blocks.home)");
}

void NcWriter::Switch() {
  Emit(Block::kSpindle);
  Emit(Block::kCoolant);
}

// Before the tool is at the part, the blocks that bring it there, or the first motion, switch.
void NcWriter::Handle(const cl::Spindle&) {
  if (positioned_) Switch();
}
void NcWriter::Handle(const cl::Coolant&) {
  if (positioned_) Switch();
}
// With the next motion: TakeModal has it.
void NcWriter::Handle(const cl::CutterComp&) {}

void NcWriter::Handle(const ClDwell& dwell) {
  EndCycle();
  double seconds = dwell.value;
  if (dwell.revolutions) {
    const double speed = values_.number(Value::kSpeed).value_or(0.0);
    if (speed <= 0.0) Problem("a dwell of revolutions, and the spindle stands");
    seconds = speed > 0.0 ? dwell.value * 60.0 / speed : 0.0;
  }
  values_.Set(Value::kDwell, seconds);
  Emit(Block::kDwell);
}

void NcWriter::Handle(const cl::Code& code) {
  EndCycle();
  std::string text = std::string(1, code.letter) + Short(code.number);
  if (code.with_next) {
    printer_.Written(text);
    output_.Prepend(text);
    return;
  }
  values_.Set(Value::kCode, std::move(text));
  if (!Emit(Block::kCode)) Problem("AUXFUN and PREFUN have no words in the post (blocks.code)");
}

void NcWriter::Handle(const cl::Stop& stop) {
  EndCycle();
  Emit(stop.optional_stop ? Block::kOptionalStop : Block::kStop);
  // A stop may switch off spindle and coolant: they are switched on anew before the next motion.
  printer_.SwitchedOff();
}

void NcWriter::Apply(const PostText& text, const std::string& comment) {
  if (text.what == PostText::What::kWords && AreWords(comment)) {
    EndCycle();
    printer_.Written(comment);
    output_.Write(comment);
  } else if (text.what == PostText::What::kComment || text.what == PostText::What::kWords) {
    if (text.what == PostText::What::kWords) {
      diagnostics_->Warning(info_.source, where_.line, where_.column,
                            "'" + comment + "' is no NC words: it is printed as a comment");
    }
    values_.Set(Value::kText, comment);
    Emit(Block::kComment);
  } else if (text.what == PostText::What::kBlock) {
    EndCycle();
    EmitTemplate(text.block, BlockPrinter::Counts::kAnything);
  }
}

void NcWriter::Handle(const cl::Text& text) {
  const auto found = data_.texts.find(text.kind);
  if (found == data_.texts.end()) {
    Problem("'" + text.text + "' has no words in the post (texts)");
    return;
  }
  values_.Set(Value::kText, text.text);
  Apply(found->second, text.text);
}

void NcWriter::Handle(const cl::PostWord& word) {
  const auto found = data_.functions.find(word.major);
  if (found == data_.functions.end()) {
    Problem(word.major + " has no words in the post (functions)");
    return;
  }
  std::string comment = word.major;
  for (std::size_t i = 0; i < kWordValues.size(); ++i) {
    values_.Clear(kWordValues[i]);
    if (i < word.values.size()) values_.Set(kWordValues[i], word.values[i]);
  }
  for (const std::string& value : word.values) comment += " " + value;
  Apply(found->second, comment);
}

void NcWriter::Handle(const PlanEnd&) {
  Leave();
  EndFile();
  Emit(Block::kProgramEnd);
}

}  // namespace ncsim::post
