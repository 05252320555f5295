// SPDX-License-Identifier: BSD-3-Clause
// What `ncsim check` found for one program, and its writers. Reports know machines, motions and results; no control.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <ostream>
#include <string>
#include <string_view>
#include <vector>

#include "sim/base/finding.h"
#include "sim/collision/checker.h"
#include "sim/machine/machine.h"
#include "sim/motion/motion.h"

namespace ncsim::report {

struct CheckResult {
  Verdict verdict = Verdict::kUnproven;
  std::string program;   ///< As given on the command line.
  std::string model;     ///< Machine::name.
  std::uint64_t blocks = 0;
  double motion_time = 0.0;                 ///< s.
  std::vector<Finding> findings;            ///< Sorted by file, line, column, rule.
  std::vector<collision::PairClearance> clearances;
  std::vector<collision::DeepestCut> cuts;
  std::vector<Assumption> assumptions;
  std::vector<std::string> not_checked;     ///< "stock" ...
};

/// Text of a line (for the caret), by SourcePosition::file and line.
using LineText = std::function<std::string_view(int file, int line)>;

void WriteText(const CheckResult& result, const SourceFiles& files, const LineText& line_text,
               std::ostream& out);
void WriteJson(const CheckResult& result, const SourceFiles& files, std::ostream& out);

/// `--trace`: one row at the end of each motion; six decimals. See the contract in docs/trace.md.
class TraceWriter {
 public:
  TraceWriter(const machine::Machine& machine, std::ostream& out);
  /// `X_BP` is the part frame of the motion's offset; `tool_length` the metal's length, mm.
  void Write(const motion::Motion& motion, const Eigen::Isometry3d& X_BP, double tool_length,
             const SourceFiles& files);

 private:
  const machine::Machine* machine_;
  std::ostream* out_;
  std::string row_;
};

}  // namespace ncsim::report
