// SPDX-License-Identifier: BSD-3-Clause
#include "post/planner.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "post/plan_moves.h"
#include "post/rotary_choice.h"
#include "sim/base/text.h"
#include "sim/base/units.h"

namespace ncsim::post {
namespace {

constexpr double kSameToolAxis = 1e-7;  // rad
constexpr double kSameRotary = 1e-9;
constexpr double kTimeRounding = 1e-3;  // of a time: inverse time is printed with three decimals
constexpr double kExactly = 1e-6;       // of a time

bool SameAxis(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  return a.cross(b).norm() < kSameToolAxis && a.dot(b) > 0.0;
}

bool SameRotary(const Rotary& a, const Rotary& b) {
  return std::abs(a[0] - b[0]) < kSameRotary && std::abs(a[1] - b[1]) < kSameRotary;
}

/// X and Y directions of a plane with this normal: X level with P's XY plane, as a swivel cycle
/// would be told by two angles; P's own where the normal is its Z.
Eigen::Matrix3d PlaneOf(const Eigen::Vector3d& normal) {
  const Eigen::Vector3d level(normal.x(), normal.y(), 0.0);
  Eigen::Matrix3d plane = Eigen::Matrix3d::Identity();
  if (level.norm() < kSameToolAxis) {
    if (normal.z() < 0.0) plane.diagonal() << 1.0, -1.0, -1.0;
    return plane;
  }
  plane.col(2) = normal;
  plane.col(1) = Eigen::Vector3d(-level.y(), level.x(), 0.0).normalized();
  plane.col(0) = plane.col(1).cross(normal);
  return plane;
}

/// A motion or a hole of the operation in hand, in P.
struct Work {
  std::size_t event = 0;  ///< Index into the buffer.
  std::optional<ClPose> start;
  ClPose end;
  std::optional<ClArc> arc;
  ClFeed feed;
  bool rapid = false;
  bool hole = false;
  /// Where the tool comes from above: the end, or the level over a hole.
  ClPose approach;
};

}  // namespace

class Planner::State {
 public:
  State(const PartGeometry& geometry, const PlanOptions& options, std::string name,
        Diagnostics* diagnostics, PlanSink* sink)
      : geometry_(geometry),
        options_(options),
        name_(std::move(name)),
        diagnostics_(diagnostics),
        sink_(sink) {}

  void Take(const ClEvent& event) {
    const bool begins = std::holds_alternative<ClOperationBegin>(event.what) ||
                        std::holds_alternative<ClToolLoad>(event.what);
    const bool ends = std::holds_alternative<ClEnd>(event.what);
    if ((begins && has_work_) || ends) Hand();
    has_work_ = has_work_ || std::holds_alternative<ClMotion>(event.what) ||
                std::holds_alternative<ClHole>(event.what);
    buffer_.push_back(event);
    if (!ends) return;
    Hand();
    Plan(std::exchange(waiting_, {}), {});
    Emit(event, PlanEnd{});
  }

  const std::vector<PlanChoice>& choices() const { return choices_; }

 private:
  using Events = std::vector<ClEvent>;

  /// The buffer becomes the operation that waits for its successor's tool.
  void Hand() {
    Events next = std::exchange(buffer_, {});
    has_work_ = false;
    std::optional<int> tool;
    if (!next.empty()) tool = next.back().modal->tool->number;
    Plan(std::exchange(waiting_, std::move(next)), tool);
  }

