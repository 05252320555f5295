// SPDX-License-Identifier: BSD-3-Clause
#include "sim/control/sinumerik_interpreter.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "sim/base/text.h"
#include "sim/base/units.h"
#include "sim/nc/sinumerik_token.h"

namespace ncsim::control {
namespace {

using nc::Support;

// mm, deg: what G642 to G645 and the compressors may leave the path by where nobody states it
// (MD33100, standard value).
constexpr double kStandardTolerance = 0.05;
constexpr double kStandardOrientation = Radians(0.05);

ContourOptions CompensationOptions() {
  ContourOptions options;
  options.type_b = false;         // NORM: straight to the point beside the contour's start.
  options.fanuc_corners = false;  // G450: an arc about an outside corner.
  options.long_lead = false;      // NORM asks for no length (W1 09/2011, 18.5.3).
  options.corner_names = {"RND=", "CHR=", "CHF="};
  return options;
}

/// What F counts: it must be programmed anew where that changes (NC programming 12/2019, "Feed").
Command::FeedMode FeedType(const nc::SinumerikCommand* code) {
  if (code->name == "G93") return Command::FeedMode::kInverseTime;
  const bool revolution = code->name == "G95" || code->name == "G96" || code->name == "G97";
  return revolution ? Command::FeedMode::kPerRevolution : Command::FeedMode::kPerMinute;
}

}  // namespace

SinumerikInterpreter::SinumerikInterpreter(const Parts& parts, std::vector<int> motionless_m,
                                           int start_tool)
    : parts_(parts),
      settings_(*parts.settings),
      log_(*parts.log),
      axes_(parts.frames->axes()),
      motionless_m_(std::move(motionless_m)),
      contour_(
          CompensationOptions(),
          [this](const Command& command) {
            if (under_way_ != 0) {
              Unsupported("POSA", command.where,
                          "what moves before WAITP, while the axis is still under way");
            }
            parts_.to_motion->Execute(command);
          },
          [this](const Finding& finding) {
            // Which corners compensation cannot go round is the other control's rule.
            const bool alarm = finding.severity == Severity::kError;
            log_.ReportOnce("compensation", Rule::kUnsupportedCode, finding.where,
                            "G41 or G42 was not simulated here: " + finding.message);
            if (alarm) log_.Stop();
          },
          [this](const Finding& finding) {
            // The control shortens a corner that does not fit, or leaves it out.
            log_.ReportOnce("corner", Rule::kUnsupportedCode, finding.where,
                            "RND, RNDM, CHR or CHF was not simulated here: " + finding.message);
          }),
      tool_(start_tool) {
  for (const nc::SinumerikCommand& row : nc::Sinumerik840dGCodes()) {
    if (row.is_default) modal_.codes[static_cast<std::size_t>(row.group)] = &row;
  }
  for (const auto& [group, code] : settings_.start_codes) {
    const nc::SinumerikCommand* row = nc::FindSinumerikCommand(code);
    if (row == nullptr || row->group != group) continue;
    // What A2, B2, C2 mean is asked for where they stand.
    if (row->support == Support::kUnsupported && group != kSinOrientationAngles) {
      log_.Assume("MD20150[" + std::to_string(group - 1) + "]",
                  code + " is active at the start and was not simulated", true);
    }
    modal_.codes[static_cast<std::size_t>(group)] = row;
    if (group == kSinOffset) SelectOffset(std::max(0, OffsetIndex(code)));
  }
  if (tool_ != 0) edge_ = 1;
  active_ = parts_.registers->Edge(tool_, edge_).value_or(EdgeData{});
  UpdateModes();
  frame_ = std::make_shared<const Frame>(MakeFrame());
  position_ = parts_.frames->ToProgram(frame_, parts_.to_motion->position());
  contour_.SetPosition(position_);
}

SourcePosition SinumerikInterpreter::Where(const SinumerikItem& item) const {
  SourcePosition where = step_->where;
  where.column = item.column;
  return where;
}

bool SinumerikInterpreter::Alarm(const SourcePosition& where, int number, std::string text) {
  log_.Alarm(Rule::kControlAlarm, where, nc::AlarmText(number, std::move(text)));
  return false;
}

void SinumerikInterpreter::Unsupported(std::string_view name, const SourcePosition& where,
                                       const std::string& why) {
  std::string text = std::string(name) + " was not simulated";
  if (!why.empty()) text += ": " + why;
  log_.ReportOnce(name, Rule::kUnsupportedCode, where, std::move(text));
}

SinumerikItem* SinumerikInterpreter::Peek(std::string_view name) {
  for (SinumerikItem& item : step_->items) {
    if (item.kind != SinumerikItemKind::kWord || item.used) continue;
    const bool short_word = item.letter != 0 && item.extension < 0;
    if (short_word ? name.size() == 1 && item.letter == name[0] : nc::SameName(item.name, name)) {
      return &item;
    }
  }
  return nullptr;
}

SinumerikItem* SinumerikInterpreter::Take(std::string_view name) {
  SinumerikItem* item = Peek(name);
  if (item == nullptr) return nullptr;
  item->used = true;
  if (!item->is_text) return item;
  Alarm(Where(*item), 12150, std::string(name) + " needs a number");
  return nullptr;
}

void SinumerikInterpreter::TakeAll() {
  for (SinumerikItem& item : step_->items) item.used = true;
}

bool SinumerikInterpreter::Is(int group, std::string_view name) const {
  const nc::SinumerikCommand* code = modal_.codes[static_cast<std::size_t>(group)];
  return code != nullptr && code->name == name;
}

void SinumerikInterpreter::Execute(SinumerikStep* step) {
  step_ = step;
  statement_ = nullptr;
  suppress_ = nullptr;
  tool_frame_due_ = false;
  moved_ = feed_in_block_ = edge_in_block_ = exact_stop_here_ = has_codes_ = false;
  if (step->skip_level >= 0) {
    log_.Assume("block skip", "off: blocks with / are executed where no level is switched on",
                false);
  }
  ResolveAxisWords();
  if (!log_.stopped()) ApplyCodes();
  if (!log_.stopped()) ApplyTechnology();
  if (!log_.stopped()) ApplyM(false);
  // Of the tool that M6 has brought.
  if (SinumerikItem* d = log_.stopped() ? nullptr : Peek("D")) ApplyEdge(d);
  if (!log_.stopped()) ExecuteCalls();
  if (log_.stopped()) return;
  if (frame_dirty_) RefreshFrame();
  if (tool_frame_due_) TurnToTool();
  UpdatePrototype();
  if (statement_ != nullptr) {
    statement_->command->group == kSinFrame ? ExecuteFrameStatement(*statement_)
                                            : ExecuteAction(*statement_);
  } else {
    ExecuteMotion();
  }
  if (log_.stopped()) return;
  ApplyM(true);
  ReportLeftovers();
}

void SinumerikInterpreter::Finish() {
  if (!log_.stopped()) contour_.Flush();
}

void SinumerikInterpreter::Save() { saved_.push_back(modal_); }

void SinumerikInterpreter::Restore() {
  if (saved_.empty()) return;
  modal_ = std::move(saved_.back());
  saved_.pop_back();
  if (modal_.offset != 0 || !modal_.program.is_zero()) cancelled_.clear();
  UpdateModes();
  new_frame_ = true;
  frame_dirty_ = true;
}

AxisValues SinumerikInterpreter::MachinePosition() {
  contour_.Flush();
  if (Is(kSinComp, "G40")) return parts_.to_motion->position();
  return parts_.frames->ToMachine(frame_, position_);
}

/// AX[X]=10 is X=10.
void SinumerikInterpreter::ResolveAxisWords() {
  for (SinumerikItem& item : step_->items) {
    const bool word = item.kind == SinumerikItemKind::kWord && item.letter == 0;
    if (!word || item.value_count == 0 || !nc::SameName(item.name, "AX")) continue;
    const std::string& axis = step_->argument(item, 0).text;
    if (axis.size() != 1 || std::string_view("XYZABC").find(axis[0]) == std::string_view::npos) {
      continue;
    }
    if (step_->Find(axis[0]) != nullptr) {
      Alarm(Where(item), 16420, axis + " stands twice in the block");
      return;
    }
    item.letter = axis[0];
    ++item.first_value;
    --item.value_count;
  }
}

void SinumerikInterpreter::ApplyCodes() {
  for (SinumerikItem& item : step_->items) {
    if (item.kind == SinumerikItemKind::kCommand && !item.used) ApplyCode(&item);
  }
  if (has_codes_) UpdateModes();
}

void SinumerikInterpreter::ApplyCode(SinumerikItem* item) {
  const nc::SinumerikCommand* code = item->command;
  item->used = true;
  if (code->support == Support::kUnsupported) {
    const int group = code->group;
    Unsupported(code->name, Where(*item), std::string(code->meaning));
    // What it makes of the other words is not known.
    if (nc::IsSyntaxGroup(group) || group == kSinMotion) TakeAll();
    return;
  }
  const auto group = static_cast<std::size_t>(code->group);
  switch (code->group) {
    case kSinAction:
    case kSinFrame:
      statement_ = item;
      return;
    case kSinSuppress:
      suppress_ = code;
      return;
    case kSinExactStopHere:
      exact_stop_here_ = true;
      return;
    case kSinOffset:
      SelectOffset(OffsetIndex(nc::UpperName(item->name)));
      break;
    case kSinToolFrame:
      tool_frame_due_ = true;
      break;
    case kSinFeedMode:
      if (FeedType(modal_.codes[group]) != FeedType(code)) feed_word_ = 0.0;
      break;
    default:
      break;
  }
  has_codes_ = true;
  modal_.codes[group] = code;
}

int SinumerikInterpreter::OffsetIndex(std::string_view name) {
  int number = 0;
  for (const char c : name) {
    if (IsDigit(c)) number = 10 * number + (c - '0');
  }
  if (number >= 54 && number <= 57) return number - 53;
  return number >= 500 && number < 500 + kNumSettableFrames ? number - 500 : -1;
}

void SinumerikInterpreter::UpdateModes() {
  motion_ = Is(kSinMotion, "G0")    ? MotionMode::kRapid
            : Is(kSinMotion, "G2")  ? MotionMode::kClockwise
            : Is(kSinMotion, "G3")  ? MotionMode::kCounterClockwise
            : Is(kSinMotion, "CIP") ? MotionMode::kThroughPoint
            : Is(kSinMotion, "CT")  ? MotionMode::kTangent
            : Is(kSinMotion, "G33") || Is(kSinMotion, "G331") || Is(kSinMotion, "G332")
                ? MotionMode::kThread
                : MotionMode::kLine;
  plane_ = Is(kSinPlane, "G18") ? Plane::kZX : Is(kSinPlane, "G19") ? Plane::kYZ : Plane::kXY;
  if (LengthAxis() != length_axis_) {
    length_axis_ = LengthAxis();
    length_checked_ = false;
    if (active_.length != 0.0) frame_dirty_ = new_length_ = true;
  }
  incremental_ = Is(kSinDistance, "G91");
  // CDOF: the corner with the next block, and nothing beyond it.
  contour_.LookAhead(Is(kSinBottleneck, "CDON"));
  mm_ = Is(kSinUnits, "G70") || Is(kSinUnits, "G700") ? kMmPerInch : 1.0;
  feed_mm_ = Is(kSinUnits, "G700") ? kMmPerInch : 1.0;
}

void SinumerikInterpreter::UpdatePrototype() {
  command_.where = step_->where;
  if (command_.frame != frame_) command_.frame = frame_;
  command_.named = 0;
  command_.plane = plane_;
  command_.full_circle = false;
  command_.arc_normal.setZero();
  command_.corner_radius = command_.corner_chamfer = command_.corner_chamfer_length = 0.0;
  command_.feed_mode = FeedType(modal_.codes[kSinFeedMode]);
  const bool inverse = command_.feed_mode == Command::FeedMode::kInverseTime;
  const bool revolution = command_.feed_mode == Command::FeedMode::kPerRevolution;
  command_.feed = feed_word_ / 60.0;
  if (!inverse) command_.feed *= feed_mm_;
  if (revolution) command_.feed *= rpm_;
  command_.spindle_on = spindle_ != 0 && rpm_ > 0.0;
  command_.tool = tool_;
  command_.cycle = 0;
  const bool independent = Is(kSinRapid, "RTLIOF") && !traori_ && Is(kSinExactStop, "G60") &&
                           Is(kSinCompressor, "COMPOF") && Is(kSinComp, "G40");
  command_.rapid = independent ? RapidMode::kIndependent : RapidMode::kLinearRotary;
  command_.orientation = vector_path() ? Orientation::kVector : Orientation::kAxes;
  command_.wrap_note = WrapNote();
  command_.comp = Is(kSinComp, "G41")   ? Command::Comp::kLeft
                  : Is(kSinComp, "G42") ? Command::Comp::kRight
                                        : Command::Comp::kOff;
  command_.comp_radius = active_.radius;
  UpdateTolerance();
  CheckToleranceFactor();
}

/// How far smoothing may leave path and orientation: by CYCLE832, else by what is programmed.
void SinumerikInterpreter::UpdateTolerance() {
  const bool smooths = contour_tolerance_ > 0.0;
  const bool stops = Is(kSinExactStop, "G60") || exact_stop_here_;
  const bool compresses = !Is(kSinCompressor, "COMPOF");
  command_.exact_stop = stops && !smooths && !compresses;
  command_.corner_rounding = contour_tolerance_;
  // SD42466: only with an orientation transformation.
  command_.orientation_tolerance = traori_ && smooths ? orientation_tolerance_ : 0.0;
  if (smooths || command_.exact_stop) return;
  if (Is(kSinExactStop, "G641") && !compresses) {
    command_.corner_rounding = (motion_ == MotionMode::kRapid ? adispos_ : adis_).value_or(0.0);
    return;
  }
  if (Is(kSinExactStop, "G64") && !compresses) return;
  command_.corner_rounding = ctol_.value_or(kStandardTolerance);
  if (!ctol_) {
    log_.Assume("smoothing tolerance",
                Fixed(kStandardTolerance, 2) +
                    " mm: G642 to G645 and compressors leave the path by no more (MD33100)",
                false);
  }
  if (!traori_) return;
  command_.orientation_tolerance = otol_.value_or(kStandardOrientation);
  if (!otol_) {
    log_.Assume(
        "orientation tolerance",
        Short(Degrees(kStandardOrientation), 3) +
            " deg: G642 to G645 and compressors turn the tool by no more (SD42466, SD42476)",
        false);
  }
}

/// S, F, T and the words of smoothing.
void SinumerikInterpreter::ApplyTechnology() {
  const bool dwell = statement_ != nullptr && statement_->command->name == "G4";
  for (const std::string_view name : {std::string_view("S"), std::string_view("S1")}) {
    if (dwell || Peek(name) == nullptr) continue;
    if (const SinumerikItem* s = Take(name)) rpm_ = std::max(0.0, s->value);
  }
  if (!dwell && Peek("F") != nullptr) {
    const SinumerikItem* f = Take("F");
    if (f == nullptr) return;
    if (!(f->value > 0.0)) {
      Alarm(Where(*f), 14800, "F" + Short(f->value) + " is no feed");
      return;
    }
    feed_word_ = f->value;
    feed_in_block_ = true;
  }
  if (SinumerikItem* t = Peek("T")) ApplyToolWord(t);
  if (log_.stopped()) return;
  const auto number = [&](std::string_view name, double unit, std::optional<double>* value) {
    if (Peek(name) == nullptr) return;
    const SinumerikItem* item = Take(name);
    if (item == nullptr) return;
    value->reset();
    if (item->value >= 0.0) *value = item->value * unit;
  };
  number("CTOL", mm_, &ctol_);
  number("OTOL", kPi / 180.0, &otol_);
  number("ADIS", mm_, &adis_);
  number("ADISPOS", mm_, &adispos_);
  if (Peek("RNDM") != nullptr) {
    const SinumerikItem* radius = Take("RNDM");
    if (radius != nullptr) modal_rounding_ = std::max(0.0, radius->value * mm_);
  }
  for (const std::string_view name : {"SPOS", "SPOSA"}) {
    if (Peek(name) != nullptr && Take(name) != nullptr) spindle_ = 0;
  }
}

void SinumerikInterpreter::ApplyM(bool at_end) {
  for (SinumerikItem& item : step_->items) {
    const bool spindle = item.extension < 0 || item.extension == 1;
    if (item.kind != SinumerikItemKind::kWord || item.letter != 'M' || !spindle) continue;
    const int code = static_cast<int>(std::lround(item.value));
    const bool ends = code == 0 || code == 1 || code == 2 || code == 17 || code == 30;
    if (item.is_text || ends != at_end || log_.stopped()) continue;
    item.used = true;
    ExecuteM(code, item);
  }
}

void SinumerikInterpreter::ExecuteM(int code, const SinumerikItem& item) {
  const std::string name = "M" + std::to_string(code);
  switch (code) {
    case 1:
      log_.Assume("optional stop", "off: M1 does not stop", false);
      if (settings_.optional_stop) contour_.Flush();
      return;
    case 0:
    case 17:
      contour_.Flush();
      return;
    case 2:
    case 30:
      contour_.Flush();
      if (!step_->in_subprogram) spindle_ = 0;
      return;
    case 3:
    case 4:
      spindle_ = code == 3 ? 1 : -1;
      return;
    case 5:
    case 19:
      spindle_ = 0;
      return;
    case 6:
      return ChangeTool(Where(item));
    default:
      break;
  }
  const nc::SinumerikCommand* row = nc::FindSinumerikCommand(name);
  const bool known = row != nullptr && row->support != Support::kUnsupported;
  const bool quiet =
      std::find(motionless_m_.begin(), motionless_m_.end(), code) != motionless_m_.end();
  if (known || quiet) return;
  Unsupported(name, Where(item),
              row == nullptr ? "it is the machine builder's; if it moves nothing, name it in the "
                               "job's m_codes_without_motion"
                             : std::string(row->meaning));
}

void SinumerikInterpreter::ExecuteCalls() {
  for (SinumerikItem& item : step_->items) {
    if (item.kind != SinumerikItemKind::kCall || item.used || log_.stopped()) continue;
    item.used = true;
    const nc::SinumerikCommand& command = *item.command;
    const std::span<const nc::SinumerikValue> arguments(step_->values.data() + item.first_value,
                                                        item.value_count);
    if (command.kind == nc::SinumerikCommandKind::kCycle) {
      ExecuteCycle(command, arguments, Where(item));
    } else if (command.name == "TRAORI") {
      const bool first = arguments.empty() || (arguments.size() == 1 && arguments[0].number == 1.0);
      if (!first) Unsupported("TRAORI with parameters", Where(item));
      CancelFrame(true, Where(item));
    } else if (command.name == "TRAFOOF") {
      if (traori_) CancelFrame(false, Where(item));
    } else if (command.name == "WAITP") {
      WaitForAxes(arguments);
    } else if (command.support == Support::kUnsupported) {
      Unsupported(command.name, Where(item), std::string(command.meaning));
    }
  }
}

/// What nobody has consumed is said.
void SinumerikInterpreter::ReportLeftovers() {
  for (const SinumerikItem& item : step_->items) {
    if (item.used) continue;
    const bool one_letter = item.letter != 0 && item.extension < 0;
    std::string name = nc::UpperName(item.name);
    if (one_letter) name = std::string(1, item.letter);
    const nc::SinumerikCommand* row = nc::FindSinumerikCommand(name);
    if (row != nullptr && row->support == Support::kNoMotionEffect) continue;
    const std::size_t axis = std::string_view("XYZABC").find(name);
    if (name.size() == 1 && axis < kNumAxes && !axes_.has(static_cast<int>(axis))) {
      Unsupported(name, Where(item), "the machine has no such axis");
      continue;
    }
    Unsupported(name, Where(item), row == nullptr ? "" : std::string(row->meaning));
  }
}

}  // namespace ncsim::control
