// SPDX-License-Identifier: BSD-3-Clause
// Clearance of one pair at one pose. Two engines behind one face; the conformance test holds them
// against each other.
#pragma once

#include <Eigen/Geometry>
#include <memory>
#include <optional>

#include "sim/collision/bodies.h"
#include "sim/collision/profile_distance.h"
#include "sim/collision/swept.h"

namespace ncsim::collision {

class PairEngine {
 public:
  virtual ~PairEngine() = default;

  /// Clearance of the two SURFACES with A at X_BA in B's link frame; `goal` says how closely.
  /// Negative where the engine knows depths. nullopt: cannot be certified at this pose.
  virtual std::optional<Interval> Clearance(const Eigen::Isometry3d& X_BA,
                                            const DistanceGoal& goal) = 0;
  /// A lower bound of Clearance over all of a straight way of A, from X_BA on by `way` (mm, in B's
  /// frame), without a turn. Worth nothing unless it is above `need`. nullopt where no such way is
  /// known.
  virtual std::optional<double> ClearanceAllTheWay(const Eigen::Isometry3d& X_BA,
                                                   const Eigen::Vector3d& way, double need) = 0;
  /// With no contact of the surfaces: is one body inside the other?
  virtual bool Contained(const Eigen::Isometry3d& X_BA) = 0;
  /// Clearance of the SOLIDS; of a pair that has no depth, 0 stands for any contact.
  virtual std::optional<Interval> Solid(const Eigen::Isometry3d& X_BA,
                                        const DistanceGoal& goal) = 0;
  /// The second opinion on a contact: true when FCL sees the surfaces meet or one body is inside
  /// the other.
  virtual bool Confirms(const Eigen::Isometry3d& X_BA) = 0;

  /// How far beyond what is needed a clearance is worth computing, mm: it is a budget for the
  /// motions to come.
  virtual double Budget(double need) const = 0;
  /// Which part of a clearance that was found to be ask for next time: one where asking for too
  /// much costs little.
  virtual double thrift() const = 0;
  virtual bool has_depth() const = 0;
  /// The least value that Clearance or Solid can have; minus the greatest depth.
  virtual double floor() const = 0;
};

/// Tool body A against a mesh.
std::unique_ptr<PairEngine> MakeEngine(std::shared_ptr<const ToolBody> a,
                                       std::shared_ptr<const MeshBody> b);
/// A swept body and a mesh; only clearances are asked of it.
std::unique_ptr<PairEngine> MakeEngine(std::shared_ptr<const SweptPair> pair);
/// Mesh against mesh; FCL has the word on contact. No depth.
std::unique_ptr<PairEngine> MakeEngine(std::shared_ptr<const MeshBody> a,
                                       std::shared_ptr<const MeshBody> b);

}  // namespace ncsim::collision
