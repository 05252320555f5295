// SPDX-License-Identifier: BSD-3-Clause
// Lines of a cutter-location file to records, by one table of major words (cl_words.h). An unknown
// statement, an unknown word in a known one, a value that is none: reported with line and column,
// never dropped.
#pragma once

#include <memory>
#include <string>

#include "post/cl_record.h"
#include "post/cl_text.h"

namespace ncsim::post {

class ClReader {
 public:
  /// `file` is the index of the program's name for SourcePosition.
  ClReader(const std::shared_ptr<const nc::Program>& program, int file, Diagnostics* diagnostics);
  /// The next record, comments and Unknown included; false at the end.
  bool Next(ClRecord* record);
  int line() const { return text_.lines(); }  ///< The last one read.

 private:
  std::string name_;
  int file_;
  Diagnostics* diagnostics_;
  ClText text_;
  ClLine line_;
};

}  // namespace ncsim::post
