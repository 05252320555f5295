// SPDX-License-Identifier: BSD-3-Clause
// How far a check is: one line on a terminal, gone at the end.
#pragma once

#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <functional>
#include <mutex>
#include <ostream>
#include <stop_token>
#include <string>
#include <thread>
#include <vector>

namespace ncsim::app {

/// Told from time to time how much of a program's text (0 to 1) is done, and how many blocks that
/// move anything.
using ProgressReport = std::function<void(double done, std::uint64_t blocks)>;

struct ProgressView {
  std::string label;
  double done = 0.0;  ///< 0 to 1.
  std::uint64_t blocks = 0;
  double reached = 0.0;  ///< s: when `done` and `blocks` were told.
  double elapsed = 0.0;  ///< s: now.
};

/// "part.nc  42% [=====>      ] 34.5 k blocks/s, 0:12, 0:17 left" in at most `width` columns: what
/// does not fit is left out, the bar takes what is spare. Speed and the time
/// that is left are told from a second and 2 % on.
std::string ProgressLine(const ProgressView& view, int width);

/// Several programs as one. Never goes back, whatever loops and subprograms do, and stays below the
/// end until all have finished.
class ProgressTotal {
 public:
  /// By file name, weighed by size.
  explicit ProgressTotal(const std::vector<std::string>& programs);

  /// `now` in s from the start.
  void Update(std::size_t program, double done, std::uint64_t blocks, double now);
  void Finish(std::size_t program, double now);
  ProgressView View(double now) const;

 private:
  struct Part {
    double weight = 1.0;
    double done = 0.0;
    std::uint64_t blocks = 0;
    bool finished = false;
  };
  std::string name_;
  std::vector<Part> parts_;
  double reached_ = 0.0;
};

/// Draws a total on a terminal, ten times a second, and clears it when it is destroyed. Any thread
/// may report.
class ProgressBar {
 public:
  /// `out` outlives this; null draws nothing.
  ProgressBar(const std::vector<std::string>& programs, std::ostream* out);

  /// What program number `program` reports to; empty where nothing is drawn.
  ProgressReport ReportOf(std::size_t program);
  void Finish(std::size_t program);

 private:
  double Now() const;
  void Draw(const std::stop_token& stop);

  const std::chrono::steady_clock::time_point begin_ = std::chrono::steady_clock::now();
  std::ostream* out_;
  std::mutex mutex_;  // of total_
  ProgressTotal total_;
  std::condition_variable_any end_;
  std::jthread drawer_;  // the last: it ends before what it reads
};

/// Standard error is a terminal that can clear a line.
bool StderrShowsProgress();

}  // namespace ncsim::app
