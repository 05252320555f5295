// SPDX-License-Identifier: BSD-3-Clause
#include "sim/control/haas_interpreter.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "sim/base/text.h"
#include "sim/base/units.h"

namespace ncsim::control {
namespace {

// Highest T and D words; what the machine has is checked where the tool is changed.
constexpr int kMaxToolWord = 9999;

bool TakesAxisWords(int code) {
  constexpr std::array<int, 11> kCodes = {100, 120, 130, 280, 290, 520, 530, 700, 710, 720, 920};
  return std::find(kCodes.begin(), kCodes.end(), code) != kCodes.end();
}

Command::FeedMode ToFeedMode(int code) {
  if (code == 930) return Command::FeedMode::kInverseTime;
  return code == 950 ? Command::FeedMode::kPerRevolution : Command::FeedMode::kPerMinute;
}

}  // namespace

HaasInterpreter::HaasInterpreter(const Parts& parts, const CodeIndex& codes,
                                 std::vector<int> motionless_m, int start_tool)
    : parts_(parts),
      settings_(*parts.settings),
      log_(*parts.log),
      axes_(parts.frames->axes()),
      block_(codes, *parts.settings, std::move(motionless_m), parts.log),
      contour_(
          parts.settings->contour,
          [this](const Command& command) { parts_.to_motion->Execute(command); },
          [this](Finding finding) {
            const bool alarm = finding.severity == Severity::kError;
            log_.Report(std::move(finding));
            if (alarm) log_.Stop();
          }),
      tool_(start_tool),
      corner_rounding_(parts.settings->corner_rounding) {
  for (const nc::CodeSpec& spec : nc::HaasNgc().codes) {
    if (spec.address != 'G' || !spec.is_default || spec.group >= kNumGroups) continue;
    codes_[static_cast<std::size_t>(spec.group)] = spec.number_x10;
  }
  codes_[kGroupUnits] = settings_.inch ? 200 : 210;
  command_.rapid = settings_.rapid;
  for (int axis = kX; axis < kNumAxes; ++axis) {
    if (!axes_.has(axis)) missing_axes_ += "XYZABC"[axis];
  }
  cycle_.r = cycle_.z = std::nan("");
  frame_ = std::make_shared<const Frame>(MakeFrame());
  position_ = parts_.frames->ToProgram(frame_, parts_.to_motion->position());
  contour_.SetPosition(position_);
}

void HaasInterpreter::Alarm(Rule rule, char at, std::string message) {
  log_.Alarm(rule, block_.WhereOf(at), std::move(message));
}

void HaasInterpreter::Unsupported(std::string_view key, SourcePosition where, std::string message) {
  log_.ReportOnce(key, Rule::kUnsupportedCode, where, std::move(message));
}

void HaasInterpreter::AssumeUnlessStated(const std::string& key, const std::string& name,
                                         const std::string& text) {
  if (!log_.Assumed(name) && !parts_.source->Text(key)) log_.Assume(name, text, false);
}

void HaasInterpreter::Execute(ResolvedBlock* block) {
  if (block->block_delete) {
    AssumeUnlessStated("block_skip", "block skip", "off: blocks with / are executed");
  }
  if (block->words.empty() || !block_.Load(block)) return;
  ExecuteLoaded();
  if (log_.stopped()) return;
  RememberWords(*block);
  block_.ReportLeftovers(missing_axes_);
}

void HaasInterpreter::ExecuteLoaded() {
  CollectCodes();
  if (log_.stopped() || !ApplyModes()) return;
  if (frame_dirty_) RefreshFrame(tcp_on_);
  UpdatePrototype();
  UpdateCycle();
  const bool go_on = !block_.axes_taken() && ExecuteRotation() && ExecuteNonModal();
  if (go_on) ExecuteMotion();
  if (log_.stopped()) return;
  ExecuteM();
  if (settings_.g91_non_modal) codes_[kGroupDistance] = 900;
}

void HaasInterpreter::Finish() {
  if (!log_.stopped()) contour_.Flush();
}

void HaasInterpreter::CollectCodes() {
  if (has_codes_) in_block_.fill(nullptr);
  has_codes_ = !block_.g_codes().empty();
  non_modal_ = nullptr;
  tcp_on_ = feed_in_block_ = defining_ = false;
  for (const CodeUse& use : block_.g_codes()) {
    if (use.spec->support == nc::Support::kUnsupported) continue;
    if (use.spec->group > 0 && use.spec->group < kNumGroups) {
      in_block_[static_cast<std::size_t>(use.spec->group)] = &use;
      continue;
    }
    if (use.spec->number_x10 == 40) in_block_[kGroupNonModal] = &use;  // G04
    if (!TakesAxisWords(use.spec->number_x10)) continue;
    if (non_modal_ != nullptr) {
      log_.Alarm(Rule::kControlAlarm, block_.WhereOf(*use.word),
                 CodeName('G', non_modal_->word->value) + " and " + CodeName('G', use.word->value) +
                     " in one block: both are of group 0");
      return;
    }
    non_modal_ = &use;
  }
}

void HaasInterpreter::RememberWords(const ResolvedBlock& block) {
  for (const ResolvedWord& word : block.words) {
    if (!word.comma && word.address >= 'A' && word.address <= 'Z') {
      last_words_[static_cast<std::size_t>(word.address - 'A')] = word.value;
    }
  }
}

bool HaasInterpreter::ApplyModes() {
  if (block_.g_codes().empty()) {
    if (block_.Has('F')) ApplyFeed(false);
    if (block_.HasAnyOf("STD") && !ApplyToolWords()) return false;
    return (!block_.Has('H') || ApplyLength()) && (!frame_dirty_ || CheckRotationRules());
  }
  const int feed_mode = group_code(kGroupFeedMode);
  if (!ApplyUnits()) return false;
  for (const int group :
       {kGroupPlane, kGroupDistance, kGroupFeedMode, kGroupReturn, kGroupExactStop}) {
    if (const CodeUse* use = CodeOf(group)) {
      codes_[static_cast<std::size_t>(group)] = use->spec->number_x10;
    }
  }
  plane_ = IsSet(kGroupPlane, 18) ? Plane::kZX : IsSet(kGroupPlane, 19) ? Plane::kYZ : Plane::kXY;
  ApplyFeed(feed_mode != group_code(kGroupFeedMode));
  if (!ApplyToolWords()) return false;
  if (const CodeUse* use = CodeOf(kGroupOffset); use != nullptr && !ApplyOffsetCode(*use)) {
    return false;
  }
  if (!ApplyLength() || !ApplyDwo() || !CheckRotationRules()) return false;
  return ApplyComp();
}

// G20 and G21 do not convert: they are held against setting 9 (manual, G20/G21).
bool HaasInterpreter::ApplyUnits() {
  const CodeUse* use = CodeOf(kGroupUnits);
  if (use == nullptr) return true;
  const bool inch = use->spec->number_x10 == 200;
  if (inch == settings_.inch) return true;
  log_.Alarm(Rule::kControlAlarm, block_.WhereOf(*use->word),
             std::string(inch ? "G20" : "G21") + " while setting 9 is " +
                 (settings_.inch ? "INCH" : "MM"));
  return false;
}

void HaasInterpreter::ApplyFeed(bool mode_changed) {
  if (mode_changed) feed_word_ = 0.0;
  if (!block_.Has('F')) return;
  feed_word_ = block_.FeedWord();
  feed_in_block_ = true;
}

bool HaasInterpreter::ApplyToolWords() {
  if (block_.Has('S')) rpm_ = std::max(0.0, block_.Number('S'));
  if (block_.Has('T')) {
    const std::optional<int> tool = block_.Integer('T', 0, kMaxToolWord);
    if (!tool) return false;
    next_tool_ = *tool;
  }
  if (block_.Has('D')) {
    const std::optional<int> d = block_.Integer('D', 0, kMaxToolOffset);
    if (!d) return false;
    d_ = *d;
    has_d_ = true;
  }
  return true;
}

bool HaasInterpreter::ApplyComp() {
  const CodeUse* use = CodeOf(kGroupComp);
  if (use == nullptr) return true;
  codes_[kGroupComp] = use->spec->number_x10;
  if (!IsSet(kGroupComp, 40) && d_ == 0 && !has_d_) {
    Unsupported("comp without D", block_.WhereOf(*use->word),
                CodeName('G', use->word->value) + " with no D in force: none is compensated");
  }
  if (IsSet(kGroupComp, 40) || plane_ == Plane::kXY) return true;
  log_.Alarm(Rule::kControlAlarm, block_.WhereOf(*use->word),
             CodeName('G', use->word->value) + ": cutter compensation works in G17 only");
  return false;
}

void HaasInterpreter::UpdatePrototype() {
  command_.where = block_.where();
  if (command_.frame != frame_) command_.frame = frame_;
  command_.named = 0;
  command_.plane = plane_;
  command_.full_circle = false;
  command_.feed_mode = ToFeedMode(group_code(kGroupFeedMode));
  command_.feed = feed_word_ / 60.0;
  if (command_.feed_mode != Command::FeedMode::kInverseTime) {
    command_.feed *= settings_.mm_per_unit();
  }
  if (command_.feed_mode == Command::FeedMode::kPerRevolution) command_.feed *= rpm_;
  command_.spindle_on = spindle_ != 0 && rpm_ > 0.0;
  command_.exact_stop = IsSet(kGroupExactStop, 61);
  for (const CodeUse& use : block_.g_codes()) {
    if (use.spec->number_x10 == 90) command_.exact_stop = true;
  }
  command_.brakes = brakes_;
  command_.tool = tool_;
  command_.cycle = 0;
  command_.corner_rounding = corner_rounding_;
  command_.corner_radius = command_.corner_chamfer = 0.0;
  command_.comp = IsSet(kGroupComp, 41)   ? Command::Comp::kLeft
                  : IsSet(kGroupComp, 42) ? Command::Comp::kRight
                                          : Command::Comp::kOff;
  if (command_.comp == Command::Comp::kOff) return;
  const double d = parts_.registers->Tool(ToolRegister::kDiameter, d_) +
                   parts_.registers->Tool(ToolRegister::kDiameterWear, d_);
  command_.comp_radius = settings_.diameter_d ? 0.5 * d : d;
}

AxisValues HaasInterpreter::MachinePosition(bool flush) {
  if (flush) contour_.Flush();
  if (IsSet(kGroupComp, 40)) return parts_.to_motion->position();
  return parts_.frames->ToMachine(frame_, position_);
}

void HaasInterpreter::RegistersChanged() {
  frame_dirty_ = true;
  length_checked_ = offset_checked_ = false;
}

}  // namespace ncsim::control
