// SPDX-License-Identifier: BSD-3-Clause
#include "kinematics/relative_bound.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace ncsim::kinematics {

double Chord(double angle) {
  constexpr double kSmall = 2e-3;  // rad: the arc is longer by a part in six million
  if (angle < kSmall) return angle;
  return 2.0 * std::sin(0.5 * std::min(angle, std::numbers::pi));
}

RelativePath::RelativePath(const KinematicTree& tree, int link_b, int link_a)
    : chain_(tree, link_b, link_a) {
  const std::vector<ChainStep>& steps = chain_.steps();
  Eigen::Matrix3d R = Eigen::Matrix3d::Identity();  // from the slide's first step to step i
  for (int i = 0; i < static_cast<int>(steps.size()); ++i) {
    indices_.push_back(steps[i].index);
    if (steps[i].revolute) continue;
    if (slides_.empty() || slides_.back().last != i) {
      slides_.push_back({i, i, {}});
      R.setIdentity();
    }
    Slide& slide = slides_.back();
    slide.last = i + 1;
    slide.directions.emplace_back(R * steps[i].axis);
    for (std::size_t k = 0; k + 1 < slide.directions.size(); ++k) {
      if (std::abs(slide.directions[k].dot(slide.directions.back())) > 1e-9) slide.square = false;
    }
    R = R * steps[i].X_after.linear();
  }
}

bool RelativePath::MovesBetween(const JointVector& q0, const JointVector& q1) const {
  return std::any_of(indices_.begin(), indices_.end(), [&](int i) { return q0[i] != q1[i]; });
}

double RelativePath::SlideBound(const Slide& slide, const JointVector& deviation) const {
  double square = 0.0;
  for (int i = slide.first; i < slide.last; ++i) {
    const double d_i = deviation[indices_[i]];
    if (d_i == 0.0) continue;
    square += d_i * d_i;
    for (int j = slide.first; j < i; ++j) {
      const double cosine =
          slide.directions[i - slide.first].dot(slide.directions[j - slide.first]);
      square += 2.0 * d_i * deviation[indices_[j]] * std::abs(cosine);
    }
  }
  return std::sqrt(square);
}

double RelativePath::Bound(const JointVector& q, const Extent& a, const JointVector& deviation,
                           double prismatic_limit) const {
  double bound = 0.0;
  for (const Slide& slide : slides_) {
    bound += std::min(SlideBound(slide, deviation), prismatic_limit);
  }
  // The centre of the extent, carried from link a toward b joint by joint: always in the frame of
  // the joint at hand.
  Eigen::Vector3d y = a.p_LC;
  const std::vector<ChainStep>& steps = chain_.steps();
  for (auto step = steps.rbegin(); step != steps.rend(); ++step) {
    y = step->X_after * y;
    if (step->revolute && deviation[step->index] != 0.0) {
      bound += Chord(deviation[step->index]) * (step->axis.cross(y).norm() + a.radius);
    }
    y = step->Apply(q[step->index], y);
  }
  return bound;
}

TravelWeights RelativePath::Weights(const JointVector& middle, const JointVector& half,
                                    const Extent& a) const {
  TravelWeights weights;
  weights.joints = JointVector::Zero(middle.size());
  for (const Slide& slide : slides_) {
    const bool as_one = slide.square && slide.last - slide.first > 1;
    if (as_one) weights.linear += 1.0;
    for (int i = slide.first; i < slide.last && !as_one; ++i) weights.joints[indices_[i]] += 1.0;
  }
  Eigen::Vector3d y = a.p_LC;
  double astray = 0.0;  // how far from y the centre may be
  const std::vector<ChainStep>& steps = chain_.steps();
  for (auto step = steps.rbegin(); step != steps.rend(); ++step) {
    y = step->X_after * y;
    if (step->revolute) {
      const double radius = step->axis.cross(y).norm();
      weights.joints[step->index] = radius + astray + a.radius;
      astray += Chord(half[step->index]) * (radius + astray);
    } else {
      astray += half[step->index];
    }
    y = step->Apply(middle[step->index], y);
  }
  return weights;
}

}  // namespace ncsim::kinematics
