// SPDX-License-Identifier: BSD-3-Clause
#include "tests/conformance/canon_step.h"

#include <algorithm>
#include <cmath>

#include "sim/base/text.h"

namespace ncsim::conformance {
namespace {

using Position = std::array<double, 6>;

constexpr double kStill = 1e-6;
constexpr double kDegrees = 1e-4;
constexpr double kRelativeFeed = 1e-3;
constexpr std::size_t kReach = 60;

bool Near(double a, double b, double tolerance) { return std::abs(a - b) <= tolerance; }

double Tolerance(std::size_t axis, const Step& reference) {
  return axis < 3 ? reference.tolerance : kDegrees;
}

// Drops what moves nothing; a full circle moves.
std::vector<Step> Moving(const std::vector<Step>& steps) {
  std::vector<Step> moving;
  Position at{};
  for (const Step& step : steps) {
    if (step.kind == StepKind::kDwell) {
      if (step.dwell > 0.0) moving.push_back(step);
      continue;
    }
    const bool still = std::equal(at.begin(), at.end(), step.end.begin(),
                                  [](double a, double b) { return Near(a, b, kStill); });
    at = step.end;
    if (!still || step.kind == StepKind::kArc || step.kind == StepKind::kToolChange) {
      moving.push_back(step);
    }
  }
  return moving;
}

std::string Facts(const Step& ours, const Step& reference) {
  if (reference.feed >= 0.0 && ours.feed >= 0.0 &&
      !Near(ours.feed, reference.feed, kRelativeFeed * reference.feed + 1e-6)) {
    return "feed " + Short(ours.feed * 60.0) + ", reference " + Short(reference.feed * 60.0) +
           " mm/min";
  }
  if (ours.spindle != reference.spindle && ours.kind != StepKind::kRapid) {
    return ours.spindle ? "spindle on, reference off" : "spindle off, reference on";
  }
  if (reference.tool >= 0 && ours.tool >= 0 && ours.tool != reference.tool) {
    return "tool " + std::to_string(ours.tool) + ", reference " + std::to_string(reference.tool);
  }
  return "";
}

std::string ArcDifference(const Step& ours, const Step& reference, bool any_sweep) {
  if (ours.normal != reference.normal) return "plane of the arc";
  for (int i = 0; i < 3; ++i) {
    if (i != ours.normal && !Near(ours.centre[i], reference.centre[i], 2.0 * reference.tolerance)) {
      return "centre of the arc";
    }
  }
  const Eigen::Vector3d end(reference.end[0], reference.end[1], reference.end[2]);
  Eigen::Vector3d r = end - reference.centre;
  r[reference.normal] = 0.0;
  const double slack = kDegrees + 4.0 * reference.tolerance / std::max(r.norm(), 1e-3) * 57.3;
  if (!any_sweep && !Near(ours.sweep_deg, reference.sweep_deg, slack)) {
    return "sweep " + Short(ours.sweep_deg) + ", reference " + Short(reference.sweep_deg) + " deg";
  }
  return "";
}

// Walks both lists.
class Walk {
 public:
  Walk(std::vector<Step> ours, std::vector<Step> reference)
      : ours_(std::move(ours)), reference_(std::move(reference)) {}

  Comparison Run() {
    result_.steps = static_cast<int>(reference_.size());
    while (!lost_ && (i_ < ours_.size() || j_ < reference_.size())) Next();
    result_.agree = result_.difference.empty();
    return result_;
  }

 private:
  void Next() {
    if (SkipToolChange()) return;
    const bool have_both = i_ < ours_.size() && j_ < reference_.size();
    const std::string difference = have_both ? Difference() : "one program is longer";
    if (difference.empty()) {
      Advance(&ours_at_, ours_[i_++]);
      Advance(&reference_at_, reference_[j_++]);
      ++result_.agreed;
      return;
    }
    if (SkipReturn() || SkipTiny()) return;
    Note(difference);
    Align();
  }

  // Keeps the first difference.
  void Note(const std::string& difference) {
    if (!result_.difference.empty()) return;
    result_.difference =
        difference + ": " + (i_ < ours_.size() ? ToText(ours_[i_]) : std::string("end")) +
        ", reference " + (j_ < reference_.size() ? ToText(reference_[j_]) : std::string("end"));
    result_.line = i_ < ours_.size() ? ours_[i_].line : 0;
  }

  // Goes on at the nearest pair of steps that end alike.
  void Align() {
    free_ = {};
    for (std::size_t skipped = 1; skipped <= kReach; ++skipped) {
      for (std::size_t a = 0; a <= skipped; ++a) {
        const std::size_t i = i_ + a, j = j_ + skipped - a;
        if (i >= ours_.size() || j >= reference_.size() || !Alike(ours_[i], reference_[j]))
          continue;
        if (i > i_) Advance(&ours_at_, ours_[i - 1]);
        if (j > j_) Advance(&reference_at_, reference_[j - 1]);
        i_ = i;
        j_ = j;
        return;
      }
    }
    lost_ = true;
  }
  static bool Alike(const Step& a, const Step& b) {
    if (a.kind != b.kind || a.kind == StepKind::kDwell) return false;
    for (std::size_t k = 0; k < 6; ++k) {
      if (!Near(a.end[k], b.end[k], Tolerance(k, b))) return false;
    }
    return true;
  }

