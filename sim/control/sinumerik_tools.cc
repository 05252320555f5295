// SPDX-License-Identifier: BSD-3-Clause
// T, D and M6 (NC programming 12/2019, "Tool change", "Tool offsets"; MD22550, MD20270).
#include <cmath>
#include <utility>

#include "sim/base/text.h"
#include "sim/control/arc.h"
#include "sim/control/limits.h"
#include "sim/control/sinumerik_interpreter.h"
#include "sim/control/tool_change.h"
#include "sim/nc/sinumerik_token.h"

namespace ncsim::control {
namespace {

constexpr double kMaxToolNumber = 32000.0;

}  // namespace

/// `T=5`, `T5`, `T="NAME"`, T1=: spindle 1.
void SinumerikInterpreter::ApplyToolWord(SinumerikItem* item) {
  item->used = true;
  if (item->is_text) {
    const std::string& name = step_->text(*item).text;
    const machine::Tool* found = nullptr;
    for (const machine::Tool& tool : parts_.tools->tools) {
      if (found == nullptr && !name.empty() && tool.name == name) found = &tool;
    }
    if (found == nullptr) {
      log_.Alarm(Rule::kToolMissing, Where(*item),
                 nc::AlarmText(17190, "no tool is known by the name \"" + name +
                                          "\": the program was not followed any further"));
      return;
    }
    next_tool_ = found->number;
  } else {
    if (!(item->value >= 0.0 && item->value <= kMaxToolNumber) ||
        item->value != std::floor(item->value)) {
      Alarm(Where(*item), 17190, "T" + Short(item->value) + " is no tool number");
      return;
    }
    next_tool_ = static_cast<int>(item->value);
  }
  if (!settings_.m6_changes) ChangeTool(Where(*item));
}

void SinumerikInterpreter::ApplyEdge(SinumerikItem* item) {
  item->used = true;
  if (item->is_text || !(item->value >= 0.0 && item->value <= kMaxEdge) ||
      item->value != std::floor(item->value)) {
    Alarm(Where(*item), 17180, "D" + Short(item->value) + " is no edge");
    return;
  }
  edge_in_block_ = true;
  SelectEdge(static_cast<int>(item->value), Where(*item));
}

/// Moves nothing: an axis goes the new length with its next own move.
void SinumerikInterpreter::SelectEdge(int edge, const SourcePosition& where) {
  std::optional<EdgeData> data = parts_.registers->Edge(tool_, edge);
  const machine::Tool* tool = parts_.tools->Find(tool_);
  // A tool that nobody states has whatever edges are asked for.
  if (!data && tool != nullptr && !tool->assumed.empty()) data = parts_.registers->Edge(tool_, 1);
  edge_ = edge;
  if (!data) {
    const bool known = tool != nullptr;
    const std::string name = "T" + std::to_string(tool_);
    if (known) {
      Alarm(where, 17180,
            name + " has no edge D" + std::to_string(edge) +
                ": the job states none, nor does a file of tool offsets");
    } else {
      log_.ReportOnce(name, Rule::kToolMissing, where,
                      nc::AlarmText(17190, name + " is not in the tool table"));
    }
    return;
  }
  if (data->length != active_.length) frame_dirty_ = new_length_ = true;
  active_ = *data;
  length_checked_ = false;
}

void SinumerikInterpreter::ChangeTool(const SourcePosition& where) {
  if (next_tool_ < 0) {
    Alarm(where, 17190, "M6 without a T");
    return;
  }
  if (frame_dirty_) RefreshFrame();
  const std::string name = "T" + std::to_string(next_tool_);
  const machine::Tool* tool = parts_.tools->Find(next_tool_);
  const int pockets = parts_.machine->control.tool_pockets;
  if (pockets > 0 && next_tool_ > pockets) {
    log_.Report(Rule::kToolMissing, where,
                name + ": the tool changer has " + std::to_string(pockets) + " pockets");
  } else if (next_tool_ > 0 && tool == nullptr) {
    log_.Report(Rule::kToolMissing, where,
                nc::AlarmText(17190, name + " is not in the tool table"));
  }
  spindle_ = 0;
  UpdatePrototype();
  const ToolChangeWay way(parts_.machine->control);
  way.AssumePose(&log_);
  for (const unsigned axes : way.steps) {
    PushMachine(CommandKind::kMachineRapid, axes, way.pose);
  }
  if (log_.stopped()) return;
  tool_ = next_tool_;
  command_.tool = tool_;
  PushMachine(CommandKind::kToolChange, 0, {});
  length_checked_ = false;
  if (tool != nullptr && !tool->assumed.empty()) {
    log_.Assume("tool " + name, tool->assumed, true);
  }
  if (settings_.edge_after_change == -2) return;
  const bool known = tool != nullptr || tool_ == 0;
  const int edge = settings_.edge_after_change == -1 ? edge_ : settings_.edge_after_change;
  if (known) SelectEdge(tool_ == 0 ? 0 : edge, where);
}

/// Of a milling tool (SD42940: 0 goes by the active plane, what is not in its table is 17).
int SinumerikInterpreter::LengthAxis() const {
  const int plane = std::abs(settings_.length_plane);
  if (plane == 0) return AxesOf(plane_).normal;
  if (plane == 18) return kY;
  return plane == 19 ? kX : kZ;
}

/// Beside the spindle's direction the length is a mere shift.
void SinumerikInterpreter::ApplyLength(Frame* frame, double length) const {
  if (length_axis_ == kZ) {
    frame->tool_length = length;
  } else {
    frame->offset[static_cast<std::size_t>(length_axis_)] += length;
  }
}

void SinumerikInterpreter::CheckToolLength() {
  length_checked_ = true;
  if (edge_ == 0) return;
  if (length_axis_ != kZ && active_.length != 0.0) {
    const char letter = "XYZ"[length_axis_];
    if (traori_) {
      Unsupported("TRAORI with a tool length along " + std::string(1, letter), step_->where);
    }
    log_.ReportOnce(
        std::string("length along ") + letter,
        MakeFinding(Rule::kToolLength, step_->where,
                    "the length of D" + std::to_string(edge_) + ", " + Fixed(active_.length, 3) +
                        " mm, counts along " + letter + " (" +
                        (settings_.length_plane == 0
                             ? std::string(letter == 'Y' ? "G18" : "G19") + " with SD42940 = 0"
                             : "SD42940 = " + std::to_string(settings_.length_plane)) +
                        ") while the tool stands along Z, which goes that much too "
                        "deep; SD42940 = 17 keeps it along Z"));
    return;
  }
  const machine::Tool* tool = parts_.tools->Find(tool_);
  const double length = active_.length;
  if (tool == nullptr || std::abs(length - tool->length) <= kLengthTolerance) return;
  const std::string name = "D" + std::to_string(edge_);
  Finding finding = MakeFinding(Rule::kToolLength, step_->where,
                                name + " of T" + std::to_string(tool_) + " is " + Fixed(length, 3) +
                                    " mm, the tool in the spindle is " + Fixed(tool->length, 3) +
                                    " mm from gauge line to tip");
  if (length > 0.0) finding.severity = Severity::kWarning;
  log_.ReportOnce("length " + name + " T" + std::to_string(tool_), std::move(finding));
}

}  // namespace ncsim::control
