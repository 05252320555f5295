// SPDX-License-Identifier: BSD-3-Clause
// `--report`: one HTML file that shows a run, with nothing to fetch. docs/report.md describes it,
// sim/report/viewer is what runs in it.
#pragma once

#include <ostream>
#include <string>
#include <string_view>
#include <vector>

#include "sim/report/picture.h"
#include "sim/report/result.h"

namespace ncsim::report {

/// A text of the run: the program, or a subprogram that it calls.
struct PageText {
  std::string name;  ///< As findings name it.
  std::string_view text;
};

/// The least clearance that was seen at some instants, of the pairs that must never touch.
struct ClearanceTrack {
  struct Sample {
    std::uint32_t tick = 0;
    double clearance_mm = 0.0;
    int pair = 0;  ///< Index into `pairs`.
  };
  std::vector<Sample> samples;
  std::vector<std::vector<std::string>> pairs;
};

/// Looks at the run at `count` instants, evenly spaced, at each finding's, and through the blocks
/// where pairs are nearest.
ClearanceTrack LookAtClearance(const machine::Machine& machine, const machine::Scene& scene,
                               const machine::ToolTable& tools, const Recording& recording,
                               const CheckResult& result, int count);

struct Page {
  const CheckResult* result = nullptr;
  const SourceFiles* files = nullptr;
  const Picture* picture = nullptr;
  std::vector<PageText> texts;  ///< By SourcePosition::file.
  ClearanceTrack clearance;     ///< Empty where collisions were not checked.
};

/// What the viewer reads: a length (4 bytes), JSON of that length, and the bytes that it refers to.
std::string PageData(const Page& page);

void WriteHtml(const Page& page, std::ostream& out);

}  // namespace ncsim::report