  static void Advance(Position* at, const Step& step) {
    if (step.kind != StepKind::kDwell) *at = step.end;
  }

  bool SkipToolChange() {
    if (i_ < ours_.size() && ours_[i_].kind == StepKind::kToolChange) {
      Advance(&ours_at_, ours_[i_++]);
    } else if (j_ < reference_.size() && reference_[j_].kind == StepKind::kToolChange) {
      ++j_;
      ++result_.agreed;
    } else {
      return false;
    }
    for (std::size_t k = 0; k < 6; ++k)
      free_[k] = free_[k] || !Near(ours_at_[k], reference_at_[k], 1e-4);
    return true;
  }

  // After a tool change one of the two may have to go where the other stands already.
  bool SkipReturn() {
    if (std::find(free_.begin(), free_.end(), true) == free_.end()) return false;
    if (i_ < ours_.size() && Reaches(ours_[i_], ours_at_, reference_at_)) {
      Advance(&ours_at_, ours_[i_++]);
      return true;
    }
    if (j_ < reference_.size() && Reaches(reference_[j_], reference_at_, ours_at_)) {
      Advance(&reference_at_, reference_[j_++]);
      ++result_.agreed;
      return true;
    }
    return false;
  }
  bool Reaches(const Step& step, const Position& from, const Position& goal) {
    if (step.kind == StepKind::kDwell || step.kind == StepKind::kArc) return false;
    for (std::size_t k = 0; k < 6; ++k) {
      if (Near(step.end[k], from[k], kStill)) continue;
      if (!free_[k] || !Near(step.end[k], goal[k], 2e-3)) return false;
      free_[k] = false;
    }
    return true;
  }

  // A move below the printed digits may be there in one list only.
  bool SkipTiny() {
    if (reference_.empty()) return false;
    const double tiny = reference_.front().tolerance;
    if (i_ < ours_.size() && Tiny(ours_[i_], ours_at_, tiny)) {
      Advance(&ours_at_, ours_[i_++]);
      return true;
    }
    if (j_ < reference_.size() && Tiny(reference_[j_], reference_at_, tiny)) {
      Advance(&reference_at_, reference_[j_++]);
      ++result_.agreed;
      return true;
    }
    return false;
  }
  static bool Tiny(const Step& step, const Position& from, double tiny) {
    if (step.kind != StepKind::kRapid && step.kind != StepKind::kFeed) return false;
    for (std::size_t k = 0; k < 6; ++k) {
      if (!Near(step.end[k], from[k], tiny)) return false;
    }
    return true;
  }

  std::string Difference() {
    const Step& a = ours_[i_];
    const Step& b = reference_[j_];
    if (a.kind != b.kind) return "kind";
    if (a.kind == StepKind::kDwell) return Near(a.dwell, b.dwell, 1e-4) ? "" : "dwell";
    std::array<bool, 6> freed = free_;
    bool loose = false;
    for (std::size_t k = 0; k < 6; ++k) {
      if (Near(a.end[k], b.end[k], Tolerance(k, b))) {
        freed[k] = false;
      } else if (b.loose && k < 2) {
        loose = freed[k] = true;
      } else if (!(free_[k] && Near(a.end[k], ours_at_[k], kStill) &&
                   Near(b.end[k], reference_at_[k], kStill))) {
        return std::string("end of ") + "XYZABC"[k];
      }
    }
    if (a.kind == StepKind::kArc) {
      // Where the arc starts is the business of the control too after such an end.
      const bool any_start = j_ > 0 && reference_[j_ - 1].loose;
      if (std::string text = ArcDifference(a, b, any_start || b.loose); !text.empty()) return text;
    }
    std::string facts = Facts(a, b);
    if (facts.empty()) free_ = freed;
    if (facts.empty() && loose) ++result_.loose;
    return facts;
  }

  const std::vector<Step> ours_, reference_;
  std::size_t i_ = 0, j_ = 0;
  bool lost_ = false;  // No place found where the two meet again.
  Position ours_at_{}, reference_at_{};
  std::array<bool, 6> free_{};  // Axes that stand at different places since a tool change.
  Comparison result_;
};

}  // namespace

std::string ToText(const Step& step) {
  static constexpr const char* kNames[] = {"rapid", "feed", "arc", "dwell", "tool change"};
  std::string text = kNames[static_cast<int>(step.kind)];
  if (step.kind == StepKind::kDwell) return text + " " + Short(step.dwell) + " s";
  for (std::size_t k = 0; k < 6; ++k) {
    if (k < 3 || step.end[k] != 0.0) text += std::string(" ") + "XYZABC"[k] + Short(step.end[k], 3);
  }
  if (step.kind == StepKind::kArc) text += " by " + Short(step.sweep_deg, 2) + " deg";
  return text;
}

Comparison Compare(const std::vector<Step>& ours, const std::vector<Step>& reference) {
  return Walk(Moving(ours), Moving(reference)).Run();
}

}  // namespace ncsim::conformance
