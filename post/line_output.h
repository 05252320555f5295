// SPDX-License-Identifier: BSD-3-Clause
// Lines of a program, with their numbers, to a stream.
#pragma once

#include <ostream>
#include <string>

#include "post/post_data.h"

namespace ncsim::post {

class LineOutput {
 public:
  explicit LineOutput(const LineNumbers& numbers) : numbers_(numbers), next_(numbers.start) {}
  /// What follows goes to `out`, numbered from the start. It must outlive the lines.
  void To(std::ostream* out);
  /// Goes on where another file was.
  void Resume(std::ostream* out, int number);
  int next_number() const { return next_; }
  /// What stands before the text of the next numbered line.
  void Prepend(const std::string& words);
  void Write(const std::string& line);

 private:
  bool HasNumber(const std::string& line) const;

  const LineNumbers& numbers_;
  std::ostream* out_ = nullptr;
  int next_;
  std::string before_;
};

}  // namespace ncsim::post
