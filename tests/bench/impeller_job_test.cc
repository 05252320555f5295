// SPDX-License-Identifier: BSD-3-Clause
// The benchmark measures what it says: the job is sound, clear of contacts and the same for all who
// take part, and all of them find a crash that is planted in it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <set>
#include <sstream>
#include <string>
#include <variant>
#include <vector>

#include "sim/base/units.h"
#include "sim/machine/mesh_check.h"
#include "tests/bench/bench_mesh.h"
#include "tests/bench/checker_run.h"
#include "tests/bench/impeller_job.h"
#include "tests/bench/impeller_path.h"
#include "tests/bench/peer_run.h"
#include "tests/peers/fcl_world.h"

namespace {

using namespace ncsim;
using PairNames = std::set<std::set<std::string>>;

constexpr int kBlocks = 300;

class ImpellerJob : public testing::Test {
 protected:
  void SetUp() override {
    bench::ImpellerSpec spec;
    spec.blocks = kBlocks;
    spec.triangles = 3'000;
    job_ = bench::MakeImpellerJob(spec, folder_.path());
    ASSERT_TRUE(job_.has_value());
  }

  machine::SceneBody& Body(const std::string& name) {
    return *std::find_if(job_->scene.bodies.begin(), job_->scene.bodies.end(),
                         [&](const machine::SceneBody& body) { return body.name == name; });
  }
  std::vector<motion::Motion> Motions() const {
    std::vector<motion::Motion> motions;
    bench::ForEachWindow(*job_, [&](const motion::Window& window) {
      motions.insert(motions.end(), window.motions.begin(), window.motions.end());
      return true;
    });
    return motions;
  }

