// SPDX-License-Identifier: BSD-3-Clause
#include "sim/base/diagnostics.h"

#include <utility>

namespace ncsim {

std::string ToString(const Diagnostic& diagnostic) {
  std::string text = diagnostic.file;
  if (diagnostic.line > 0) text += ":" + std::to_string(diagnostic.line);
  if (diagnostic.line > 0 && diagnostic.column > 0) text += ":" + std::to_string(diagnostic.column);
  text += diagnostic.level == Diagnostic::Level::kError ? ": error: " : ": warning: ";
  return text + diagnostic.message;
}

void Diagnostics::Error(std::string file, int line, int column, std::string message) {
  all_.push_back({Diagnostic::Level::kError, std::move(file), line, column, std::move(message)});
  ++errors_;
}

void Diagnostics::Warning(std::string file, int line, int column, std::string message) {
  all_.push_back({Diagnostic::Level::kWarning, std::move(file), line, column, std::move(message)});
}

}  // namespace ncsim
