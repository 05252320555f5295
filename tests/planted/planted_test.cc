// SPDX-License-Identifier: BSD-3-Clause
// The planted-crash benchmark: cases whose truth comes from closed forms (docs/planted-crashes.md),
// through the collision checker, and through FCL as a user would call it.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "sim/base/units.h"
#include "sim/collision/tessellate.h"
#include "tests/peers/fcl_pair.h"
#include "tests/planted/families.h"

namespace ncsim::planted {
namespace {

using collision::CollisionResult;

constexpr double kFalseAlarmsBelow = 0.02;  // mm of true clearance
constexpr double kFirst = 1e-3;             // of the motion
constexpr double kDepth = 0.01;             // mm
constexpr double kSagitta = 0.019;          // mm, of the peers' meshes of tools

constexpr const char* kOnlyLag = "(with the machine's acceleration)";

struct Family {
  const char* id;
  const char* name;
  std::optional<Case> (*make)(Random*, bool);
  unsigned seed;
};
constexpr int kCases = 184;
const Family kFamilies[] = {
    {"ThinWall", "thin wall", ThinWall, 101},
    {"PinThroughSlot", "pin through a slot", PinThroughSlot, 102},
    {"Grazing", "grazing", Grazing, 103},
    {"Contained", "one inside the other", Contained, 104},
    {"LongRapid", "long rapid, small body", LongRapid, 105},
    {"DogLegPolyline", "dog-leg, polyline", DogLegPolyline, 106},
    {"DogLegAccelerated", "dog-leg, accelerated", DogLegAccelerated, 107},
    {"TcpDip", "TCP move that dips", TcpDip, 108},
    {"FarRotation", "rotation about a far centre", FarRotation, 109},
    {"HolderInPocket", "holder in a pocket", HolderInPocket, 110},
    {"HeadOverTable", "head against a body", HeadOverTable, 112},
    {"WrapAt360", "wrap at 360", WrapAt360, 111},
};

/// Of one checker.
struct Score {
  int missed = 0;
  int false_alarms = 0;

  void Count(bool reported, double true_clearance) {
    if (true_clearance <= 0.0) missed += reported ? 0 : 1;
    if (true_clearance >= kFalseAlarmsBelow) false_alarms += reported ? 1 : 0;
  }
  std::string Cell() const {
    return " " + std::to_string(missed) + " / " + std::to_string(false_alarms) + " |";
  }
};

struct Row {
  int cases = 0;
  int hits = 0;
  Score ncsim, continuous, advancement, sampled;

