// SPDX-License-Identifier: BSD-3-Clause
#include "sim/control/cycles.h"

#include <algorithm>
#include <cmath>

#include "sim/base/text.h"
#include "sim/control/hole_moves.h"

namespace ncsim::control {
namespace {

using Out = HoleMoves::Out;

// Smaller pecks than this many a hole are a mistake of scale, and must not run for hours.
constexpr double kMaxPecks = 100'000.0;
constexpr double kNear = 1e-9;

std::string Name(int code) { return "G" + std::to_string(code); }

// Depths of the pecks of G73 and G83: equal by Q, falling from I by J to at least K, or one.
class Pecks {
 public:
  static std::optional<Pecks> Make(const CycleWords& words, std::string* error) {
    Pecks pecks;
    const bool by_ijk = words.i.has_value() || words.j.has_value();
    if (words.q && (by_ijk || (words.k && words.code == 83))) {
      *error = Name(words.code) + " has Q as well as " + (by_ijk ? "I or J" : "K");
      return std::nullopt;
    }
    for (const auto& word : {words.q, words.i, words.k}) {
      if (word && !(*word > 0.0)) {
        *error = Name(words.code) + " needs Q, I and K greater than 0, not " + Short(*word);
        return std::nullopt;
      }
    }
    if (words.j && !(*words.j >= 0.0)) {
      *error = Name(words.code) + " needs J not less than 0";
      return std::nullopt;
    }
    if (!words.q && !words.i && (words.j || words.k)) {
      *error = Name(words.code) + " has J or K without I or Q";
      return std::nullopt;
    }
    const double depth = words.r - words.z;
    pecks.size_ = words.q ? *words.q : words.i.value_or(depth);
    pecks.less_ = words.j.value_or(0.0);
    pecks.least_ = words.q ? *words.q : words.k.value_or(0.0);
    // All pecks but the first ones may be as small as `least`, or as the last positive one where K
    // is not given.
    const double smallest = pecks.less_ > 0.0 ? pecks.least_ : pecks.size_;
    if (pecks.Reach(depth) || smallest * kMaxPecks >= depth) return pecks;
    *error = Name(words.code) + " does not reach Z: the pecks are too small for the depth of " +
             Short(depth) + " mm";
    return std::nullopt;
  }

  double Next() {
    const double peck = size_;
    size_ = std::max(size_ - less_, least_);
    return peck;
  }

 private:
  // True when falling pecks without a least one sum up to the depth before they are nothing.
  bool Reach(double depth) const {
    if (less_ <= 0.0 || size_ / less_ > kMaxPecks) return false;
    double sum = 0.0;
    for (double peck = size_; peck > 0.0; peck -= less_) sum += peck;
    return sum >= depth;
  }

