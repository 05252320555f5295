// SPDX-License-Identifier: BSD-3-Clause
// Plan steps to NC text, by the data of a post. Words are rounded first: what later words are
// computed from (I, J, K) is what the control reads in the words before them. What the post has no
// words for is reported with the line of the cutter-location file, never dropped.
#pragma once

#include <Eigen/Core>
#include <functional>
#include <memory>
#include <optional>
#include <ostream>
#include <set>
#include <string>
#include <vector>

#include "post/block_printer.h"
#include "post/line_output.h"
#include "post/plan.h"
#include "post/post_data.h"

namespace ncsim::post {

/// What a file does with a tool.
struct ToolUse {
  ClTool tool;
  SourcePosition where;      ///< Where it is loaded, or moves first.
  bool compensated = false;  ///< It is moved with cutter compensation (CUTCOM).
};

struct ProgramInfo {
  std::string name;            ///< Of the program, for its head and the names of its files.
  std::optional<int> number;   ///< O number.
  std::string source;          ///< Name of the cutter-location file.
  std::string mode;            ///< Preferred among the modes of a kind; "" for the first.
  std::vector<ToolUse> tools;  ///< For the tool table, in the order of their first use.
};

class NcWriter : public PlanSink {
 public:
  /// Opens the file of an operation by its name (with the post's extension).
  using OpenFile = std::function<std::ostream*(const std::string& name)>;

  /// `data`, `diagnostics` and `main` must outlive this. With `open_operation` each operation is a
  /// file of its own, which the main program calls (block call_operation).
  NcWriter(const PostData& data, ProgramInfo info, Diagnostics* diagnostics, std::ostream* main,
           OpenFile open_operation = nullptr);

  void OnStep(const PlanStep& step) override;

 private:
  void Handle(const PlanMove& move);
  void Handle(const PlanHole& hole);
  void Handle(const ClCycleOff& off);
  void Handle(const PlanOperation& operation);
  void Handle(const ClOperationEnd& end);
  void Handle(const PlanIndex& index);
  void Handle(const ClHome& home);
  void Handle(const cl::Spindle& spindle);
  void Handle(const cl::Coolant& coolant);
  void Handle(const cl::CutterComp& comp);
  void Handle(const ClDwell& dwell);
  void Handle(const cl::Code& code);
  void Handle(const cl::Stop& stop);
  void Handle(const cl::Text& text);
  void Handle(const cl::PostWord& word);
  void Handle(const PlanEnd& end);

  // writer.cc
  void Start();
  void WriteToolTable();
  void TakeModal(const ClModal& modal);
  void TakeTool(const ClTool& tool);
  void TakeSpindle(const cl::Spindle& spindle);
  void BeginFile();
  void EndFile();
  void Leave();
  void Switch();
  void Apply(const PostText& text, const std::string& comment);
  void SetPlaneAngles(const Eigen::Matrix3d& plane_P);

  // writer_motion.cc
  void SetPose(const PlanPose& pose);
  void SetPoint(const Eigen::Vector3d& xyz);
  void SetFeed(const ClFeed& feed, double time, bool turns);
  void Rapid(const PlanPose& end);
  void RapidTo(const Eigen::Vector3d& xyz);
  void Line(const PlanMove& move);
  void Arc(const PlanMove& move);
  void ArcBlock(const PlanMove& move, const Eigen::Vector3d& start, const PlanPose& end,
                double share, int turns);
  bool Turns(const PlanPose& end) const;
  void Arrive(const PlanPose& end);
  Eigen::Vector3d Rounded(const Eigen::Vector3d& xyz) const;
  void CheckPrinted(Block block);

  // writer_cycle.cc
  void EndCycle();
  void SetHole(const PlanHole& hole);
  void SetSteps(const std::vector<double>& steps);
  void BeginCycle(const PlanHole& hole, int along, double level);
  bool GoesOn(const PlanHole& hole, double level) const;

  /// Prints a block; true where it has lines.
  bool Emit(Block block, BlockPrinter::Counts counts = BlockPrinter::Counts::kAnything);
  bool EmitTemplate(const BlockTemplate& block, BlockPrinter::Counts counts);
  void Want(Group group, std::string_view key);
  void Problem(const std::string& message);

  const PostData& data_;
  ProgramInfo info_;
  Diagnostics* diagnostics_;
  std::ostream* main_;
  OpenFile open_operation_;
  int main_number_ = 0;
  BlockPrinter printer_;
  LineOutput output_;

  bool started_ = false;
  bool in_file_ = false;  ///< Of an operation.
  SourcePosition where_;
  std::set<std::string> reported_;
  std::shared_ptr<const ClModal> modal_;
  Values values_;
  WantedCodes wanted_{};

  const PostMode* mode_ = nullptr;
  bool positioned_ = false;  ///< An index has brought the tool to the part in mode_.
  PlanPose pose_;            ///< Where the plan is.
  Eigen::Vector3d here_ =
      Eigen::Vector3d::Zero();  ///< Where the control is: in the program's unit.

  struct ActiveCycle {
    std::shared_ptr<const ClHoleCycle> cycle;
    bool to_clearance = false;
    double level = 0.0;      ///< Where the tool is between holes.
    double reference = 0.0;  ///< Of the hole.
  };
  std::optional<ActiveCycle> cycle_;
};

}  // namespace ncsim::post
