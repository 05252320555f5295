// SPDX-License-Identifier: BSD-3-Clause
// The SINUMERIK 840D sl control: executes the blocks that the flow hands out. Keeps modal state and
// the programmed position; sends commands through the contour stage to ToMotion. NC programming
// 12/2019; machine data by number.
//
// Order within a block: G codes, S F T, tool change, D, predefined subprograms, frame; then a
// statement that gives the words another meaning (TRANS, G4 ...), or motion; M0 to M30 at the end.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "sim/control/command.h"
#include "sim/control/contour.h"
#include "sim/control/frames.h"
#include "sim/control/part_frames.h"
#include "sim/control/run_log.h"
#include "sim/control/sinumerik_arc.h"
#include "sim/control/sinumerik_cycle_arguments.h"
#include "sim/control/sinumerik_flow.h"
#include "sim/control/sinumerik_registers.h"
#include "sim/control/sinumerik_settings.h"
#include "sim/control/sinumerik_swivel.h"
#include "sim/control/to_motion.h"
#include "sim/machine/machine.h"
#include "sim/machine/tool.h"
#include "sim/nc/sinumerik_commands.h"

namespace ncsim::control {

/// G groups that the interpreter asks for (NC programming 12/2019, "G functions").
enum SinumerikGroup {
  kSinMotion = 1,
  kSinAction = 2,  ///< G4, G74 ...
  kSinFrame = 3,   ///< TRANS, ROT, G110 ...
  kSinPlane = 6,
  kSinComp = 7,
  kSinOffset = 8,
  kSinSuppress = 9,
  kSinExactStop = 10,
  kSinExactStopHere = 11,
  kSinUnits = 13,
  kSinDistance = 14,
  kSinFeedMode = 15,
  kSinBottleneck = 23,
  kSinOrientationSystem = 25,
  kSinCompressor = 30,
  kSinOrientationAngles = 50,
  kSinOrientationPath = 51,
  kSinToolFrame = 53,
  kSinRapid = 55,
  kNumSinGroups = 65
};

class SinumerikInterpreter {
 public:
  struct Parts {
    const machine::Machine* machine;
    const machine::ToolTable* tools;
    const SinumerikSettings* settings;
    SinumerikRegisters* registers;
    PartFrames* part_frames;
    Frames* frames;
    ToMotion* to_motion;
    RunLog* log;
  };
  /// All parts outlive this. `motionless_m`: M codes that move nothing at this machine.
  SinumerikInterpreter(const Parts& parts, std::vector<int> motionless_m, int start_tool);

  void Execute(SinumerikStep* step);
  /// The block executed last moved the path: a modal call follows it.
  bool moved() const { return moved_; }
  /// To the next position of a pattern of holes (HOLES1 ...) that the block has called, as a motion
  /// that a modal call follows. False: there is none.
  bool NextPosition();
  /// A cycle, called in a block or by MCALL behind one.
  void ExecuteCycle(const nc::SinumerikCommand& cycle, std::span<const nc::SinumerikValue> values,
                    SourcePosition where);
  /// A subprogram with SAVE begins, and ends: modal G codes and the programmable frame.
  void Save();
  void Restore();
  void Finish();

  // What system variables show.
  AxisValues MachinePosition();
  const AxisValues& program_position() const { return position_; }
  const Frame& frame() const { return *frame_; }
  const SinumerikRegisters& registers() const { return *parts_.registers; }
  int tool() const { return tool_; }
  int next_tool() const { return next_tool_; }
  int edge() const { return edge_; }
  double tool_radius() const { return active_.radius; }
  double feed_word() const { return feed_word_; }
  double spindle_rpm() const { return rpm_; }
  int spindle() const { return spindle_; }
  bool transforms() const { return traori_; }
  int settable_frame() const { return modal_.offset; }
  /// mm of a unit of lengths in system variables (NC programming 12/2019, "G70, G71, G700, G710").
  double system_unit() const { return feed_mm_; }
  double tool_length() const { return active_.length; }
  const AffineFrame& program_frame() const { return modal_.program; }
  bool swivels() const { return swivel_.active; }
  bool tool_frame() const { return modal_.tool_turn != Eigen::Matrix3d::Identity(); }
  const SettableFrame& active_settable() const { return modal_.settable; }
  void SetProgramFrame(const AffineFrame& frame);
  void SetActiveSettable(const SettableFrame& frame);

 private:
  /// What SAVE keeps.
  struct Modal {
    std::array<const nc::SinumerikCommand*, kNumSinGroups> codes{};
    int offset = 0;                                           ///< Of $P_UIFR.
    SettableFrame settable;                                   ///< As it was when it was selected.
    Eigen::Matrix3d tool_turn = Eigen::Matrix3d::Identity();  ///< TOROT: before `program`.
    AffineFrame program;
  };
  enum class MotionMode {
    kRapid,
    kLine,
    kThread,
    kClockwise,
    kCounterClockwise,
    kThroughPoint,
    kTangent
  };
  /// What CYCLE800 has laid between work offset and programmable frame.
  struct SwivelState {
    bool active = false;
    SwivelPlane plane;    ///< In the coordinates of the work offset, rotary axes at 0.
    AxisValues tables{};  ///< Machine values of the rotary axes; the frame does not follow them.
  };

