// SPDX-License-Identifier: BSD-3-Clause
// The drilling cycles of the SINUMERIK as moves of one hole, where the tool stands (Programming
// Guide Cycles 11/2002, "Drilling cycles"; NC programming 12/2019, "Programming cycles
// externally"). Pure: no modal state.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "sim/control/hole_moves.h"

namespace ncsim::control {

/// Of an alarm of the cycles (61000 ff.).
struct SinumerikCycleAlarm {
  int number = 0;
  std::string text;
};

/// Levels absolute along the plane's normal axis; mm, mm/s, s.
struct SinumerikDrilling {
  int cycle = 81;                        ///< 81 to 89, 840.
  double rtp = 0.0;                      ///< Where the tool ends.
  double rfp = 0.0;                      ///< The surface.
  double sdis = 0.0;                     ///< How far before it the rapid ends; not less than 0.
  double depth = 0.0;                    ///< Of the hole (DP, or RFP and DPR: HoleDepth()).
  double dwell = 0.0;                    ///< DTB.
  double feed_in = 0.0, feed_out = 0.0;  ///< 85: FFR, RFF; 84, 840: pitch times speed.
  // 83, and 84 in several strokes.
  enum class Strokes { kOne, kBreakChips, kClearChips } strokes = Strokes::kOne;
  double first = 0.0;         ///< Depth of the first stroke below the surface, > 0.
  double degression = 0.0;    ///< DAM: > 0 an amount, < 0 a factor, 0 none.
  double least = 0.0;         ///< _MDEP.
  double first_factor = 1.0;  ///< FRF.
  double retract = 0.0;       ///< _VRT.
  double reapproach = 0.0;    ///< _DIS1; 0: the cycle works it out.
  double dwell_bottom = 0.0, dwell_top = 0.0;  ///< _DTD, DTS.
  // 86: RPA, RPO, RPAP.
  double lift_first = 0.0, lift_second = 0.0, lift_normal = 0.0;
};

/// The depth that DP and DPR mean. `mode`, the units of _AMODE: 0 DPR where it is not 0, else DP; 1
/// DPR; 2 DP. nullopt with alarm 61101.
std::optional<double> HoleDepth(double rtp, double rfp, double dp, double dpr, int mode,
                                SinumerikCycleAlarm* alarm);

/// How deep below the surface each stroke of CYCLE83 goes; the last is `depth`. Empty: it does not
/// get there.
std::vector<double> StrokeDepths(double depth, double first, double degression, double least);

/// ISO coarse pitch of a metric thread of this size (MPIT, 3 to 48), mm; 0 for none.
double CoarsePitch(double size);

/// Returns the position after it, or nullopt with `alarm`.
std::optional<AxisValues> ExpandSinumerikDrilling(const SinumerikDrilling& words,
                                                  const Command& prototype,
                                                  const AxisValues& position,
                                                  const HoleMoves::Out& out,
                                                  SinumerikCycleAlarm* alarm);

}  // namespace ncsim::control
