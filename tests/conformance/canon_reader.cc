// SPDX-License-Identifier: BSD-3-Clause
#include "tests/conformance/canon_reader.h"

#include <zlib.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>

#include "sim/base/units.h"

namespace ncsim::conformance {
namespace {

using Values = std::array<double, 6>;

struct Call {
  std::string_view name;
  std::string_view text;        // Between the brackets.
  std::vector<double> numbers;  // Of the text, separated by commas or spaces; words are left out.
};

std::optional<Call> ParseCall(std::string_view line) {
  const std::size_t open = line.find('(');
  const std::size_t close = line.rfind(')');
  if (open == std::string_view::npos || close == std::string_view::npos || close < open) {
    return std::nullopt;
  }
  std::size_t begin = open;
  while (begin > 0 && (std::isupper(static_cast<unsigned char>(line[begin - 1])) != 0 ||
                       std::isdigit(static_cast<unsigned char>(line[begin - 1])) != 0 ||
                       line[begin - 1] == '_')) {
    --begin;
  }
  Call call;
  call.name = line.substr(begin, open - begin);
  call.text = line.substr(open + 1, close - open - 1);
  if (call.name.empty() || call.name == "COMMENT" || call.name == "MESSAGE") return call;
  const char* at = call.text.data();
  const char* const end = at + call.text.size();
  while (at < end) {
    double value = 0.0;
    const auto [next, error] = std::from_chars(at, end, value);
    if (error == std::errc()) {
      call.numbers.push_back(value);
      at = next;
    }
    while (at < end && *at != ',' && *at != ' ') ++at;
    while (at < end && (*at == ',' || *at == ' ')) ++at;
  }
  return call;
}

bool IsNoMotion(std::string_view name) {
  static constexpr std::string_view kNames[] = {"COMMENT",
                                                "MESSAGE",
                                                "LOG",
                                                "LOGOPEN",
                                                "LOGCLOSE",
                                                "ON_RESET",
                                                "SET_FEED_REFERENCE",
                                                "SET_MOTION_CONTROL_MODE",
                                                "SET_NAIVECAM_TOLERANCE",
                                                "SET_SPINDLE_SPEED",
                                                "SET_SPINDLE_MODE",
                                                "START_CHANGE",
                                                "SELECT_TOOL",
                                                "SELECT_POCKET",
                                                "FLOOD_ON",
                                                "FLOOD_OFF",
                                                "MIST_ON",
                                                "MIST_OFF",
                                                "PALLET_SHUTTLE",
                                                "OPTIONAL_PROGRAM_STOP",
                                                "PROGRAM_STOP",
                                                "FINISH",
                                                "DISABLE_FEED_OVERRIDE",
                                                "ENABLE_FEED_OVERRIDE",
                                                "DISABLE_SPEED_OVERRIDE",
                                                "ENABLE_SPEED_OVERRIDE",
                                                "CHANGE_TOOL_NUMBER",
                                                "TURN_PROBE_ON",
                                                "TURN_PROBE_OFF",
                                                "CLEAR_MOTION_OUTPUT_BIT",
                                                "SET_MOTION_OUTPUT_BIT",
                                                "ORIENT_SPINDLE",
                                                "SET_BLOCK_DELETE"};
  return std::find(std::begin(kNames), std::end(kNames), name) != std::end(kNames);
}

class Reader {
 public:
  bool Apply(const Call& call) {
    if (call.name == "COMMENT") Compensation(call.text);
    if (Motion(call) || State(call) || IsNoMotion(call.name)) return true;
    canon_.unknown_call = std::string(call.name);
    return false;
  }
  Canon Take() { return std::move(canon_); }

 private:
  // Where LinuxCNC turns compensation on or off it goes to other points than a Haas: the first move
  // after "on", the last before "off".
  void Compensation(std::string_view text) {
    const bool on = text.find("radius compensation on") != std::string_view::npos;
    if (on) loose_ = compensates_ = true;
    if (text.find("radius compensation off") == std::string_view::npos) return;
    if (compensates_) LastInXY();
    loose_ = compensates_ = false;
  }
  void LastInXY() {
    for (auto step = canon_.steps.rbegin(); step != canon_.steps.rend(); ++step) {
      step->loose = true;
      const auto before = std::next(step);
      if (before == canon_.steps.rend() || before->end[0] != step->end[0] ||
          before->end[1] != step->end[1]) {
        return;
      }
    }
  }

