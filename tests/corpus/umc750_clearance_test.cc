// SPDX-License-Identifier: BSD-3-Clause
// Clearances of the real program held against brute force: FCL's exact distances of meshes, so
// densely along the motion that no pose between two of them can be nearer by more than a few
// micrometres.
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <memory>
#include <random>
#include <string>
#include <vector>

#include "sim/collision/checker.h"
#include "sim/collision/tessellate.h"
#include "sim/control/controller.h"
#include "sim/machine/load.h"
#include "sim/machine/scene.h"
#include "tests/corpus/umc750_job.h"
#include "tests/peers/fcl_pair.h"

namespace ncsim {
namespace {

constexpr int kMotions = 500;
constexpr double kNearest = 100.0;  // mm: pairs that are further apart are no test
constexpr double kStep = 0.015;     // mm: what brute force may miss
constexpr double kLongest = 10.0;   // mm: ways that brute force can go in steps so small
constexpr double kFacets = 0.005;   // mm: what a circumscribed tool stands out

class Umc750Clearance : public ::testing::Test,
                        protected corpus::Umc750Job,
                        public control::RunSink {
 protected:
  void SetUp() override {
    if (!Prepare("clearance")) GTEST_SKIP() << "NCSIM_CORPUS is not set";
    WriteJob();
    Diagnostics diagnostics;
    machine_ = machine::LoadMachine(Model().string(), &diagnostics);
    job_ = machine::LoadJob(JobFile().string(), &diagnostics);
    ASSERT_TRUE(machine_.has_value() && job_.has_value());
    const machine::Scene all = machine::BuildScene(*machine_, *job_, &diagnostics);
    for (const machine::SceneBody& body : all.bodies) {
      for (const char* name : {"part", "riser", "c_platter", "spindle"}) {
        if (body.name == name) Add(name, body, machine::Tool());
      }
    }
    for (const machine::Tool& tool : job_->tools) {
      const std::string prefix = "T" + std::to_string(tool.number) + ".";
      for (const auto part :
           {&machine::Tool::flutes, &machine::Tool::shank, &machine::Tool::holder}) {
        machine::Tool alone = tool;
        alone.flutes = alone.shank = alone.holder = {};
        alone.*part = tool.*part;
        machine::SceneBody body;
        body.link = machine_->spindle_link;
        body.mesh = collision::Tessellate(tool.*part, tool.length);
        Add(prefix + (part == &machine::Tool::flutes
                          ? "flutes"
                          : (part == &machine::Tool::shank ? "shank" : "holder")),
            body, alone);
      }
    }
    Interpret(&diagnostics);
  }
  void TearDown() override { Remove(); }

  void OnMotion(const motion::Motion& motion) override { motions_.push_back(motion); }
  void OnFinding(Finding) override {}

  struct Body {
    machine::SceneBody scene;
    machine::Tool tool;  ///< With this body alone; number 0 for a body of the scene.
    std::unique_ptr<peers::FclBody> mesh;
    Eigen::AlignedBox3d box;
  };

  void Add(const std::string& name, const machine::SceneBody& scene, const machine::Tool& tool) {
    Body& body = bodies_[name];
    body.scene = scene;
    body.tool = tool;
    body.mesh = std::make_unique<peers::FclBody>(scene.mesh);
    for (const Eigen::Vector3d& vertex : scene.mesh.vertices) body.box.extend(vertex);
  }

  void Interpret(Diagnostics* diagnostics) {
    SourceFiles files;
    std::vector<control::PartFrame> frames;
    control::RunProgram(nc::Program::Load(Program().string(), diagnostics), *machine_, *job_,
                        machine::ToolTable{job_->tools}, &files, &frames, this);
  }

  /// Clearance of one pair over one motion, told to 0.02 mm; none where it is not told.
  std::optional<collision::PairClearance> Check(const motion::Motion& motion, const Body& a,
                                                const Body& b) const {
    machine::CheckSettings settings = job_->check;
    settings.exact_below = 2.0 * kNearest;
    machine::Scene scene;
    machine::ToolTable tools;
    scene.bodies = {b.scene};
    if (a.tool.number == 0) scene.bodies.push_back(a.scene);
    machine::Tool tool = a.tool;
    tool.number = motion.facts.tool;
    tools.tools = {tool};
    collision::CollisionChecker checker(*machine_, scene, tools, settings);
    checker.Check({{motion}});
    const auto clearances = checker.Finish().clearances;
    return clearances.empty() ? std::nullopt : std::optional(clearances.front());
  }

  Eigen::Isometry3d Pose(const motion::Motion& motion, double s, const Body& a,
                         const Body& b) const {
    const motion::JointVector q = motion.At(s);
    return machine_->tree.Pose(b.scene.link, q).inverse() * machine_->tree.Pose(a.scene.link, q);
  }

  /// The longest way of a corner of A's box as seen from B, by a fine polyline.
  double Way(const motion::Motion& motion, const Body& a, const Body& b) const {
    constexpr int kPieces = 200;
    double longest = 0.0;
    for (int corner = 0; corner < 8; ++corner) {
      const Eigen::Vector3d p = a.box.corner(static_cast<Eigen::AlignedBox3d::CornerType>(corner));
      double way = 0.0;
      Eigen::Vector3d from = Pose(motion, 0.0, a, b) * p;
      for (int i = 1; i <= kPieces; ++i) {
        const Eigen::Vector3d to = Pose(motion, static_cast<double>(i) / kPieces, a, b) * p;
        way += (to - from).norm();
        from = to;
      }
      longest = std::max(longest, way);
    }
    return 1.02 * longest;
  }

  /// Where the pair is further apart than the nearest so far, the poses at which it cannot have
  /// come nearer are passed over.
  double BruteForce(const motion::Motion& motion, double way, const Body& a, const Body& b) const {
    double least = 1e9;
    for (double s = 0.0;;) {
      const double distance =
          peers::Distance(*a.mesh, *b.mesh, Pose(motion, s, a, b), least + 0.1 * way + 0.1);
      least = std::min(least, distance);
      if (s >= 1.0 || way == 0.0) return least;
      s = std::min(1.0, s + (distance - least + kStep) / way);
    }
  }

  std::optional<machine::Machine> machine_;
  std::optional<machine::Job> job_;
  std::map<std::string, Body> bodies_;
  std::vector<motion::Motion> motions_;
};

TEST_F(Umc750Clearance, IsThatOfBruteForce) {
  std::mt19937 random(7);
  const std::vector<std::string> table = {"part", "riser", "c_platter"};
  const std::vector<std::string> head = {"flutes", "shank", "holder", "spindle"};
  int compared = 0;
  for (int tries = 0; compared < kMotions; ++tries) {
    ASSERT_LT(tries, 100 * kMotions);
    const motion::Motion& motion = motions_[random() % motions_.size()];
    if (!motion::IsFeed(motion)) continue;  // one path, whatever the acceleration
    const std::string& part = head[random() % head.size()];
    const std::string& b = table[random() % table.size()];
    const std::string a =
        bodies_.count(part) > 0 ? part : "T" + std::to_string(motion.facts.tool) + "." + part;
    if (bodies_.count(a) == 0 || bodies_.at(a).scene.mesh.triangles.empty()) continue;
    if (b == "part" && (part == "flutes" || part == "shank")) continue;  // they cut it
    const double way = Way(motion, bodies_.at(a), bodies_.at(b));
    if (way > kLongest) continue;
    const auto told = Check(motion, bodies_.at(a), bodies_.at(b));
    if (!told || told->seen_mm > kNearest) continue;
    const double truth = BruteForce(motion, way, bodies_.at(a), bodies_.at(b));
    const std::string where = "line " + std::to_string(motion.where.line) + ", " + a + " and " + b;
    EXPECT_LE(told->proven_mm, truth + kFacets) << where;
    EXPECT_GE(told->seen_mm, truth - kStep) << where;
    EXPECT_NEAR(told->proven_mm, truth, 0.02 + kFacets) << where;
    EXPECT_NEAR(told->seen_mm, truth, 0.02 + kFacets) << where;
    ++compared;
  }
}

}  // namespace
}  // namespace ncsim
