// SPDX-License-Identifier: BSD-3-Clause
// The Haas NGC control: executes resolved blocks. Keeps modal state and the programmed position;
// sends commands through the contour stage to ToMotion. Haas NGC Mill Operator's Manual 2017.
//
// Order within a block: units, plane, distance and feed mode, F S T D, work offset, tool length,
// DWO; then non-modal codes, motion, and at the block's end the M code (manual, "M-codes").
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "sim/control/arc.h"
#include "sim/control/command.h"
#include "sim/control/contour.h"
#include "sim/control/cycles.h"
#include "sim/control/flow.h"
#include "sim/control/frames.h"
#include "sim/control/haas_block.h"
#include "sim/control/haas_registers.h"
#include "sim/control/haas_settings.h"
#include "sim/control/part_frames.h"
#include "sim/control/run_log.h"
#include "sim/control/to_motion.h"
#include "sim/machine/machine.h"
#include "sim/machine/tool.h"

namespace ncsim::control {

/// The groups of the manual's list of G codes.
enum HaasGroup {
  kGroupNonModal = 0,
  kGroupMotion = 1,
  kGroupPlane = 2,
  kGroupDistance = 3,
  kGroupFeedMode = 5,
  kGroupUnits = 6,
  kGroupComp = 7,
  kGroupLength = 8,
  kGroupCycle = 9,
  kGroupReturn = 10,
  kGroupOffset = 12,
  kGroupExactStop = 15,
  kGroupRotation = 16,
  kGroupDwo = 23,
  kNumGroups = 24
};

class HaasInterpreter {
 public:
  struct Parts {
    const machine::Machine* machine;
    const machine::ToolTable* tools;
    const HaasSettings* settings;
    const SettingSource* source;
    HaasRegisters* registers;
    PartFrames* part_frames;
    Frames* frames;
    ToMotion* to_motion;
    RunLog* log;
  };
  /// All parts outlive this. `motionless_m` as in HaasBlock.
  HaasInterpreter(const Parts& parts, const CodeIndex& codes, std::vector<int> motionless_m,
                  int start_tool);

  void Execute(ResolvedBlock* block);
  /// M30 or M02 has been executed.
  bool ended() const { return ended_; }
  /// Sends on what the contour stage still holds.
  void Finish();

  // What system variables show.
  /// Machine values now; sends on what waits, if `flush`.
  AxisValues MachinePosition(bool flush);
  const AxisValues& program_position() const { return position_; }
  /// The last G code of a group, times ten.
  int group_code(int group) const { return codes_[static_cast<std::size_t>(group)]; }
  /// The last value of an address, as programmed; nullopt before the first.
  std::optional<double> last_word(char address) const {
    return last_words_[static_cast<std::size_t>(address - 'A')];
  }
  int tool() const { return tool_; }
  double spindle_rpm() const { return spindle_ == 0 ? 0.0 : rpm_; }
  double active_length() const { return frame_->tool_length; }
  double time() const { return parts_.to_motion->time(); }
  /// A register that the active frame may depend on was written by a macro.
  void RegistersChanged();

 private:
  // haas_interpreter.cc: modal state
  void ExecuteLoaded();
  const CodeUse* CodeOf(int group) const { return in_block_[static_cast<std::size_t>(group)]; }
  void CollectCodes();
  void RememberWords(const ResolvedBlock& block);
  bool ApplyModes();
  bool ApplyUnits();
  void ApplyFeed(bool mode_changed);
  bool ApplyToolWords();
  bool ApplyComp();
  void UpdatePrototype();
  bool IsSet(int group, int code) const { return group_code(group) == 10 * code; }
  bool incremental() const { return IsSet(kGroupDistance, 91); }
  bool tcp() const { return IsSet(kGroupLength, 234); }
  bool dwo() const { return IsSet(kGroupDwo, 254); }
  void Alarm(Rule rule, char at, std::string message);
  void Alarm(char at, std::string message) { Alarm(Rule::kControlAlarm, at, std::move(message)); }
  void Unsupported(std::string_view key, SourcePosition where, std::string message);
  void AssumeUnlessStated(const std::string& key, const std::string& name, const std::string& text);

