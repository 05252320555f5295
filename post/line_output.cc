// SPDX-License-Identifier: BSD-3-Clause
#include "post/line_output.h"

#include <algorithm>

namespace ncsim::post {

void LineOutput::To(std::ostream* out) { Resume(out, numbers_.start); }

void LineOutput::Resume(std::ostream* out, int number) {
  out_ = out;
  next_ = number;
}

void LineOutput::Prepend(const std::string& words) { before_ += words + " "; }

bool LineOutput::HasNumber(const std::string& line) const {
  if (line.empty()) return false;
  return std::none_of(numbers_.without.begin(), numbers_.without.end(),
                      [&](const std::string& beginning) { return line.rfind(beginning, 0) == 0; });
}

void LineOutput::Write(const std::string& line) {
  if (!HasNumber(line)) {
    *out_ << line << '\n';
    return;
  }
  if (!numbers_.prefix.empty()) {
    *out_ << numbers_.prefix << next_ << ' ';
    next_ += numbers_.step;
    if (next_ > numbers_.highest) next_ = numbers_.start;
  }
  *out_ << before_ << line << '\n';
  before_.clear();
}

}  // namespace ncsim::post
