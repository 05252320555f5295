// SPDX-License-Identifier: BSD-3-Clause
// What `ncsim compare` found, and its writers.
#pragma once

#include "sim/compare/compare.h"
#include "sim/report/result.h"

namespace ncsim::report {

/// One of the two programs.
struct ComparedProgram {
  std::string program;  ///< As given on the command line.
  std::string model;    ///< Machine::name; "" for a CL file.
  std::string job;      ///< Path of the job file; "" for none.
  std::string frame;    ///< The work offset in which it was read; "" for a CL file.
  std::uint64_t blocks = 0;
  std::vector<Assumption> assumptions;
};

struct CompareResult {
  Verdict verdict = Verdict::kUnproven;
  ComparedProgram reference, tested;
  compare::Tolerances tolerances;
  compare::Comparison comparison;  ///< Its findings have gone to `findings`.
  std::vector<Finding> findings;   ///< Sorted.
};

void WriteText(const CompareResult& result, const SourceFiles& files, const LineText& line_text,
               std::ostream& out);
/// The last line of WriteText, without its end.
std::string Summary(const CompareResult& result);
/// Of two that are the same motion: "hub.nc: the motion of hub.cls: tip within 0.0011 mm, ...".
std::string Nearness(const CompareResult& result);
/// One JSON object and a line end; docs/json.md describes it.
void WriteJson(const CompareResult& result, const SourceFiles& files, std::ostream& out);

}  // namespace ncsim::report
