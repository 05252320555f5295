// SPDX-License-Identifier: BSD-3-Clause
#include "sim/compare/nc_path.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <variant>

namespace ncsim::compare {
namespace {

using motion::JointVector;
using motion::Motion;

/// mm: a tip that moves less in a feed has no speed to compare.
constexpr double kLeastWay = 1e-3;
/// Samples of the way of a feed whose tip is not led along a line or an arc.
constexpr int kWaySamples = 16;

struct BendOf {
  const kinematics::FiveAxis& five_axis;
  double length;

  /// With the rotary joints at the rates w0 (next to the tool) and w1, no point of a tool turns
  /// faster than w0 + w1, and |u''| <= (w0 + w1)^2.
  double Turn(const JointVector& q0, const JointVector& q1) const {
    double turn = 0.0;
    for (const int joint : five_axis.rotary()) turn += std::abs(q1[joint] - q0[joint]);
    return turn;
  }

  Pose At(const JointVector& q) const {
    Pose pose;
    five_axis.TipInTable(q, length, &pose.p, &pose.u);
    return pose;
  }

  /// The path is a product of turns about the rotary axes and a slide y(s) with |y'| <= speed and
  /// |y''| <= bend; so
  ///   |p''| <= sum_k w_k^2 r_k + 2 w0 w1 r_0 + 2 (w0 + w1) speed + bend,
  /// r_k the distance of the tip from axis k in the frame in which that axis rests. r_k is no
  /// greater than at the start plus the way of the tip there: the slide, and for the table's axis
  /// (k = 1) what axis 0 turns it by.
  Distance Joints(const JointVector& q0, const JointVector& q1, double speed, double bend) const {
    const std::vector<int>& rotary = five_axis.rotary();
    std::array<double, 2> rate{};
    for (std::size_t k = 0; k < rotary.size(); ++k) {
      rate[k] = std::abs(q1[rotary[k]] - q0[rotary[k]]);
    }
    if (rate[0] + rate[1] == 0.0) return {bend, 0.0};
    std::array<double, 2> radius = five_axis.TipRadii(At(q0).p, length, q0);
    radius[0] += speed;
    radius[1] += speed + rate[0] * radius[0];
    const double turn = rate[0] + rate[1];
    return {rate[0] * rate[0] * radius[0] + rate[1] * rate[1] * radius[1] +
                2.0 * rate[0] * rate[1] * radius[0] + 2.0 * turn * speed + bend,
            turn * turn};
  }

  /// Way of the tip if only the linear joints went from q0 to q1: the slide.
  double Slide(const JointVector& q0, const JointVector& q1) const {
    JointVector q = q1;
    for (const int joint : five_axis.rotary()) q[joint] = q0[joint];
    return (At(q).p - At(q0).p).norm();
  }