  std::string Ours() const {
    return "| " + std::to_string(cases) + " | " + std::to_string(hits) + " |" + ncsim.Cell();
  }
  std::string Peers() const { return continuous.Cell() + advancement.Cell() + sampled.Cell(); }
};

Case Draw(const Family& family, int index) {
  Random random(family.seed * 10000U + static_cast<unsigned>(index));
  for (;;) {
    std::optional<Case> c = family.make(&random, index % 2 == 0);
    if (c.has_value()) return *std::move(c);
  }
}

/// Of the tool (or head) that the truth is about, with `body`.
bool IsOf(const std::vector<std::string>& bodies, const Case& c, const std::string& body) {
  const std::string moving = c.tool > 0 ? "T" + std::to_string(c.tool) + "." : "head";
  return bodies.size() == 2 && bodies[0].starts_with(moving) && bodies[1] == body;
}

/// Part of the motion at which the finding says that contact begins.
double Where(const Case& c, const Finding& finding, int motion) {
  const motion::Motion& m = c.rig.motions()[static_cast<std::size_t>(motion)];
  const auto* dog_leg = std::get_if<motion::DogLeg>(&m.path);
  const double time = dog_leg != nullptr ? motion::Duration(*dog_leg, 0.0) : m.duration;
  return (*finding.time_s - m.start_time) / time;
}

void HoldFirst(const Case& c, const Finding& finding, const FirstContact& first) {
  EXPECT_EQ(finding.where.line, first.motion + 1);
  const double at = Where(c, finding, first.motion);
  EXPECT_GE(at, first.at.lower - kFirst);
  EXPECT_LE(at, first.at.upper + kFirst);
}

/// Verdict, least clearance, first contact and depth of one pair.
void HoldPair(const Case& c, const PairTruth& truth, const CollisionResult& result, Row* row) {
  const Finding* first = nullptr;
  double least = 1e300;
  for (const Finding& f : result.findings) {
    EXPECT_EQ(f.rule, Rule::kCollision);
    if (!IsOf(f.bodies, c, truth.body)) continue;
    if (first == nullptr) first = &f;
    least = std::min(least, f.clearance_mm.value_or(1e300));
  }
  const Bounds& real = truth.clearance;
  EXPECT_TRUE(real.lower > 0.0 || real.upper <= 0.0) << "the truth of this case is not told";
  EXPECT_LT(real.upper - real.lower, 0.005);
  row->ncsim.Count(first != nullptr, real.upper);
  if (real.upper <= 0.0) {
    ASSERT_NE(first, nullptr) << "missed";
  }
  if (real.lower >= kFalseAlarmsBelow) {
    EXPECT_EQ(first, nullptr) << "false alarm";
  }
  bool listed = false;
  for (const collision::PairClearance& pair : result.clearances) {
    if (!IsOf(pair.bodies, c, truth.body)) continue;
    listed = true;
    EXPECT_LE(pair.proven_mm, real.upper + 1e-6);
    EXPECT_GE(pair.seen_mm, real.lower - 1e-6);
  }
  // Two meshes that count as touching have no clearance to tell.
  EXPECT_EQ(listed, truth.has_depth || first == nullptr);
  if (real.upper > 0.0) return;
  if (truth.has_depth) {
    EXPECT_GE(least, real.lower - kDepth);
    // Of a dog-leg whose polyline hits, the polyline's depth is told.
    const bool polyline = truth.accelerated && !first->message.ends_with(kOnlyLag);
    if (!polyline) {
      EXPECT_LE(least, real.upper + kDepth);
    }
  }
  if (truth.first.has_value()) HoldFirst(c, *first, *truth.first);
}

Eigen::Isometry3d ToolInTable(const Case& c, const motion::JointVector& q) {
  const machine::Machine& m = c.rig.machine();
  return m.tree.Pose(m.table_link, q).inverse() * m.tree.Pose(m.spindle_link, q);
}

/// Steps of 0.1 mm of the linear axes and 0.05 degrees.
int Samples(const motion::Motion& motion) {
  constexpr int kPieces = 64;
  double mm = 0.0;
  double turn = 0.0;
  for (int i = 0; i < kPieces; ++i) {
    const motion::JointVector step = motion.At((i + 1.0) / kPieces) - motion.At(1.0 * i / kPieces);
    mm += step.head<3>().norm();
    turn += step.tail<2>().cwiseAbs().maxCoeff();
  }
  return std::max(1, static_cast<int>(std::ceil(std::max(mm / 0.1, Degrees(turn) / 0.05))));
}

bool SampledHit(const Case& c, const motion::Motion& motion, const peers::FclBody& moving,
                const peers::FclBody& body) {
  const int samples = Samples(motion);
  for (int i = 0; i <= samples; ++i) {
    const motion::JointVector q = motion.At(static_cast<double>(i) / samples);
    if (peers::Collides(moving, body, ToolInTable(c, q))) return true;
  }
  return false;
}

machine::TriangleMesh MovingMesh(const Case& c) {
  if (c.tool == 0) return c.head;
  const machine::Tool& tool = *c.rig.tools().Find(c.tool);
  const machine::Profile& profile = !tool.flutes.empty()  ? tool.flutes
                                    : !tool.shank.empty() ? tool.shank
                                                          : tool.holder;
  return collision::Tessellate(profile, tool.length, kSagitta);
}

void RunPeers(const Case& c, double true_clearance, Row* row) {
  const peers::FclBody moving(MovingMesh(c));
  bool continuous = false;
  bool advancement = false;
  bool sampled = false;
  for (const machine::SceneBody& scene_body : c.rig.scene().bodies) {
    if (scene_body.link == c.rig.machine().spindle_link) continue;
    const peers::FclBody body(scene_body.mesh);
    for (const motion::Motion& motion : c.rig.motions()) {
      if (motion.facts.tool != c.tool) continue;
      const Eigen::Isometry3d X_BS0 = ToolInTable(c, motion.At(0.0));
      const Eigen::Isometry3d X_BS1 = ToolInTable(c, motion.At(1.0));
      const auto hits = [&](peers::Solver solver) {
        return peers::ContinuousCollides(moving, body, X_BS0, X_BS1, solver);
      };
      continuous = continuous || hits(peers::Solver::kDefault);
      advancement = advancement || hits(peers::Solver::kConservativeAdvancement);
      sampled = sampled || SampledHit(c, motion, moving, body);
    }
  }
  row->continuous.Count(continuous, true_clearance);
  row->advancement.Count(advancement, true_clearance);
  row->sampled.Count(sampled, true_clearance);
}

const std::filesystem::path kTable =
    std::filesystem::path(NCSIM_SOURCE_DIR) / "docs/planted-crashes.md";

/// The table's row of a family; with NCSIM_WRITE_DOCS=1 it is written first.
std::string DocumentedRow(const std::string& name, const std::string& now) {
  std::ifstream in(kTable);
  std::vector<std::string> lines;
  std::string* row = nullptr;
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  for (std::string& line : lines) {
    // The first: another table has the families' names too.
    if (row == nullptr && line.starts_with("| " + name + " |")) row = &line;
  }
  if (row == nullptr) return "";
  const char* write = std::getenv("NCSIM_WRITE_DOCS");
  if (write != nullptr && std::string(write) == "1") {
    *row = now;
    std::ofstream out(kTable);
    for (const std::string& line : lines) out << line << "\n";
  }
  return *row;
}

class PlantedTest : public ::testing::TestWithParam<Family> {};

TEST_P(PlantedTest, NoneIsMissed) {
  Row row;
  for (int i = 0; i < kCases; ++i) {
    const Case c = Draw(GetParam(), i);
    const CollisionResult result = c.rig.Run();
    double least = 1e300;
    for (const PairTruth& truth : c.pairs) {
      SCOPED_TRACE("case " + std::to_string(i) + ", " + truth.body + ", true clearance " +
                   std::to_string(truth.clearance.lower) + " to " +
                   std::to_string(truth.clearance.upper) + "\n" + collision::Words(result));
      HoldPair(c, truth, result, &row);
      least = std::min(least, truth.clearance.upper);
    }
    ++row.cases;
    row.hits += least <= 0.0 ? 1 : 0;
    RunPeers(c, least, &row);
  }
  const std::string ours = "| " + std::string(GetParam().name) + " " + row.Ours();
  const std::string documented = DocumentedRow(GetParam().name, ours + row.Peers());
  EXPECT_TRUE(documented.starts_with(ours)) << documented << "\n" << ours << row.Peers();
}

std::string IdOf(const ::testing::TestParamInfo<Family>& family) { return family.param.id; }

INSTANTIATE_TEST_SUITE_P(Families, PlantedTest, ::testing::ValuesIn(kFamilies), IdOf);

}  // namespace
}  // namespace ncsim::planted
