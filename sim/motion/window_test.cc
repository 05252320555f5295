// SPDX-License-Identifier: BSD-3-Clause
#include "sim/motion/window.h"

#include <gtest/gtest.h>

#include <random>
#include <set>

namespace ncsim::motion {
namespace {

Motion To(double x, int tool, int line) {
  Motion motion;
  AxisLinear path;
  path.q0 = path.q1 = JointVector::Constant(5, 1.0);
  path.q1[0] = x;
  motion.path = path;
  motion.facts.tool = tool;
  motion.where.line = line;
  return motion;
}

std::vector<Motion> RandomMotions(int count) {
  std::mt19937 random(3);
  std::vector<Motion> motions;
  for (int i = 0; i < count; ++i)
    motions.push_back(To(0.001 * static_cast<double>(random() % 1000000), 1, i));
  return motions;
}

std::vector<Window> Cut(const std::vector<Motion>& motions) {
  WindowCutter cutter;
  std::vector<Window> windows;
  for (const Motion& motion : motions) {
    if (Window full = cutter.Add(motion); !full.motions.empty()) windows.push_back(std::move(full));
  }
  windows.push_back(cutter.Take());
  return windows;
}

/// Lines of the first motions of all windows.
std::set<int> Starts(const std::vector<Motion>& motions) {
  std::set<int> starts;
  for (const Window& window : Cut(motions)) starts.insert(window.motions.front().where.line);
  return starts;
}

TEST(WindowTest, HoldAllMotionsInOrder) {
  const std::vector<Motion> motions = RandomMotions(30000);
  const std::vector<Window> windows = Cut(motions);
  int next = 0;
  for (const Window& window : windows) {
    EXPECT_LE(window.motions.size(), kWindowSize);
    EXPECT_TRUE(window.motions.size() >= WindowCutter::kShortest || &window == &windows.back());
    for (const Motion& motion : window.motions) EXPECT_EQ(motion.where.line, next++);
  }
  EXPECT_EQ(next, 30000);
}

TEST(WindowTest, EndAtToolChanges) {
  std::vector<Motion> motions;
  for (int i = 0; i < 30; ++i) motions.push_back(To(i, i / 10, i));
  EXPECT_EQ(Starts(motions), (std::set<int>{0, 10, 20}));
}

TEST(WindowTest, EndSomewhereWhereNothingIsMarked) {
  const std::vector<Window> windows = Cut(std::vector<Motion>(10000, To(1.0, 1, 0)));
  EXPECT_EQ(windows.size(), 3u);
}

// An edit in the middle: what is before is cut as it was, and after a few windows what is behind.
TEST(WindowTest, AreTheSameAgainBehindAnEdit) {
  const std::vector<Motion> motions = RandomMotions(90000);
  const std::set<int> before = Starts(motions);
  ASSERT_GT(before.size(), 25u);
  for (const int inserted : {1, 10, 500, 3000}) {
    std::vector<Motion> edited = motions;
    const std::vector<Motion> more(static_cast<std::size_t>(inserted), To(0.5, 1, 100000));
    edited.insert(edited.begin() + 20000, more.begin(), more.end());
    std::set<int> after = Starts(edited);
    after.erase(100000);
    int others = 0;
    for (const int start : before) {
      if (after.count(start) > 0) continue;
      ++others;
      EXPECT_GT(start, 16000);
      EXPECT_LT(start, 35000) << inserted;
    }
    EXPECT_LE(others, 5) << inserted;
  }
}

}  // namespace
}  // namespace ncsim::motion
