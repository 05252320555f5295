// SPDX-License-Identifier: BSD-3-Clause
// One planted case: a scene and a program for the checker, and the true clearances beside them.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "sim/collision/test_rig.h"
#include "tests/planted/solids.h"
#include "tests/planted/truth.h"

namespace ncsim::planted {

using Random = kinematics::Random;

/// The rotary table of the test machine, by its closed form: B turns about +Y through `pivot_b`
/// and carries C, about +Z through `pivot_c`; ISO senses (the table turns against the NC value).
struct Table {
  Eigen::Vector3d pivot_b = Eigen::Vector3d::Zero();
  Eigen::Vector3d pivot_c = Eigen::Vector3d::Zero();

  Eigen::Isometry3d InMachine(double b_deg, double c_deg) const;
};

/// The tool as seen from a body's frame G, over u in [0, 1].
struct Course {
  std::function<ToolPose(double)> pose;
  double lipschitz = 0.0;  ///< No point of the tool moves by more than this times the step of u.
  bool straight = false;   ///< A pure translation: the clearance of convex bodies is convex in u.
  int motion = 0;          ///< Which motion of the program it belongs to,
  double begin = 0.0, end = 1.0;  ///< and from where to where on it, in parts of its time.
};

/// A checker that counts less than this as contact may be early by it; mm.
inline constexpr double kNearContact = 0.01;

/// A hit is told by the motion and how far on it: `upper` is where contact begins, `lower` where
/// the tool comes within kNearContact.
struct FirstContact {
  int motion = 0;
  Bounds at;
};

/// What is true of a pair of the tool and a body.
struct PairTruth {
  std::string body;
  bool has_depth = true;     ///< False: pairs of two meshes, of which no depth is told.
  bool accelerated = false;  ///< Over all accelerations of a dog-leg, not its polyline alone.
  Bounds clearance;          ///< Least over the program: minus the depth for a hit.
  std::optional<FirstContact> first;
};

/// Least clearance of a tool on its courses from a body that stands at `offset` in G.
Bounds LeastClearance(const Cutter& cutter, const std::vector<Course>& courses, const Solid& solid,
                      const Eigen::Vector3d& offset);
std::optional<FirstContact> FirstHit(const Cutter& cutter, const std::vector<Course>& courses,
                                     const Solid& solid, const Eigen::Vector3d& offset);

/// How far along `away` (a unit vector, away from the tool) the body must be for the least
/// clearance to be `target`. nullopt: it cannot be had.
std::optional<Eigen::Vector3d> Tune(
    const std::function<double(const Eigen::Vector3d&)>& clearance_at, const Eigen::Vector3d& away,
    double target);
std::optional<Eigen::Vector3d> Tune(const Cutter& cutter, const std::vector<Course>& courses,
                                    const Solid& solid, const Eigen::Vector3d& away, double target);

struct Case {
  static constexpr int kTool = 5;

  explicit Case(const Table& the_table)
      : table(the_table), rig(kinematics::TrunnionBC(table.pivot_b, table.pivot_c)) {}

  /// The tool, as flutes, shank or holder; in the spindle from here on.
  void SetTool(const Cutter& the_cutter, machine::BodyKind kind, int number = kTool);
  /// A machine body as the head, and no tool.
  void SetHead(const machine::TriangleMesh& head_S);
  /// A body on the table; its truth is of `courses`.
  void AddBody(const Solid& solid, const Eigen::Isometry3d& X_BG, const Eigen::Vector3d& offset,
               const std::vector<Course>& courses);
  /// The same with a truth that was found otherwise.
  void AddBody(const Solid& solid, const Eigen::Isometry3d& X_BG, const Eigen::Vector3d& offset,
               const PairTruth& truth);

  Table table;
  collision::Rig rig;
  Cutter cutter;
  int tool = kTool;  ///< The one that the truth is about; 0: the head.
  /// A machine body on the spindle link instead of a tool, in frame S.
  machine::TriangleMesh head;
  std::vector<PairTruth> pairs;
};

/// A place where the tool stands upright on a table that is tilted and turned: frame G has its Z
/// along the spindle.
struct Upright {
  explicit Upright(Random* random);

  Table table;
  double b_deg = 0.0, c_deg = 0.0;
  Eigen::Isometry3d X_MG = Eigen::Isometry3d::Identity();

  Eigen::Isometry3d InTable() const { return table.InMachine(b_deg, c_deg).inverse() * X_MG; }
  void Start(Case* c, const Eigen::Vector3d& tip_G) const;
  void Go(Case* c, motion::MotionKind kind, const Eigen::Vector3d& tip_G) const;
};

/// Course of a straight move of the tip in G, tool along Z_G.
Course Straight(const Eigen::Vector3d& tip0_G, const Eigen::Vector3d& tip1_G, int motion = 0);

/// A pose of all five axes: the tip in the machine, and the table.
struct AxisPose {
  Eigen::Vector3d tip_M = Eigen::Vector3d::Zero();
  double b_deg = 0.0, c_deg = 0.0;
};
/// All axes in proportion; `reach`: how far points of the tool are from its tip.
Course Proportional(const Table& table, const Eigen::Isometry3d& X_BG, const AxisPose& from,
                    const AxisPose& to, double reach);
/// The tip straight in the table frame while the rotary axes turn in proportion.
Course TcpStraight(const Eigen::Isometry3d& X_BG, const Eigen::Vector3d& p0_B,
                   const Eigen::Vector3d& p1_B, const AxisPose& from, const AxisPose& to,
                   double reach);

/// Minus 0.001 to minus `deepest`, or 0.0205 to 2; one near miss in twenty is nearer than 0.02,
/// where an alarm is allowed.
double RandomTarget(Random* random, bool hit, double deepest = 1.0);
double LogUniform(Random* random, double lower, double upper);
/// End mill, bull nose or ball nose.
Cutter RandomCutter(Random* random, double least_radius, double greatest_radius);
machine::BodyKind RandomKind(Random* random);
motion::MotionKind RandomMotion(Random* random);

}  // namespace ncsim::planted