  bench::BenchFolder folder_;
  std::optional<bench::BenchJob> job_;
};

TEST(Impeller, IsAClosedSolidOfTheStatedFineness) {
  for (const int triangles : {1'000, 30'000}) {
    machine::TriangleMesh mesh = bench::Impeller::Mesh(triangles);
    EXPECT_NEAR(static_cast<double>(mesh.triangles.size()), triangles, 0.1 * triangles);
    EXPECT_GT(machine::SignedVolume(mesh), 0.0);
    mesh.watertight = false;
    EXPECT_EQ(machine::CheckMesh(&mesh).defect, "");
    EXPECT_TRUE(mesh.watertight);
  }
}

TEST(ImpellerPath, IsTheSameForTheSameSeedAndHasTheStatedBlocks) {
  const auto text = [](std::uint32_t seed) {
    bench::ImpellerPath::Options options;
    options.seed = seed;
    std::ostringstream out;
    bench::ImpellerPath(options).Write(2'000, out);
    return out.str();
  };
  const std::string program = text(1);
  EXPECT_EQ(program, text(1));
  EXPECT_NE(program, text(2));
  EXPECT_EQ(std::count(program.begin(), program.end(), '\n'), 2'000 + 20);
}

TEST(BlockMesh, OfABoxWithAHoleHasItsVolume) {
  const machine::TriangleMesh mesh =
      bench::BlockMesh({{{0, 0, 0}, {30, 20, 10}}, {{10, 5, 0}, {20, 15, 10}, true}}, 7.0);
  EXPECT_NEAR(machine::SignedVolume(mesh), 30 * 20 * 10 - 10 * 10 * 10, 1e-9);
}

TEST_F(ImpellerJob, HasTenLinksAndTheMotionsOfAnImpeller) {
  EXPECT_EQ(job_->machine.bodies.size(), 10U);
  for (const machine::SceneBody& body : job_->scene.bodies) EXPECT_EQ(body.defect, "") << body.name;
  std::vector<double> ways, turns;
  int rapids = 0;
  const kinematics::FiveAxis& five = *job_->machine.five_axis;
  const double length = job_->job.tools.front().length;
  const std::vector<motion::Motion> motions = Motions();
  for (const motion::Motion& motion : motions) {
    if (motion::IsRapid(motion)) ++rapids;
    if (!std::holds_alternative<motion::TcpCurve>(motion.path)) continue;
    Eigen::Vector3d from, to, axis;
    five.TipInTable(motion.q0(), length, &from, &axis);
    five.TipInTable(motion.q1(), length, &to, &axis);
    ways.push_back((to - from).norm());
    turns.push_back(
        Degrees(std::hypot(motion.q1()[3] - motion.q0()[3], motion.q1()[4] - motion.q0()[4])));
  }
  ASSERT_GT(ways.size(), 0.9 * kBlocks);
  std::sort(ways.begin(), ways.end());
  std::sort(turns.begin(), turns.end());
  EXPECT_NEAR(ways[ways.size() / 2], 0.30, 0.03);
  EXPECT_NEAR(turns[turns.size() / 2], 0.11, 0.03);
  EXPECT_NEAR(static_cast<double>(rapids) / static_cast<double>(motions.size()), 0.06, 0.03);
}

TEST_F(ImpellerJob, IsClearForAllAndTheyLookAtTheSamePairs) {
  const bench::CheckerRun run = bench::RunChecker(*job_, kBlocks);
  EXPECT_THAT(run.result.findings, testing::IsEmpty());
  PairNames ours;
  for (const auto& clearance : run.result.clearances) {
    ours.insert({clearance.bodies.begin(), clearance.bodies.end()});
  }
  for (const auto arrangement : {peers::Arrangement::kPlain, peers::Arrangement::kBest}) {
    EXPECT_EQ(bench::RunPeer(*job_, arrangement, 0.0, 60).contact, "");
    PairNames theirs;
    for (const auto& names :
         peers::FclWorld(job_->machine, job_->scene, job_->job.tools.front(), arrangement)
             .pairs()) {
      theirs.insert({names.begin(), names.end()});
    }
    EXPECT_EQ(theirs, ours);
  }
}

TEST_F(ImpellerJob, WithTheToolAsMeshesTheClearancesAreTheSame) {
  const auto least = [](const bench::BenchJob& job, const std::string& tool) {
    const bench::CheckerRun run = bench::RunChecker(job, kBlocks);
    EXPECT_THAT(run.result.findings, testing::IsEmpty());
    for (const auto& clearance : run.result.clearances) {
      const auto& names = clearance.bodies;
      if (std::find(names.begin(), names.end(), tool) == names.end()) continue;
      if (std::find(names.begin(), names.end(), "part") != names.end()) return clearance;
    }
    return collision::PairClearance();
  };
  const collision::PairClearance profile = least(*job_, "T1.shank");
  const collision::PairClearance mesh = least(bench::WithToolAsMeshes(*job_), "mesh of shank");
  // Each proven clearance is below what the other has seen; the mesh is 0.005 mm outside.
  ASSERT_GT(profile.proven_mm, 1.0);
  EXPECT_LE(profile.proven_mm, mesh.seen_mm + 0.01);
  EXPECT_LE(mesh.proven_mm, profile.seen_mm);
}

TEST_F(ImpellerJob, APlantedCrashIsFoundByAll) {
  // The fixture is raised into the shank's way.
  for (Eigen::Vector3d& v : Body("fixture").mesh.vertices) v.z() += 60.0;
  const bench::CheckerRun run = bench::RunChecker(*job_, kBlocks);
  EXPECT_THAT(run.result.findings,
              testing::Contains(testing::Field(&Finding::rule, Rule::kCollision)));
  for (const auto arrangement : {peers::Arrangement::kPlain, peers::Arrangement::kBest}) {
    const bench::PeerRun peer = bench::RunPeer(*job_, arrangement, 1.0, kBlocks);
    EXPECT_THAT(peer.contact, testing::HasSubstr("fixture"));
  }
}

TEST_F(ImpellerJob, PairsAloneCostQueriesLikeAllTogether) {
  std::uint64_t queries = 0;
  for (const bench::PairRun& run : bench::RunPairs(*job_, kBlocks)) queries += run.queries;
  EXPECT_EQ(queries, bench::RunChecker(*job_, kBlocks).result.queries);
}

}  // namespace
