// SPDX-License-Identifier: BSD-3-Clause
#include "sim/control/sinumerik_drilling_words.h"

#include <algorithm>
#include <cmath>

#include "sim/base/text.h"
#include "sim/base/units.h"

namespace ncsim::control {
namespace {

using Strokes = SinumerikDrilling::Strokes;

/// Digits of CYCLE83's _AMODE beyond those of times: 0 as without it; of depths 1 incremental, 2
/// absolute; of DAM 2 percent; of _DIS1 1 as given; of FRF 1 percent.
constexpr int kFirstMode = 4, kDegressionMode = 5, kReapproachMode = 6, kFactorMode = 7;

/// Reads one call. Each step returns false when it has filled in alarm or unsupported.
class ParameterReader {
 public:
  ParameterReader(const SinumerikCycleArguments& arguments, const SinumerikCycleState& state,
                  SinumerikCycleAlarm* alarm, std::string* unsupported)
      : a_(arguments), state_(state), alarm_(alarm), unsupported_(unsupported) {
    words().cycle = 0;
    for (const char c : a_.cycle().name.substr(std::string_view("CYCLE").size())) {
      words().cycle = 10 * words().cycle + (c - '0');
    }
  }
  bool Read();
  const SinumerikDrillCall& call() const { return call_; }

 private:
  SinumerikDrilling& words() { return call_.words; }
  bool Alarm(int number, std::string text) {
    *alarm_ = {number, std::move(text)};
    return false;
  }
  bool Unsupported(std::string_view parameter) {
    *unsupported_ = std::string(parameter) + " = " + Short(a_.Number(parameter));
    return false;
  }
  bool ReadModes();
  bool ReadLevels();
  bool ReadDeepHole();
  bool ReadThread();
  bool ReadCompensatedThread();
  bool ReadStop();
  bool TakePitch(double* pitch);
  double Seconds(std::string_view parameter, int unit) const;
  int Mode(int place) const { return Digit(a_.Whole("_AMODE"), place); }