  // haas_frames.cc: what makes the frame
  bool ApplyOffsetCode(const CodeUse& use);
  bool ApplyLength();
  bool ApplyTcp(const CodeUse* use, std::optional<int> h);
  bool ApplyPlainLength(const CodeUse* use, std::optional<int> h, int last_h);
  bool CancelLength();
  bool CheckHWord(int h);
  bool ApplyDwo();
  bool CheckRotationRules();
  void RefreshFrame(bool tcp_on);
  Frame MakeFrame() const;
  ProgramFrame TurnInPlane() const;
  bool ExecuteRotation();
  bool SetShift();  // G52
  bool SetG92();
  bool SetOffsets();  // G10
  bool SetToolRegister(int l);
  void BeforeLinearMotion(bool uses_length);
  void CheckToolLength();

  // haas_motion.cc
  bool ExecuteNonModal();
  bool ExecuteMotion();
  bool Move(unsigned words, const AxisValues& values, const ArcWords& arc);
  ArcWords TakeArcWords();
  AxisValues TakeAxisWords(unsigned words);
  AxisValues Target(unsigned words, const AxisValues& values) const;
  void SetCornerRounding();    // G187
  bool MachineMove();          // G53
  bool ReturnHome();           // G28
  bool ReturnFromReference();  // G29
  bool Dwell();
  bool CheckFeed();
  unsigned MachineAxisWords() const;
  void CheckCancelledTcp(unsigned words);
  AxisValues PlainMachineTarget(unsigned words, const AxisValues& from);
  double HomeTarget(int axis, double from) const;
  void PushMachine(CommandKind kind, unsigned named, const AxisValues& target);
  void ResyncPosition();

  // haas_cycles.cc
  void UpdateCycle();
  bool cycle_active() const { return !IsSet(kGroupCycle, 80); }
  bool pattern() const;
  bool ExecuteCycle();
  bool TakeCycleWords();
  bool ExecutePattern();
  bool ExecutePocket(bool clockwise);
  bool DrillHole(const AxisValues& hole);

  // haas_m_codes.cc
  void ExecuteM();
  void StopProgram(bool end);
  void ToolChange();
  void MoveToToolChange();
  void CommandSpindle(int direction);

  Parts parts_;
  const HaasSettings& settings_;
  RunLog& log_;
  const AxisMap& axes_;
  HaasBlock block_;
  Contour contour_;

  std::array<int, kNumGroups> codes_{};  ///< Modal code of each group, times ten.
  std::array<const CodeUse*, kNumGroups> in_block_{};
  const CodeUse* non_modal_ = nullptr;  ///< The block's code of group 0 that takes its axis words.
  bool has_codes_ = false;              ///< in_block_ is not all null.
  std::string missing_axes_;            ///< Letters of axes that the machine lacks.
  std::array<std::optional<double>, 26> last_words_{};
  std::shared_ptr<const Frame> frame_;
  AxisValues position_{};  ///< Programmed position, program coordinates of frame_.
  Command command_;        ///< Carries the modal facts; reused.
  Plane plane_ = Plane::kXY;

  double feed_word_ = 0.0;  ///< F as read; 0 = none.
  double rpm_ = 0.0;
  int spindle_ = 0;                     ///< +1 forward, -1 reverse, 0 stopped.
  std::optional<int> spindle_command_;  ///< As the last M03, M04 or M05 said.
  int tool_ = 0, next_tool_ = -1;
  int h_ = 0, d_ = 0;
  bool has_d_ =
      false;        ///< A D has been commanded: D0 is an offset of none, no D at all is none known.
  int offset_ = 0;  ///< Index of the active work offset.
  std::uint8_t brakes_ = 0;
  double corner_rounding_ = 0.0;
  bool g68_ = false;
  Plane g68_plane_ = Plane::kXY;
  double g68_angle_ = 0.0;
  double g68_centre_[2] = {0.0, 0.0};
  std::optional<AxisValues> g28_point_;  ///< Machine values, for G29.
  CycleWords cycle_;
  double cycle_initial_level_ = 0.0;
  int cycle_count_ = 0;
  bool frame_dirty_ = false, tcp_on_ = false;
  bool feed_in_block_ = false, defining_ = false;  ///< F, and a canned cycle's G, in the block.
  bool offset_checked_ = false, length_checked_ = false, no_tool_reported_ = false;
  bool tcp_cancelled_ = false;  ///< By G43 or G44, and not commanded again since.
  bool ended_ = false;
};

}  // namespace ncsim::control
