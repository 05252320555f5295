// SPDX-License-Identifier: BSD-3-Clause
#include "tests/bench/growth.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fstream>

#include "sim/base/text.h"
#include "tests/bench/checker_run.h"

namespace ncsim::bench {
namespace {

constexpr double kWidth = 420.0, kHeight = 260.0;  // of a panel, px
constexpr double kLeft = 60.0, kRight = 16.0, kTop = 34.0, kBottom = 44.0;

void Add(const ImpellerSpec& spec, double value, const std::string& folder, GrowthSeries* series) {
  const auto job = MakeImpellerJob(spec, folder);
  if (!job) return;
  const CheckerRun run = RunChecker(*job, static_cast<std::size_t>(spec.blocks));
  GrowthPoint point;
  point.value = value;
  point.pairs = run.result.clearances.size();
  point.us_per_block = run.microseconds_per_motion();
  point.queries_per_block =
      static_cast<double>(run.result.queries) / static_cast<double>(run.motions);
  point.setup_seconds = run.setup_seconds;
  std::printf("| %s | %s | %zu | %.2f | %.3f | %.2f |\n", series->name.c_str(),
              Short(value).c_str(), point.pairs, point.us_per_block, point.queries_per_block,
              point.setup_seconds);
  std::fflush(stdout);
  series->points.push_back(point);
}

/// A scale from values to pixels; logarithmic where the values span more than a decade.
struct Scale {
  double low = 0.0, high = 1.0, from = 0.0, to = 1.0;
  bool log = false;

  double operator()(double value) const {
    const auto f = [this](double v) { return log ? std::log10(v) : v; };
    const double span = f(high) - f(low);
    return from + (to - from) * (span > 0.0 ? (f(value) - f(low)) / span : 0.5);
  }
};

std::string Text(double x, double y, const char* anchor, const std::string& text) {
  return "<text x=\"" + Short(x, 1) + "\" y=\"" + Short(y, 1) + "\" text-anchor=\"" + anchor +
         "\">" + text + "</text>\n";
}

std::string Panel(const GrowthSeries& series, double x0, double y0) {
  Scale x{series.points.front().value, series.points.back().value, x0 + kLeft, x0 + kWidth - kRight,
          false};
  x.log = x.low > 0.0 && x.high > 10.0 * x.low;
  Scale y{0.0, 0.0, y0 + kHeight - kBottom, y0 + kTop, false};
  for (const GrowthPoint& point : series.points) y.high = std::max(y.high, point.us_per_block);
  y.high *= 1.1;
  std::string text = Text(x0 + kLeft, y0 + 18, "start", "us/block by " + series.name);
  text += "<path d=\"M" + Short(x.from, 1) + " " + Short(y.to, 1) + "V" + Short(y.from, 1) + "H" +
          Short(x.to, 1) + "\" fill=\"none\" stroke=\"#888\"/>\n";
  std::string line;
  for (const GrowthPoint& point : series.points) {
    const double px = x(point.value);
    const double py = y(point.us_per_block);
    line += (line.empty() ? "M" : "L") + Short(px, 1) + " " + Short(py, 1);
    text += "<circle cx=\"" + Short(px, 1) + "\" cy=\"" + Short(py, 1) +
            "\" r=\"3\" fill=\"#1565c0\"/>\n";
    text += Text(px, py - 7, "middle", Short(point.us_per_block, 1));
    text += Text(px, y.from + 16, "middle", Short(point.value, 1));
  }
  return text + "<path d=\"" + line + "\" fill=\"none\" stroke=\"#1565c0\"/>\n";
}

}  // namespace

std::vector<GrowthSeries> PrintGrowth(const ImpellerSpec& spec, const GrowthPlan& plan,
                                      const std::string& folder) {
  std::printf(
      "| grows | to | pairs | us/block | queries/block | setup s |\n|---|---|---|---|---|---|\n");
  std::vector<GrowthSeries> all(4);
  all[0].name = "blocks";
  for (const int blocks : plan.blocks) {
    ImpellerSpec varied = spec;
    varied.blocks = blocks;
    Add(varied, blocks, folder, &all[0]);
  }
  all[1].name = "triangles of the part";
  for (const int triangles : plan.triangles) {
    ImpellerSpec varied = spec;
    varied.triangles = triangles;
    Add(varied, triangles, folder, &all[1]);
  }
  all[2].name = "further fixtures";
  for (const int studs : plan.studs) {
    ImpellerSpec varied = spec;
    varied.studs = studs;
    Add(varied, studs, folder, &all[2]);
  }
  all[3].name = "clearance threshold, mm";
  for (const double clearance : plan.clearances) {
    ImpellerSpec varied = spec;
    varied.clearance = clearance;
    Add(varied, clearance, folder, &all[3]);
  }
  return all;
}

bool WriteGrowthSvg(const std::vector<GrowthSeries>& series, const std::string& path) {
  std::string text = "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"" +
                     Short(2 * kWidth + kLeft) + "\" height=\"" + Short(2 * kHeight) +
                     "\" font-family=\"sans-serif\" font-size=\"11\">\n"
                     "<rect width=\"100%\" height=\"100%\" fill=\"white\"/>\n";
  int panel = 0;
  for (const GrowthSeries& one : series) {
    if (!one.points.empty()) text += Panel(one, (panel % 2) * kWidth, (panel / 2) * kHeight);
    ++panel;
  }
  std::ofstream out(path);
  out << text << "</svg>\n";
  return static_cast<bool>(out.flush());
}

}  // namespace ncsim::bench
