// SPDX-License-Identifier: BSD-3-Clause
// A check that has a cache says what it says without one, to the last bit, whatever is in the
// cache; and computes no more than what has changed.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <functional>
#include <iterator>
#include <limits>
#include <set>
#include <thread>

#include "sim/collision/batch.h"
#include "sim/collision/outcome_cache.h"
#include "sim/collision/outcome_record.h"
#include "sim/collision/random_rig.h"
#include "sim/collision/threads.h"

namespace ncsim::collision {

namespace {

namespace fs = std::filesystem;
using machine::BodyKind;
using ::testing::ElementsAre;
using ::testing::SizeIs;

class CacheTest : public ::testing::Test {
 protected:
  CacheTest() {
    const auto* info = ::testing::UnitTest::GetInstance()->current_test_info();
    folder_ = fs::temp_directory_path() /
              ("ncsim_cache_" + std::to_string(getpid()) + "_" + info->name());
    fs::remove_all(folder_);
    Open();
  }
  ~CacheTest() override { fs::remove_all(folder_); }

  void Open() {
    std::string reason;
    store_ = RecordStore::Open(folder_.string(), &reason);
    ASSERT_NE(store_, nullptr) << reason;
  }
  void Empty() {
    fs::remove_all(folder_);
    Open();
  }
  CollisionResult Run(const Rig& rig, std::size_t window, const std::string& build = "") {
    const OutcomeCache cache(store_.get(), DigestOf(build));
    return rig.Run(window, &cache);
  }
  std::vector<fs::path> Files() const {
    std::vector<fs::path> files;
    for (const auto& entry : fs::directory_iterator(folder_)) files.push_back(entry.path());
    return files;
  }