  void Plan(const Events& events, const std::optional<int>& next_tool);
  std::vector<Work> Collect(const Events& events);
  Eigen::Isometry3d FrameOf(const ClEvent& event);
  bool ModeFits(const Events& events, const std::vector<Work>& works, PlanMode mode);
  void MeetPole(std::vector<Work>* works) const;
  PlanMode ModeOf(const std::vector<Work>& works) const;
  void BeginOperation(const Events& events, PlanMode mode, const std::optional<int>& next_tool);
  bool PlanSection(const Events& events, const std::vector<Work>& works, std::size_t first,
                   std::size_t last);
  const RotaryPath* Choose(const ClEvent& event, const std::vector<RotaryPath>& ways);
  void Index(const ClEvent& event, const Rotary& rotary, const ClPose& approach,
             PlanIndex::Why why);
  void Rewind(const ClEvent& event, const ClPose& pose, const Rotary& to, const Work& next,
              bool in_rapid);
  bool Move(const ClEvent& event, const Work& work, const Rotary& to);
  bool FastEnough(const ClEvent& event, const PlanPose& from, const PlanMove& move);
  void Pass(const Events& events, std::size_t end);
  void Error(const SourcePosition& where, std::string message) {
    diagnostics_->Error(name_, where.line, where.column, std::move(message));
  }
  template <typename What>
  void Emit(const ClEvent& event, What what) {
    sink_->OnStep({event.where, event.modal, std::move(what)});
  }
  MoveFrame frame() const {
    return {mode_, mode_ == PlanMode::kIndexed && options_.turned_planes ? &plane_ : nullptr};
  }

