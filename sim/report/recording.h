// SPDX-License-Identifier: BSD-3-Clause
// What a run did, to be shown: the axes as keyframes, and which block was when. Nothing is proven
// with it.
#pragma once

#include <cstdint>
#include <vector>

#include "sim/machine/machine.h"
#include "sim/machine/scene.h"
#include "sim/machine/tool.h"
#include "sim/motion/motion.h"

namespace ncsim::report {

/// Between two keyframes all axes run in proportion to time, and no point of any body is then
/// farther than this, mm, from where it was within a tick of that time (by samples, not proven).
inline constexpr double kShownTolerance = 0.05;
inline constexpr double kTicksPerSecond = 1e4;
/// Of a joint value, mm or degrees.
inline constexpr double kValuesPerUnit = 1e4;

/// Motions of one block with one tool, of one kind.
struct Step {
  std::uint32_t begin = 0;  ///< Ticks; it ends where the next one begins.
  SourcePosition where;
  motion::MotionKind kind = motion::MotionKind::kFeed;
  int tool = 0;    ///< T number in the spindle; 0 = none.
  int offset = 0;  ///< motion::Facts::offset.
};

struct Recording {
  int num_joints = 0;
  std::vector<bool> rotary;          ///< Of each joint.
  std::vector<std::uint32_t> ticks;  ///< Of each keyframe; strictly increasing.
  std::vector<std::int32_t> values;  ///< num_joints a keyframe, in 1 / kValuesPerUnit.
  std::vector<Step> steps;
  std::uint32_t end = 0;  ///< Ticks.

  /// mm and rad.
  motion::JointVector Key(std::size_t i) const;
  motion::JointVector PoseAt(double tick) const;
};

/// Takes motions in program order. Memory grows by 4 bytes a joint and keyframe, and 28 a block.
class Recorder {
 public:
  Recorder(const machine::Machine& machine, const machine::Scene& scene,
           const machine::ToolTable& tools);
  void OnMotion(const motion::Motion& motion);
  /// Once, after the last motion.
  Recording Finish();

 private:
  struct Sample {
    double time = 0.0;  ///< s
    motion::JointVector q;
  };

  void AddStep(const motion::Motion& motion);
  void Refine(const motion::Motion& motion, double lag, double s0, const Sample& a, double s1,
              const Sample& b, int depth);
  void Add(const Sample& sample);
  bool InsideDoor(const Sample& sample) const;
  void NarrowDoor(const Sample& sample);
  void Emit(const Sample& sample);

  Recording recording_;
  motion::JointVector tolerance_;  // of each joint
  // The swinging door: slopes from the last keyframe at which every sample since is met.
  Sample key_, last_;
  motion::JointVector lower_, upper_;
  bool empty_ = true;
};

}  // namespace ncsim::report
