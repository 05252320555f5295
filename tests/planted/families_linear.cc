// SPDX-License-Identifier: BSD-3-Clause
// Moves of the linear axes, the table at rest: the clearance of convex bodies is a convex function
// of the way, so its least is exact.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "tests/planted/families.h"

namespace ncsim::planted {

namespace {

using Eigen::Vector3d;
using machine::BodyKind;

struct Program {
  std::vector<Vector3d> tips;  // in G
  std::vector<Course> Courses() const {
    std::vector<Course> courses;
    for (std::size_t i = 0; i + 1 < tips.size(); ++i) {
      courses.push_back(Straight(tips[i], tips[i + 1], static_cast<int>(i)));
    }
    return courses;
  }
};

Case Make(const Upright& place, const Cutter& cutter, const Program& program,
          machine::BodyKind body, motion::MotionKind kind) {
  Case c(place.table);
  c.SetTool(cutter, body);
  place.Start(&c, program.tips.front());
  for (std::size_t i = 1; i < program.tips.size(); ++i) place.Go(&c, kind, program.tips[i]);
  return c;
}

Case Make(const Upright& place, const Cutter& cutter, const Program& program, Random* random) {
  const BodyKind body = RandomKind(random);
  return Make(place, cutter, program, body, RandomMotion(random));
}

/// Tunes the body to the target and puts it into the case.
bool Plant(const Upright& place, const Program& program, const Solid& solid, const Vector3d& away,
           double target, Case* c) {
  const std::vector<Course> courses = program.Courses();
  const auto offset = Tune(c->cutter, courses, solid, away, target);
  if (offset.has_value()) c->AddBody(solid, place.InTable(), *offset, courses);
  return offset.has_value();
}

Vector3d Horizontal(double angle) { return {std::cos(angle), std::sin(angle), 0.0}; }

/// A block or a regular prism about the origin of G, top at z = 0.
Solid RandomPost(Random* random, double size, double height) {
  if (random->Chance(0.5)) {
    const double x = size * random->Uniform(0.4, 1.0);
    return Block({-x, -size, -height}, {x, size, 0.0});
  }
  const int sides = 3 + random->Below(46);
  return PrismSolid(RegularBase(sides, size, random->Uniform(0.0, 6.0)), -height, 0.0);
}

Case MakeToolChange(const Upright& place, const Cutter& cutter, const Solid& solid,
                    bool shape_clear, const Vector3d& tip) {
  Case c(place.table);
  // Before: a short stump at the gauge line, far above everything.
  c.SetTool({120.0, 150.0, 10.0, 0.0, false}, BodyKind::kHolder, Case::kTool);
  place.Start(&c, tip + Vector3d(0, 0, 1.0));
  place.Go(&c, motion::MotionKind::kRapid, tip);
  c.SetTool(cutter, BodyKind::kFlutes, Case::kTool + 1);
  const Vector3d aside = tip + Vector3d(0, 0, shape_clear ? 0.5 : 0.1);
  place.Go(&c, motion::MotionKind::kToolChange, tip);
  place.Go(&c, motion::MotionKind::kFeed, aside);
  c.AddBody(solid, place.InTable(), Vector3d::Zero(),
            {Straight(tip, tip, 1), Straight(tip, aside, 2)});
  return c;
}

/// A cavity or pocket around all that the tool takes up, `gap` away on one side, further on the
/// others.
Solid Around(Random* random, const Cutter& cutter, const Program& program, double gap, bool open) {
  Vector3d lower = program.tips.front();
  Vector3d upper = lower;
  for (const Vector3d& tip : program.tips) {
    lower = lower.cwiseMin(tip);
    upper = upper.cwiseMax(tip);
  }
  lower += Vector3d(-cutter.radius, -cutter.radius, cutter.z0);
  upper += Vector3d(cutter.radius, cutter.radius, cutter.z1);
  const int side = random->Below(open ? 5 : 6);  // the last is the lid
  constexpr int kAxis[] = {0, 0, 1, 1, 2, 2};
  constexpr bool kUpper[] = {false, true, false, true, false, true};
  for (int i = 0; i < 6; ++i) {
    const double g = i == side ? gap : random->Uniform(2.5, 6.0);
    (kUpper[i] ? upper[kAxis[i]] += g : lower[kAxis[i]] -= g);
  }
  const double wall = LogUniform(random, 0.05, 30.0);
  const Vector3d walls = Vector3d::Constant(wall);
  Vector3d top = upper + walls;
  if (open) top.z() = lower.z() + random->Uniform(0.2, 0.8) * (upper.z() - lower.z());
  return PocketBlock(lower - walls, top, lower, upper);
}

}  // namespace

std::optional<Case> ThinWall(Random* random, bool hit) {
  const Upright place(random);
  const Cutter cutter = RandomCutter(random, 0.5, 8.0);
  const double thick = LogUniform(random, 0.05, 0.5);
  const double half = random->Uniform(10.0, 40.0);
  const double height = random->Uniform(10.0, 40.0);
  const Solid wall = Block({0, -half, -height}, {thick, half, 0});
  Program program;
  const double before = random->Uniform(20.0, 120.0);
  const double after = random->Uniform(10.0, 120.0);
  const bool beside = random->Chance(0.4);
  const double z = beside ? -random->Uniform(2.0, height) : 0.0;
  const double y = beside ? half + cutter.radius : random->Uniform(-half, half);
  const Vector3d slope(0, random->Uniform(-3.0, 3.0), random->Uniform(-1.0, 1.0));
  program.tips = {Vector3d(-before, y, z) - slope, Vector3d(after, y, z) + slope};
  Case c = Make(place, cutter, program, random);
  if (hit && random->Chance(0.5)) {  // right through
    const Vector3d up(0, 0, random->Uniform(1.0, height));
    const Vector3d across(0, beside ? cutter.radius + random->Uniform(0.0, half) : 0.0, 0);
    c.AddBody(wall, place.InTable(), up + across, program.Courses());
    return c.pairs[0].clearance.upper < 0.0 ? std::optional(c) : std::nullopt;
  }
  const Vector3d away = beside ? Vector3d(0, -1, 0) : Vector3d(0, 0, -1);
  const double target = RandomTarget(random, hit, std::min(1.0, 0.5 * cutter.radius));
  if (!Plant(place, program, wall, away, target, &c)) return std::nullopt;
  return c;
}

std::optional<Case> PinThroughSlot(Random* random, bool hit) {
  const Upright place(random);
  const Cutter cutter = RandomCutter(random, 1.0, 8.0);
  const double length = random->Uniform(15.0, 80.0);
  Program program;
  const double skew = random->Uniform(-0.5, 0.5);
  program.tips = {Vector3d(-length, -skew, -4.0),
                  Vector3d(length, skew, random->Uniform(-6.0, -3.0))};
  Case c = Make(place, cutter, program, random);
  const int hit_side = random->Below(3);  // one jaw, the other, both
  for (int side = 0; side < 2; ++side) {
    const bool this_hit = hit && hit_side != side;
    const double target = RandomTarget(random, this_hit, 0.4 * cutter.radius);
    Solid jaw;
    if (random->Chance(0.7)) {
      const double x = random->Uniform(3.0, 0.7 * length);
      const double y = LogUniform(random, 0.1, 20.0);
      jaw = Block({-x, -y, -25.0}, {x, y, random->Uniform(0.0, 10.0)});
    } else {
      jaw = PrismSolid(
          RegularBase(3 + random->Below(22), random->Uniform(1.0, 12.0), random->Uniform(0.0, 6.0)),
          -25.0, 2.0);
    }
    // From beyond the pin, so that it comes to it from its own side.
    const double out = side == 0 ? -1.0 : 1.0;
    const Vector3d start(0, out * (cutter.radius + 14.0), 0);
    for (Part& part : jaw.parts) {
      for (Eigen::Vector2d& p : std::get<Prism>(part).base) p += start.head<2>();
    }
    for (Vector3d& v : jaw.mesh.vertices) v += start;
    if (!Plant(place, program, jaw, {0, out, 0}, target, &c)) return std::nullopt;
  }
  return c;
}

std::optional<Case> Grazing(Random* random, bool hit) {
  const Upright place(random);
  Cutter cutter = RandomCutter(random, 0.5, 6.0);
  const double sign = hit ? -1.0 : 1.0;
  const double target = random->Chance(0.6) ? 0.03 * sign
                                            : (hit ? -LogUniform(random, 0.001, 0.03)
                                                   : random->Uniform(0.0205, 0.05));
  const int contact = random->Below(5);
  const double turn = random->Uniform(-3.0, 3.0);
  const double reach = random->Uniform(10.0, 80.0);
  Solid solid = RandomPost(random, random->Uniform(1.0, 10.0), random->Uniform(20.0, 60.0));
  Program program;
  Vector3d away(0, 0, -1);
  if (contact == 0 || contact == 4) {  // the flank along a side or past an edge
    const Vector3d along = reach * Horizontal(turn);
    const Vector3d below(0, 0, -random->Uniform(3.0, 15.0));
    away = Horizontal(turn + 0.5 * std::numbers::pi);
    program.tips = {below - along, below + along};
    if (contact == 4) {  // exactly in a side's plane
      solid = Block({-7, -3, -30}, {7, 3, 0});
      away = Vector3d(0, 1, 0);
      program.tips = {below - Vector3d(reach, 0, 0), below + Vector3d(reach, 0, 0)};
    }
  } else if (contact == 1) {  // the nose over the top, dipping
    const Vector3d along = reach * Horizontal(turn);
    const double dip = random->Uniform(0.0, 5.0);
    program.tips = {Vector3d(0, 0, dip) - along, Vector3d::Zero(), Vector3d(0, 0, dip) + along};
  } else if (contact == 2) {  // a plunge that ends there
    program.tips = {Vector3d(0, 0, reach), Vector3d::Zero()};
  } else {  // a corner of the nose past an edge or a corner
    const Vector3d along = reach * Horizontal(turn);
    away = (Horizontal(turn + 0.5 * std::numbers::pi) * random->Uniform(0.3, 1.0) -
            Vector3d(0, 0, random->Uniform(0.3, 1.0)))
               .normalized();
    program.tips = {-along, along};
  }
  if (random->Chance(0.2)) {  // a ball past a faceted ball
    cutter = {0.0, 2.0 * cutter.radius, cutter.radius, cutter.radius, true};
    solid = FacetedSphere(random->Uniform(1.0, 10.0), 4 + random->Below(6));
    away = random->Direction();
    const Vector3d along = away.cross(random->Direction()).normalized() * reach;
    const Vector3d middle(0, 0, -cutter.radius);
    program.tips = {middle - along, middle + along};
  }
  Case c = Make(place, cutter, program, random);
  if (!Plant(place, program, solid, away, target, &c)) return std::nullopt;
  return c;
}

std::optional<Case> Contained(Random* random, bool hit) {
  const Upright place(random);
  const Vector3d move = random->Uniform(0.2, 3.0) * random->Direction();
  const Vector3d size(random->Uniform(30, 80), random->Uniform(30, 80), random->Uniform(30, 80));
  const int kind = random->Below(4);
  Cutter cutter = RandomCutter(random, 0.5, 6.0);
  cutter.z1 = random->Uniform(2.0, 4.0) * cutter.radius;
  Program program;
  program.tips = {Vector3d::Zero(), move};
  if (kind == 0) {  // the tool in a block, or beside it
    Case c = Make(place, cutter, program, random);
    Vector3d offset(0, 0, cutter.Middle());
    if (!hit) offset.x() += size.x() + cutter.radius + 4.0 + random->Uniform(0.0, 2.0);
    c.AddBody(Block(-size, size), place.InTable(), offset, program.Courses());
    return c;
  }
  if (kind == 1) {  // a body in the tool, or just under it
    cutter = {0.0, random->Uniform(50, 80), random->Uniform(15, 30), 0.0, false};
    Case c = Make(place, cutter, program, random);
    const double post = random->Uniform(0.1, 3.0);
    const Vector3d inside(random->Uniform(-6, 6), random->Uniform(-6, 6), random->Uniform(10, 45));
    const Vector3d below(0, 0, std::min(0.0, move.z()) - random->Uniform(0.03, 1.0));
    c.AddBody(RandomPost(random, post, post), place.InTable(), hit ? inside : below,
              program.Courses());
    return c;
  }
  if (kind == 2) {  // a tool change: the new tool is in the block, or in a cavity of it
    Program still;
    still.tips = {Vector3d::Zero(), Vector3d(0, 0, 0.5)};
    const Solid solid = hit ? Block({-20, -20, -15}, {20, 20, 60})
                            : Around(random, cutter, still, random->Uniform(0.03, 2.0), false);
    return MakeToolChange(place, cutter, solid, !hit, Vector3d::Zero());
  }
  // In a cavity: not touched, or nearly; or through its wall.
  Case c = Make(place, cutter, program, random);
  const double gap = RandomTarget(random, hit, 0.4 * cutter.radius);
  c.AddBody(Around(random, cutter, program, gap, false), place.InTable(), Vector3d::Zero(),
            program.Courses());
  return c;
}

std::optional<Case> LongRapid(Random* random, bool hit) {
  const Upright place(random);
  const Cutter cutter = RandomCutter(random, 0.5, 8.0);
  Vector3d direction = random->Direction();
  direction.z() *= 0.3;
  direction.normalize();
  const double length = random->Uniform(500.0, 1500.0);
  const double at = random->Uniform(0.02, 0.98);
  Program program;
  program.tips = {-at * length * direction, (1.0 - at) * length * direction};
  Case c = Make(place, cutter, program, RandomKind(random), motion::MotionKind::kRapid);
  const double size = LogUniform(random, 0.05, 3.0);
  const Vector3d side(-direction.y(), direction.x(), 0.0);
  Vector3d away =
      side.normalized() * random->Uniform(-1.0, 1.0) - Vector3d(0, 0, random->Uniform(0.0, 1.0));
  away = (away - away.dot(direction) * direction).normalized();
  const double deepest = std::min(1.0, 0.4 * cutter.radius);
  if (!Plant(place, program, RandomPost(random, size, size), away,
             RandomTarget(random, hit, deepest), &c)) {
    return std::nullopt;
  }
  return c;
}

std::optional<Case> HolderInPocket(Random* random, bool hit) {
  const Upright place(random);
  Cutter holder{random->Uniform(20.0, 60.0), 0.0, random->Uniform(6.0, 20.0), 0.0, false};
  holder.z1 = holder.z0 + random->Uniform(30.0, 80.0);
  if (random->Chance(0.3)) holder.corner = random->Uniform(0.5, 5.0);
  const double across = random->Uniform(-30.0, 30.0);
  Program program;
  program.tips = {Vector3d(0, 0, 90),      Vector3d::Zero(),         Vector3d(20, 0, 0),
                  Vector3d(20, across, 2), Vector3d(3, across, 2.5), Vector3d(3, across, 90)};
  Case c = Make(place, holder, program, BodyKind::kHolder, RandomMotion(random));
  Program inside;
  inside.tips.assign(program.tips.begin() + 1, program.tips.end() - 1);
  const double gap = RandomTarget(random, hit, 2.0);
  c.AddBody(Around(random, holder, inside, gap, true), place.InTable(), Vector3d::Zero(),
            program.Courses());
  return c;
}

}  // namespace ncsim::planted
