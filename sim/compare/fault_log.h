// SPDX-License-Identifier: BSD-3-Clause
// Faults in the order of the program that is tested, one finding a cause: what goes on from block
// to block, with nothing right in between, is one.
#pragma once

#include <string>
#include <vector>

#include "sim/base/run_finding.h"
#include "sim/compare/pose.h"
#include "sim/compare/toolpath.h"

namespace ncsim::compare {

/// What the two programs may differ in.
struct Tolerances {
  double position = 0.006;            ///< mm
  double angle = 1.7453292519943e-4;  ///< rad
  double feed_ratio = 0.01;
  double feed_resolution = 0.5 / 60.0;  ///< mm/s: half of the last digit of F.
};

double AngleOf(double axis_distance);
double AxisDistance(double angle);

/// A stretch where the two programs go different ways.
struct Fault {
  Rule rule = Rule::kPathDeviation;
  SourcePosition tested, reference;    ///< Where it begins.
  std::vector<SourcePosition> blocks;  ///< Of the tested program, in order.
  std::string message;                 ///< "": made of the distance.
  /// Of runs that are missing: the last block. Line 0: no such thing.
  SourcePosition missing_to;
  std::string hint;  ///< After the message.
  Distance apart;
};

class FaultLog {
 public:
  FaultLog(const Tolerances& tolerances, const SourceFiles& files)
      : tolerances_(tolerances), files_(&files) {}

  void Add(const Fault& fault);
  /// The programs agree on the way of a feed: an open fault has ended.
  void Agree();
  /// The feeds of a stretch; equal ones end an open fault.
  void Feed(const Piece& tested, const Piece& reference);
  std::vector<Finding> Take();

  /// "dome.nc:120", without the folder.
  std::string Place(const SourcePosition& where) const;

 private:
  std::string Message() const;

  const Tolerances tolerances_;
  const SourceFiles* files_;
  std::vector<Finding> findings_;
  RunFinding run_;
  Fault open_;
  RunFinding feed_run_;
  double feed_factor_ = 0.0;
};

}  // namespace ncsim::compare
