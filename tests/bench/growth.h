// SPDX-License-Identifier: BSD-3-Clause
// How the checker's cost grows: with blocks, triangles of the part, pairs and threshold.
#pragma once

#include <string>
#include <vector>

#include "tests/bench/impeller_job.h"

namespace ncsim::bench {

struct GrowthPoint {
  double value = 0.0;  ///< What the series varies.
  std::size_t pairs = 0;
  double us_per_block = 0.0;
  double queries_per_block = 0.0;
  double setup_seconds = 0.0;
};

struct GrowthSeries {
  std::string name;
  std::vector<GrowthPoint> points;
};

struct GrowthPlan {
  std::vector<int> blocks, triangles, studs;
  std::vector<double> clearances;
};

/// Measures and prints a Markdown row a point. All but the first series run `spec.blocks` blocks.
std::vector<GrowthSeries> PrintGrowth(const ImpellerSpec& spec, const GrowthPlan& plan,
                                      const std::string& folder);

/// A panel a series; false where the file cannot be written.
bool WriteGrowthSvg(const std::vector<GrowthSeries>& series, const std::string& path);

}  // namespace ncsim::bench
