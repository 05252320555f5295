// SPDX-License-Identifier: BSD-3-Clause
// Trouble with an input that is not the program: a model, a mesh, a job. Readers report here,
// recover, and go on, so that a user sees everything that is wrong in one run. Nothing here throws,
// prints or exits.
#pragma once

#include <string>
#include <vector>

namespace ncsim {

struct Diagnostic {
  enum class Level { kError, kWarning };
  Level level = Level::kError;
  std::string file;
  int line = 0;    ///< From 1; 0 where the whole file is meant.
  int column = 0;  ///< From 1; 0 where not known.
  std::string message;
};

/// "umc750.urdf:12:3: error: message"; parts that are not known are left out.
std::string ToString(const Diagnostic& diagnostic);

class Diagnostics {
 public:
  void Error(std::string file, int line, int column, std::string message);
  void Warning(std::string file, int line, int column, std::string message);
  bool has_errors() const { return errors_ > 0; }
  const std::vector<Diagnostic>& all() const { return all_; }

 private:
  std::vector<Diagnostic> all_;
  int errors_ = 0;
};

}  // namespace ncsim
