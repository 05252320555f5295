// SPDX-License-Identifier: BSD-3-Clause
#include "sim/compare/cl_toolpath.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <regex>
#include <string_view>
#include <variant>

namespace ncsim::compare {
namespace {

using post::ClArc;
using post::ClCycleKind;
using post::ClEvent;
using post::ClFeed;

/// Axes that differ by less (rad) have no great circle of their own.
constexpr double kSameAxis = 1e-9;

/// mm/s; 0 where it is not known.
double FeedOf(const ClFeed& feed, const post::ClModal& modal) {
  if (!feed.per_revolution) return feed.value;
  const bool known = modal.spindle.mode == post::cl::Spindle::Mode::kRpm;
  return known ? feed.value * modal.spindle.speed / 60.0 : 0.0;
}

/// A tip on a line or an arc, an axis on a great circle. `M` is one frame for all.
struct ClCurve {
  Pose from, to;
  std::optional<ClArc> arc;
  Eigen::Isometry3d X_FM = Eigen::Isometry3d::Identity();  ///< Of the arc's frame.
  double turn = 0.0;                                       ///< rad, between the axes.

  ClCurve(const Pose& start, const Pose& end)
      : from(start), to(end), turn(std::atan2(start.u.cross(end.u).norm(), start.u.dot(end.u))) {}

  Eigen::Vector3d Axis(double s) const {
    if (turn < kSameAxis) return from.u + s * (to.u - from.u);
    return (std::sin((1.0 - s) * turn) * from.u + std::sin(s * turn) * to.u) / std::sin(turn);
  }

  /// Where the end is not on the circle it is met all the same: the difference goes in with s.
  Eigen::Vector3d ArcTip(double s) const {
    const Eigen::Vector3d centre = X_FM * arc->centre_M, normal = X_FM.linear() * arc->normal_M;
    const auto on = [&](double at) {
      const Eigen::AngleAxisd rotation(at * arc->sweep, normal);
      return Eigen::Vector3d(centre + rotation * (from.p - centre) + at * arc->rise * normal);
    };
    return on(s) + s * (to.p - on(1.0));
  }

  Pose operator()(double s) const {
    return {arc ? ArcTip(s) : from.p + s * (to.p - from.p), Axis(s)};
  }

