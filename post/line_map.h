// SPDX-License-Identifier: BSD-3-Clause
// Which lines of a cutter-location file the lines of a posted program come from: `PROGRAM.lines`,
// docs/post.md.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace ncsim::post {

class LineMap {
 public:
  /// From `line` of the program on, lines come from `cl_line`. Both count from 1; lines in rising
  /// order.
  void Add(int line, int cl_line);
  /// The line of the cutter-location file; 0 where it is not known.
  int At(int line) const;
  bool operator==(const LineMap&) const = default;

  /// Line of the program and line of the cutter-location file, where the second changes.
  const std::vector<std::pair<int, int>>& steps() const { return steps_; }

 private:
  std::vector<std::pair<int, int>> steps_;
};

/// A map, and the contents of the files that it holds for. Of any others it says nothing.
struct LineMapFile {
  std::string program;  ///< DigestOf() the program's bytes.
  std::string cl;       ///< DigestOf() the cutter-location file's.
  std::string cl_name;  ///< Its path, seen from the folder of the program.
  LineMap map;
};

std::string WriteLineMap(const LineMapFile& file);
/// nullopt for what WriteLineMap() has not written so.
std::optional<LineMapFile> ReadLineMap(std::string_view text);

}  // namespace ncsim::post
