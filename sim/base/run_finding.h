// SPDX-License-Identifier: BSD-3-Clause
// A fault that goes on from block to block is one finding, placed where it starts.
#pragma once

#include <utility>
#include <vector>

#include "sim/base/finding.h"

namespace ncsim {

class RunFinding {
 public:
  bool open() const { return blocks_ > 0; }
  int blocks() const { return blocks_; }
  /// Begins a run, which must not be open; Add() its first motion's place next.
  void Start(Finding finding) { finding_ = std::move(finding); }
  /// Counts the block of a motion. Several motions of one block count once.
  void Add(const SourcePosition& where);
  /// Goes on with the blocks of `next`, the same fault from the motion after the last one on. Keeps
  /// this run's finding.
  void Append(const RunFinding& next);
  /// Of the open run; its message may change until the run ends.
  Finding& finding() { return finding_; }
  const Finding& finding() const { return finding_; }
  /// Ends the open run: its finding, with " (13 blocks, the last is line 440)" after the message
  /// where there are more than one.
  Finding Take();
  /// Take() into `findings`. Does nothing when no run is open.
  void Close(std::vector<Finding>* findings);

 private:
  int blocks_ = 0;
  SourcePosition first_, last_;
  Finding finding_;
};

}  // namespace ncsim
