// SPDX-License-Identifier: BSD-3-Clause
// The real UMC-750 program of the corpus with a job of ours, in a folder of its own, to be changed
// and checked.
#pragma once

#include <filesystem>
#include <string>

namespace ncsim::corpus {

class Umc750Job {
 public:
  struct Scene {
    std::string part_xyz = "[-50.8, -50.8, 150.0]";  ///< Of G54, on the platter's centre.
    double riser_diameter = 200.0;
    double riser_height = 149.9;
    std::string holder_t3 = "\"CAT40-ER32-100\"";
    std::string extra;  ///< More lines of the job.
    std::string body;   ///< [part] or [stock].
  };

 protected:
  /// Copies program and model into a folder named after the test. False without NCSIM_CORPUS.
  bool Prepare(const std::string& test);
  void Remove();

  std::filesystem::path Program() const { return folder_ / "part.nc"; }
  std::filesystem::path Model() const { return folder_ / "model/umc750.urdf"; }
  std::filesystem::path JobFile() const { return folder_ / "part.nc.job.toml"; }
  std::string PartBody(const std::string& at = "{ on = \"G54\" }") const;
  static std::string StockBody(const std::string& at = "{ on = \"G54\", xyz = [50.8, 50.8, 0.0] }");
  /// Once, in a file of the folder. Throws std::runtime_error where `from` is not there.
  void Replace(const std::filesystem::path& path, const std::string& from, const std::string& to);
  /// Line `line` (from 1) becomes empty, so that all others keep their numbers.
  void Blank(int line);
  /// Keeps the first `lines` lines, for a fault that shows early: a shorter run, the same lines.
  void Keep(int lines);
  void WriteJob() const;

  Scene scene_;
  std::filesystem::path folder_, source_;
};

}  // namespace ncsim::corpus
