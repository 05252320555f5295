// SPDX-License-Identifier: BSD-3-Clause
#include "post/cl_arguments.h"

#include <algorithm>
#include <cmath>

#include "sim/base/text.h"

namespace ncsim::post {
std::string ClArguments::Peek() const {
  if (done() || at_number()) return {};
  std::string word(line_.tokens[next_].text);
  for (char& c : word) c = Upper(c);
  return word;
}

bool ClArguments::Take(std::string_view word) {
  if (done() || at_number()) return false;
  const std::string_view text = line_.tokens[next_].text;
  const bool same = std::equal(text.begin(), text.end(), word.begin(), word.end(),
                               [](char a, char b) { return Upper(a) == b; });
  if (same) ++next_;
  return same;
}

std::string ClArguments::TakeText() {
  return done() ? std::string() : std::string(line_.tokens[next_++].text);
}

double ClArguments::Number(std::string_view what) {
  if (!ok_) return 0.0;
  if (at_number()) return line_.tokens[next_++].number;
  if (done() || line_.tokens[next_].text.empty()) {
    Error(line_.major + " without " + std::string(what));
  } else {
    Error(std::string(what) + " of " + line_.major + " should be a number and is " +
          Quoted(line_.tokens[next_].text));
  }
  return 0.0;
}

int ClArguments::Integer(std::string_view what, int least, int most) {
  const double number = Number(what);
  if (!ok_) return least;
  if (number != std::floor(number) || number < least || number > most) {
    --next_;
    Error(std::string(what) + " of " + line_.major + " should be a whole number from " +
          std::to_string(least) + " to " + std::to_string(most));
    return least;
  }
  return static_cast<int>(number);
}

Eigen::Vector3d ClArguments::Vector(std::string_view what) {
  const double x = Number(what), y = Number(what), z = Number(what);
  return {x, y, z};
}

std::vector<double> ClArguments::Numbers() {
  std::vector<double> numbers;
  while (at_number()) numbers.push_back(line_.tokens[next_++].number);
  return numbers;
}

void ClArguments::Error(const std::string& message) {
  if (done()) return ErrorAtStart(message);
  if (ok_) {
    const ClToken& token = line_.tokens[next_];
    diagnostics_->Error(file_, token.line, token.column, message);
  }
  ok_ = false;
}

void ClArguments::ErrorAtStart(const std::string& message) {
  if (ok_) diagnostics_->Error(file_, line_.line, line_.column, message);
  ok_ = false;
}

bool ClArguments::Finish() {
  if (ok_ && !done()) {
    Error(Quoted(line_.tokens[next_].text) + " is not known in " + line_.major);
  }
  return ok_;
}

}  // namespace ncsim::post