  // sinumerik_interpreter.cc: blocks and modal state
  void ResolveAxisWords();
  void ApplyCodes();
  void ApplyCode(SinumerikItem* item);
  void UpdateModes();
  void UpdatePrototype();
  void UpdateTolerance();
  void ApplyTechnology();
  void ApplyM(bool at_end);
  void ExecuteM(int code, const SinumerikItem& item);
  void ExecuteCalls();
  void ReportLeftovers();
  bool Is(int group, std::string_view name) const;
  SinumerikItem* Take(std::string_view name);
  SinumerikItem* Peek(std::string_view name);
  void TakeAll();
  SourcePosition Where(const SinumerikItem& item) const;
  bool Alarm(const SourcePosition& where, int number, std::string text);
  void Unsupported(std::string_view name, const SourcePosition& where, const std::string& why = "");

  // sinumerik_frames.cc
  static int OffsetIndex(std::string_view name);  // -1: none
  void SelectOffset(int index);
  void CancelFrame(bool traori, const SourcePosition& where);
  Frame MakeFrame() const;
  Frame SuppressedFrame() const;
  void RefreshFrame();
  void TurnToTool();
  void UseFrame(const Frame& frame);
  void ExecuteFrameStatement(const SinumerikItem& item);
  void CheckFine(const SourcePosition& where);
  void ReplaceShift(bool fine, const SourcePosition& where);
  void Translate(bool adds);
  void Rotate(const SourcePosition& where);
  void RotateBySolidAngles(const SourcePosition& where);
  void Scale();
  void Mirror();
  void SetPole(std::string_view name);
  void BeforeLinearMotion();

  // sinumerik_tools.cc
  void ApplyToolWord(SinumerikItem* item);
  void ApplyEdge(SinumerikItem* item);
  void SelectEdge(int edge, const SourcePosition& where);
  void ChangeTool(const SourcePosition& where);
  void CheckToolLength();
  int LengthAxis() const;
  void ApplyLength(Frame* frame, double length) const;

  // sinumerik_motion.cc
  void ExecuteAction(const SinumerikItem& item);
  void Dwell();
  void MachinePoint(const SinumerikItem& item);
  void ExecuteMotion();
  void PositionAxis();
  void WaitForAxes(std::span<const nc::SinumerikValue> axes);
  bool TakeTargets(AxisValues* end, unsigned* named);
  bool LinearTarget(int axis, const SinumerikItem& item, double* value);
  bool RotaryTarget(int axis, const SinumerikItem& item, double* value);
  bool ModuloTarget(int axis, const SinumerikItem& item, double* value);
  bool TakePolar(AxisValues* end, unsigned* named);
  void TakePole(SinumerikArcWords* words);
  bool TakeArcWords(SinumerikArcWords* words);
  bool TakePitch();
  bool CheckFeed();
  void Move(const AxisValues& end, unsigned named);
  bool TakeCorner();
  void MoveOnArc(const SinumerikArcWords& words);
  bool CheckArcFrame();
  void Push();
  void PushMachine(CommandKind kind, unsigned named, const AxisValues& target);

  // sinumerik_orientation.cc
  bool TakeOrientation(const SinumerikArcWords* arc, AxisValues* end, unsigned* named);
  std::optional<Eigen::Vector3d> TakeTriple(char digit);
  std::optional<Eigen::Vector3d> TakeToolAxis();
  void TakeSurfaceNormal();
  std::optional<Eigen::Vector3d> TakeLeaning(const SinumerikArcWords* arc, const AxisValues& end);
  std::optional<Eigen::Vector3d> WayAt(const SinumerikArcWords* arc, const AxisValues& end) const;
  bool Reach(const Eigen::Vector3d& axis, AxisValues* end, unsigned* named);
  bool WithinLimits(const Eigen::Vector3d& u_B, const std::array<double, 2>& from, bool led,
                    std::array<double, 2>* reached);
  std::array<double, 2> RotaryJoints(AxisValues values) const;
  void SetRotary(const std::array<double, 2>& joints, AxisValues* end) const;
  Eigen::Vector3d InTable(const Eigen::Vector3d& axis);
  void PassPole();
  void TurnAtPole(const std::array<double, 2>& start);
  bool vector_path() const;
  std::string_view WrapNote() const;