  double size_ = 0.0, less_ = 0.0, least_ = 0.0;
};

// G73: short retracts (setting 22); with K beside Q also a full one whenever the pecks since the
// last come to K.
bool ChipBreak(const CycleWords& words, const CycleSettings& settings, HoleMoves* hole,
               std::string* error) {
  std::optional<Pecks> pecks = Pecks::Make(words, error);
  if (!pecks) return false;
  const bool clear_by_k = words.q && words.k;
  double since_clear = 0.0;
  double depth = words.r;
  while (true) {
    const double peck = pecks->Next();
    depth -= peck;
    if (depth <= words.z + kNear) break;
    hole->FeedTo(depth);
    since_clear += peck;
    if (clear_by_k && since_clear >= *words.k - kNear) {
      hole->RapidTo(words.r + settings.setting52);
      since_clear = 0.0;
    }
    hole->RapidTo(std::min(depth + settings.setting22, words.r));
  }
  hole->FeedTo(words.z);
  return true;
}

// G83: full retracts to R (plus setting 52), then a rapid to setting 22 above the last depth.
bool DeepHole(const CycleWords& words, const CycleSettings& settings, HoleMoves* hole,
              std::string* error) {
  std::optional<Pecks> pecks = Pecks::Make(words, error);
  if (!pecks) return false;
  double depth = words.r;
  while (true) {
    depth -= pecks->Next();
    if (depth <= words.z + kNear) break;
    hole->FeedTo(depth);
    hole->RapidTo(words.r + settings.setting52);
    hole->RapidTo(std::min(depth + settings.setting22, words.r));
  }
  hole->FeedTo(words.z);
  return true;
}

struct ShiftVector {
  double first = 0.0, second = 0.0;
};

// G76, G77: Q in the direction of setting 27, else I and J.
ShiftVector BoringShift(const CycleWords& words, const CycleSettings& settings) {
  if (!words.q) return {words.i.value_or(0.0), words.j.value_or(0.0)};
  const double q = settings.setting27 % 2 == 0 ? *words.q : -*words.q;
  return settings.setting27 < 2 ? ShiftVector{q, 0.0} : ShiftVector{0.0, q};
}

void FineBore(const CycleWords& words, ShiftVector shift, double retract, HoleMoves* hole,
              bool spindle) {
  hole->FeedTo(words.z);
  hole->Dwell(words.dwell);
  hole->SetSpindle(false);
  const bool shifts = shift.first != 0.0 || shift.second != 0.0;
  if (shifts) hole->Shift(shift.first, shift.second);
  hole->RapidTo(retract);
  if (shifts) hole->Shift(-shift.first, -shift.second);
  hole->SetSpindle(spindle);
}

// The tool passes the bore stopped and shifted, both ways; G98 is implied.
void BackBore(const CycleWords& words, ShiftVector shift, double initial_level, HoleMoves* hole,
              bool spindle) {
  const bool shifts = shift.first != 0.0 || shift.second != 0.0;
  hole->SetSpindle(false);
  if (shifts) hole->Shift(shift.first, shift.second);
  hole->RapidTo(words.r);
  if (shifts) hole->Shift(-shift.first, -shift.second);
  hole->SetSpindle(spindle);
  hole->FeedTo(words.z);
  hole->Dwell(words.dwell);
  hole->SetSpindle(false);
  if (shifts) hole->Shift(shift.first, shift.second);
  hole->RapidTo(initial_level);
  if (shifts) hole->Shift(-shift.first, -shift.second);
  hole->SetSpindle(spindle);
}

bool CheckLevels(const CycleWords& words, std::string* error) {
  if (!std::isfinite(words.r) || !std::isfinite(words.z)) {
    *error = Name(words.code) + " needs R and Z";
    return false;
  }
  if (words.code == 77 ? words.z < words.r - kNear : words.z > words.r + kNear) {
    *error = Name(words.code) + (words.code == 77 ? " needs Z above R: Z" : " needs Z below R: Z") +
             Short(words.z) + ", R" + Short(words.r);
    return false;
  }
  return true;
}

// From R to the bottom, and out as far as `retract` where the cycle rapids out.
bool Body(const CycleWords& words, const CycleSettings& settings, double initial_level,
          double retract, bool spindle, HoleMoves* hole, std::string* error) {
  switch (words.code) {
    case 73:
      if (!ChipBreak(words, settings, hole, error)) return false;
      hole->Dwell(words.dwell);
      break;
    case 83:
      if (!DeepHole(words, settings, hole, error)) return false;
      hole->Dwell(words.dwell);
      break;
    case 74:
    case 84:
      hole->SetSpindle(true);  // The cycle starts and stops the spindle.
      hole->FeedTo(words.z);
      hole->FeedTo(words.r, words.retract_feed_factor);
      hole->SetSpindle(spindle);
      break;
    case 76:
      FineBore(words, BoringShift(words, settings), retract, hole, spindle);
      break;
    case 77:
      BackBore(words, BoringShift(words, settings), initial_level, hole, spindle);
      break;
    case 81:
      hole->FeedTo(words.z);
      break;
    case 82:
      hole->FeedTo(words.z);
      hole->Dwell(words.dwell);
      break;
    case 86:
      hole->FeedTo(words.z);
      hole->SetSpindle(false);
      hole->RapidTo(retract);
      hole->SetSpindle(spindle);
      break;
    case 85:
    case 89:
      hole->FeedTo(words.z);
      if (words.code == 89) hole->Dwell(words.dwell);
      hole->FeedTo(words.r);
      break;
    default:
      *error = Name(words.code) + " is not a canned cycle of this control";
      return false;
  }
  return true;
}

}  // namespace

std::optional<AxisValues> ExpandCycle(const CycleWords& words, const CycleSettings& settings,
                                      const Command& prototype, const AxisValues& position,
                                      const AxisValues& hole, double initial_level, const Out& out,
                                      std::string* error) {
  if (!CheckLevels(words, error)) return std::nullopt;
  if ((words.code == 73 || words.code == 83) && !Pecks::Make(words, error)) return std::nullopt;
  HoleMoves moves(prototype, position, out);
  moves.RapidInPlane(hole);
  const bool back_bore = words.code == 77;
  if (!back_bore) moves.RapidTo(words.r);
  const double retract = words.return_to_initial ? initial_level : words.r;
  if (!Body(words, settings, initial_level, retract, prototype.spindle_on, &moves, error)) {
    return std::nullopt;
  }
  if (!back_bore) moves.RapidTo(retract);
  return moves.position();
}

}  // namespace ncsim::control
