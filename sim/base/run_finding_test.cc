// SPDX-License-Identifier: BSD-3-Clause
#include "sim/base/run_finding.h"

#include <gtest/gtest.h>

namespace ncsim {
namespace {

RunFinding Hit(int first, int last) {
  RunFinding run;
  run.Start(MakeFinding(Rule::kCollision, {0, first, 1}, "hit"));
  for (int line = first; line <= last; ++line) {
    run.Add({0, line, 1});
    run.Add({0, line, 1});  // two motions of one block
  }
  return run;
}

TEST(RunFindingTest, CountsBlocks) {
  EXPECT_EQ(Hit(7, 7).Take().message, "hit");
  EXPECT_EQ(Hit(7, 10).Take().message, "hit (4 blocks, the last is line 10)");
  RunFinding run = Hit(7, 10);
  EXPECT_EQ(run.Take().where.line, 7);
  EXPECT_FALSE(run.open());
}

TEST(RunFindingTest, GoesOnWithAnotherRun) {
  RunFinding run = Hit(7, 10);
  run.Append(Hit(11, 12));
  EXPECT_EQ(run.blocks(), 6);
  // The next motion of the same block.
  run.Append(Hit(12, 13));
  const Finding finding = run.Take();
  EXPECT_EQ(finding.message, "hit (7 blocks, the last is line 13)");
  EXPECT_EQ(finding.where.line, 7);
}

}  // namespace
}  // namespace ncsim
