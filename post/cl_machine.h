// SPDX-License-Identifier: BSD-3-Clause
// What ClPath does with one record. cl_machine.cc: motion; cl_machine_modal.cc: everything else.
#pragma once

#include <deque>
#include <memory>
#include <optional>
#include <string>

#include "post/cl_arc.h"
#include "post/cl_event.h"
#include "post/cl_flavour.h"
#include "post/cl_path.h"
#include "sim/base/diagnostics.h"

namespace ncsim::post {

class ClMachine {
 public:
  /// `options.flavour` and `options.unit` have values. `name` is the file's, for messages.
  ClMachine(std::string name, int file, const ClOptions& options, Diagnostics* diagnostics);

  void Take(ClRecord&& record);
  /// The text has ended with this line.
  void End(int line);
  /// In order; the caller takes them off the front.
  std::deque<ClEvent>& events() { return events_; }

 private:
  // Motion.
  void On(cl::Goto&& to);
  void On(cl::Point&& to);
  void On(cl::GoDelta&& by);
  void On(cl::GoHome&& home);
  void On(cl::From&& from);
  void On(cl::Rapid&&);
  void On(cl::Feed&& feed);
  void On(cl::Circle&& circle);
  void On(cl::Cycle&& cycle);
  void On(cl::CycleSwitch&& what);
  // Structure, coordinate systems, tools.
  void On(cl::OperationBegin&& begin);
  void On(cl::OperationEnd&&);
  void On(cl::Msys&& msys);
  void On(cl::Csys&& csys);
  void On(cl::ToolShape&& shape);
  void On(cl::LoadTool&& load);
  void On(cl::End&&);
  // Modal facts.
  void On(cl::Spindle&& spindle);
  void On(cl::Coolant&& coolant);
  void On(cl::CutterComp&& comp);
  // What goes through, and what has done its work already.
  void On(cl::Delay&& delay) { Emit(ClDwell{delay.value, delay.revolutions}); }
  void On(cl::SelectTool&& select) { Emit(select); }
  void On(cl::Code&& code) { Emit(code); }
  void On(cl::Stop&& stop) { Emit(stop); }
  void On(cl::Text&& text) { Emit(std::move(text)); }
  void On(cl::PostWord&& word) { Emit(std::move(word)); }
  void On(cl::Units&&) {}      // by Survey()
  void On(cl::MultiAxis&&) {}  // a GOTO shows itself whether it has an axis
  void On(cl::Ignored&&) {}
  void On(cl::Unknown&&) {}

  /// The pose of a point, or nothing where its axis is none.
  std::optional<ClPose> PoseOf(const Eigen::Vector3d& point,
                               const std::optional<Eigen::Vector3d>& axis);
  void MoveTo(const ClPose& pose);
  void Line(const ClPose& pose, bool rapid, bool home);
  void Hole(const ClPose& pose);
  void AddToArc(const ClPose& pose);
  void CloseArc();
  /// Reports a CIRCLE that no point has followed.
  void DropCircle();
  /// Tool and operation are as they should be for a motion.
  void BeforeMotion();
  /// Of a feed; reports where there is none.
  ClFeed FeedForMotion();
  ClFeed ToFeed(const cl::Feed& feed);
  void ReadDepth(const cl::Cycle& cycle, ClHoleCycle* hole_cycle);

  void BeginOperation(ClOperation operation);
  void SetTool(ClTool tool);
  void ApplyAnnounced(ClTool* tool);
  template <class Change>
  void ChangeModal(Change change);
  template <class What>
  void Emit(What&& what) {
    EmitAt(where_, std::forward<What>(what));
  }
  template <class What>
  void EmitAt(const SourcePosition& where, What&& what) {
    if (begins_) {
      const SourcePosition begin = *begins_;
      begins_.reset();
      events_.push_back({begin, modal_, ClOperationBegin{}});
    }
    events_.push_back({where, modal_, std::forward<What>(what)});
  }
  /// Unit vector in that direction, or nothing, reported: its length is not 1.
  std::optional<Eigen::Vector3d> Unit(const Eigen::Vector3d& vector, const std::string& what);
  /// Reports a meaning that only the flavour tells, where that is not known.
  void NeedFlavour(const std::string& what);
  void Error(const std::string& message) { ErrorAt(where_, message); }
  void ErrorAt(const SourcePosition& where, const std::string& message);
  void ErrorOnce(bool* said, const std::string& message);

  const std::string name_;
  const int file_;
  const ClOptions options_;
  const ClFlavour flavour_;
  const double scale_;  ///< mm of a unit of the file.
  Diagnostics* diagnostics_;
  std::deque<ClEvent> events_;
  SourcePosition where_;  ///< Of the record that is taken.

  std::shared_ptr<const ClModal> modal_;
  std::optional<SourcePosition> begins_;  ///< An operation whose event waits for its MSYS.
  bool in_operation_ = false;             ///< NX
  bool ended_ = false;                    ///< FINI
  bool moved_ = false;
  std::optional<cl::Spindle> last_spindle_;  ///< The last one that was not off.
  std::optional<cl::CutterComp> last_comp_;

  /// What TOOL PATH, TLDATA and CUTTER have said since the last LOAD and the last motion.
  struct Announced {
    std::optional<std::string> name;
    std::optional<cl::ToolShape> shape;
  } announced_;

  std::optional<ClPose> pose_;                       ///< Where the tool is.
  Eigen::Vector3d axis_ = Eigen::Vector3d::UnitZ();  ///< Of the last point.
  bool rapid_ = false;                               ///< RAPID: of the next motion.
  std::optional<ClFeed> feed_;
  bool per_revolution_ = false;  ///< What a FEDRAT without a unit means.

  struct OpenCircle {
    SourcePosition where;
    ClArcBuilder builder;
    bool broken = false;        ///< Reported; the motion is not made.
    std::optional<ClPose> end;  ///< The last point so far.
  };
  std::optional<OpenCircle> circle_;
  /// Whether a line of numbers may follow, and what it goes on with.
  enum class List { kNone, kMotion, kRapid } list_ = List::kNone;

  std::shared_ptr<const ClHoleCycle> cycle_, last_cycle_;
  ClHole::Level level_ = ClHole::Level::kClearance;
  double retract_ = 0.0;           ///< mm, of Level::kDistance.
  std::optional<ClPose> initial_;  ///< Where the tool was before the cycle.

  /// Said once a file.
  struct Said {
    bool feed = false, feed_unit = false, tool = false, outside = false, after_end = false,
         flavour = false;
  } said_;
};

template <class Change>
void ClMachine::ChangeModal(Change change) {
  auto modal = std::make_shared<ClModal>(*modal_);
  change(modal.get());
  modal_ = std::move(modal);
}

}  // namespace ncsim::post
