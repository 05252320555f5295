// SPDX-License-Identifier: BSD-3-Clause
// The Toolpath of a cutter-location file, from the events that post/ reads out of it.
#pragma once

#include <optional>
#include <set>
#include <string>
#include <vector>

#include "post/cl_event.h"
#include "sim/compare/toolpath.h"

namespace ncsim::compare {

/// Collects events. A tool axis goes from point to point along the great circle, at constant speed.
/// Poses are in the coordinate system (MSYS) of the first feed, those of other ones led over where
/// the file says how they lie to each other.
class ClToolpath {
 public:
  explicit ClToolpath(const Distance& chord_error) : builder_(chord_error) {}

  void OnEvent(const post::ClEvent& event);
  Toolpath Take() { return builder_.Take(); }
  /// What the file says that was not followed.
  std::vector<Finding> TakeFindings() { return std::move(findings_); }
  std::uint64_t motions() const { return motions_; }

 private:
  void OnMotion(const post::ClEvent& event, const post::ClMotion& motion);
  void OnHole(const post::ClEvent& event, const post::ClHole& hole);
  Pose InFirst(const post::ClEvent& event, const post::ClPose& pose);
  void NotFollowed(const post::ClEvent& event, const std::string& what);

  ToolpathBuilder builder_;
  std::vector<Finding> findings_;
  std::set<std::string> told_;
  std::uint64_t motions_ = 0;
  /// Of the first motion's operation; whether it has been met.
  std::optional<Eigen::Isometry3d> X_AFirst_;
  bool met_ = false;
};

}  // namespace ncsim::compare
