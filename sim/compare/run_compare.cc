// SPDX-License-Identifier: BSD-3-Clause
#include "sim/compare/run_compare.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "sim/base/text.h"
#include "sim/compare/magnitude.h"

namespace ncsim::compare {
namespace {

/// Stretches of one run that are told apart; behind them the rest is one.
constexpr int kMostFaults = 200;
/// In radii: a way that is shorter is none.
constexpr double kLeastWayBehind = 8.0;
/// In radii: what is nearer is at one place.
constexpr double kMeets = 0.25;

const Pose& EndOfFirstPiece(const Run& run) {
  std::size_t chord = 1;
  while (chord < run.chords() && run.pieces[chord] == run.pieces[0]) ++chord;
  return run.vertices[chord];
}

double End(const Run& run) { return static_cast<double>(run.chords()); }

}  // namespace

const SourcePosition& RunCompare::WhereReference(const Run& run) const {
  return (*parts_.reference)[run.pieces.front()].where;
}

void RunCompare::Compare(Run reference, Run tested, const Blame& blame) {
  for (int faults = 0;; ++faults) {
    const Walk walk = WalkTogether(reference, tested, parts_.radii);
    const bool nowhere = walk.steps.empty();
    if (!nowhere) Measure(reference, tested, walk.steps);
    if (walk.complete) return;
    const Step from = nowhere ? Step() : walk.steps.back();
    std::vector<Step> next;
    if (faults < kMostFaults) next = FindNext(reference, tested, from, parts_.radii);
    const Step to = next.empty() ? Step{End(reference), End(tested)} : next.front();
    const Step meeting = LastMeeting(reference, tested, walk.steps);
    Report({Cut(reference, from.a, to.a), Cut(tested, from.b, to.b),
            Cut(reference, meeting.a, to.a), Cut(tested, meeting.b, to.b), nowhere && faults == 0,
            blame});
    const bool at_end = to.a >= End(reference) || to.b >= End(tested);
    if (next.empty() || at_end) return;
    reference = Cut(reference, to.a, End(reference));
    tested = Cut(tested, to.b, End(tested));
  }
}

/// The last step at which both are near each other, before they have come apart by the radii.
Step RunCompare::LastMeeting(const Run& reference, const Run& tested,
                             const std::vector<Step>& steps) const {
  for (std::size_t k = steps.size(); k-- > 0;) {
    const Distance apart = Between(At(reference, steps[k].a), At(tested, steps[k].b));
    if (Ratio(apart, parts_.radii) <= kMeets) return steps[k];
  }
  return {};
}

/// Distances at the steps (they are greatest there), and the feeds of the stretches between.
void RunCompare::Measure(const Run& reference, const Run& tested, const std::vector<Step>& steps) {
  std::uint32_t piece_a = 0, piece_b = 0;
  double length = 0.0;
  const auto flush = [&] {
    if (length > kLeastWayBehind * parts_.radii.position) {
      const Piece& a = (*parts_.reference)[piece_a];
      const Piece& b = (*parts_.tested)[piece_b];
      if (a.rapid == b.rapid) {
        parts_.log->Agree();
        parts_.log->Feed(b, a);
      } else {
        ReportRapid(a, b);
      }
    }
    length = 0.0;
  };
  for (std::size_t k = 0; k < steps.size(); ++k) {
    const Step& step = steps[k];
    const Pose a = At(reference, step.a), b = At(tested, step.b);
    const Distance apart = Between(a, b);
    const std::size_t from = k > 0 ? k - 1 : k;
    const std::uint32_t in_a = reference.pieces[ChordAt(reference, steps[from].a)];
    const std::uint32_t in_b = tested.pieces[ChordAt(tested, steps[from].b)];
    const auto keep = [&](double value, Largest* largest) {
      if (value <= largest->value) return;
      *largest = {value, (*parts_.tested)[in_b].where, (*parts_.reference)[in_a].where};
    };
    keep(apart.position, parts_.position);
    keep(apart.axis, parts_.axis);
    if (k == 0) continue;
    if (in_a != piece_a || in_b != piece_b) flush();
    piece_a = in_a;
    piece_b = in_b;
    length += (b.p - At(tested, steps[k - 1].b).p).norm();
  }
  flush();
}

/// The same way, but one of the two goes it in rapid.
void RunCompare::ReportRapid(const Piece& reference, const Piece& tested) {
  Fault fault;
  fault.rule = tested.rapid ? Rule::kFeedLost : Rule::kFeedExtra;
  fault.tested = tested.where;
  fault.reference = reference.where;
  fault.blocks = {tested.where};
  const std::string other = parts_.log->Place(reference.where);
  fault.message = tested.rapid ? "a rapid, where " + other + " feeds"
                               : "a feed, where " + other + " goes in rapid";
  parts_.log->Add(fault);
}

bool RunCompare::Rests(const Run& run) const {
  return std::all_of(run.vertices.begin(), run.vertices.end(), [&](const Pose& pose) {
    return Ratio(Between(pose, run.vertices.front()), parts_.radii) <= kLeastWayBehind;
  });
}

/// Out along the tool axis and back to where it began, the feeds on that line: a retract, whatever
/// turns meanwhile.
bool RunCompare::IsDetour(const Run& tested) const {
  const Pose& at = tested.vertices.front();
  if (Ratio(Between(at, tested.vertices.back()), parts_.radii) > 2.0) return false;
  for (std::size_t chord = 0; chord < tested.chords(); ++chord) {
    if ((*parts_.tested)[tested.pieces[chord]].rapid) continue;
    for (const Pose& pose : {tested.vertices[chord], tested.vertices[chord + 1]}) {
      const Eigen::Vector3d way = pose.p - at.p;
      const double out = way.dot(at.u);
      const double aside = (way - out * at.u).norm();
      if (out < -2.0 * parts_.radii.position || aside > 2.0 * parts_.radii.position) return false;
    }
  }
  return true;
}

bool RunCompare::Touches(const Run& run, const Pose& pose) const {
  for (std::size_t chord = 0; chord < run.chords(); ++chord) {
    const bool near =
        !Near(pose, run.vertices[chord], run.vertices[chord + 1], parts_.radii).empty();
    if (near) return true;
  }
  return false;
}

std::string RunCompare::Hint(const Region& region) const {
  const Run& a = region.reference;
  const Run& b = region.tested;
  const auto one_piece = [](const Run& run) { return run.pieces.front() == run.pieces.back(); };
  const bool same_ends = Ratio(Between(a.vertices.back(), b.vertices.back()), parts_.radii) <= 2.0;
  if (region.at_start || !same_ends) return "";
  if (one_piece(b) && !one_piece(a) && !Touches(b, EndOfFirstPiece(a))) {
    return ": the point at the end of " + parts_.log->Place(WhereReference(a)) + " is left out";
  }
  const bool arcs = one_piece(a) && one_piece(b) && a.chords() > 2 && b.chords() > 2;
  const Eigen::Vector3d begin_a = a.vertices[1].p - a.vertices[0].p;
  const Eigen::Vector3d begin_b = b.vertices[1].p - b.vertices[0].p;
  if (arcs && begin_a.dot(begin_b) < -0.5 * begin_a.norm() * begin_b.norm()) {
    return ": the arc goes the other way round";
  }
  return "";
}

void RunCompare::Report(const Region& region) {
  const auto pieces = [](const Run& run, const std::vector<Piece>& all, auto&& use) {
    for (std::size_t i = 0; i < run.chords(); ++i) {
      if (i == 0 || run.pieces[i] != run.pieces[i - 1]) use(all[run.pieces[i]]);
    }
  };
  Fault fault;
  bool tested_rapid = false, reference_rapid = false;
  pieces(region.tested, *parts_.tested, [&](const Piece& piece) {
    fault.blocks.push_back(piece.where);
    tested_rapid = tested_rapid || piece.rapid;
  });
  pieces(region.reference, *parts_.reference,
         [&](const Piece& piece) { reference_rapid = reference_rapid || piece.rapid; });
  fault.tested = fault.blocks.front();
  fault.reference = WhereReference(region.reference);
  const std::string other = parts_.log->Place(fault.reference);
  if (Rests(region.reference) && !Rests(region.tested)) {
    if (IsDetour(region.tested)) {
      parts_.added->push_back({fault.tested, "a retract along the tool axis and back"});
      return;
    }
    fault.rule = Rule::kFeedExtra;
    fault.message = "feeds where " + other + " does not";
  } else if (Rests(region.tested) && !Rests(region.reference)) {
    fault.rule = Rule::kFeedLost;
    fault.message = "the feed of " + other + " is missing";
  } else if (tested_rapid && !reference_rapid) {
    fault.rule = Rule::kFeedLost;
    fault.message = "a rapid, where " + other + " feeds";
  } else if (reference_rapid && !tested_rapid) {
    fault.rule = Rule::kFeedExtra;
    fault.message = "a feed, where " + other + " goes in rapid";
  }
  fault.apart = Apart(region.whole_reference, region.whole_tested, parts_.radii);
  if (fault.rule == Rule::kPathDeviation) {
    fault.hint = Hint(region);
    if (region.at_start && region.blame.tested.line > 0) fault.tested = region.blame.tested;
    if (region.at_start && region.blame.reference.line > 0) {
      fault.reference = region.blame.reference;
    }
  }
  const auto keep = [&](double value, Largest* largest) {
    if (value <= largest->value) return;
    *largest = {value, fault.blocks.front(), WhereReference(region.reference)};
  };
  keep(fault.apart.position, parts_.position);
  keep(fault.apart.axis, parts_.axis);
  parts_.log->Add(fault);
}

}  // namespace ncsim::compare