  bool Motion(const Call& call) {
    const std::vector<double>& n = call.numbers;
    if (call.name == "STRAIGHT_TRAVERSE" || call.name == "STRAIGHT_FEED") {
      if (n.size() != 6) return false;
      for (std::size_t k = 0; k < 6; ++k) program_[k] = n[k];
      Send(call.name == "STRAIGHT_FEED" ? StepKind::kFeed : StepKind::kRapid);
    } else if (call.name == "ARC_FEED") {
      if (n.size() != 9) return false;
      Arc(n);
    } else if (call.name == "DWELL") {
      if (n.size() != 1) return false;
      Step step = Base(StepKind::kDwell);
      step.dwell = n[0];
      canon_.steps.push_back(step);
    } else if (call.name == "CHANGE_TOOL") {
      if (n.size() == 1) tool_ = static_cast<int>(n[0]);
      if (n.empty()) tool_ = -1;
      Send(StepKind::kToolChange);
    } else if (call.name == "PROGRAM_END") {
      canon_.ends = true;
    } else {
      return false;
    }
    return true;
  }

  bool State(const Call& call) {
    const std::vector<double>& n = call.numbers;
    if (call.name == "USE_LENGTH_UNITS") {
      SetUnit(call.text == "CANON_UNITS_INCHES" ? kMmPerInch : 1.0);
    } else if (call.name == "SET_G5X_OFFSET" && n.size() == 7) {
      Keep(n, 1, &g5x_);
    } else if (call.name == "SET_G92_OFFSET" && n.size() == 6) {
      Keep(n, 0, &g92_);
    } else if (call.name == "USE_TOOL_LENGTH_OFFSET" && n.size() == 9) {
      Keep(n, 0, &tool_offset_);
    } else if (call.name == "SET_XY_ROTATION" && n.size() == 1) {
      rotation_ = Radians(n[0]);
    } else if (call.name == "SELECT_PLANE") {
      normal_ = call.text == "CANON_PLANE_XZ" ? 1 : (call.text == "CANON_PLANE_YZ" ? 0 : 2);
    } else if (call.name == "SET_FEED_RATE" && n.size() == 1) {
      feed_ = n[0];
    } else if (call.name == "SET_FEED_MODE" && n.size() == 2) {
      per_minute_ = n[1] == 0.0;
    } else if (call.name == "START_SPINDLE_CLOCKWISE" ||
               call.name == "START_SPINDLE_COUNTERCLOCKWISE") {
      spindle_ = true;
    } else if (call.name == "STOP_SPINDLE_TURNING") {
      spindle_ = false;
    } else {
      return false;
    }
    return true;
  }

  // Program coordinates are in the active unit: a change of unit rescales them.
  void SetUnit(double mm) {
    for (std::size_t k = 0; k < 3; ++k) program_[k] *= unit_ / mm;
    // An F beside G20 or G21 was read in the old unit there; a Haas has one unit.
    if (mm != unit_) feed_ = -1.0;
    unit_ = mm;
  }
  void Keep(const std::vector<double>& n, std::size_t first, Values* offset) const {
    for (std::size_t k = 0; k < 6; ++k) (*offset)[k] = n[first + k] * (k < 3 ? unit_ : 1.0);
  }

  // Rotation turns program coordinates with the G92 shift, before the work offset (emccanon.cc,
  // rotate_and_offset_pos).
  Values Machine(const Values& program) const {
    Values machine{};
    for (std::size_t k = 0; k < 6; ++k) machine[k] = program[k] * (k < 3 ? unit_ : 1.0) + g92_[k];
    const double x = machine[0], y = machine[1];
    machine[0] = x * std::cos(rotation_) - y * std::sin(rotation_);
    machine[1] = x * std::sin(rotation_) + y * std::cos(rotation_);
    for (std::size_t k = 0; k < 6; ++k) machine[k] += g5x_[k] + tool_offset_[k];
    return machine;
  }

