// SPDX-License-Identifier: BSD-3-Clause
// Toolpaths made by hand, held together.
#include "sim/compare/compare.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "kinematics/test_machines.h"
#include "sim/base/units.h"

namespace ncsim::compare {
namespace {

using kinematics::Random;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using Points = std::vector<Pose>;

Pose At(double x, double y, double z, double tilt_deg = 0.0) {
  return {{x, y, z}, {std::sin(Radians(tilt_deg)), 0.0, std::cos(Radians(tilt_deg))}};
}

/// Motions by hand; each is a line of its file.
class Path {
 public:
  explicit Path(int file) : file_(file), builder_({1e-4, 1e-6}) {}
  Path& Rapid(const Pose& end) {
    builder_.Rapid(Next(), end);
    return *this;
  }
  Path& Feed(const Pose& end, double feed = 10.0, double slack = 0.0) {
    const Pose from = builder_.pose();
    Curve line;
    line.at = [&](double s) { return Lerp(from, end, s); };
    builder_.Feed(Next(), feed, line, slack);
    return *this;
  }
  Path& Feeds(const Points& points) {
    for (const Pose& point : points) Feed(point);
    return *this;
  }
  /// A circle about the Z axis from the present point, with a rise.
  Path& Arc(double sweep, double rise) {
    const Pose from = builder_.pose();
    const double radius = std::hypot(from.p.x(), from.p.y());
    Curve arc;
    arc.at = [&](double s) {
      Pose pose = from;
      pose.p = Eigen::AngleAxisd(s * sweep, Eigen::Vector3d::UnitZ()) * from.p;
      pose.p.z() += s * rise;
      return pose;
    };
    arc.bend = {radius * sweep * sweep, 0.0};
    builder_.Feed(Next(), 10.0, arc);
    return *this;
  }
  Toolpath Take() { return builder_.Take(); }