  Curve Make() const {
    Curve curve;
    curve.at = *this;
    curve.bend.axis = turn * turn;
    if (arc) {
      const double radius = (from.p - X_FM * arc->centre_M).norm();
      curve.bend.position = radius * arc->sweep * arc->sweep;
    }
    return curve;
  }
};

/// Of the words that are passed on to a post: those that neither move the tool nor turn or shift
/// anything.
bool LeavesPath(std::string_view major) {
  constexpr std::array<std::string_view, 8> kWords = {"CLAMP",  "CLEARP", "COUPLE", "END",
                                                      "LINTOL", "SEQNO",  "TMARK",  "UNLOAD"};
  return std::find(kWords.begin(), kWords.end(), major) != kWords.end();
}

/// Nothing but addresses with numbers: "G53 Z0.", not "Stock Size X85.".
bool IsNcText(const std::string& text) {
  static const std::regex words(R"(\s*(/?\s*[A-Za-z]\s*=?\s*[-+]?[0-9.]+\s*)+;?\s*)");
  constexpr std::size_t kLongest = 200;  // of a block; std::regex recurses with the length
  return text.size() > kLongest || std::regex_match(text, words);
}

Pose Along(const Pose& point, double distance) { return {point.p + distance * point.u, point.u}; }

}  // namespace

void ClToolpath::NotFollowed(const ClEvent& event, const std::string& what) {
  if (!told_.insert(what).second) return;
  findings_.push_back(MakeFinding(Rule::kUnsupportedCode, event.where, what));
}

Pose ClToolpath::InFirst(const ClEvent& event, const post::ClPose& pose) {
  const std::optional<Eigen::Isometry3d>& X_AM = event.modal->operation->X_AM;
  if (!met_) {
    met_ = true;
    X_AFirst_ = X_AM;
  }
  if (X_AM.has_value() != X_AFirst_.has_value()) {
    NotFollowed(event,
                "how this operation's coordinate system lies to the first one's is not said");
  }
  if (!X_AM || !X_AFirst_) return {pose.tip_M, pose.axis_M};
  const Eigen::Isometry3d X_FM = X_AFirst_->inverse(Eigen::Isometry) * *X_AM;
  return {X_FM * pose.tip_M, X_FM.linear() * pose.axis_M};
}

void ClToolpath::OnEvent(const ClEvent& event) {
  if (const auto* motion = std::get_if<post::ClMotion>(&event.what)) {
    OnMotion(event, *motion);
  } else if (const auto* hole = std::get_if<post::ClHole>(&event.what)) {
    OnHole(event, *hole);
  } else if (const auto* position = std::get_if<post::ClPosition>(&event.what)) {
    builder_.Rapid(event.where, InFirst(event, position->pose));
  } else if (const auto* load = std::get_if<post::ClToolLoad>(&event.what)) {
    if (load->change) builder_.ToolChange();
  } else if (std::holds_alternative<post::ClDwell>(event.what)) {
    builder_.Dwell(event.where);
  } else if (const auto* word = std::get_if<post::cl::PostWord>(&event.what)) {
    if (!LeavesPath(word->major)) {
      NotFollowed(event, "what " + word->major + " does to the path was not followed");
    }
  } else if (const auto* code = std::get_if<post::cl::Code>(&event.what)) {
    if (code->letter == 'G') NotFollowed(event, "the G code of a PREFUN was not followed");
  } else if (const auto* text = std::get_if<post::cl::Text>(&event.what)) {
    if (text->kind == post::cl::Text::Kind::kInsert && IsNcText(text->text)) {
      NotFollowed(event, "the NC words of an INSERT were not followed");
    }
  }
}

void ClToolpath::OnMotion(const ClEvent& event, const post::ClMotion& motion) {
  ++motions_;
  const Pose to = InFirst(event, motion.end);
  // A feed from where nobody knows the tool to be is the way there.
  if (motion.rapid || motion.home || !motion.start) return builder_.Rapid(event.where, to);
  ClCurve curve(InFirst(event, *motion.start), to);
  curve.arc = motion.arc;
  if (X_AFirst_ && event.modal->operation->X_AM) {
    curve.X_FM = X_AFirst_->inverse(Eigen::Isometry) * *event.modal->operation->X_AM;
  }
  builder_.Feed(event.where, FeedOf(motion.feed, *event.modal), curve.Make());
}

void ClToolpath::OnHole(const ClEvent& event, const post::ClHole& hole) {
  ++motions_;
  const post::ClHoleCycle& cycle = *hole.cycle;
  const Pose point = InFirst(event, hole.point);
  const double feed = FeedOf(cycle.feed, *event.modal);
  const Pose top = Along(point, cycle.clearance), bottom = Along(point, cycle.bottom);
  builder_.Rapid(event.where, top);
  builder_.Feed(event.where, feed, ClCurve(top, bottom).Make());
  if (cycle.dwell > 0.0) builder_.Dwell(event.where);
  switch (cycle.kind) {
    case ClCycleKind::kTap:
    case ClCycleKind::kReam:
    case ClCycleKind::kBore:
      builder_.Feed(event.where, feed, ClCurve(bottom, top).Make());
      break;
    case ClCycleKind::kBoreBack:
    case ClCycleKind::kBoreManual:
    case ClCycleKind::kThru:
      NotFollowed(event, "the motion of this cycle was not followed");
      break;
    default:
      break;
  }
  builder_.Rapid(event.where, Along(point, hole.retract));
}

}  // namespace ncsim::compare
