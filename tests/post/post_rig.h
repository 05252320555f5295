// SPDX-License-Identifier: BSD-3-Clause
// `ncsim post` and then `ncsim compare` of what it wrote against the file it was made from.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace ncsim::posting {

inline const char* const kUmc750 = "haas_umc750/umc750.urdf";
inline const char* const kBcTable = "bc_table_840d/bc_table_840d.urdf";

/// A way to post: a machine's model, and more of the command line.
struct Way {
  std::string model;  ///< Under models/.
  std::string mode;   ///< "" for what each operation needs.
  std::vector<std::string> more;
};

/// One file's way there and back, in a folder of its own that goes with it.
class PostRig {
 public:
  explicit PostRig(const std::string& name);
  ~PostRig();
  PostRig(const PostRig&) = delete;
  PostRig& operator=(const PostRig&) = delete;

  /// Exit code of `ncsim post` without a check; `said` is what it wrote to the user.
  int Post(const std::filesystem::path& cl, const Way& way);
  /// The same of a text, which becomes the file part.cls.
  int PostText(const std::string& text, const Way& way);
  /// Exit code of `ncsim compare`, assumptions accepted, of `cl` and the program.
  int Compare(const std::filesystem::path& cl, const Way& way);
  /// Writes `text` as a file of the folder.
  std::filesystem::path Write(const std::string& name, const std::string& text) const;

  /// The program of the last Post().
  std::filesystem::path program() const { return program_; }
  std::string Program() const;
  const std::filesystem::path& folder() const { return folder_; }
  const std::string& said() const { return said_; }
  /// Of the last Compare(): largest deviations of tip and tool axis, mm and deg; negative without
  /// one.
  double position() const { return position_; }
  double angle() const { return angle_; }

 private:
  int Run(const std::vector<std::string>& arguments);

  std::filesystem::path folder_, program_;
  std::string said_;
  double position_ = -1.0, angle_ = -1.0;
};

}  // namespace ncsim::posting