 private:
  SourcePosition Next() { return {file_, ++line_, 1}; }
  int file_, line_ = 0;
  ToolpathBuilder builder_;
};

class CompareTest : public ::testing::Test {
 protected:
  CompareTest() {
    files_.Add("new.nc");
    files_.Add("old.nc");
  }
  static Path Old() { return Path(1); }
  static Path New() { return Path(0); }
  Comparison Hold(Path old, Path tested) const {
    return Compare(old.Take(), tested.Take(), {}, files_);
  }
  /// "rule@line" of each finding.
  static std::vector<std::string> Rules(const Comparison& comparison) {
    std::vector<std::string> rules;
    for (const Finding& finding : comparison.findings) {
      rules.push_back(std::string(Info(finding.rule).id) + "@" +
                      std::to_string(finding.where.line));
    }
    return rules;
  }
  SourceFiles files_;
};

using ::testing::ElementsAre;

TEST_F(CompareTest, AHelixIsItsTurnsAndItsChords) {
  const auto start = [](Path path) { return path.Rapid(At(10, 0, 0)); };
  Path turns = start(New());
  for (int i = 0; i < 6; ++i) turns.Arc(kPi, -1.0);
  EXPECT_THAT(Rules(Hold(start(Old()).Arc(6.0 * kPi, -6.0), turns)), IsEmpty());
  const Comparison flat = Hold(start(Old()).Arc(2.0 * kPi, -2.0).Feed(At(20, 0, -2)),
                               start(New()).Arc(2.0 * kPi, 0.0).Feed(At(20, 0, -2)));
  EXPECT_THAT(Rules(flat), ElementsAre("path-deviation@2"));
}

TEST_F(CompareTest, ALostPointIsNamedWithBothLines) {
  const Points all = {At(10, 0, 0), At(20, 3, 0), At(30, 0, 0), At(40, 0, 0)};
  const Comparison lost = Hold(Old().Rapid(At(0, 0, 0)).Feeds(all),
                               New().Rapid(At(0, 0, 0)).Feeds({all[0], all[2], all[3]}));
  ASSERT_THAT(Rules(lost), ElementsAre("path-deviation@3"));
  EXPECT_EQ(lost.findings[0].other->line, 3);
  EXPECT_THAT(lost.findings[0].message, HasSubstr("the tip goes 3.0"));
  EXPECT_THAT(lost.findings[0].message, HasSubstr("the point at the end of old.nc:3 is left out"));
}

TEST_F(CompareTest, FaultsWithGoodFeedBetweenAreTwoFindings) {
  Points right, wrong;
  for (int i = 1; i < 40; ++i) right.push_back(At(10.0 * i, 0, 0));
  wrong = right;
  wrong[9].p.y() = 0.5;
  wrong[29].p.z() = -0.25;
  const Comparison held =
      Hold(Old().Rapid(At(0, 0, 0)).Feeds(right), New().Rapid(At(0, 0, 0)).Feeds(wrong));
  EXPECT_THAT(Rules(held), ElementsAre("path-deviation@11", "path-deviation@31"));
}

TEST_F(CompareTest, WhatIsOffUntilTheEndIsOneFinding) {
  Path old = Old(), tested = New();
  for (int pass = 0; pass < 10; ++pass) {
    const double shift = pass < 4 ? 0.0 : 0.1;
    old.Rapid(At(0, pass, 5)).Feed(At(0, pass, 0)).Feed(At(50, pass, 0));
    tested.Rapid(At(0, pass + shift, 5)).Feed(At(0, pass + shift, 0)).Feed(At(50, pass + shift, 0));
  }
  const Comparison held = Hold(old, tested);
  ASSERT_THAT(Rules(held), ElementsAre("path-deviation@13"));
  EXPECT_THAT(held.findings[0].message, HasSubstr("the tip goes 0.100 mm away"));
}

TEST_F(CompareTest, LostExtraAndMovedRuns) {
  const auto pass = [](Path& path, double y) {
    path.Rapid(At(0, y, 5)).Feed(At(0, y, 0)).Feed(At(50, y, 0));
  };
  const auto passes = [&](Path path, const std::vector<double>& ys) {
    for (const double y : ys) pass(path, y);
    return path;
  };
  const Path old = passes(Old(), {0, 1, 2, 3, 4, 5});
  EXPECT_THAT(Rules(Hold(old, passes(New(), {0, 1, 3, 4, 5}))), ElementsAre("feed-lost@6"));
  EXPECT_THAT(Rules(Hold(old, passes(New(), {0, 1, 2, 2.5, 3, 4, 5}))),
              ElementsAre("feed-extra@11"));
  EXPECT_THAT(Rules(Hold(old, passes(New(), {0, 1, 4, 2, 3, 5}))), ElementsAre("feed-order@8"));
}

TEST_F(CompareTest, ARapidInTheMiddleOfAFeedIsNoFeed) {
  const Path old = Old().Rapid(At(0, 0, 0)).Feeds({At(10, 0, 0), At(20, 0, 0), At(30, 0, 0)});
  const Path rapid =
      New().Rapid(At(0, 0, 0)).Feed(At(10, 0, 0)).Rapid(At(20, 0, 0)).Feed(At(30, 0, 0));
  EXPECT_THAT(Rules(Hold(old, rapid)), ElementsAre("feed-lost@3"));
  EXPECT_THAT(Rules(Hold(rapid, old)), ElementsAre("feed-extra@3"));
}

TEST_F(CompareTest, FeedRates) {
  const auto path = [](Path start, double feed) {
    return start.Rapid(At(0, 0, 0)).Feed(At(10, 0, 0), 10.0).Feed(At(20, 0, 0), feed);
  };
  EXPECT_THAT(Rules(Hold(path(Old(), 20.0), path(New(), 20.19))), IsEmpty());
  EXPECT_THAT(Rules(Hold(path(Old(), 20.0), path(New(), 20.21))), ElementsAre("feed-rate@3"));
  // 0.5 mm/min is half of the last digit of F.
  EXPECT_THAT(Rules(Hold(path(Old(), 0.1), path(New(), 0.108))), IsEmpty());
  const Comparison inch = Hold(path(Old(), 20.0), path(New(), 20.0 * 25.4));
  ASSERT_THAT(Rules(inch), ElementsAre("feed-rate@3"));
  EXPECT_THAT(inch.findings[0].message, HasSubstr("mm for inch"));
}

// Out along the tool axis at the feed or in rapid, turn, and back to the same place.
TEST_F(CompareTest, ARewindIsAdded) {
  const Path old = Old().Rapid(At(0, 0, 0, 30)).Feeds({At(10, 0, 0, 30), At(20, 0, 0, 30)});
  const Pose at = At(10, 0, 0, 30), out{at.p + 40.0 * at.u, at.u};
  Pose turned = out;
  turned.u.x() = -turned.u.x();
  const Path rapid = New()
                         .Rapid(At(0, 0, 0, 30))
                         .Feed(at)
                         .Rapid(out)
                         .Rapid(turned)
                         .Rapid(out)
                         .Rapid(at)
                         .Feed(At(20, 0, 0, 30));
  const Path feed = New()
                        .Rapid(At(0, 0, 0, 30))
                        .Feed(at)
                        .Feed(out)
                        .Rapid(turned)
                        .Rapid(out)
                        .Feed(at)
                        .Feed(At(20, 0, 0, 30));
  for (const Path& tested : {rapid, feed}) {
    const Comparison held = Hold(old, tested);
    EXPECT_THAT(Rules(held), IsEmpty());
    EXPECT_FALSE(held.added.empty());
  }
  // A way into the part and back is none.
  const Pose in{at.p - 5.0 * at.u, at.u};
  EXPECT_THAT(
      Rules(Hold(old,
                 New().Rapid(At(0, 0, 0, 30)).Feed(at).Feed(in).Feed(at).Feed(At(20, 0, 0, 30)))),
      ElementsAre("feed-extra@3"));
}

// Each run of the old program is two of the new one, which comes back with a feed.
TEST_F(CompareTest, ARewindInEachRun) {
  const auto old = [] {
    Path path = Old();
    for (const double y : {0.0, 50.0}) {
      path.Rapid(At(0, y, 40)).Rapid(At(0, y, 0)).Feed(At(10, y, 0)).Feed(At(20, y, 0));
    }
    // Behind them a feed that rounding leaves out.
    return path.Rapid(At(20, 50, 40)).Feed(At(20, 50, 40.002));
  };
  Path tested = New();
  for (const double y : {0.0, 50.0}) {
    tested.Rapid(At(0, y, 40)).Rapid(At(0, y, 0)).Feed(At(10, y, 0)).Rapid(At(10, y, 40));
    tested.Rapid(At(0, 0, 200)).Rapid(At(10, y, 40)).Feed(At(10, y, 0)).Feed(At(20, y, 0));
  }
  const Comparison held = Hold(old(), tested.Rapid(At(20, 50, 40)));
  EXPECT_THAT(Rules(held), IsEmpty());
  EXPECT_EQ(held.runs, 2u);
  EXPECT_FALSE(held.added.empty());
}

TEST_F(CompareTest, AFeedThatIsShorterThanTheToleranceMayFallAway) {
  const auto path = [](Path start, double z) {
    start.Rapid(At(0, 0, 5)).Feed(At(9, 0, 5)).Rapid(At(20, 0, 5));
    if (z > 0.0) start.Feed(At(20, 0, 5.0 - z));
    return start.Rapid(At(40, 0, 5)).Feed(At(50, 0, 5));
  };
  EXPECT_THAT(Rules(Hold(path(Old(), 0.002), path(New(), 0.0))), IsEmpty());
  EXPECT_THAT(Rules(Hold(path(Old(), 0.0), path(New(), 0.002))), IsEmpty());
  EXPECT_THAT(Rules(Hold(path(Old(), 0.02), path(New(), 0.0))), ElementsAre("feed-lost@2"));
}

// The tolerance lies between what the one and the other, rounded, has of it.
TEST_F(CompareTest, AFeedAboutAsShortAsTheToleranceIsFoundInBoth) {
  const double tolerance = Tolerances().position;
  const auto path = [](Path start, double x, double z, int times = 1) {
    start.Rapid(At(0, 0, 5)).Feed(At(9, 0, 5));
    for (int i = 0; i < times; ++i) start.Rapid(At(x, i, 5)).Feed(At(x, i, 5.0 - z));
    return start.Rapid(At(40, 0, 5)).Feed(At(50, 0, 5));
  };
  const double less = 0.9 * tolerance, more = 1.4 * tolerance;
  EXPECT_THAT(Rules(Hold(path(Old(), 20, less), path(New(), 20, more))), IsEmpty());
  EXPECT_THAT(Rules(Hold(path(Old(), 20, more), path(New(), 20, less))), IsEmpty());
  EXPECT_THAT(Rules(Hold(path(Old(), 20, less), path(New(), 21, more))),
              ElementsAre("feed-extra@4"));
  EXPECT_THAT(Rules(Hold(path(Old(), 20, more), path(New(), 21, less))),
              ElementsAre("feed-lost@2"));
  EXPECT_THAT(Rules(Hold(path(Old(), 20, less), path(New(), 20, 2.2 * tolerance))),
              ElementsAre("feed-extra@4"));
  EXPECT_THAT(Rules(Hold(path(Old(), 20, less), path(New(), 20, more, 2))),
              ElementsAre("feed-extra@6"));
}

// Way by time: of a short block the ends are rounded.
TEST_F(CompareTest, AFeedThatATimeTellsIsAsExactAsItsEnds) {
  const auto path = [](Path start, double feed, double slack) {
    return start.Rapid(At(0, 0, 0)).Feed(At(0.1, 0, 0), feed, slack);
  };
  EXPECT_THAT(Rules(Hold(path(Old(), 10.0, 0.0), path(New(), 10.2, 0.2))), IsEmpty());
  EXPECT_THAT(Rules(Hold(path(Old(), 10.0, 0.0), path(New(), 10.2, 0.0))),
              ElementsAre("feed-rate@2"));
}

TEST_F(CompareTest, APathWithoutFeedsIsEqualToItself) {
  EXPECT_THAT(Rules(Hold(Old().Rapid(At(1, 2, 3)), New().Rapid(At(4, 5, 6)))), IsEmpty());
  EXPECT_THAT(Rules(Hold(Old().Rapid(At(1, 2, 3)).Feed(At(1, 2, 0)), New())),
              ElementsAre("feed-lost@0"));
}

/// Random feeds, split anywhere and rounded to 0.001 mm, are the same; a point that is displaced is
/// found, with what it is off.
TEST_F(CompareTest, RandomPathsSplitAndRounded) {
  Random random(5);
  for (int run = 0; run < 60; ++run) {
    Points points = {At(0, 0, 0)};
    for (int i = 0; i < 40; ++i) {
      Pose next = points.back();
      next.p += random.InBox(random.Chance(0.3) ? 0.2 : 20.0);
      next.u = (next.u + random.InBox(random.Chance(0.5) ? 0.0 : 0.1)).normalized();
      points.push_back(next);
    }
    const auto rounded = [](Pose pose) {
      pose.p = (pose.p * 1000.0).array().round() / 1000.0;
      return pose;
    };
    const int wrong = random.Below(38) + 2;
    const double by = random.Uniform(0.01, 1.0);
    // Square to both feeds that meet there, and short against them: the corner is by so much off.
    const Eigen::Vector3d before = points[wrong].p - points[wrong - 1].p;
    const Eigen::Vector3d behind =
        points[wrong + 1 > 40 ? wrong - 1 : wrong + 1].p - points[wrong].p;
    Path old = Old(), split = New(), displaced = New();
    old.Rapid(points[0]);
    split.Rapid(points[0]);
    displaced.Rapid(points[0]);
    for (int i = 1; i <= 40; ++i) {
      old.Feed(points[i]);
      for (int k = random.Below(4); k > 0; --k) {
        split.Feed(rounded(Lerp(points[i - 1], points[i], 1.0 / (k + 1.5))));
      }
      split.Feed(rounded(points[i]));
      Pose end = points[i];
      if (i == wrong) end.p += by * before.cross(behind).normalized();
      displaced.Feed(end);
    }
    EXPECT_THAT(Rules(Hold(old, split)), IsEmpty()) << run;
    const Comparison held = Hold(old, displaced);
    if (before.cross(behind).norm() < 1e-3) continue;
    ASSERT_EQ(held.findings.size(), 1U) << run;
    EXPECT_EQ(held.findings[0].where.line, wrong + 1) << run;
    EXPECT_NEAR(held.position.value, by, 1e-3 * std::max(1.0, by)) << run;
  }
}

}  // namespace
}  // namespace ncsim::compare
