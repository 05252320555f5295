// SPDX-License-Identifier: BSD-3-Clause
#include "post/post_data.h"

#include <algorithm>
#include <iterator>

#include "sim/base/units.h"

namespace ncsim::post {
const std::array<BlockInfo, kBlocks>& BlockTable() {
  static const std::array<BlockInfo, kBlocks> table = {{
      {"program_start", kGeneral, true},
      {"program_end", kGeneral, true},
      {"tool_table_head", kGeneral, false},
      {"tool_table_row", kToolTable, false},
      {"tool_table_foot", kGeneral, false},
      {"tool_change", kToolChange, true},
      {"operation_start", kGeneral, false},
      {"safe_start", kGeneral, true},
      {"operation_end", kGeneral, false},
      {"call_operation", kGeneral, false},
      {"file_start", kGeneral, false},
      {"file_end", kGeneral, false},
      {"spindle", kGeneral, true},
      {"coolant", kGeneral, true},
      {"rapid", kMotion, true},
      {"line", kMotion, true},
      {"arc", kMotion, false},
      {"index", kPosition, true},
      {"rewind", kPosition, false},
      {"leave", kGeneral, true},
      {"hole", kHole, false},
      {"cycle_end", kGeneral, false},
      {"dwell", kDwellBlock, true},
      {"stop", kGeneral, true},
      {"optional_stop", kGeneral, true},
      {"home", kGeneral, false},
      {"comment", kTextBlock, true},
      {"code", kCodeBlock, false},
  }};
  return table;
}

std::string_view ToString(ClCycleKind kind) {
  switch (kind) {
    case ClCycleKind::kDrill:
      return "drill";
    case ClCycleKind::kFace:
      return "face";
    case ClCycleKind::kCounterSink:
      return "counter_sink";
    case ClCycleKind::kDeep:
      return "deep";
    case ClCycleKind::kBreakChip:
      return "break_chip";
    case ClCycleKind::kTap:
      return "tap";
    case ClCycleKind::kReam:
      return "ream";
    case ClCycleKind::kBore:
      return "bore";
    case ClCycleKind::kBoreDrag:
      return "bore_drag";
    case ClCycleKind::kBoreNoDrag:
      return "bore_no_drag";
    case ClCycleKind::kBoreBack:
      return "bore_back";
    case ClCycleKind::kBoreManual:
      return "bore_manual";
    case ClCycleKind::kThru:
      return "thru";
  }
  return "";
}

const PostMode* PostData::Mode(PlanMode kind, std::string_view preferred) const {
  const PostMode* named = ModeNamed(preferred);
  if (named != nullptr && named->kind == kind) return named;
  const auto first = std::find_if(modes.begin(), modes.end(),
                                  [&](const PostMode& mode) { return mode.kind == kind; });
  return first == modes.end() ? nullptr : &*first;
}

const PostMode* PostData::ModeNamed(std::string_view mode_name) const {
  const auto found = std::find_if(modes.begin(), modes.end(),
                                  [&](const PostMode& mode) { return mode.name == mode_name; });
  return found == modes.end() ? nullptr : &*found;
}

const BlockTemplate* PostData::Find(Block block, const PostMode* mode) const {
  const auto index = static_cast<std::size_t>(block);
  if (mode != nullptr && mode->blocks[index]) return &*mode->blocks[index];
  return blocks[index] ? &*blocks[index] : nullptr;
}

const BlockTemplate* PostData::Cycle(const ClHoleCycle& cycle, bool counter_clockwise,
                                     std::string* why) const {
  std::string wanted(ToString(cycle.kind));
  if (cycle.kind == ClCycleKind::kTap && counter_clockwise) wanted += "_left";
  const bool dwells = cycle.dwell > 0.0;
  if (dwells) {
    const auto with_dwell = cycles.find(wanted + "_dwell");
    if (with_dwell != cycles.end()) return &with_dwell->second;
  }
  const auto found = cycles.find(wanted);
  const auto lacks = [&](std::string_view what, Value value) -> const BlockTemplate* {
    *why = "cycles." + wanted + " of the post prints no {" + std::string(Info(value).name) +
           "}, and the cycle has " + std::string(what);
    return nullptr;
  };
  if (found == cycles.end()) {
    *why = "the post has no cycles." + wanted;
    return nullptr;
  }
  const BlockTemplate& block = found->second;
  if (dwells && !block.Uses(Value::kHoleDwell)) return lacks("a dwell", Value::kHoleDwell);
  if (cycle.steps.empty()) {
    if (!block.Uses(Value::kHoleStep)) return &block;
    *why = "the cycle has no depth of its pecks";
    return nullptr;
  }
  const double first = cycle.steps.front(), next = cycle.steps.back();
  const auto second = std::next(cycle.steps.begin());
  const bool alike =
      std::all_of(second, cycle.steps.end(), [&](double step) { return step == next; });
  if (!alike || first < next) {
    *why = "pecks have words where they are alike, or the first one is longer";
    return nullptr;
  }
  // The shorter one for all is no deeper peck than the file's.
  if (first > next && block.Uses(Value::kHoleNextStep)) return &block;
  const Value step = first > next ? Value::kHoleFirstStep : Value::kHoleStep;
  return block.Uses(step) ? &block : lacks("pecks", step);
}

const WordFormat* PostData::FindWord(Value value) const {
  const auto found = std::find_if(words.begin(), words.end(),
                                  [&](const WordFormat& word) { return word.value == value; });
  return found == words.end() ? nullptr : &*found;
}

double PostData::AsPrinted(Value value, double number) const {
  const WordFormat* word = FindWord(value);
  if (word == nullptr) return number;
  return Print(formats[static_cast<std::size_t>(word->format)], number).value;
}

double PostData::Increment(Value value) const {
  const WordFormat* word = FindWord(value);
  return word == nullptr ? 0.0 : formats[static_cast<std::size_t>(word->format)].increment();
}

double PostData::unit_mm() const { return unit == ClUnit::kInch ? kMmPerInch : 1.0; }

}  // namespace ncsim::post
