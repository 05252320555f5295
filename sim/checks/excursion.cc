// SPDX-License-Identifier: BSD-3-Clause
#include "sim/checks/excursion.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <variant>
#include <vector>

namespace ncsim::checks {
namespace {

/// Boxes that one search may ask for. A path that crosses a limit needs some tens, one that touches
/// it from inside some ten thousand; only one that curves along it for a long way can need more.
constexpr int kMaxBoxes = 200000;
/// Resolution of Excursion::worst, in tolerances.
constexpr double kWorstResolution = 100.0;
constexpr int kSamples = 16;

class Search {
 public:
  Search(const motion::Motion& motion, const Bound& bound) : motion_(&motion), bound_(bound) {}

  double Excess(double s) const {
    return bound_.sense * (motion_->At(s)[bound_.joint] - bound_.limit);
  }
  bool Outside(double s) const { return !(Excess(s) <= bound_.tolerance); }  // NaN is outside.

  /// Upper bound of Excess over [s0, s1].
  double BoxExcess(double s0, double s1) const {
    const motion::JointBox box = motion::Box(*motion_, {s0, s1, 0.0, 0.0});
    const double q = bound_.sense > 0.0 ? box.upper[bound_.joint] : box.lower[bound_.joint];
    return bound_.sense * (q - bound_.limit);
  }

  /// The crossing between a point inside and a later one outside.
  double Crossing(double inside, double outside) const {
    for (int i = 0; i < 60 && outside - inside > 1e-15; ++i) {
      const double middle = 0.5 * (inside + outside);
      (Outside(middle) ? outside : inside) = middle;
    }
    return outside;
  }

  Excursion Monotone() const {
    Excursion result;
    if (!Outside(0.0) && !Outside(1.0)) return result;
    result.outcome = Excursion::Outcome::kOutside;
    result.s = Outside(0.0) ? 0.0 : Crossing(0.0, 1.0);
    result.worst = std::max(Excess(0.0), Excess(1.0));
    return result;
  }

  Excursion Curved(double known_worst) const {
    Excursion result;
    if (Outside(0.0)) {
      result.outcome = Excursion::Outcome::kOutside;
    } else {
      FindFirst(&result);
    }
    if (result.outcome == Excursion::Outcome::kOutside) result.worst = Worst(known_worst);
    return result;
  }

 private:
  using Piece = std::pair<double, double>;

  /// Depth first from the left, so that the first piece with a point outside holds the first
  /// excursion.
  void FindFirst(Excursion* result) const {
    std::vector<Piece> open{{0.0, 1.0}};
    for (int boxes = 0; !open.empty(); ++boxes) {
      const auto [s0, s1] = open.back();
      open.pop_back();
      if (BoxExcess(s0, s1) <= bound_.tolerance) continue;
      const double middle = 0.5 * (s0 + s1);
      if (boxes >= kMaxBoxes || middle <= s0 || middle >= s1) {
        result->s = s0;
        result->outcome = Excursion::Outcome::kUnproven;
        return;
      }
      // s0 is inside: it is 0, or the end of a piece that has been dealt with.
      if (s1 - s0 < 1e-6 && (Outside(middle) || Outside(s1))) {
        result->s = Crossing(s0, Outside(middle) ? middle : s1);
        result->outcome = Excursion::Outcome::kOutside;
        return;
      }
      open.emplace_back(middle, s1);
      open.emplace_back(s0, middle);
    }
  }

  /// Branch and bound, from the best of some samples.
  double Worst(double known_worst) const {
    double best = known_worst;
    for (int i = 0; i <= kSamples; ++i) {
      best = std::max(best, Excess(static_cast<double>(i) / kSamples));
    }
    std::vector<Piece> open{{0.0, 1.0}};
    for (int boxes = 0; boxes < kMaxBoxes && !open.empty(); ++boxes) {
      const auto [s0, s1] = open.back();
      open.pop_back();
      if (BoxExcess(s0, s1) <= best + kWorstResolution * bound_.tolerance) continue;
      const double middle = 0.5 * (s0 + s1);
      if (middle <= s0 || middle >= s1) continue;
      best = std::max(best, Excess(middle));
      open.emplace_back(s0, middle);
      open.emplace_back(middle, s1);
    }
    return best;
  }

  const motion::Motion* motion_;
  Bound bound_;
};

}  // namespace

bool IsMonotone(const motion::Motion& motion) {
  if (const auto* curve = std::get_if<motion::TcpCurve>(&motion.path)) {
    if (curve->arc) return false;
    const motion::JointVector turn = curve->q1 - curve->q0;
    const std::vector<int>& rotary = curve->frame->control.rotary();
    return std::all_of(rotary.begin(), rotary.end(), [&](int joint) { return turn[joint] == 0.0; });
  }
  return !std::holds_alternative<motion::AxisArc>(motion.path);
}

Excursion FindExcursion(const motion::Motion& motion, const Bound& bound, double known_worst) {
  const Search search(motion, bound);
  return IsMonotone(motion) ? search.Monotone() : search.Curved(known_worst);
}

}  // namespace ncsim::checks
