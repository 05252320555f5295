// SPDX-License-Identifier: BSD-3-Clause
// The values of a statement, taken one after the other. The first thing that is wrong is reported
// with its column; after it nothing more is.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "post/cl_text.h"

namespace ncsim::post {

class ClArguments {
 public:
  ClArguments(const ClLine& line, const std::string& file, Diagnostics* diagnostics)
      : line_(line), file_(file), diagnostics_(diagnostics) {}

  const ClLine& line() const { return line_; }
  bool ok() const { return ok_; }
  bool done() const { return next_ == line_.tokens.size(); }
  std::size_t left() const { return line_.tokens.size() - next_; }
  bool at_number() const { return !done() && line_.tokens[next_].is_number; }
  /// Upper case; "" at the end and for a number. Takes nothing.
  std::string Peek() const;
  /// Takes the next value where it is this word.
  bool Take(std::string_view word);
  /// Takes the next value as it is written.
  std::string TakeText();
  /// Take a number, or report that `what` is missing; 0 then.
  double Number(std::string_view what);
  int Integer(std::string_view what, int least, int most);
  Eigen::Vector3d Vector(std::string_view what);
  std::vector<double> Numbers();

  /// Reports at the next value, or at the end of the statement.
  void Error(const std::string& message);
  void ErrorAtStart(const std::string& message);
  /// Reports what is left over. True where nothing was wrong.
  bool Finish();

 private:
  const ClLine& line_;
  const std::string& file_;
  Diagnostics* diagnostics_;
  std::size_t next_ = 0;
  bool ok_ = true;
};

}  // namespace ncsim::post