  fs::path folder_;
  std::unique_ptr<RecordStore> store_;
};

std::string Slurp(const fs::path& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

/// Holes, one a cycle, and feeds and rapids about a part in a blank; two tools, twice each.
Rig Operations(int lines) {
  Rig rig;
  rig.check().clearance = 2.0;
  rig.AddTool(4, CylinderProfile(0, 30, 8), {}, CylinderProfile(60, 150, 25));
  rig.AddBox("post", BodyKind::kFixture, {60, -20, -50}, {90, 20, 60});
  rig.AddBox("part", BodyKind::kPart, {-60, -30, -50}, {0, 30, 0});
  rig.AddBox("blank", BodyKind::kStock, {-62, -32, -50}, {2, 32, 3});
  rig.AddBody("head", BodyKind::kMachine, BoxMesh({-50, -50, 0}, {50, 50, 200}),
              rig.machine().spindle_link);
  rig.AddBody("column", BodyKind::kMachine, BoxMesh({200, -100, -50}, {260, 100, 400}), 0);
  rig.Start(-30, 0, 60);
  int cycle = 0;
  for (int operation = 0; operation < 4; ++operation) {
    rig.facts().tool = 3 + operation % 2;
    rig.Rapid(-30, 0, 60);
    for (int i = 0; i < lines; ++i) {
      const double x = -55.0 + 50.0 * i / lines;
      rig.Rapid(x, 10, 5);
      rig.facts().cycle = ++cycle;
      rig.Feed(x, 10, -0.3 - 0.01 * (i % 7));
      rig.Rapid(x, 10, 5);
      rig.facts().cycle = 0;
      rig.Feed(x, -10, 2.0 - 0.02 * i);
    }
    rig.Rapid(-30, 0, 60);
  }
  return rig;
}

/// The same program `lines` further down, later, and after other cycles.
Rig Shifted(Rig rig, int lines) {
  for (motion::Motion& motion : rig.motions()) {
    motion.where.line += lines;
    motion.start_time += 17.25;
    if (motion.facts.cycle > 0) motion.facts.cycle += lines;
  }
  return rig;
}

motion::JointVector& End(motion::Motion* motion) {
  return std::get<motion::AxisLinear>(motion->path).q1;
}

/// Another end for a motion, from which the next one starts.
void MoveEnd(Rig* rig, std::size_t i, double dx) {
  End(&rig->motions()[i])[0] += dx;
  std::get<motion::AxisLinear>(rig->motions()[i + 1].path).q0 = End(&rig->motions()[i]);
}

void ChangeJoint(Rig* r, std::size_t i, const std::function<void(kinematics::Joint*)>& f) {
  std::vector<kinematics::Joint> joints = r->machine().tree.joints();
  f(&joints[i]);
  r->machine().tree = kinematics::KinematicTree(r->machine().tree.links(), joints);
  r->machine().five_axis = kinematics::FiveAxis::Make(r->machine().tree, r->machine().spindle_link,
                                                      r->machine().table_link);
}

struct Change {
  const char* name;
  std::function<void(Rig*)> make;
  bool told = true;  // the report differs
};

std::vector<Change> OtherShapes() {
  return {
      {"a fixture moved",
       [](Rig* r) {
         r->scene().bodies[0].mesh = BoxMesh({60.1, -20, -50}, {90, 20, 60});
       }},
      {"a fixture of another kind", [](Rig* r) { r->scene().bodies[0].kind = BodyKind::kPart; }},
      {"a fixture of another name", [](Rig* r) { r->scene().bodies[0].name = "stop"; }},
      {"a fixture on another link", [](Rig* r) { r->scene().bodies[0].link = 0; }},
      {"a fixture that is not closed",
       [](Rig* r) { r->scene().bodies[0].mesh.watertight = false; }},
      {"the part lower",
       [](Rig* r) {
         r->scene().bodies[1].mesh = BoxMesh({-60, -30, -50}, {0, 30, -0.1});
       }},
      {"the blank higher",
       [](Rig* r) {
         r->scene().bodies[2].mesh = BoxMesh({-62, -32, -50}, {2, 32, 6});
       }},
      {"a link's shape",
       [](Rig* r) {
         r->scene().bodies[3].mesh = BoxMesh({-50, -50, -90}, {50, 50, 200});
       }},
      {"a wider holder", [](Rig* r) { r->tools().tools[0].holder = CylinderProfile(90, 150, 22); }},
      {"a longer tool", [](Rig* r) { r->tools().tools[0].length += 1.0; }},
      {"wider flutes", [](Rig* r) { r->tools().tools[1].flutes = CylinderProfile(0, 30, 9); }}};
}

std::vector<Change> OtherSettingsAndMotions() {
  return {
      {"clearance", [](Rig* r) { r->check().clearance = 120.0; }},
      {"a margin",
       [](Rig* r) {
         machine::PairMargin margin;
         margin.bodies[0].name = "T3.holder";
         margin.bodies[1].name = "post";
         margin.clearance = 90.0;
         r->check().margins.push_back(margin);
       }},
      {"tolerance in rapids", [](Rig* r) { r->check().part_tolerance = 0.01; }, false},
      {"tolerance in feeds", [](Rig* r) { r->check().gouge_tolerance = 0.32; }},
      {"gouge off", [](Rig* r) { r->check().gouge = machine::GougeMode::kOff; }},
      {"gouge a warning", [](Rig* r) { r->check().gouge = machine::GougeMode::kWarning; }},
      {"exact below", [](Rig* r) { r->check().exact_below = 200.0; }},
      {"a joint elsewhere",
       [](Rig* r) { ChangeJoint(r, 0, [](auto* j) { j->X_PJ.translation().x() += 1.0; }); }},
      {"a joint turned",
       [](Rig* r) {
         ChangeJoint(r, 2, [](auto* j) { j->axis = Eigen::Vector3d(0.0, 0.01, 1.0).normalized(); });
       }},
      {"the spindle stopped",
       [](Rig* r) {
         for (auto& m : r->motions()) m.facts.spindle_on = false;
       }},
      {"corners rounded",
       [](Rig* r) {
         for (auto& m : r->motions()) m.facts.corner_rounding = 40.0;
       }},
      {"the tool may lean",
       [](Rig* r) {
         for (auto& m : r->motions()) m.facts.orientation_tolerance = 0.4;
       }},
      {"rapids for feeds",
       [](Rig* r) {
         for (auto& m : r->motions()) m.kind = motion::MotionKind::kRapid;
       }},
      {"no cycles",
       [](Rig* r) {
         for (auto& m : r->motions()) m.facts.cycle = 0;
       },
       false},
  };
}

}  // namespace

TEST_F(CacheTest, ColdAndWarmAndWithoutSayTheSame) {
  kinematics::Random random(5);
  int findings = 0;
  for (int i = 0; i < 4; ++i) {
    const Rig rig = i < 3 ? RandomRig(&random, 60) : Operations(10);
    for (const std::size_t window : {1, 7, 4096}) {
      Empty();
      const std::string without = Everything(rig.Run(window));
      for (const int threads : {1, 2}) {
        const ThreadLimit limit(threads);
        if (threads == 2) Empty();
        const CollisionResult cold = Run(rig, window);
        EXPECT_GT(cold.outcomes, 5u);
        EXPECT_EQ(Everything(cold), without) << i << " window " << window;
        const CollisionResult warm = Run(rig, window);
        EXPECT_EQ(warm.recalled, warm.outcomes);
        EXPECT_EQ(warm.outcomes, cold.outcomes);
        EXPECT_EQ(Everything(warm), without) << i << " window " << window;
        findings += static_cast<int>(warm.findings.size());
      }
    }
  }
  EXPECT_GT(findings, 100);
}

TEST_F(CacheTest, WhereTheProgramStandsDoesNotMatter) {
  const Rig rig = Operations(12);
  Run(rig, 16);
  const Rig shifted = Shifted(rig, 100);
  const CollisionResult warm = Run(shifted, 16);
  EXPECT_EQ(warm.recalled, warm.outcomes);
  EXPECT_EQ(Everything(warm), Everything(shifted.Run(16)));
  EXPECT_NE(Everything(warm), Everything(rig.Run(16)));
  ASSERT_FALSE(warm.findings.empty());
  EXPECT_GT(warm.findings.front().where.line, 100);
}

// A motion of its own in front, so each run has another number; the blank's first cut too.
TEST_F(CacheTest, RunsAreCountedFromTheirStart) {
  Rig rig = Operations(12);
  Run(rig, 4096);
  motion::Motion first = rig.motions().front();
  first.facts.tool = 9;  // another run
  std::get<motion::AxisLinear>(first.path).q1 = std::get<motion::AxisLinear>(first.path).q0;
  rig.motions().insert(rig.motions().begin(), first);
  const CollisionResult warm = Run(rig, 4096);
  EXPECT_EQ(Everything(warm), Everything(rig.Run(4096)));
  EXPECT_GE(warm.recalled, warm.outcomes - 10);
}

TEST_F(CacheTest, AnEditOfOneOperationChecksThatOperation) {
  const Rig rig = Operations(40);  // about 160 motions each
  const std::size_t window = 20;
  const CollisionResult whole = Run(rig, window);
  for (const std::size_t at : {30UL, 220UL, 400UL, 600UL}) {
    Rig edited = rig;
    MoveEnd(&edited, at, 0.25);
    const CollisionResult warm = Run(edited, window);
    EXPECT_EQ(Everything(warm), Everything(edited.Run(window))) << at;
    // One run of 33, and one more for what passes on from it, or where the end is the next one's
    // start.
    EXPECT_LE(warm.outcomes - warm.recalled, whole.outcomes / 33 * 2 + 3) << at;
    EXPECT_LT(warm.recalled, warm.outcomes) << at;
  }
  EXPECT_EQ(Run(rig, window).recalled, whole.outcomes) << "the first state is known still";
}

// What a changed job or model changes, each against a fresh run.
TEST_F(CacheTest, WhatDoesNotFitIsNotUsed) {
  const Rig rig = Operations(12);
  const CollisionResult whole = Run(rig, 16);
  const std::string before = Everything(whole);
  std::vector<Change> changes = OtherShapes();
  for (const Change& change : OtherSettingsAndMotions()) changes.push_back(change);
  for (const Change& change : changes) {
    Rig changed = rig;
    change.make(&changed);
    const std::string fresh = Everything(changed.Run(16));
    const CollisionResult warm = Run(changed, 16);
    EXPECT_EQ(Everything(warm), fresh) << change.name;
    EXPECT_TRUE(warm.recalled < warm.outcomes || warm.outcomes < whole.outcomes) << change.name;
    EXPECT_TRUE(!change.told || fresh != before) << change.name << " changes nothing: no test";
    EXPECT_EQ(Everything(Run(changed, 16)), fresh) << change.name;
  }
  EXPECT_EQ(Everything(Run(rig, 16)), before);
}

// Windows that are the same each time, to which something else passes on: how deep the feeds were,
// and of which cycle the motions are.
TEST_F(CacheTest, WhatPassesOnIsLookedAt) {
  std::set<std::string> told;
  for (const std::size_t window : {1, 2, 3, 4096}) {
    for (const machine::GougeMode gouge : {machine::GougeMode::kError, machine::GougeMode::kOff}) {
      for (const double depth : {1.0, 3.0}) {
        for (const auto& [out, in] : {std::pair{5, 5}, {5, 6}, {5, 0}, {0, 0}, {0, 5}, {7, 7}}) {
          Rig rig;
          rig.check().gouge = gouge;
          rig.AddBox("part", BodyKind::kPart, {-60, -30, -50}, {0, 30, 0});
          rig.Start(-40, 0, 20);
          rig.Feed(-40, 0, -3);  // the deepest cut of all
          rig.Rapid(-40, 0, 20);
          rig.Rapid(-30, 0, 20);
          rig.facts().cycle = out;
          rig.Feed(-30, 0, -depth);
          rig.Feed(-30, 0, -1);
          rig.Rapid(-30, 0, -2.5);  // no deeper than the feeds
          rig.Rapid(-30, 0, 5);
          rig.Rapid(-20, 0, 5);
          rig.Rapid(-20, 0, 6);
          rig.facts().cycle = in;
          rig.Rapid(-20, 0, -2.5);  // in the same cycle it may come back
          rig.Rapid(-30, 0, 50);
          const std::string fresh = Everything(rig.Run(window));
          for (int i = 0; i < 2; ++i) {
            EXPECT_EQ(Everything(Run(rig, window)), fresh)
                << window << ": " << depth << " deep, cycles " << out << ' ' << in;
          }
          told.insert(fresh);
        }
      }
    }
  }
  EXPECT_GE(told.size(), 8u);
}

// On a machine of which no five axes are known, whose joints else stand for themselves.
TEST_F(CacheTest, EveryJointIsLookedAt) {
  Rig rig = Operations(3);
  rig.machine().five_axis.reset();
  Run(rig, 4096);
  for (std::size_t i = 0; i < rig.machine().tree.joints().size(); ++i) {
    for (const bool turned : {false, true}) {
      Rig changed = rig;
      std::vector<kinematics::Joint> joints = rig.machine().tree.joints();
      joints[i].X_PJ.translation() += Eigen::Vector3d(0.3, 0.2, 0.1);
      if (turned)
        joints[i].axis = (joints[i].axis + Eigen::Vector3d(0.03, 0.02, 0.01)).normalized();
      changed.machine().tree = kinematics::KinematicTree(rig.machine().tree.links(), joints);
      EXPECT_EQ(Everything(Run(changed, 4096)), Everything(changed.Run())) << i;
      EXPECT_NE(Everything(changed.Run()), Everything(rig.Run())) << i;
      Run(rig, 4096);
    }
  }
}

// Wider flutes cut the blank earlier, and what the holder does to it is another fault, though
// neither holder nor motions have changed.
TEST_F(CacheTest, WhereTheBlankWasCutIsLookedAt) {
  std::vector<Severity> severities;
  for (const double radius : {5.0, 8.0, 5.0}) {
    Rig rig;
    rig.tools().tools[0].flutes = CylinderProfile(0, 30, radius);
    rig.AddBox("blank", BodyKind::kStock, {-62, -32, -50}, {2, 32, 3});
    rig.Start(-30, 45, 20);
    rig.Feed(-30, 45, -10);
    rig.Feed(-30, 38, -10);  // the wider ones touch
    rig.Feed(-30, 45, -10);
    rig.Rapid(-30, 45, -100);  // the holder goes 7 mm into it
    rig.Rapid(-30, 45, -10);
    rig.Feed(-30, 30, -10);
    const CollisionResult warm = Run(rig, 4096);
    EXPECT_EQ(Everything(warm), Everything(rig.Run()));
    for (const Finding& finding : warm.findings) {
      if (finding.bodies.front() == "T3.holder") severities.push_back(finding.severity);
    }
  }
  EXPECT_THAT(severities, ElementsAre(Severity::kError, Severity::kWarning, Severity::kError));
}

// A pair that a change does not concern is not computed again.
TEST_F(CacheTest, AChangedFixtureIsCheckedAgainAndNothingElse) {
  Rig rig = Operations(12);
  const CollisionResult whole = Run(rig, 4096);
  rig.scene().bodies[0].mesh = BoxMesh({60.1, -20, -50}, {90, 20, 60});
  const CollisionResult warm = Run(rig, 4096);
  // Four runs; flutes, holder, the shank of one tool, head and column against the post.
  EXPECT_EQ(warm.outcomes, whole.outcomes);
  EXPECT_EQ(warm.outcomes - warm.recalled, 2 * 3 + 2 * 2 + 4 * 2u);
}

// Feeds, times and lines change what is told and no outcome: what content.cc leaves out is read by
// no check.
TEST_F(CacheTest, WhatKeysLeaveOutChangesNothing) {
  kinematics::Random random(9);
  for (int i = 0; i < 3; ++i) {
    Empty();
    Rig rig = i < 2 ? RandomRig(&random, 60) : Operations(12);
    Run(rig, 16);
    for (motion::Motion& motion : rig.motions()) {
      motion.where = {1, random.Below(1000) + 1, random.Below(9)};
      motion.start_time = random.Uniform(0, 1e4);
      motion.duration = random.Uniform(0, 10);
      motion.facts.feed = random.Uniform(0, 100);
      motion.facts.tcp = random.Below(2) == 0;
      motion.facts.brake_conflict = random.Below(2) == 0;
      motion.facts.exact_stop = random.Below(2) == 0;
      motion.facts.names_linear = random.Below(2) == 0;
      motion.facts.offset = random.Below(5);
    }
    rig.machine().name = "another";
    rig.machine().path = "elsewhere";
    for (machine::Axis& axis : rig.machine().axes) axis.rapid = random.Uniform(1, 9);
    const CollisionResult warm = Run(rig, 16);
    EXPECT_EQ(warm.recalled, warm.outcomes);
    EXPECT_EQ(Everything(warm), Everything(rig.Run(16)));
  }
}

TEST_F(CacheTest, AnotherBuildKnowsNothing) {
  const Rig rig = Operations(5);
  Run(rig, 16, "old");
  const CollisionResult other = Run(rig, 16, "new");
  EXPECT_EQ(other.recalled, 0u);
  EXPECT_EQ(Run(rig, 16, "old").recalled, other.outcomes);
}

TEST_F(CacheTest, DamagedEntriesAreFoundAndDropped) {
  const Rig rig = Operations(3);
  const std::string fresh = Everything(Run(rig, 10));
  kinematics::Random random(1);
  const std::vector<fs::path> files = Files();
  ASSERT_GT(files.size(), 3u);
  for (int i = 0; i < 150; ++i) {
    const fs::path& file = files[static_cast<std::size_t>(i) % files.size()];
    std::string bytes = Slurp(file);
    const auto at = static_cast<std::size_t>(random.Below(static_cast<int>(bytes.size())));
    if (i % 3 == 0) {
      bytes.resize(at);
    } else {
      bytes[at] = static_cast<char>(bytes[at] ^ (1 << random.Below(8)));
    }
    std::ofstream(file, std::ios::binary) << bytes;
    const CollisionResult warm = Run(rig, 10);
    EXPECT_LT(warm.recalled, warm.outcomes);
    EXPECT_EQ(Everything(warm), fresh) << i;
    EXPECT_EQ(Run(rig, 10).recalled, warm.outcomes) << "it was not made good";
  }
}

// Bytes that a checksum does not guard: no outcome, or one that is told without harm.
TEST_F(CacheTest, BytesThatAreNoOutcomeAreRefused) {
  PairOutcome outcome;
  ContactRun run;
  run.last = 3;
  run.points = {{1, 2, 3}, {4, 5, 6}};
  outcome.runs = {run, run};
  outcome.uncertified = "because";
  PairCarry carry;
  BlankState blank{true, 12, 0.5};
  const RunPlace place{10, 4, 7};
  const std::string bytes = PackOutcome(outcome, carry, &blank, place);
  PairOutcome read;
  BlankState whole;
  ASSERT_TRUE(UnpackOutcome(bytes, {100, 4, 7}, &read, &carry, &whole));
  EXPECT_THAT(read.runs, SizeIs(2));
  EXPECT_EQ(read.uncertified, "because");
  EXPECT_TRUE(whole.cut);
  EXPECT_EQ(whole.motion, 102u);
  EXPECT_FALSE(UnpackOutcome(bytes, {100, 3, 7}, &read, &carry, &whole)) << "of a longer run";
  EXPECT_FALSE(UnpackOutcome(bytes, {100, 4, 7}, &read, &carry, nullptr)) << "of a pair with blank";
  for (std::size_t size = 0; size < bytes.size(); ++size) {
    EXPECT_FALSE(UnpackOutcome(bytes.substr(0, size), place, &read, &carry, &whole)) << size;
  }
  EXPECT_FALSE(UnpackOutcome(bytes + "x", place, &read, &carry, &whole));
  for (std::size_t bit = 0; bit < 8 * bytes.size(); ++bit) {
    std::string damaged = bytes;
    damaged[bit / 8] = static_cast<char>(damaged[bit / 8] ^ (1 << bit % 8));
    if (!UnpackOutcome(damaged, place, &read, &carry, &whole)) continue;
    for (const ContactRun& each : read.runs) EXPECT_LT(each.last, place.size);
    EXPECT_LT(read.least_at, place.size);
  }
}

TEST_F(CacheTest, TwoMayUseAFolderAtATime) {
  const Rig one = Operations(8);
  Rig other = one;
  MoveEnd(&other, 10, 0.25);
  const std::string of_one = Everything(one.Run(10));
  const std::string of_other = Everything(other.Run(10));
  for (int round = 0; round < 5; ++round) {
    Empty();
    std::string first, second, third;
    {
      std::jthread a([&] { first = Everything(Run(one, 10)); });
      std::jthread b([&] { second = Everything(Run(one, 10)); });
      std::jthread c([&] { third = Everything(Run(other, 10)); });
    }
    EXPECT_EQ(first, of_one);
    EXPECT_EQ(second, of_one);
    EXPECT_EQ(third, of_other);
    EXPECT_EQ(Everything(Run(one, 10)), of_one);
    EXPECT_EQ(Run(one, 10).recalled, Run(one, 10).outcomes);
  }
}

TEST_F(CacheTest, AFolderThatCannotBeWrittenChangesNothing) {
  const Rig rig = Operations(5);
  fs::remove_all(folder_);
  std::ofstream(folder_) << "a file where the folder was";
  const CollisionResult result = Run(rig, 10);
  EXPECT_EQ(Everything(result), Everything(rig.Run(10)));
  EXPECT_NE(store_->trouble(), "");
}

TEST(RoundedLeastTest, IsAtMostASixteenthMoreAndKeepsItsOrder) {
  kinematics::Random random(2);
  double last = -1e9;
  for (double least = -50.0; least < 2000.0; least += random.Uniform(0.0, 1.0)) {
    const double rounded = RoundedLeast(least);
    EXPECT_GE(rounded, least);
    EXPECT_LE(rounded - least, std::abs(least) / 16.0);
    EXPECT_GE(rounded, last);
    EXPECT_EQ(RoundedLeast(rounded), rounded);
    last = rounded;
  }
  EXPECT_EQ(RoundedLeast(0.0), 0.0);
  EXPECT_EQ(RoundedLeast(std::numeric_limits<double>::infinity()),
            std::numeric_limits<double>::infinity());
}

}  // namespace ncsim::collision