  // sinumerik_cycle800.cc
  std::string CannotSwivel(const SinumerikCycleArguments& arguments) const;
  void Swivel(const SinumerikCycleArguments& arguments, const SourcePosition& where);
  bool SolveSwivel(const SinumerikCycleArguments& arguments, const SwivelPlane& from,
                   const SourcePosition& where, SwivelPlane* plane, JointVector* joints);
  std::optional<kinematics::RotarySolution> StandingSwivel(
      const std::vector<kinematics::RotarySolution>& solutions, const std::array<double, 2>& here,
      const SourcePosition& where);
  std::optional<kinematics::RotarySolution> TurnedSwivel(
      std::vector<kinematics::RotarySolution> solutions, const std::array<double, 2>& here,
      const SwivelPlane& plane, const SinumerikCycleArguments& arguments,
      const SourcePosition& where);
  void AssumeOfSwivel(std::string_view setting, bool stated, std::string_view name,
                      std::string_view instead);
  std::optional<kinematics::RotarySolution> PoleSwivel(kinematics::RotarySolution solution,
                                                       const std::array<double, 2>& here,
                                                       const SwivelPlane& plane,
                                                       const SinumerikCycleArguments& arguments,
                                                       const SourcePosition& where);
  bool RetractToSwivel(const SinumerikCycleArguments& arguments, const SourcePosition& where);
  void TurnTables(const AxisValues& target, bool tracks);

  // sinumerik_cycles.cc
  void HighSpeedSettings(const SinumerikCycleArguments& arguments, const SourcePosition& where);
  void CheckToleranceFactor();
  std::string CannotDrill() const;
  void Drill(const SinumerikCycleArguments& arguments, const SourcePosition& where);
  void MakePattern(const SinumerikCycleArguments& arguments, const SourcePosition& where);

  Parts parts_;
  const SinumerikSettings& settings_;
  RunLog& log_;
  const AxisMap& axes_;
  const std::vector<int> motionless_m_;
  Contour contour_;

  SinumerikStep* step_ = nullptr;
  const SinumerikItem* statement_ = nullptr;        ///< Of group 2 or 3: takes the block's words.
  const nc::SinumerikCommand* suppress_ = nullptr;  ///< G53, G153, SUPA.
  bool exact_stop_here_ = false, has_codes_ = false, feed_in_block_ = false, edge_in_block_ = false;
  bool moved_ = false;

  Modal modal_;
  std::vector<Modal> saved_;
  SwivelState swivel_;
  MotionMode motion_ = MotionMode::kLine;
  Plane plane_ = Plane::kXY;
  bool incremental_ = false;
  double mm_ = 1.0;       ///< Of a unit of length as programmed.
  double feed_mm_ = 1.0;  ///< Likewise of F.

  std::shared_ptr<const Frame> frame_;
  bool frame_dirty_ = false;
  bool new_frame_ = false, new_length_ = false;         ///< What made it so.
  bool tool_frame_due_ = false;                         ///< TOROT stands in the block.
  bool replaces_shift_ = false, fine_dropped_ = false;  ///< G58, G59; TRANS behind ATRANS.
  bool traori_ = false;
  std::string
      cancelled_;  ///< The frame that TRAORI or TRAFOOF cancelled, and nobody selected again.
  AxisValues position_{};  ///< Programmed position, program coordinates of frame_.
  AxisValues carry_{};     ///< What the next incremental move of an axis goes beside its own way.
  std::array<bool, kNumAxes> carry_turned_{};  ///< And the frame has turned since.
  unsigned under_way_ = 0;                     ///< Bit n: the axis that POSA has sent, till WAITP.
  double modal_rounding_ = 0.0;                ///< RNDM, mm.
  Eigen::Vector2d pole_ = Eigen::Vector2d::Zero();
  Eigen::Vector3d tangent_ = Eigen::Vector3d::Zero();          ///< At the end of the last motion.
  Eigen::Vector3d surface_normal_ = Eigen::Vector3d::UnitZ();  ///< A5 B5 C5, or A4 B4 C4.
  std::array<double, 2> leaning_{};                            ///< LEAD, TILT; rad.
  Command command_;                                            ///< Carries the modal facts; reused.

  double feed_word_ = 0.0, rpm_ = 0.0;
  int spindle_ = 0;
  int tool_ = 0, next_tool_ = -1, edge_ = 0;
  EdgeData active_;
  int length_axis_ = kZ;                                          ///< Along which length 1 counts.
  double contour_tolerance_ = 0.0, orientation_tolerance_ = 0.0;  ///< CYCLE832. mm, rad.
  std::string_view factor_name_;  ///< SD5544n that made it; "" where it was said or is none.
  double factor_ = 0.0;           ///< deg a mm.
  bool factor_stated_ = false;
  std::optional<double> ctol_, otol_, adis_, adispos_;
  std::vector<AxisValues> holes_;  ///< Of a pattern, still to be gone to; the next one last.
  SourcePosition holes_where_;
  int cycle_count_ = 0;
  bool offset_checked_ = false, length_checked_ = false, no_tool_reported_ = false;
};

}  // namespace ncsim::control
