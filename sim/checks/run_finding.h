// SPDX-License-Identifier: BSD-3-Clause
// A fault that goes on from block to block is one finding, placed where it starts.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "sim/base/finding.h"
#include "sim/machine/machine.h"
#include "sim/motion/motion.h"

namespace ncsim::checks {

/// A finding at parameter s of a motion, with the axes' positions and the time there.
Finding FindingAt(const machine::Machine& machine, Rule rule, const motion::Motion& motion,
                  double s, std::string message);

/// "X-81.280 Y0.000 B-20.000" of Finding::axes.
std::string AxesText(const Finding& finding);

class RunFinding {
 public:
  bool open() const { return blocks_ > 0; }
  int blocks() const { return blocks_; }
  /// Begins a run, which must not be open; Add() its first motion next.
  void Start(Finding finding) { finding_ = std::move(finding); }
  /// Counts the motion's block. Several motions of one block count once.
  void Add(const motion::Motion& motion);
  /// Of the open run; its message may change until Close.
  Finding& finding() { return finding_; }
  /// Hands the finding over, with " (13 blocks, the last is line 440)" after its message where
  /// there are more than one. Does nothing when no run is open.
  void Close(std::vector<Finding>* findings);

 private:
  int blocks_ = 0;
  SourcePosition last_;
  Finding finding_;
};

}  // namespace ncsim::checks
