// SPDX-License-Identifier: BSD-3-Clause
// Plan steps made by hand, and what a post writes of them.
#pragma once

#include <memory>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "post/post_data.h"
#include "post/writer.h"
#include "sim/base/file.h"
#include "sim/base/units.h"

namespace ncsim::post {

inline std::string ShippedPost(const std::string& path) {
  std::string reason;
  return ReadFile(std::string(NCSIM_SOURCE_DIR) + "/models/" + path, 1 << 20, &reason).value_or("");
}
inline const char* const kUmc750 = "haas_umc750/umc750.post.toml";
inline const char* const kBcTable = "bc_table_840d/bc_table_840d.post.toml";
inline const char* const kFanuc = "fanuc_3axis.post.toml";

inline std::string AllOf(const Diagnostics& diagnostics) {
  std::string all;
  for (const Diagnostic& one : diagnostics.all()) all += ToString(one) + "\n";
  return all;
}

/// A plan that grows, a line of the cutter-location file a step.
class TestPlan {
 public:
  TestPlan() {
    tool_.number = 3;
    tool_.name = "BALL_MILL";
    operation_.index = 1;
    operation_.name = "FINISH";
    modal_.spindle.mode = cl::Spindle::Mode::kRpm;
    modal_.spindle.speed = 8000.0;
    modal_.spindle.clockwise = true;
    Share();
  }

  TestPlan& Add(decltype(PlanStep::what) what) {
    PlanStep step;
    step.where.line = static_cast<int>(steps_.size()) + 1;
    step.modal = shared_;
    step.what = std::move(what);
    steps_.push_back(std::move(step));
    return *this;
  }
  ClModal& modal() { return modal_; }
  ClTool& tool() { return tool_; }
  /// After a change of modal() or tool().
  TestPlan& Share() {
    modal_.tool = std::make_shared<ClTool>(tool_);
    modal_.operation = std::make_shared<ClOperation>(operation_);
    shared_ = std::make_shared<ClModal>(modal_);
    return *this;
  }

  static PlanPose Pose(double x, double y, double z, double b = 0.0, double c = 0.0) {
    PlanPose pose;
    pose.xyz = {x, y, z};
    pose.rotary = {Radians(b), Radians(c)};
    return pose;
  }
  /// An operation with a tool change, and its index to `at`.
  TestPlan& Begin(PlanMode mode, const PlanPose& at) {
    PlanOperation operation;
    operation.mode = mode;
    operation.tool_change = true;
    Add(operation);
    return Index(mode, at);
  }
  TestPlan& Index(PlanMode mode, const PlanPose& at,
                  const Eigen::Matrix3d& plane_P = Eigen::Matrix3d::Identity()) {
    PlanIndex index;
    index.mode = mode;
    index.rotary = at.rotary;
    index.approach = at;
    index.plane_P = plane_P;
    return Add(index);
  }
  TestPlan& Rapid(const PlanPose& end) {
    PlanMove move;
    move.rapid = true;
    move.end = end;
    return Add(move);
  }
  /// `feed` in mm/min.
  TestPlan& Feed(const PlanPose& end, double feed = 600.0, double time = 1.0) {
    PlanMove move;
    move.end = end;
    move.feed.value = feed / 60.0;
    move.time = time;
    return Add(move);
  }
  TestPlan& Arc(const PlanPose& end, const Eigen::Vector3d& centre, bool clockwise, int turns = 0,
                double feed = 600.0) {
    PlanMove move;
    move.end = end;
    move.feed.value = feed / 60.0;
    move.arc = PlanArc{};
    move.arc->centre = centre;
    move.arc->clockwise = clockwise;
    move.arc->turns = turns;
    return Add(move);
  }

  /// Lines of the program without their numbers.
  std::vector<std::string> Write(const std::string& post_text, const PostSettings& settings = {},
                                 const std::string& mode = "") {
    const auto post = LoadPost(post_text, "test.post.toml", settings, &diagnostics);
    if (!post) return {};
    ProgramInfo info;
    info.name = "PART";
    info.number = 1;
    info.source = "part.cls";
    info.mode = mode;
    std::ostringstream out;
    NcWriter writer(*post, info, &diagnostics, &out);
    for (const PlanStep& step : steps_) writer.OnStep(step);
    return Lines(out.str());
  }

  static std::vector<std::string> Lines(const std::string& text) {
    std::vector<std::string> lines;
    std::istringstream in(text);
    for (std::string line; std::getline(in, line);) {
      const std::size_t blank = line.find(' ');
      const bool numbered = line.size() > 1 && line[0] == 'N' && line[1] >= '0' && line[1] <= '9';
      lines.push_back(numbered ? line.substr(blank + 1) : line);
    }
    return lines;
  }

  template <typename Function>
  void ForEach(Function function) const {
    for (const PlanStep& step : steps_) function(step);
  }

  Diagnostics diagnostics;

 private:
  ClTool tool_;
  ClOperation operation_;
  ClModal modal_;
  std::shared_ptr<const ClModal> shared_;
  std::vector<PlanStep> steps_;
};

/// What stands behind the line `after`.
inline std::vector<std::string> Behind(const std::vector<std::string>& lines,
                                       const std::string& after) {
  for (std::size_t i = 0; i < lines.size(); ++i) {
    if (lines[i] == after) {
      return {lines.begin() + static_cast<std::ptrdiff_t>(i) + 1, lines.end()};
    }
  }
  return {};
}
inline std::vector<std::string> First(std::vector<std::string> lines, std::size_t n) {
  lines.resize(std::min(n, lines.size()));
  return lines;
}

}  // namespace ncsim::post
