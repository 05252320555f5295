// SPDX-License-Identifier: BSD-3-Clause
// What a whole check must not depend on.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>
#include <regex>
#include <set>
#include <string>
#include <tuple>

#include "sim/collision/random_rig.h"

namespace ncsim::collision {
namespace {

using kinematics::Random;

constexpr int kMotions = 50;

/// Rule, severity, line and bodies of each contact.
using Contact = std::tuple<Rule, Severity, int, std::vector<std::string>>;

std::multimap<Contact, double> Contacts(const CollisionResult& result) {
  std::multimap<Contact, double> contacts;
  for (const Finding& f : result.findings) {
    if (f.rule == Rule::kNearMiss) continue;
    contacts.emplace(Contact{f.rule, f.severity, f.where.line, f.bodies},
                     f.clearance_mm.value_or(0.0));
  }
  return contacts;
}

/// How many blocks of each pair are told to be too near or in contact.
std::map<std::vector<std::string>, int> Blocks(const CollisionResult& result) {
  static const std::regex kCount(R"(\((\d+) blocks)");
  std::map<std::vector<std::string>, int> blocks;
  for (const Finding& f : result.findings) {
    std::smatch match;
    blocks[f.bodies] += std::regex_search(f.message, match, kCount) ? std::stoi(match[1]) : 1;
  }
  return blocks;
}

TEST(ScenePropertyTest, MovingTheWholeSceneChangesNothing) {
  std::size_t contacts = 0;
  for (unsigned seed = 0; seed < 5; ++seed) {
    Random random(seed);
    const CollisionResult here = RandomRig(&random, kMotions).Run();
    random = Random(seed);
    const Eigen::Isometry3d X = Random(seed + 100).Pose(2000.0);
    const CollisionResult there = RandomRig(&random, kMotions, X).Run();
    const auto expected = Contacts(here);
    const auto moved = Contacts(there);
    ASSERT_EQ(moved.size(), expected.size()) << Words(here) << Words(there);
    for (auto a = expected.begin(), b = moved.begin(); a != expected.end(); ++a, ++b) {
      EXPECT_EQ(a->first, b->first);
      EXPECT_NEAR(a->second, b->second, 0.02);
    }
    EXPECT_EQ(Blocks(there), Blocks(here));
    ASSERT_EQ(here.clearances.size(), there.clearances.size());
    for (std::size_t i = 0; i < here.clearances.size(); ++i) {
      EXPECT_LE(here.clearances[i].proven_mm, there.clearances[i].seen_mm + 1e-6);
      EXPECT_LE(there.clearances[i].proven_mm, here.clearances[i].seen_mm + 1e-6);
    }
    contacts += expected.size();
  }
  EXPECT_GT(contacts, 30u);
}

/// The last block of a fault.
int LastLine(const Finding& finding) {
  static const std::regex kLast(R"(the last is line (\d+)\))");
  std::smatch match;
  return std::regex_search(finding.message, match, kLast) ? std::stoi(match[1])
                                                          : finding.where.line;
}

// A fault may be interrupted within a block, and end a run that way; the cut blank is warned of
// once a tool, where the first part of a block that may be cut does so.
TEST(ScenePropertyTest, SplittingAMotionRemovesNoFinding) {
  std::size_t contacts = 0;
  for (unsigned seed = 10; seed < 15; ++seed) {
    Random random(seed);
    const Rig rig = RandomRig(&random, kMotions);
    const CollisionResult whole = rig.Run();
    const CollisionResult split = rig.Split(&random).Run();
    for (const Finding& fault : whole.findings) {
      if (fault.rule == Rule::kNearMiss) continue;
      ++contacts;
      const bool found =
          std::any_of(split.findings.begin(), split.findings.end(), [&](const Finding& other) {
            const bool once = fault.severity == Severity::kWarning;
            return other.rule == fault.rule && other.bodies == fault.bodies &&
                   other.where.line <= fault.where.line &&
                   (once || LastLine(other) >= fault.where.line);
          });
      EXPECT_TRUE(found) << fault.where.line << ": " << fault.message << "\n" << Words(split);
    }
  }
  EXPECT_GT(contacts, 30u);
}

TEST(ScenePropertyTest, ABiggerThresholdRemovesNoFinding) {
  int near_misses = 0;
  for (unsigned seed = 20; seed < 24; ++seed) {
    Random random(seed);
    Rig rig = RandomRig(&random, kMotions);
    std::map<std::vector<std::string>, int> before;
    std::set<Contact> contacts;
    for (const double clearance : {0.0, 0.5, 2.0, 5.0, 20.0}) {
      rig.check().clearance = clearance;
      const CollisionResult result = rig.Run();
      const auto blocks = Blocks(result);
      for (const auto& [bodies, count] : before) EXPECT_GE(blocks.at(bodies), count) << clearance;
      std::set<Contact> now;
      for (const auto& [contact, depth] : Contacts(result)) now.insert(contact);
      EXPECT_THAT(now, ::testing::IsSupersetOf(contacts)) << clearance;
      before = blocks;
      contacts = now;
      near_misses += static_cast<int>(Of(result, Rule::kNearMiss).size());
    }
  }
  EXPECT_GT(near_misses, 20);
}

}  // namespace
}  // namespace ncsim::collision
