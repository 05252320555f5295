// SPDX-License-Identifier: BSD-3-Clause
// What `ncsim check` found for one program, and its writers. Reports know machines, motions and
// results; no control.
#pragma once

#include <array>
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
  std::string program;  ///< As given on the command line.
  std::string model;    ///< Machine::name.
  std::string job;      ///< Path of the job file; "" for none.
  std::uint64_t blocks = 0;
  double motion_time = 0.0;       ///< s.
  std::vector<Finding> findings;  ///< Sorted: see SortFindings.
  std::vector<collision::PairClearance> clearances;
  std::vector<collision::DeepestCut> cuts;
  double orientation_tolerance = 0.0;  ///< rad: what smoothing may turn the tool by, at most.
  std::vector<Assumption> assumptions;
  std::vector<std::string> not_checked;  ///< "stock" ...
};

/// How CheckResult::motion_time is worked out, in words.
std::string_view MotionTimeModel();

/// Program order: file, line, column; then rule, then message, so that equal runs print equal
/// bytes.
void SortFindings(std::vector<Finding>* findings);

/// Text of a line (for the caret), by SourcePosition::file and line; empty where it is not known.
using LineText = std::function<std::string_view(int file, int line)>;

/// As compilers do: a line for each finding, the source line and a caret; then clearances,
/// assumptions and the summary. Of one rule the first kMaxFindingsOfRule are printed and the rest
/// are counted.
inline constexpr int kMaxFindingsOfRule = 20;
void WriteText(const CheckResult& result, const SourceFiles& files, const LineText& line_text,
               std::ostream& out);

/// The findings of WriteText alone.
void WriteFindings(const std::vector<Finding>& findings, const SourceFiles& files,
                   const LineText& line_text, std::ostream& out);
/// What was assumed; nothing where nothing was.
void WriteAssumptions(const std::vector<Assumption>& assumptions, std::ostream& out);
/// "1 error, 0 unproven, 2 warnings".
std::string CountFindings(const std::vector<Finding>& findings);
/// "1 block", "2 blocks".
std::string Count(std::size_t number, const std::string& singular);

/// "4.2 s", "3 min 55 s", "2 h 15 min 23 s".
std::string Duration(double seconds);

/// The last line of WriteText, without its end: "pass, stock not simulated: ...".
std::string Summary(const CheckResult& result);

/// One JSON object and a line end; docs/json.md describes it.
void WriteJson(const CheckResult& result, const SourceFiles& files, std::ostream& out);

/// `--trace`: one row at the end of each motion; six decimals. docs/trace.md describes it.
class TraceWriter {
 public:
  /// Writes the header. Machine and stream must outlive the writer.
  TraceWriter(const machine::Machine& machine, std::ostream& out);
  /// `X_BP` is the part frame of the motion's offset; `tool_length` the metal's length, mm.
  void Write(const motion::Motion& motion, const Eigen::Isometry3d& X_BP, double tool_length,
             const SourceFiles& files);

 private:
  const machine::Machine* machine_;
  std::ostream* out_;
  std::array<const machine::Axis*, 6> axes_{};  // X Y Z A B C; null for one that the machine lacks.
  std::string row_;
};

}  // namespace ncsim::report
