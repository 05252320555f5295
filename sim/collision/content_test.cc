// SPDX-License-Identifier: BSD-3-Clause
#include "sim/collision/content.h"

#include <gtest/gtest.h>

#include <functional>
#include <limits>
#include <set>

#include "sim/collision/test_rig.h"

namespace ncsim::collision {

namespace {

template <class Path>
using Changes = std::vector<std::function<void(Path*)>>;

Digest ContentOf(const Rig& rig, const motion::Motion& motion, double length = 150.0) {
  const motion::Travel run(rig.machine().tree, &*rig.machine().five_axis, length, {&motion});
  return ContentOf(run, PlaceOf(run, 5));
}

/// The digest of a path and of each of its changes: all of them differ.
template <class Path>
void ExpectEachCounts(const Path& path, const Changes<Path>& changes) {
  Rig rig;
  motion::Motion motion = rig.Feed(1, 2, 3);
  motion.path = path;
  std::set<Digest> seen{ContentOf(rig, motion)};
  for (std::size_t i = 0; i < changes.size(); ++i) {
    Path changed = path;
    changes[i](&changed);
    motion.path = changed;
    EXPECT_TRUE(seen.insert(ContentOf(rig, motion)).second) << "change " << i;
  }
}

motion::AxisArc Arc() {
  motion::AxisArc arc;
  arc.q0 = arc.q1 = motion::JointVector::Constant(5, 1.0);
  arc.e1 = Eigen::Vector3d::UnitX();
  arc.e2 = Eigen::Vector3d::UnitY();
  arc.centre = arc.pitch = arc.end_error = Eigen::Vector3d::Zero();
  arc.radius = 10.0;
  arc.sweep = 1.0;
  arc.linear = {0, 1, 2};
  return arc;
}

/// What arcs of either kind have.
template <class Path>
Changes<Path> ArcChanges() {
  return {[](auto* p) { p->q0[3] += 0.1; },        [](auto* p) { p->q1[3] += 0.1; },
          [](auto* p) { p->centre[1] += 0.1; },    [](auto* p) { p->e1[1] += 0.1; },
          [](auto* p) { p->e2[2] += 0.1; },        [](auto* p) { p->pitch[2] += 0.1; },
          [](auto* p) { p->end_error[0] += 0.1; }, [](auto* p) { p->radius += 0.1; },
          [](auto* p) { p->phi0 += 0.1; },         [](auto* p) { p->sweep += 0.1; }};
}

motion::TcpCurve Curve() {
  Rig rig;
  return std::get<motion::TcpCurve>(rig.Tcp({0, 0, 0}, {10, 0, 0}, 0, 0, 20, 30).path);
}

}  // namespace

TEST(ContentTest, EveryMemberOfAPathCounts) {
  ExpectEachCounts<motion::AxisLinear>(
      {motion::JointVector::Zero(5), motion::JointVector::Ones(5)},
      {[](auto* p) { p->q0[4] += 0.1; }, [](auto* p) { p->q1[4] += 0.1; }});
  Rig rig;
  rig.Start(0, 0, 0);
  ExpectEachCounts<motion::DogLeg>(
      std::get<motion::DogLeg>(rig.DogLeg(10, 20, 30).path),
      {[](auto* p) { p->q0[0] += 0.1; }, [](auto* p) { p->q1[0] += 0.1; },
       [](auto* p) { p->duration[1] += 0.1; }, [](auto* p) { p->ramp[1] += 0.1; }});
  Changes<motion::AxisArc> changes = ArcChanges<motion::AxisArc>();
  changes.emplace_back([](auto* p) { p->linear = {1, 0, 2}; });
  ExpectEachCounts<motion::AxisArc>(Arc(), changes);
}

TEST(ContentTest, EveryMemberOfATcpCurveCounts) {
  const auto frame = [](const std::function<void(motion::TcpFrame*)>& change) {
    return [change](motion::TcpCurve* p) {
      motion::TcpFrame changed = *p->frame;
      change(&changed);
      p->frame = std::make_shared<const motion::TcpFrame>(changed);
    };
  };
  const auto other = kinematics::TrunnionBC({1, 0, 0}, {0, 0, 0});
  const Changes<motion::TcpCurve> of_both{
      frame([](auto* f) { f->length += 0.1; }), frame([](auto* f) { f->centre_error += 0.1; }),
      frame([&](auto* f) {
        f->control = *kinematics::FiveAxis::Make(other.tree, other.spindle_link, other.table_link);
      })};
  Changes<motion::TcpCurve> of_line = of_both;
  of_line.insert(of_line.end(),
                 {[](auto* p) { p->q0[3] += 0.1; }, [](auto* p) { p->q1[3] += 0.1; },
                  [](auto* p) { p->p0_B[0] += 0.1; }, [](auto* p) { p->p1_B[0] += 0.1; }});
  ExpectEachCounts<motion::TcpCurve>(Curve(), of_line);

  motion::TcpCurve arc = Curve();
  arc.arc = true;
  arc.e1 = Eigen::Vector3d::UnitX();
  arc.e2 = Eigen::Vector3d::UnitY();
  arc.radius = 10.0;
  arc.sweep = 1.0;
  Changes<motion::TcpCurve> of_arc = ArcChanges<motion::TcpCurve>();
  of_arc.insert(of_arc.end(), of_both.begin(), of_both.end());
  of_arc.emplace_back([](auto* p) { p->arc = false; });
  ExpectEachCounts<motion::TcpCurve>(arc, of_arc);
}

// What a control leaves unset in a line is not looked at, nor where a frame lies in memory.
TEST(ContentTest, WhatALineDoesNotHaveDoesNotCount) {
  Rig rig;
  motion::Motion motion = rig.Feed(1, 2, 3);
  motion::TcpCurve line = Curve();
  motion.path = line;
  const Digest content = ContentOf(rig, motion);
  line.centre = line.e1 = Eigen::Vector3d::Constant(std::numeric_limits<double>::quiet_NaN());
  line.radius = 7.0;
  line.frame = std::make_shared<const motion::TcpFrame>(*line.frame);
  motion.path = line;
  EXPECT_EQ(ContentOf(rig, motion), content);
}

TEST(ContentTest, SoDoKindAndFactsAndTheTool) {
  Rig rig;
  const motion::Motion motion = rig.Feed(1, 2, 3);
  std::set<Digest> seen{ContentOf(rig, motion), ContentOf(rig, motion, 151.0)};
  const Changes<motion::Motion> changes{[](auto* m) { m->kind = motion::MotionKind::kRapid; },
                                        [](auto* m) { m->facts.spindle_on = false; },
                                        [](auto* m) { m->facts.cycle = 3; },
                                        [](auto* m) { m->facts.corner_rounding = 0.1; },
                                        [](auto* m) { m->facts.orientation_tolerance = 0.1; }};
  for (const auto& change : changes) {
    motion::Motion changed = motion;
    change(&changed);
    seen.insert(ContentOf(rig, changed));
  }
  EXPECT_EQ(seen.size(), 7u);
}

}  // namespace ncsim::collision