  const SinumerikCycleArguments& a_;
  const SinumerikCycleState& state_;
  SinumerikCycleAlarm* alarm_;
  std::string* unsupported_;
  SinumerikDrillCall call_;
};

/// Negative times are revolutions of the spindle. `unit`: 0 by the sign, 1 seconds, 2 revolutions.
double ParameterReader::Seconds(std::string_view parameter, int unit) const {
  const double value = a_.Number(parameter);
  if (unit == 1 || (unit == 0 && value >= 0.0)) return std::abs(value);
  return state_.rpm > 0.0 ? 60.0 * std::abs(value) / state_.rpm : 0.0;
}

bool ParameterReader::Read() {
  if (!ReadModes() || !ReadLevels()) return false;
  switch (words().cycle) {
    case 83:
      return ReadDeepHole();
    case 84:
      return ReadThread();
    case 840:
      return ReadCompensatedThread();
    case 85:
      words().feed_in = a_.Number("FFR") * state_.feed_unit;
      words().feed_out = a_.Number("RFF") * state_.feed_unit;
      if (words().feed_in > 0.0 && words().feed_out > 0.0) return true;
      return Alarm(10860, "CYCLE85 needs FFR and RFF");
    case 86:
      words().lift_first = a_.Length("RPA");
      words().lift_second = a_.Length("RPO");
      words().lift_normal = a_.Length("RPAP");
      return ReadStop();
    case 87:
    case 88:
      return ReadStop();
    default:
      return true;
  }
}

/// The tail of the newer forms. Digits that are not known to mean nothing else are not guessed at.
bool ParameterReader::ReadModes() {
  if (!CheckAllZero(a_, "_GMODE", unsupported_)) return false;
  if (!CheckDisplayMode(a_, state_.plane, unsupported_)) return false;
  const long axis = a_.Whole("_AXN");
  if (axis != 0 && axis != 3) return Unsupported("_AXN");
  // The depth that is asked for must be there.
  const long mode = a_.Whole("_AMODE");
  const bool deep = words().cycle == 83;
  bool known = mode >= 0 && mode < (deep ? 100'000'000 : 100);
  for (int place = 0; place <= kDegressionMode; ++place) known = known && Mode(place) <= 2;
  known = known && (Mode(0) != 1 || a_.given("DPR")) && (Mode(0) != 2 || a_.given("DP"));
  if (deep) {
    const bool automatic = a_.Whole("VARI") == 1 && !(a_.Number("_DIS1") > 0.0);
    known = known && (Mode(kFirstMode) != 1 || a_.given("FDPR"));
    known = known && (Mode(kFirstMode) != 2 || a_.given("FDEP"));
    known = known && Mode(kReapproachMode) <= (automatic ? 0 : 1) && Mode(kFactorMode) <= 1;
    call_.reads_percent = Mode(kDegressionMode) == 2 || Mode(kFactorMode) == 1;
  }
  return known ? true : Unsupported("_AMODE");
}

bool ParameterReader::ReadLevels() {
  SinumerikDrilling& w = words();
  w.rtp = a_.Length("RTP");
  w.rfp = a_.Length("RFP");
  w.sdis = std::abs(a_.Length("SDIS"));
  if (!a_.given("DP") && !a_.given("DPR")) {
    return Alarm(61101, "neither DP nor DPR says how deep");
  }
  const auto depth = HoleDepth(w.rtp, w.rfp, a_.Length("DP"), a_.Length("DPR"), Mode(0), alarm_);
  if (!depth) return false;
  w.depth = *depth;
  w.dwell = Seconds("DTB", Mode(words().cycle == 83 ? 2 : 1));
  return true;
}

bool ParameterReader::ReadDeepHole() {
  SinumerikDrilling& w = words();
  const long way = a_.Whole("VARI");
  if (way != 0 && way != 1) return Unsupported("VARI");
  w.strokes = way == 0 ? Strokes::kBreakChips : Strokes::kClearChips;
  const int mode = Mode(kFirstMode);
  const double down = w.rfp > w.depth ? 1.0 : -1.0;
  const bool relative = mode == 1 || (mode == 0 && a_.Number("FDPR") != 0.0);
  w.first = relative ? std::abs(a_.Length("FDPR")) : down * (w.rfp - a_.Length("FDEP"));
  if (!(w.first > 0.0)) {
    return Alarm(61107, "the first drilling depth does not lie behind RFP" + Short(w.rfp));
  }
  constexpr double kLeastFactor = 0.001, kPercent = 0.01;
  const double factor = std::abs(a_.Number("FRF")) * (Mode(kFactorMode) == 1 ? kPercent : 1.0);
  w.first_factor = std::clamp(factor, kLeastFactor, 1.0);
  // A negative DAM is a factor.
  const double degression = a_.Number("DAM");
  w.degression = degression > 0.0 ? degression * a_.mm() : degression;
  if (Mode(kDegressionMode) == 2) w.degression = -kPercent * std::abs(degression);
  w.least = a_.Length("_MDEP");
  w.retract = a_.Length("_VRT") > 0.0 ? a_.Length("_VRT") : 1.0;
  w.reapproach = a_.Length("_DIS1");
  w.dwell_bottom = a_.Number("_DTD") == 0.0 ? w.dwell : Seconds("_DTD", Mode(1));
  w.dwell_top = Seconds("DTS", Mode(3));
  return true;
}

/// By PIT in the unit of _PITA (0: as programmed), or by the size of a metric thread. Negative:
/// left-hand.
bool ParameterReader::TakePitch(double* pitch) {
  const double value = a_.Number("PIT"), size = a_.Number("MPIT");
  switch (a_.Whole("_PITA")) {
    case 0:
      *pitch = value * a_.mm();
      if (size == 0.0) break;
      *pitch = std::copysign(CoarsePitch(std::abs(size)), size);
      if (value != 0.0 && value * a_.mm() != *pitch) *pitch = 0.0;
      break;
    case 1:
      *pitch = value;
      break;
    case 2:
      *pitch = value == 0.0 ? 0.0 : kMmPerInch / value;
      break;
    case 3:
      *pitch = value * kMmPerInch;
      break;
    default:
      return Unsupported("_PITA");
  }
  return *pitch != 0.0 ? true : Alarm(61001, "PIT and MPIT are no pitch of a thread");
}

bool ParameterReader::ReadThread() {
  SinumerikDrilling& w = words();
  double pitch = 0.0;
  if (!TakePitch(&pitch)) return false;
  const double speed = a_.Number("SST");
  const double back = a_.Number("SST1") > 0.0 ? a_.Number("SST1") : speed;
  if (!(speed > 0.0)) return Unsupported("SST");
  w.feed_in = std::abs(pitch) * speed / 60.0;
  w.feed_out = std::abs(pitch) * back / 60.0;
  const long way = a_.Whole("_VARI");
  if (way < 0 || way > 2) return Unsupported("_VARI");
  w.strokes = way == 0 ? Strokes::kOne : way == 1 ? Strokes::kBreakChips : Strokes::kClearChips;
  w.first = a_.Number("_DAM") != 0.0 ? std::abs(a_.Length("_DAM")) : std::abs(w.depth);
  w.retract = a_.Length("_VRT") > 0.0 ? a_.Length("_VRT") : 1.0;
  const long after = a_.Whole("SDAC");
  call_.spindle_after = after == 3 ? 1 : after == 4 ? -1 : 0;
  return true;
}

/// ENC: 0 and 20 with an encoder, 1 without by F, 11 without by the pitch.
bool ParameterReader::ReadCompensatedThread() {
  SinumerikDrilling& w = words();
  const long encoder = a_.Whole("ENC"), reverse = a_.Whole("SDR"), after = a_.Whole("SDAC");
  if (encoder != 0 && encoder != 20 && encoder != 1 && encoder != 11) return Unsupported("ENC");
  const bool turns_back = reverse == 3 || reverse == 4;
  if (!turns_back && (encoder == 1 || encoder == 11)) {
    return Alarm(61102, "SDR does not say how the spindle turns on the way back");
  }
  w.feed_in = state_.feed;
  if (encoder != 1) {
    double pitch = 0.0;
    if (!TakePitch(&pitch)) return false;
    w.feed_in = std::abs(pitch) * state_.rpm / 60.0;
  }
  w.feed_out = w.feed_in;
  if (encoder == 0) w.dwell = 0.0;
  if (turns_back) call_.spindle_after = after == 3 ? 1 : after == 4 ? -1 : 0;
  return true;
}

bool ParameterReader::ReadStop() {
  const long turning = a_.Whole("SDIR");
  if (turning != 3 && turning != 4) {
    return Alarm(61102, "SDIR does not say how the spindle turns");
  }
  call_.spindle = turning == 3 ? 1 : -1;
  call_.spindle_after = 0;
  return true;
}

}  // namespace

bool CheckAllZero(const SinumerikCycleArguments& arguments, std::string_view parameters,
                  std::string* unsupported) {
  while (!parameters.empty()) {
    const std::size_t end = std::min(parameters.find(' '), parameters.size());
    const std::string_view name = parameters.substr(0, end);
    parameters.remove_prefix(std::min(end + 1, parameters.size()));
    if (arguments.Number(name) == 0.0 && arguments.Text(name).empty()) continue;
    *unsupported = std::string(name) + " = ";
    *unsupported += arguments.Text(name).empty() ? Short(arguments.Number(name)) : "a text";
    return false;
  }
  return true;
}

bool CheckDisplayMode(const SinumerikCycleArguments& arguments, Plane plane,
                      std::string* unsupported) {
  const long mode = arguments.Whole("_DMODE");
  const int active = plane == Plane::kXY ? 1 : plane == Plane::kZX ? 2 : 3;
  if (mode == 0 || mode == active) return true;
  *unsupported = "_DMODE = " + Short(static_cast<double>(mode));
  return false;
}

std::optional<SinumerikDrillCall> ReadDrilling(const SinumerikCycleArguments& arguments,
                                               const SinumerikCycleState& state,
                                               SinumerikCycleAlarm* alarm,
                                               std::string* unsupported) {
  ParameterReader reader(arguments, state, alarm, unsupported);
  if (!reader.Read()) return std::nullopt;
  return reader.call();
}

}  // namespace ncsim::control