  const PartGeometry& geometry_;
  const PlanOptions& options_;
  std::string name_;
  Diagnostics* diagnostics_;
  PlanSink* sink_;
  std::vector<PlanChoice> choices_;
  Events buffer_, waiting_;
  bool has_work_ = false;                  ///< Of the buffer.
  std::optional<Eigen::Isometry3d> X_AP_;  ///< P in the absolute system, from the first MSYS.
  // What the machine does.
  PlanMode mode_ = PlanMode::kIndexed;
  Eigen::Matrix3d plane_ = Eigen::Matrix3d::Identity();
  Rotary rotary_{};
  bool placed_ = false;  ///< An index has been made since the tool was loaded.
  std::optional<int> tool_;
  std::string tool_name_;
  std::size_t passed_ = 0;  ///< Events of the operation in hand that have been dealt with.
  int section_ = 0;         ///< Of the operation in hand.
};

/// X_PM of the event's operation.
Eigen::Isometry3d Planner::State::FrameOf(const ClEvent& event) {
  const auto& X_AM = event.modal->operation->X_AM;
  if (!X_AM) return Eigen::Isometry3d::Identity();
  if (!X_AP_) X_AP_ = *X_AM;
  return X_AP_->inverse() * *X_AM;
}

std::vector<Work> Planner::State::Collect(const Events& events) {
  std::vector<Work> works;
  for (std::size_t i = 0; i < events.size(); ++i) {
    Work work;
    work.event = i;
    const Eigen::Isometry3d X_PM = FrameOf(events[i]);
    if (const auto* motion = std::get_if<ClMotion>(&events[i].what)) {
      if (motion->start) work.start = Transformed(X_PM, *motion->start);
      work.end = Transformed(X_PM, motion->end);
      if (motion->arc) work.arc = Transformed(X_PM, *motion->arc);
      work.feed = motion->feed;
      work.rapid = motion->rapid;
      work.approach = work.end;
    } else if (const auto* hole = std::get_if<ClHole>(&events[i].what)) {
      if (hole->start) work.start = Transformed(X_PM, *hole->start);
      work.end = Transformed(X_PM, hole->point);
      work.hole = work.rapid = true;
      work.approach = work.end;
      work.approach.tip_M += std::max(hole->retract, hole->cycle->clearance) * work.end.axis_M;
    } else {
      continue;
    }
    works.push_back(std::move(work));
  }
  return works;
}

/// Tool axes that are at the pole but for the tolerance are there: the second axis stays.
void Planner::State::MeetPole(std::vector<Work>* works) const {
  const auto meet = [&](ClPose* pose) {
    const auto pole = geometry_.Pole(pose->axis_M);
    if (pole && AngleBetween(*pole, pose->axis_M) <= PoleTolerance(options_)) pose->axis_M = *pole;
  };
  for (Work& work : *works) {
    if (work.start) meet(&*work.start);
    meet(&work.end);
    meet(&work.approach);
  }
}

PlanMode Planner::State::ModeOf(const std::vector<Work>& works) const {
  if (options_.mode) return *options_.mode;
  for (const Work& work : works) {
    if (!work.rapid && work.start && !SameAxis(work.start->axis_M, work.end.axis_M)) {
      return PlanMode::kTcp;
    }
  }
  return PlanMode::kIndexed;
}

bool Planner::State::ModeFits(const Events& events, const std::vector<Work>& works, PlanMode mode) {
  for (const Work& work : works) {
    const bool turns = !work.rapid && work.start && !SameAxis(work.start->axis_M, work.end.axis_M);
    if (turns && mode == PlanMode::kIndexed) {
      Error(events[work.event].where,
            "a feed turns the tool axis, and this mode holds the rotary axes still");
      return false;
    }
    if (turns && geometry_.num_rotary() == 0) {
      Error(events[work.event].where,
            "a feed turns the tool axis on a machine without rotary axes");
      return false;
    }
    if (work.hole && !options_.abilities[static_cast<std::size_t>(mode)].holes) {
      Error(events[work.event].where, "the mode has no drilling cycles");
      return false;
    }
  }
  if (options_.abilities[static_cast<std::size_t>(mode)].compensation) return true;
  for (const ClEvent& event : events) {
    if (event.modal->comp.side == cl::CutterComp::Side::kOff) continue;
    Error(event.where, "the mode has no cutter compensation (CUTCOM)");
    return false;
  }
  return true;
}

void Planner::State::BeginOperation(const Events& events, PlanMode mode,
                                    const std::optional<int>& next_tool) {
  const ClModal& modal = *events.back().modal;
  PlanOperation operation;
  operation.mode = mode;
  operation.tool_change = modal.tool->number != tool_ ||
                          (!modal.tool->number && modal.tool->name != tool_name_) ||
                          choices_.empty();
  if (next_tool != modal.tool->number) operation.next_tool = next_tool;
  tool_ = modal.tool->number;
  tool_name_ = modal.tool->name;
  if (operation.tool_change || options_.separate) placed_ = false;
  PlanStep step{events.front().where, events.back().modal, operation};
  sink_->OnStep(step);
  choices_.push_back({modal.operation->index, 1, 0});
}

void Planner::State::Plan(const Events& events, const std::optional<int>& next_tool) {
  if (events.empty()) return;
  passed_ = 0;
  section_ = 0;
  std::vector<Work> works = Collect(events);
  if (!works.empty()) {
    const PlanMode mode = ModeOf(works);
    if (!ModeFits(events, works, mode)) return;
    if (mode != PlanMode::kIndexed) MeetPole(&works);
    BeginOperation(events, mode, next_tool);
    if (mode != mode_) placed_ = false;
    mode_ = mode;
    std::size_t first = 0;
    while (first < works.size()) {
      std::size_t last = first + 1;
      // A rapid that turns the tool begins a section: the machine retracts for it.
      while (last < works.size() &&
             (!works[last].rapid || SameAxis(works[last].end.axis_M, works[last - 1].end.axis_M))) {
        ++last;
      }
      if (!PlanSection(events, works, first, last)) return;
      first = last;
    }
  }
  Pass(events, events.size());
}

/// The events up to `end` that are no motions.
void Planner::State::Pass(const Events& events, std::size_t end) {
  for (; passed_ < end; ++passed_) {
    const ClEvent& event = events[passed_];
    std::visit(
        [&](const auto& what) {
          using What = std::decay_t<decltype(what)>;
          if constexpr (std::is_constructible_v<decltype(PlanStep::what), What> &&
                        !std::is_same_v<What, ClEnd>) {
            Emit(event, what);
          }
        },
        event.what);
  }
}

const RotaryPath* Planner::State::Choose(const ClEvent& event,
                                         const std::vector<RotaryPath>& ways) {
  PlanChoice& choice = choices_.back();
  std::size_t taken = 0;
  if (section_++ == 0) {  // The first section of an operation decides; the others follow nearest.
    const auto wanted = options_.choice.find(event.modal->operation->index);
    if (wanted != options_.choice.end()) taken = std::min(wanted->second, ways.size() - 1);
    choice.ways = ways.size();
    choice.taken = taken;
  }
  return &ways[taken];
}

void Planner::State::Index(const ClEvent& event, const Rotary& rotary, const ClPose& approach,
                           PlanIndex::Why why) {
  rotary_ = rotary;
  plane_ = options_.turned_planes ? PlaneOf(approach.axis_M) : Eigen::Matrix3d::Identity();
  PlanIndex index;
  index.rotary = rotary;
  index.mode = mode_;
  index.plane_P = mode_ == PlanMode::kTcp
                      ? geometry_.Directions(PlanMode::kIndexed, nullptr, rotary).transpose()
                      : plane_;
  index.approach = PoseAt(geometry_, frame(), approach, rotary);
  index.why = why;
  if (why == PlanIndex::Why::kRewind) index.retract = options_.rewind_retract;
  Emit(event, index);
  placed_ = true;
}

/// Out of the part along the tool, the turn, and back to where it was: with the feed of what comes
/// next, or as the tool has come there in rapid.
void Planner::State::Rewind(const ClEvent& event, const ClPose& pose, const Rotary& to,
                            const Work& next, bool in_rapid) {
  const ClPose clear{pose.tip_M + options_.rewind_retract * pose.axis_M, pose.axis_M};
  PlanMove out;
  out.rapid = true;
  out.of_file = false;
  out.end = PoseAt(geometry_, frame(), clear, rotary_);
  Emit(event, out);
  Index(event, to, clear, PlanIndex::Why::kRewind);
  PlanMove back;
  back.of_file = false;
  back.rapid = in_rapid;
  back.feed = next.feed;
  const bool timed = !next.feed.per_revolution && next.feed.value > 0.0;
  if (timed) back.time = options_.rewind_retract / next.feed.value;
  back.end = PoseAt(geometry_, frame(), pose, to);
  Emit(event, back);
}

bool Planner::State::Move(const ClEvent& event, const Work& work, const Rotary& to) {
  if (work.hole) {
    PlanHole hole;
    hole.hole = std::get<ClHole>(event.what);
    hole.point = PoseAt(geometry_, frame(), work.end, to);
    const Eigen::Vector3d axis = geometry_.Directions(mode_, frame().plane_P, to) * work.end.axis_M;
    int along = 2;
    axis.cwiseAbs().maxCoeff(&along);
    if (std::abs(axis[along]) < 1.0 - 1e-6) {
      Error(event.where, "the hole's axis lies along no axis of the program");
      return false;
    }
    hole.plane = along == 2 ? PlanPlane::kXY : along == 1 ? PlanPlane::kZX : PlanPlane::kYZ;
    hole.negative = axis[along] < 0.0;
    Emit(event, hole);
    return true;
  }
  if (work.rapid || !work.start) {
    PlanMove move;
    move.rapid = work.rapid;
    move.feed = work.feed;
    move.end = PoseAt(geometry_, frame(), work.end, to);
    Emit(event, move);
    return true;
  }
  std::vector<PlanMove> moves;
  const std::string problem = FeedMoves(geometry_, options_, frame(), *work.start, rotary_,
                                        work.end, to, work.arc, work.feed, &moves);
  if (!problem.empty()) {
    Error(event.where, problem);
    return false;
  }
  PlanPose from = PoseAt(geometry_, frame(), *work.start, rotary_);
  for (const PlanMove& move : moves) {
    if (!FastEnough(event, from, move)) return false;
    Emit(event, move);
    from = move.end;
  }
  return true;
}

bool Planner::State::FastEnough(const ClEvent& event, const PlanPose& from, const PlanMove& move) {
  if (!options_.abilities[static_cast<std::size_t>(mode_)].rate_alarm || !(move.time > 0.0)) {
    return true;
  }
  PlanPose to = move.end;
  double time = move.time;
  if (move.arc) {  // Each axis of the plane is as fast as the tip somewhere, on more than a
                   // quarter.
    to = from;
    to.xyz += Eigen::Vector3d::Constant(move.feed.value * time);
  }
  // Of a turn the time is what is printed, and it is rounded.
  const double rounding = SameRotary(from.rotary, to.rotary) ? kExactly : -kTimeRounding;
  const auto slow = geometry_.TooSlow(from, to, time * (1.0 + rounding));
  if (!slow) return true;
  const double feed = 60.0 * move.feed.value * time / slow->time;
  Error(event.where, "a feed of " + Short(std::round(60.0 * move.feed.value)) +
                         " mm/min is more than axis " + std::string(1, slow->letter) +
                         " can do here, and the control stops with an alarm: it can do " +
                         Short(std::floor(feed)) + " mm/min");
  return false;
}

bool Planner::State::PlanSection(const Events& events, const std::vector<Work>& works,
                                 std::size_t first, std::size_t last) {
  // The axis that the section begins with, and that of each end.
  std::vector<Eigen::Vector3d> axes;
  const bool goes_on = placed_ && !works[first].rapid && works[first].start;
  axes.push_back(goes_on ? works[first].start->axis_M : works[first].end.axis_M);
  for (std::size_t i = first; i < last; ++i) axes.push_back(works[i].end.axis_M);
  std::size_t unreachable = 0;
  const std::vector<RotaryPath> ways =
      RankRotary(geometry_, axes, rotary_, PoleTolerance(options_), &unreachable);
  const auto event_of = [&](std::size_t axis) -> const ClEvent& {
    return events[works[first + (axis == 0 ? 0 : axis - 1)].event];
  };
  if (ways.empty()) {
    const Eigen::Vector3d& u = axes[unreachable];
    Error(event_of(unreachable).where, "the machine cannot tilt the tool to the axis " +
                                           Fixed(u.x(), 6) + ", " + Fixed(u.y(), 6) + ", " +
                                           Fixed(u.z(), 6));
    return false;
  }
  const RotaryPath& path = *Choose(event_of(0), ways);
  const ClPose begin = goes_on ? *works[first].start : works[first].approach;
  const auto start_of = [&](std::size_t axis) {
    for (const auto& rewind : path.rewinds) {
      if (rewind.at == axis) return rewind.before;
    }
    return path.rotary[axis];
  };
  Pass(events, works[first].event);
  if (!placed_ || !SameRotary(start_of(0), rotary_)) {
    const bool operation = !placed_ || section_ == 1;
    Index(events[works[first].event], start_of(0), begin,
          operation ? PlanIndex::Why::kOperation : PlanIndex::Why::kAxis);
  }
  auto rewind = path.rewinds.begin();
  for (std::size_t i = first; i < last; ++i) {
    const Work& work = works[i];
    const ClEvent& event = events[work.event];
    Pass(events, work.event);
    const std::size_t axis = i - first;  // The one that the motion begins with.
    if (rewind != path.rewinds.end() && rewind->at == axis) {
      const bool in_rapid = i == first ? !goes_on : works[i - 1].rapid;
      Rewind(event, i == first ? begin : works[i - 1].end, path.rotary[axis], work, in_rapid);
      ++rewind;
    }
    const Rotary to = start_of(axis + 1);
    if (!Move(event, work, to)) return false;
    rotary_ = to;
    passed_ = work.event + 1;
  }
  return true;
}

Planner::Planner(const PartGeometry& geometry, const PlanOptions& options, std::string name,
                 Diagnostics* diagnostics, PlanSink* sink)
    : state_(std::make_unique<State>(geometry, options, std::move(name), diagnostics, sink)) {}
Planner::~Planner() = default;

void Planner::Take(const ClEvent& event) { state_->Take(event); }

const std::vector<PlanChoice>& Planner::choices() const { return state_->choices(); }

}  // namespace ncsim::post
