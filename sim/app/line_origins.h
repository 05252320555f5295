// SPDX-License-Identifier: BSD-3-Clause
// Where in cutter-location files findings come from: from what `ncsim post` has just written, or
// from the maps that `ncsim post --map` leaves beside programs.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "post/line_map.h"
#include "sim/app/program_input.h"
#include "sim/base/finding.h"

namespace ncsim::app {

/// Path of the map of a program.
std::string LineMapPath(const std::string& program);

/// Maps that are known without a file; the programs are in no file yet.
struct PostedLines {
  std::string cl;                              ///< Path of the cutter-location file.
  std::map<std::string, post::LineMap> lines;  ///< By the path of the program.
};

class LineOrigins {
 public:
  /// `files` are those of the findings, and grows by cutter-location files. All must outlive this.
  /// `posted` may be null.
  LineOrigins(SourceFiles* files, SourceLines* texts, const PostedLines* posted)
      : files_(files), texts_(texts), posted_(posted) {}

  /// Fills Finding::posted_from where it is known. A map that does not fit its program, or whose
  /// cutter-location file has changed, is not used.
  void Trace(std::vector<Finding>* findings);
  /// Why maps were not used, a line each.
  const std::vector<std::string>& notes() const { return notes_; }

 private:
  struct Origin {
    int cl = -1;  ///< Of SourceFiles; -1: nothing is known.
    post::LineMap map;
  };
  const Origin& Find(int file);
  Origin Read(const std::string& program, std::string_view text);

  SourceFiles* files_;
  SourceLines* texts_;
  const PostedLines* posted_;
  std::map<int, Origin> origins_;  ///< By file.
  std::map<std::string, int> cl_files_;
  std::vector<std::string> notes_;
};

}  // namespace ncsim::app
