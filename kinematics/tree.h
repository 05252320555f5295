// SPDX-License-Identifier: BSD-3-Clause
// A machine as a tree of rigid links and joints. Knows Eigen and nothing else: no file formats, no
// axis letters. Units: mm and rad. Frames: X_AB is the pose of frame B in A; p_AB_C a position from
// A to B, expressed in C.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <string>
#include <string_view>
#include <vector>

namespace ncsim::kinematics {

inline constexpr int kMaxJoints = 12;

/// Positions of the moving joints in the order of KinematicTree::moving_joints(): mm or rad. No
/// heap.
using JointVector = Eigen::Matrix<double, Eigen::Dynamic, 1, Eigen::ColMajor, kMaxJoints, 1>;

enum class JointType { kFixed, kPrismatic, kRevolute };

struct Joint {
  std::string name;
  JointType type = JointType::kFixed;
  int parent_link = -1;
  int child_link = -1;
  Eigen::Isometry3d X_PJ =
      Eigen::Isometry3d::Identity();  ///< Joint frame in the parent link, at position 0.
  Eigen::Vector3d axis = Eigen::Vector3d::UnitX();  ///< Unit; in the joint frame.
  double lower = 0.0;                               ///< -inf for a continuous joint.
  double upper = 0.0;                               ///< +inf for a continuous joint.
  int index = -1;                                   ///< Place in JointVector; -1 for a fixed joint.
};

struct Link {
  std::string name;
  int parent_joint = -1;  ///< -1 for the root.
};

/// Immutable after construction. Links stand in topological order: a parent before its children;
/// link 0 is the root.
class KinematicTree {
 public:
  KinematicTree() = default;
  /// Takes links and joints that form one tree with unit axes and at most kMaxJoints moving joints
  /// (the loader has checked that); sorts links, assigns Joint::index in order of appearance.
  /// Breaking this is a programming error.
  KinematicTree(std::vector<Link> links, std::vector<Joint> joints);

  const std::vector<Link>& links() const { return links_; }
  const std::vector<Joint>& joints() const { return joints_; }
  int num_moving() const { return static_cast<int>(moving_.size()); }
  /// Index into joints() of each moving joint, in JointVector order.
  const std::vector<int>& moving_joints() const { return moving_; }
  /// -1 when there is none of that name.
  int FindLink(std::string_view name) const;
  int FindJoint(std::string_view name) const;

  /// X_ML: pose of `link` in the machine frame (the root link) at q.
  Eigen::Isometry3d Pose(int link, const JointVector& q) const;
  /// All links at once; `X_ML` is resized to links().size().
  void Poses(const JointVector& q, std::vector<Eigen::Isometry3d>* X_ML) const;
  /// Motion of the child link that joint `joint` (index into joints()) makes at `position`: X_PC.
  Eigen::Isometry3d JointTransform(int joint, double position) const;

  /// Moving joints (indices into joints()) between the root and `link`, root first.
  std::vector<int> MovingJointsTo(int link) const;

 private:
  std::vector<Link> links_;
  std::vector<Joint> joints_;
  std::vector<int> moving_;
};

}  // namespace ncsim::kinematics