  Step Base(StepKind kind) const {
    Step step;
    step.kind = kind;
    step.end = Machine(program_);
    step.spindle = spindle_;
    step.tool = tool_;
    // Four digits of the unit are printed, of the position and of each offset.
    step.tolerance = 1.01e-4 * unit_ * (rotation_ == 0.0 ? 1.0 : 2.0);
    return step;
  }
  void Send(StepKind kind) {
    Step step = Base(kind);
    bool rotary = false;
    for (std::size_t k = 3; k < 6; ++k) rotary = rotary || step.end[k] != at_[k];
    if (kind == StepKind::kFeed && per_minute_ && !rotary && feed_ > 0.0)
      step.feed = feed_ * unit_ / 60.0;
    if (loose_) {
      step.loose = true;
      loose_ = step.end[0] == at_[0] && step.end[1] == at_[1];
    }
    at_ = step.end;
    canon_.steps.push_back(step);
  }

  // ARC_FEED(first_end, second_end, first_axis, second_axis, turns, axis_end, a, b, c): G18 gives Z
  // first.
  void Arc(const std::vector<double>& n) {
    const std::size_t normal = static_cast<std::size_t>(normal_);
    const std::size_t first = (normal + 1) % 3, second = (normal + 2) % 3;
    Values centre = program_;
    program_[first] = n[0];
    program_[second] = n[1];
    program_[normal] = n[5];
    for (std::size_t k = 3; k < 6; ++k) program_[k] = n[k + 3];
    centre[first] = n[2];
    centre[second] = n[3];
    const Values from = at_;
    Step step = Base(StepKind::kArc);
    const Values about = Machine(centre);
    step.centre = {about[0], about[1], about[2]};
    step.normal = normal_;
    const auto angle = [&](const Values& p) {
      return std::atan2(p[second] - about[second], p[first] - about[first]);
    };
    const double turns = n[4];
    double sweep = Degrees(angle(step.end) - angle(from));
    // The printed digits make a full circle a little more or less than one.
    const double close = Degrees(4.0 * step.tolerance /
                                 std::max(1e-3, std::hypot(step.end[first] - about[first],
                                                           step.end[second] - about[second])));
    if (turns > 0.0) {
      while (sweep <= close) sweep += 360.0;
      while (sweep > 360.0 + close) sweep -= 360.0;
      sweep += 360.0 * (turns - 1.0);
    } else {
      while (sweep >= -close) sweep -= 360.0;
      while (sweep < -360.0 - close) sweep += 360.0;
      sweep += 360.0 * (turns + 1.0);
    }
    step.sweep_deg = sweep;
    if (per_minute_ && feed_ > 0.0) step.feed = feed_ * unit_ / 60.0;
    at_ = step.end;
    canon_.steps.push_back(step);
  }

  Canon canon_;
  Values program_{}, g5x_{}, g92_{}, tool_offset_{}, at_{};
  double unit_ = 1.0;
  double rotation_ = 0.0;
  double feed_ = 0.0;
  bool per_minute_ = true;
  bool spindle_ = false;
  bool compensates_ = false, loose_ = false;
  int normal_ = 2;
  int tool_ = 0;
};

}  // namespace

Canon ReadCanon(std::string_view text) {
  Reader reader;
  while (!text.empty()) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    if (const auto call = ParseCall(text.substr(0, end)); call && !call->name.empty()) {
      if (!reader.Apply(*call)) break;
    }
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  return reader.Take();
}

std::optional<std::string> ReadText(const std::string& path) {
  // zlib reads a file that is not packed as it is.
  gzFile file = gzopen(path.c_str(), "rb");
  if (file == nullptr) return std::nullopt;
  std::string text;
  char buffer[65536];
  int count = 0;
  while ((count = gzread(file, buffer, sizeof buffer)) > 0) {
    text.append(buffer, static_cast<std::size_t>(count));
  }
  const bool good = count == 0;
  gzclose(file);
  if (!good) return std::nullopt;
  return text;
}

}  // namespace ncsim::conformance
