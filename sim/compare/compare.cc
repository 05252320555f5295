// SPDX-License-Identifier: BSD-3-Clause
#include "sim/compare/compare.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>

#include "sim/base/text.h"
#include "sim/compare/align.h"

namespace ncsim::compare {
namespace {

/// Of the tolerances.
constexpr double kChordShare = 1.0 / 64.0;
/// Pairs of runs that are tried for one that stands elsewhere.
constexpr std::size_t kMostMoves = 1'000'000;

std::string Text(const Pose& pose) {
  return "X" + Fixed(pose.p.x(), 3) + " Y" + Fixed(pose.p.y(), 3) + " Z" + Fixed(pose.p.z(), 3);
}

/// The places of ends that both have, in order: the longest common subsequence.
std::vector<RunPair> CommonEnds(const std::vector<RapidEnd>& a, const std::vector<RapidEnd>& b,
                                const Radii& radii) {
  std::vector<RunPair> common;
  const std::size_t n = a.size(), m = b.size();
  if (n * m > kMostMoves) return common;
  std::vector<std::uint32_t> length((n + 1) * (m + 1), 0);
  const auto at = [&](std::size_t x, std::size_t y) -> std::uint32_t& {
    return length[x * (m + 1) + y];
  };
  for (std::size_t x = n; x-- > 0;) {
    for (std::size_t y = m; y-- > 0;) {
      at(x, y) = Within(a[x].pose, b[y].pose, radii) ? at(x + 1, y + 1) + 1
                                                     : std::max(at(x + 1, y), at(x, y + 1));
    }
  }
  for (std::size_t x = 0, y = 0; x < n && y < m;) {
    if (Within(a[x].pose, b[y].pose, radii)) {
      common.push_back({x++, y++});
    } else {
      ++(at(x + 1, y) >= at(x, y + 1) ? x : y);
    }
  }
  return common;
}

class Comparer {
 public:
  Comparer(Toolpath reference, Toolpath tested, const Tolerances& tolerances,
           const SourceFiles& files)
      : a_(std::move(reference)), b_(std::move(tested)), log_(tolerances, files) {
    loose_ = {a_.chord_error.position + b_.chord_error.position,
              a_.chord_error.axis + b_.chord_error.axis};
    const double axis = AxisDistance(tolerances.angle);
    // Where a motion's chords are poor it is compared all the same, and the verdict says so.
    radii_ = {std::max(tolerances.position - loose_.position, 0.5 * tolerances.position),
              std::max(axis - loose_.axis, 0.5 * axis)};
    poor_ = !(loose_.position <= 0.5 * tolerances.position && loose_.axis <= 0.5 * axis);
  }

  Comparison Compare() {
    NoteClosedGaps();
    rests_a_ = TakeRests(&a_, radii_);
    rests_b_ = TakeRests(&b_, radii_);
    const std::vector<Block> blocks = Align(a_.runs, b_.runs, radii_);
    FindMoved(blocks);
    bool alike = false;  // the run before
    for (const Block& block : blocks) {
      if (block.same_ends) {
        HoldRapids(block, alike);
        HoldRuns(block.a0, block.b0);
      } else {
        HoldBlock(block);
      }
      alike = block.same_ends;
    }
    NoteDwells();
    Finish();
    return std::move(result_);
  }

 private:
  RunCompareParts Parts() {
    return {&a_.pieces, &b_.pieces, radii_, &log_, &result_.added, &position_, &axis_};
  }

  void HoldRuns(std::size_t i, std::size_t j) {
    RunCompare(Parts()).Compare(a_.runs[i], b_.runs[j], BlameFor(i, j));
    last_a_ = WhereOf(a_, a_.runs[i].pieces.back());
    last_b_ = WhereOf(b_, b_.runs[j].pieces.back());
    ++result_.runs;
  }

  /// A stretch in which the programs have other runs: as one, with the gaps closed, where its ends
  /// are the same; else run by run.
  void HoldBlock(const Block& block) {
    std::vector<std::size_t> of_a, of_b;
    for (std::size_t i = block.a0; i < block.a1; ++i) {
      if (moved_a_.count(i) == 0) of_a.push_back(i);
    }
    for (std::size_t j = block.b0; j < block.b1; ++j) {
      if (moved_b_.count(j) == 0)
        of_b.push_back(j);
      else
        Moved(moved_b_[j], j);
    }
    const bool whole = of_a.size() == block.a1 - block.a0 && of_b.size() == block.b1 - block.b0;
    if (whole && !of_a.empty() && !of_b.empty() && of_a.size() != of_b.size()) {
      const Run a = Join(a_, block.a0, block.a1, &a_.pieces);
      const Run b = Join(b_, block.b0, block.b1, &b_.pieces);
      if (SameEnds(a, b, radii_)) {
        RunCompare(Parts()).Compare(a, b, {});
        last_a_ = WhereOf(a_, a.pieces.back());
        last_b_ = WhereOf(b_, b.pieces.back());
        ++result_.runs;
        return;
      }
    }
    for (const RunPair& pair : PairByEnds(a_.runs, b_.runs, of_a, of_b, radii_)) {
      if (pair.b == RunPair::kNone) {
        const Run& run = a_.runs[pair.a];
        const std::optional<Run> rest = TakeRest(run, block.b0, block.b1, &rests_b_);
        rest ? RunCompare(Parts()).Compare(run, *rest, {}) : Lost(pair.a);
      } else if (pair.a == RunPair::kNone) {
        const Run& run = b_.runs[pair.b];
        const std::optional<Run> rest = TakeRest(run, block.a0, block.a1, &rests_a_);
        rest ? RunCompare(Parts()).Compare(*rest, run, {}) : Extra(pair.b);
      } else {
        HoldRuns(pair.a, pair.b);
      }
    }
  }

