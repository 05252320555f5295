// SPDX-License-Identifier: BSD-3-Clause
#include "sim/app/progress.h"

#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <numeric>
#include <string_view>

#include "sim/base/text.h"
#include "sim/report/printable.h"

namespace ncsim::app {

namespace {

constexpr std::chrono::milliseconds kInterval{100};
constexpr double kNearlyDone = 0.99;
constexpr std::size_t kLeastBar = 12, kGreatestBar = 40;  // columns, with brackets
constexpr int kColumnsUnknown = 80;

bool StartsCharacter(char byte) { return (static_cast<unsigned char>(byte) & 0xC0U) != 0x80U; }

std::size_t Columns(std::string_view utf8) {
  return static_cast<std::size_t>(std::count_if(utf8.begin(), utf8.end(), StartsCharacter));
}

/// "0:07", "12:30", "1:02:30".
std::string Clock(double seconds) {
  const auto total = static_cast<std::int64_t>(std::min(seconds, 3.6e6));
  const auto two = [](std::int64_t n) { return (n < 10 ? "0" : "") + std::to_string(n); };
  const std::int64_t hours = total / 3600;
  const std::int64_t minutes = total / 60 % 60;
  return (hours > 0 ? std::to_string(hours) + ":" + two(minutes) : std::to_string(minutes)) + ":" +
         two(total % 60);
}

/// "870", "34.5 k", "1.2 M".
std::string Rate(double per_second) {
  if (per_second >= 999950.0) return Fixed(per_second * 1e-6, 1) + " M";
  if (per_second >= 999.5) return Fixed(per_second * 1e-3, 1) + " k";
  return Fixed(per_second, 0);
}

std::string Bar(double done, std::size_t columns) {
  const std::size_t inner = columns - 2;
  const auto filled = static_cast<std::size_t>(done * static_cast<double>(inner));
  std::string bar(std::min(filled, inner), '=');
  if (bar.size() < inner) bar += '>';
  bar.resize(inner, ' ');
  return "[" + bar + "]";
}

int TerminalColumns() {
  winsize size{};
  const bool known = ioctl(STDERR_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 0;
  return known ? size.ws_col : kColumnsUnknown;
}

}  // namespace

std::string ProgressLine(const ProgressView& view, int width) {
  const auto room = static_cast<std::size_t>(std::max(width, 0));
  const std::string percent = std::to_string(static_cast<int>(100.0 * view.done)) + "%";
  if (percent.size() > room) return "";
  std::string line = std::string(4 - std::min<std::size_t>(percent.size(), 4), ' ') + percent;
  if (line.size() > room) return percent;
  std::string end = " " + Clock(view.elapsed);
  if (view.reached >= 1.0 && view.done >= 0.02) {
    // By the clock, down to 0, between one report and the next.
    end += ", " + Clock(std::max(0.0, view.reached / view.done - view.elapsed)) + " left";
  }
  if (view.reached >= 1.0 && view.blocks > 0) {
    const std::string rate =
        " " + Rate(static_cast<double>(view.blocks) / view.reached) + " blocks/s,";
    if (line.size() + rate.size() + end.size() <= room) end.insert(0, rate);
  }
  if (line.size() + end.size() > room) return line;
  const std::size_t label = view.label.empty() ? 0 : Columns(view.label) + 1;
  if (line.size() + end.size() + label + kLeastBar + 1 <= room && label > 0) {
    line.insert(0, view.label + " ");
  }
  const std::size_t spare = room - Columns(line) - end.size();
  if (spare > kLeastBar) line += " " + Bar(view.done, std::min(spare - 1, kGreatestBar));
  return line + end;
}

ProgressTotal::ProgressTotal(const std::vector<std::string>& programs) : parts_(programs.size()) {
  for (std::size_t i = 0; i < programs.size(); ++i) {
    std::error_code error;
    const std::uintmax_t bytes = std::filesystem::file_size(programs[i], error);
    if (!error && bytes > 0) parts_[i].weight = static_cast<double>(bytes);
  }
  if (programs.size() == 1) {
    name_ = report::Printable(std::filesystem::path(programs[0]).filename().string());
  }
}

void ProgressTotal::Update(std::size_t program, double done, std::uint64_t blocks, double now) {
  Part& part = parts_.at(program);
  part.done = std::max(part.done, std::min(done, kNearlyDone));
  part.blocks = std::max(part.blocks, blocks);
  reached_ = std::max(reached_, now);
}

void ProgressTotal::Finish(std::size_t program, double now) {
  reached_ = std::max(reached_, now);
  parts_.at(program).done = 1.0;
  parts_.at(program).finished = true;
}

ProgressView ProgressTotal::View(double now) const {
  ProgressView view;
  view.reached = reached_;
  view.elapsed = now;
  double whole = 0.0;
  std::size_t finished = 0;
  for (const Part& part : parts_) {
    whole += part.weight;
    view.done += part.weight * part.done;
    view.blocks += part.blocks;
    finished += part.finished ? 1 : 0;
  }
  if (whole > 0.0) view.done /= whole;
  if (finished < parts_.size()) view.done = std::min(view.done, kNearlyDone);
  view.label = parts_.size() == 1 ? name_
                                  : std::to_string(finished) + " of " +
                                        std::to_string(parts_.size()) + " programs";
  return view;
}

ProgressBar::ProgressBar(const std::vector<std::string>& programs, std::ostream* out)
    : out_(out), total_(programs) {
  if (out_ != nullptr) drawer_ = std::jthread([this](const std::stop_token& stop) { Draw(stop); });
}

double ProgressBar::Now() const {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin_).count();
}

ProgressReport ProgressBar::ReportOf(std::size_t program) {
  if (out_ == nullptr) return {};
  return [this, program](double done, std::uint64_t blocks) {
    const std::lock_guard lock(mutex_);
    total_.Update(program, done, blocks, Now());
  };
}

void ProgressBar::Finish(std::size_t program) {
  const std::lock_guard lock(mutex_);
  total_.Finish(program, Now());
}

void ProgressBar::Draw(const std::stop_token& stop) {
  bool visible = false;
  std::unique_lock lock(mutex_);
  while (true) {
    end_.wait_for(lock, stop, kInterval, [] { return false; });
    if (stop.stop_requested()) break;
    // One piece, so that nothing flickers; the last column stays free, where terminals may wrap.
    *out_ << "\r" + ProgressLine(total_.View(Now()), TerminalColumns() - 1) + "\033[K"
          << std::flush;
    visible = true;
  }
  if (visible) *out_ << "\r\033[K" << std::flush;
}

bool StderrShowsProgress() {
  const char* terminal = std::getenv("TERM");
  return isatty(STDERR_FILENO) == 1 && terminal != nullptr && std::string_view(terminal) != "dumb";
}

}  // namespace ncsim::app
