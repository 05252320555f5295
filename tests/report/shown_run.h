// SPDX-License-Identifier: BSD-3-Clause
// A program checked with its pictures and its trace, in a folder of its own.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace ncsim::report {

/// A row of the trace that a test asks for.
struct TraceRow {
  int line = 0;
  double time = 0.0;            ///< s, at the end.
  std::map<char, double> axes;  ///< mm and deg.
};

class ShownRun {
 public:
  /// Runs `ncsim check PROGRAM --trace --gltf --report` and `options`.
  ShownRun(const std::filesystem::path& program, const std::vector<std::string>& options = {});
  ~ShownRun();
  ShownRun(const ShownRun&) = delete;
  ShownRun& operator=(const ShownRun&) = delete;

  int exit_code() const { return exit_code_; }
  const std::string& messages() const { return messages_; }
  std::filesystem::path gltf() const { return folder_ / "run.glb"; }
  std::filesystem::path html() const { return folder_ / "run.html"; }
  /// Rows of motions that state axes.
  const std::vector<TraceRow>& trace() const { return trace_; }

 private:
  std::filesystem::path folder_;
  int exit_code_ = -1;
  std::string messages_;
  std::vector<TraceRow> trace_;
};

/// The source tree's scenes/NAME.
std::filesystem::path ScenePath(const std::string& name);
std::string ReadBytes(const std::filesystem::path& path);

}  // namespace ncsim::report