  /// Takes what the other program has of a run that is hardly longer than the tolerance: there it
  /// is shorter.
  std::optional<Run> TakeRest(const Run& run, std::size_t begin, std::size_t end,
                              std::vector<Rest>* rests) const {
    const auto same = [&](const Rest& rest) {
      return begin <= rest.before && rest.before <= end && SameEnds(rest.run, run, radii_);
    };
    const auto found = std::find_if(rests->begin(), rests->end(), same);
    if (found == rests->end()) return std::nullopt;
    Run taken = std::move(found->run);
    rests->erase(found);
    return taken;
  }

  static SourcePosition WhereOf(const Toolpath& path, std::uint32_t piece) {
    return path.pieces[piece].where;
  }

  /// The blocks that lead to a start of a run that is not the reference's: those that turned the
  /// tool last, where its axis is wrong; else the first one of the tested program that goes
  /// elsewhere.
  Blame BlameFor(std::size_t i, std::size_t j) const {
    const std::vector<RapidEnd>&of_a = a_.gaps[i].ends, &of_b = b_.gaps[j].ends;
    const Pose &wanted = a_.runs[i].vertices.front(), &found = b_.runs[j].vertices.front();
    Blame blame;
    if (Within(wanted, found, radii_)) return blame;
    const auto last_turn = [](const std::vector<RapidEnd>& ends) {
      const auto turn =
          std::find_if(ends.rbegin(), ends.rend(), [](const RapidEnd& end) { return end.turns; });
      return turn == ends.rend() ? SourcePosition() : turn->where;
    };
    if (Between(wanted, found).axis > radii_.axis) blame = {last_turn(of_b), last_turn(of_a)};
    if (blame.tested.line > 0 || of_b.empty()) return blame;
    const std::vector<RunPair> common = CommonEnds(of_a, of_b, radii_);
    const std::size_t first = common.empty() ? of_b.size() - 1 : common.back().b + 1;
    blame.tested = of_b[std::min(first, of_b.size() - 1)].where;
    return blame;
  }

  void Lost(std::size_t i) {
    const Run& run = a_.runs[i];
    Fault fault;
    fault.rule = Rule::kFeedLost;
    fault.tested = last_b_;
    if (fault.tested.line == 0 && !b_.pieces.empty()) fault.tested = b_.pieces.front().where;
    fault.reference = WhereOf(a_, run.pieces.front());
    fault.missing_to = WhereOf(a_, run.pieces.back());
    log_.Add(fault);
  }

  void Extra(std::size_t j) {
    const Run& run = b_.runs[j];
    Fault fault;
    fault.rule = Rule::kFeedExtra;
    fault.message = "a feed that " + log_.Place({file_a(), 0, 0}) + " does not have";
    fault.tested = WhereOf(b_, run.pieces.front());
    fault.reference = last_a_;
    for (const std::uint32_t piece : run.pieces) fault.blocks.push_back(WhereOf(b_, piece));
    log_.Add(fault);
    last_b_ = WhereOf(b_, run.pieces.back());
  }

  void Moved(std::size_t i, std::size_t j) {
    const Run& run = b_.runs[j];
    Fault fault;
    fault.rule = Rule::kFeedOrder;
    fault.reference = WhereOf(a_, a_.runs[i].pieces.front());
    fault.message = "the feed of " + log_.Place(fault.reference) + " comes in another place";
    fault.tested = WhereOf(b_, run.pieces.front());
    for (const std::uint32_t piece : run.pieces) fault.blocks.push_back(WhereOf(b_, piece));
    log_.Add(fault);
  }