  Distance operator()(const motion::AxisLinear& path) const {
    return Joints(path.q0, path.q1, Slide(path.q0, path.q1), 0.0);
  }
  Distance operator()(const motion::DogLeg&) const { return {}; }
  Distance operator()(const motion::AxisArc& path) const {
    const double turn = std::abs(path.sweep);
    // Unit directions: at most this much longer in space than in the joints.
    const double gain = five_axis.linear_square() ? 1.0 : std::sqrt(3.0);
    return Joints(path.q0, path.q1,
                  gain * (path.radius * turn + (path.pitch + path.end_error).norm()),
                  gain * path.radius * turn * turn);
  }
  /// The control leads its own tip on the line or the arc. Where it takes the rotary centre for
  /// another (by centre_error) or the tool for another length, the metal's tip is off by vectors of
  /// that length that turn with the joints.
  Distance operator()(const motion::TcpCurve& path) const {
    const double turn =
        path.great_circle != nullptr ? path.great_circle->angle() : Turn(path.q0, path.q1);
    const double off = path.frame->centre_error + std::abs(path.frame->length - length);
    const double arc = path.arc ? path.radius * path.sweep * path.sweep : 0.0;
    return {arc + off * turn * turn, turn * turn};
  }
};

/// Length of the tip's way in the part.
double Way(const Curve& curve, const Motion& motion) {
  if (const auto* tcp = std::get_if<motion::TcpCurve>(&motion.path)) {
    const double across = tcp->arc ? tcp->radius * tcp->sweep : (tcp->p1_B - tcp->p0_B).norm();
    return tcp->arc ? std::hypot(across, (tcp->pitch + tcp->end_error).norm()) : across;
  }
  if (curve.bend.position == 0.0) return (curve.at(1.0).p - curve.at(0.0).p).norm();
  if (const auto* arc = std::get_if<motion::AxisArc>(&motion.path); arc && curve.bend.axis == 0.0) {
    return std::hypot(arc->radius * arc->sweep, (arc->pitch + arc->end_error).norm());
  }
  double way = 0.0;
  for (int i = 0; i < kWaySamples; ++i) {
    way += (curve.at((i + 1.0) / kWaySamples).p - curve.at(1.0 * i / kWaySamples).p).norm();
  }
  return way;
}

/// Speed of the tip in the part, mm/s; 0 where it is not known.
struct TipFeed {
  double value = 0.0;
  double slack = 0.0;  ///< As Piece.
};

/// Without TCP, and with rotary axes moving, F counts another way: there the time of the block says
/// it.
TipFeed FeedOf(const Curve& curve, const Motion& motion, double increment) {
  const double way = Way(curve, motion);
  if (way < kLeastWay) return {};
  const bool by_time =
      curve.bend.axis > 0.0 && !std::holds_alternative<motion::TcpCurve>(motion.path);
  if (!by_time) return {motion.facts.feed, 0.0};
  if (!(motion.duration > 0.0)) return {};
  // Both ends are rounded in X, Y and Z: by half a diagonal at most.
  return {way / motion.duration, std::sqrt(3.0) * increment / motion.duration};
}

}  // namespace

Curve CurveInTable(const kinematics::FiveAxis& metal, const Motion& motion, double length) {
  Curve curve;
  const BendOf bend{metal, length};
  curve.at = [&motion, bend](double s) { return bend.At(motion.At(s)); };
  curve.bend = std::visit(bend, motion.path);
  // A turn along a great circle is not in proportion to s: what the centre is off counts whole.
  const auto* tcp = std::get_if<motion::TcpCurve>(&motion.path);
  if (tcp != nullptr && tcp->great_circle != nullptr) curve.loose = 2.0 * tcp->frame->centre_error;
  return curve;
}

NcPath::NcPath(const machine::Machine& machine, const machine::ToolTable& tools,
               const std::vector<control::PartFrame>& part_frames, const Distance& chord_error,
               double increment)
    : machine_(&machine),
      tools_(&tools),
      part_frames_(&part_frames),
      builder_(chord_error),
      increment_(increment) {}

void NcPath::OnFinding(Finding finding) {
  if (finding.severity != Severity::kWarning) findings_.push_back(std::move(finding));
}

void NcPath::OnMotion(const Motion& motion) {
  ++motions_;
  const machine::Tool* tool = tools_->Find(motion.facts.tool);
  const double length = tool == nullptr ? 0.0 : tool->length;
  if (motion.kind == motion::MotionKind::kDwell) return builder_.Dwell(motion.where);
  if (motion::IsFeed(motion)) return AddFeed(motion, length);
  if (motion.kind == motion::MotionKind::kToolChange) builder_.ToolChange();
  Pose pose;
  machine_->five_axis->TipInTable(motion.q1(), length, &pose.p, &pose.u);
  builder_.Rapid(motion.where, pose);
}

void NcPath::AddFeed(const Motion& motion, double length) {
  if (frame_ < 0) frame_ = motion.facts.offset;
  const Curve curve = CurveInTable(*machine_->five_axis, motion, length);
  const TipFeed feed = FeedOf(curve, motion, increment_);
  const double begin = CycleBegin(motion, curve);
  if (begin >= 1.0) return builder_.Rapid(motion.where, curve.at(1.0));
  if (begin <= 0.0) return builder_.Feed(motion.where, feed.value, curve, feed.slack);
  builder_.Rapid(motion.where, curve.at(begin));
  Curve rest = curve;
  rest.at = [&curve, begin](double s) { return curve.at(begin + s * (1.0 - begin)); };
  builder_.Feed(motion.where, feed.value, rest, feed.slack);
}

/// The part of a straight feed of a canned cycle that goes where the same hole has been fed
/// already: a peck's way back to the bottom. 0 for other feeds.
double NcPath::CycleBegin(const Motion& motion, const Curve& curve) {
  const Pose from = curve.at(0.0), to = curve.at(1.0);
  const bool new_hole = motion.facts.cycle == 0 || motion.facts.cycle != cycle_;
  if (new_hole) {
    entry_ = from;
    depth_ = 0.0;
  }
  cycle_ = motion.facts.cycle;
  if (cycle_ == 0 || curve.bend.position > 0.0 || curve.bend.axis > 0.0) return 0.0;
  const double at = (entry_.p - from.p).dot(entry_.u), end = (entry_.p - to.p).dot(entry_.u);
  const double known = depth_;
  depth_ = std::max(depth_, end);
  if (end <= at) return 0.0;
  return std::clamp((known - at) / (end - at), 0.0, 1.0);
}

std::string NcPath::frame() const {
  return frame_ < 0 ? "" : part_frames_->at(static_cast<std::size_t>(frame_)).name;
}

Toolpath NcPath::Take() {
  Toolpath path = builder_.Take();
  if (frame_ < 0) return path;
  const Eigen::Isometry3d X_PB =
      part_frames_->at(static_cast<std::size_t>(frame_)).X_BP.inverse(Eigen::Isometry);
  const auto place = [&](Pose* pose) {
    pose->p = X_PB * pose->p;
    pose->u = X_PB.linear() * pose->u;
  };
  for (Run& run : path.runs) {
    for (Pose& pose : run.vertices) place(&pose);
  }
  for (Gap& gap : path.gaps) {
    for (RapidEnd& end : gap.ends) place(&end.pose);
  }
  return path;
}

}  // namespace ncsim::compare
