// SPDX-License-Identifier: BSD-3-Clause
#include "sim/control/sinumerik_drilling.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "sim/base/text.h"

namespace ncsim::control {
namespace {

// Smaller strokes than this many a hole are a mistake, and must not run for hours.
constexpr std::size_t kMaxStrokes = 10'000;

/// +1 where the tool drills toward smaller levels.
double OutOf(const SinumerikDrilling& words) { return words.rfp > words.depth ? 1.0 : -1.0; }

/// Of a stroke with an amount of degression: no stroke is smaller than it, and the last two share
/// what is less than twice the amount.
double DegressiveStroke(double rest, double size, double amount) {
  if (rest - size >= amount) {
    if (rest > 2.0 * amount) return size;
    return rest > amount ? 0.5 * rest : rest;
  }
  if (rest <= size) return rest;
  return rest > 2.0 * amount ? rest - amount : 0.5 * rest;
}

/// How far above the last depth the rapid back into the hole ends where _DIS1 does not say: 0.6 mm
/// up to 30 mm of depth, then a fiftieth of it, at most 7 mm.
double Reapproach(double below) {
  constexpr double kShallow = 30.0, kGap = 0.6, kMost = 7.0;
  return below <= kShallow ? kGap : std::min(below / 50.0, kMost);
}

bool DeepHole(const SinumerikDrilling& words, HoleMoves* hole, SinumerikCycleAlarm* alarm) {
  const double out = OutOf(words);
  const double total = std::abs(words.rfp - words.depth);
  const std::vector<double> depths =
      StrokeDepths(total, words.first, words.degression, words.least);
  if (depths.empty()) {
    *alarm = {61107, "the strokes of " + Short(words.first) + " mm do not reach the depth of " +
                         Short(total) + " mm"};
    return false;
  }
  for (std::size_t i = 0; i < depths.size(); ++i) {
    const bool last = i + 1 == depths.size();
    const double level = last ? words.depth : words.rfp - out * depths[i];
    hole->FeedTo(level, i == 0 ? words.first_factor : 1.0);
    hole->Dwell(last ? words.dwell_bottom : words.dwell);
    if (last) break;
    if (words.strokes == SinumerikDrilling::Strokes::kClearChips) {
      hole->RapidTo(words.rfp + out * words.sdis);
      hole->Dwell(words.dwell_top);
      const double gap = words.reapproach > 0.0 ? words.reapproach : Reapproach(depths[i]);
      hole->RapidTo(level + out * gap);
    } else {
      hole->RapidTo(level + out * words.retract);
    }
  }
  return true;
}

/// The tool follows the thread in and out, at `in` and `back` times the feed.
bool Tap(const SinumerikDrilling& words, HoleMoves* hole, SinumerikCycleAlarm* alarm) {
  const double out = OutOf(words);
  const double surface = words.rfp + out * words.sdis;
  const double total = std::abs(words.rfp - words.depth);
  const double back = words.feed_out / words.feed_in;
  std::vector<double> depths = {total};
  if (words.strokes != SinumerikDrilling::Strokes::kOne) {
    if (words.first > total) {
      *alarm = {61809, "the first stroke of " + Short(words.first) + " mm is deeper than the hole"};
      return false;
    }
    depths = StrokeDepths(total, words.first, words.first, 0.0);
  }
  for (std::size_t i = 0; i < depths.size(); ++i) {
    const bool last = i + 1 == depths.size();
    const double level = last ? words.depth : words.rfp - out * depths[i];
    hole->FeedTo(level);
    hole->Dwell(words.dwell);
    if (last) break;
    if (words.strokes == SinumerikDrilling::Strokes::kClearChips) {
      hole->FeedTo(surface, back);
      hole->Dwell(words.dwell);
    }
    hole->FeedTo(level + out * words.retract, back);
  }
  hole->FeedTo(surface, back);
  return true;
}

/// From RFP and SDIS to the bottom, and out as far as the cycle does so by its own way.
bool Body(const SinumerikDrilling& words, const AxisValues& position, bool spindle, HoleMoves* hole,
          SinumerikCycleAlarm* alarm) {
  const double surface = words.rfp + OutOf(words) * words.sdis;
  if (words.cycle == 83) return DeepHole(words, hole, alarm);
  if (words.cycle == 84 || words.cycle == 840) {
    hole->SetSpindle(true);
    const bool taps = Tap(words, hole, alarm);
    hole->SetSpindle(spindle);
    return taps;
  }
  hole->FeedTo(words.depth);
  hole->Dwell(words.dwell);
  switch (words.cycle) {
    case 85:
      hole->FeedTo(surface, words.feed_out / words.feed_in);
      break;
    case 86:
      hole->SetSpindle(false);
      if (words.lift_first != 0.0 || words.lift_second != 0.0 || words.lift_normal != 0.0) {
        hole->Shift(words.lift_first, words.lift_second, words.lift_normal);
      }
      hole->RapidTo(surface);
      hole->RapidInPlane(position);
      break;
    case 87:
    case 88:
      hole->SetSpindle(false);
      break;
    case 89:
      hole->FeedTo(surface);
      break;
    default:
      break;
  }
  return true;
}

}  // namespace

std::optional<double> HoleDepth(double rtp, double rfp, double dp, double dpr, int mode,
                                SinumerikCycleAlarm* alarm) {
  double depth = dp;
  if (mode == 1 || (mode == 0 && dpr != 0.0)) {
    if (rtp == rfp) {
      *alarm = {61101, "RTP and RFP are the same with a depth by DPR"};
      return std::nullopt;
    }
    depth = rtp > rfp ? rfp - std::abs(dpr) : rfp + std::abs(dpr);
  }
  const bool wrong_side = rtp != rfp && depth != rfp && (rtp > rfp) != (rfp > depth);
  if (!wrong_side) return depth;
  *alarm = {61101, "RFP" + Short(rfp) + " does not lie between RTP" + Short(rtp) +
                       " and the depth " + Short(depth)};
  return std::nullopt;
}

std::vector<double> StrokeDepths(double depth, double first, double degression, double least) {
  std::vector<double> depths;
  if (!(first > 0.0)) return depths;
  if (degression == 0.0) {
    degression = -1.0;
    least = first;
  }
  double at = std::min(first, depth);
  double size = first;
  depths.push_back(at);
  while (at < depth) {
    if (depths.size() >= kMaxStrokes) return {};
    const double rest = depth - at;
    double stroke = rest;
    if (degression > 0.0) {
      size = std::max(size - degression, degression);
      stroke = DegressiveStroke(rest, size, degression);
    } else {
      size = std::max(size * -degression, least);
      if (size <= rest) stroke = rest - size >= least ? size : 0.5 * rest;
    }
    at = stroke >= rest ? depth : at + stroke;
    depths.push_back(at);
  }
  return depths;
}

double CoarsePitch(double size) {
  constexpr std::array<std::pair<double, double>, 20> kPitches = {
      {{3, 0.5},  {4, 0.7},  {5, 0.8},  {6, 1.0},  {8, 1.25}, {10, 1.5}, {12, 1.75},
       {14, 2.0}, {16, 2.0}, {18, 2.5}, {20, 2.5}, {22, 2.5}, {24, 3.0}, {27, 3.0},
       {30, 3.5}, {33, 3.5}, {36, 4.0}, {39, 4.0}, {42, 4.5}, {45, 4.5}}};
  for (const auto& [thread, pitch] : kPitches) {
    if (thread == size) return pitch;
  }
  constexpr double kLargest = 48.0, kLargestPitch = 5.0;
  return size == kLargest ? kLargestPitch : 0.0;
}

std::optional<AxisValues> ExpandSinumerikDrilling(const SinumerikDrilling& words,
                                                  const Command& prototype,
                                                  const AxisValues& position,
                                                  const HoleMoves::Out& out,
                                                  SinumerikCycleAlarm* alarm) {
  if (words.depth == words.rfp) return position;
  Command start = prototype;
  start.named = 0;
  if (words.feed_in > 0.0) start.feed = words.feed_in;
  HoleMoves hole(start, position, out);
  hole.RapidTo(words.rfp + OutOf(words) * words.sdis);
  if (!Body(words, position, prototype.spindle_on, &hole, alarm)) return std::nullopt;
  // The spindle of 86 to 88 turns again with the next M3 only.
  hole.RapidTo(words.rtp);
  return hole.position();
}

}  // namespace ncsim::control