  /// Runs that stand elsewhere in the tested program than in the reference.
  void FindMoved(const std::vector<Block>& blocks) {
    std::vector<std::size_t> of_a, of_b;
    for (const Block& block : blocks) {
      if (block.same_ends) continue;
      for (std::size_t i = block.a0; i < block.a1; ++i) of_a.push_back(i);
      for (std::size_t j = block.b0; j < block.b1; ++j) of_b.push_back(j);
    }
    if (of_a.size() * of_b.size() > kMostMoves) return;
    for (const std::size_t i : of_a) {
      for (const std::size_t j : of_b) {
        if (moved_b_.count(j) > 0 || !SameEnds(a_.runs[i], b_.runs[j], radii_)) continue;
        if (!WalkTogether(a_.runs[i], b_.runs[j], radii_).complete) continue;
        moved_a_.insert(i);
        moved_b_[j] = i;
        break;
      }
    }
  }

  /// Each rapid of the reference between two feeds that both have should end where one of the
  /// tested program ends. Not at tool changes: where machines change tools is their own.
  void HoldRapids(const Block& block, bool between_feeds) {
    const Gap &a = a_.gaps[block.a0], &b = b_.gaps[block.b0];
    if (!between_feeds || a.tool_change || b.tool_change) return;
    const std::vector<RunPair> common = CommonEnds(a.ends, b.ends, radii_);
    std::size_t next = 0;
    for (std::size_t x = 0; x < a.ends.size(); ++x) {
      if (next < common.size() && common[next].a == x) {
        ++next;
        continue;
      }
      if (lost_rapids_++ > 0) continue;
      const SourcePosition where =
          b.ends.empty() ? WhereOf(b_, b_.runs[block.b0].pieces.front()) : b.ends.front().where;
      lost_rapid_ = MakeFinding(Rule::kRapidEnd, where,
                                "no rapid ends at " + Text(a.ends[x].pose) + ", where that of " +
                                    log_.Place(a.ends[x].where) + " does");
      lost_rapid_.other = a.ends[x].where;
    }
    if (b.ends.size() == common.size()) return;
    if (added_rapids_ == 0) first_added_ = b.ends.front().where;
    added_rapids_ += b.ends.size() - common.size();
  }

  void NoteClosedGaps() {
    const std::vector<RapidEnd> of_a = CloseGaps(&a_, radii_), of_b = CloseGaps(&b_, radii_);
    const std::vector<RunPair> common = CommonEnds(of_a, of_b, radii_);
    std::size_t next = 0;
    for (std::size_t y = 0; y < of_b.size(); ++y) {
      if (next < common.size() && common[next].b == y) {
        ++next;
      } else {
        result_.added.push_back(
            {of_b[y].where, "rapids away from the feed and back to the same place"});
      }
    }
  }

  void NoteDwells() {
    const std::size_t more = b_.dwells.size() - std::min(b_.dwells.size(), a_.dwells.size());
    if (more == 0) return;
    result_.added.push_back({b_.dwells.front(), Count(more, "dwell")});
  }

  static std::string Count(std::size_t number, const std::string& singular) {
    return std::to_string(number) + " " + singular + (number == 1 ? "" : "s");
  }

  void Finish() {
    for (const Run& run : a_.runs) {
      result_.feed_length += Length(run, 0.0, static_cast<double>(run.chords()));
    }
    if (added_rapids_ > 0) {
      result_.added.push_back({first_added_, Count(added_rapids_, "rapid") + " between feeds"});
    }
    result_.findings = log_.Take();
    if (poor_) {
      result_.findings.push_back(MakeFinding(
          Rule::kUncertified, {}, "a motion could not be followed within the tolerance"));
    }
    if (lost_rapids_ > 1) {
      lost_rapid_.message += " (and " + std::to_string(lost_rapids_ - 1) + " more)";
    }
    if (lost_rapids_ > 0) result_.findings.push_back(lost_rapid_);
    result_.position = position_;
    result_.position.value += loose_.position;
    result_.angle = axis_;
    result_.angle.value = AngleOf(axis_.value + loose_.axis);
  }

  int file_a() const { return a_.pieces.empty() ? 0 : a_.pieces.front().where.file; }

  Toolpath a_, b_;
  FaultLog log_;
  Comparison result_;
  Distance loose_;
  Radii radii_;
  bool poor_ = false;
  Largest position_, axis_;
  std::vector<Rest> rests_a_, rests_b_;
  std::set<std::size_t> moved_a_;
  std::map<std::size_t, std::size_t> moved_b_;
  SourcePosition last_a_, last_b_;  // where the last runs that were held end
  Finding lost_rapid_;
  std::size_t lost_rapids_ = 0, added_rapids_ = 0;
  SourcePosition first_added_;
};

}  // namespace

Distance ChordErrorFor(const Tolerances& tolerances) {
  return {kChordShare * tolerances.position, kChordShare * AxisDistance(tolerances.angle)};
}

Comparison Compare(Toolpath reference, Toolpath tested, const Tolerances& tolerances,
                   const SourceFiles& files) {
  return Comparer(std::move(reference), std::move(tested), tolerances, files).Compare();
}

}  // namespace ncsim::compare
