// SPDX-License-Identifier: BSD-3-Clause
// The arithmetic of wide_bounds.h for any number of lanes. Every lane is IEEE single precision,
// operation by operation, so all widths give the same bytes.
#pragma once

#include "sim/collision/wide_bounds.h"

namespace ncsim::collision {
namespace {  // each includer compiles its own, for its own processor

template <int N>
struct Lanes {
  typedef float Float __attribute__((vector_size(N * sizeof(float))));
  typedef int Mask __attribute__((vector_size(N * sizeof(int))));
};

// Of each operation; the longest chain of them, from coordinates to a bound, has less than 40.
constexpr float kUnit = 6e-8F;
constexpr float kChain = 40.0F * kUnit;
// mm. A bound of a triangle so close to the truth is not worth another step.
constexpr float kNear = 1e-3F;
constexpr float kFar = 1e30F;
constexpr float kThird = 1.0F / 3.0F;

template <int N>
class WideKernel {
 public:
  using Float = typename Lanes<N>::Float;
  using Mask = typename Lanes<N>::Mask;

  static WideNear Boxes(const WideBoxes& boxes, const WideSolid& solid, float enough,
                        float* lower) {
    return Moves(solid) ? BoundAll<Box<4>>(boxes, solid, enough, lower)
                        : BoundAll<Box<3>>(boxes, solid, enough, lower);
  }

  static WideNear Triangles(const WideTriangles& triangles, const WideSolid& solid, float enough,
                            float* lower) {
    return Moves(solid) ? BoundAll<Triangle<true>>(triangles, solid, enough, lower)
                        : BoundAll<Triangle<false>>(triangles, solid, enough, lower);
  }

 private:
  struct Vector {
    Float x, y, z;
  };
  // A point in the solid's half plane, and the direction from the axis to it (0 on the axis); given
  // from the solid's origin.
  struct Place {
    Place() {}
    Place(const Vector& v, const Float& spread, const WideSolid& solid) {
      z = Along(v, solid);
      Vector a = Across(v, z, solid);
      // Again: what rounding left along the axis may be much of a short vector.
      a = Across(a, Along(a, solid), solid);
      const Float length = Root(Dot(a, a));
      const Mask off_axis = length > 1e-6F;
      const Float zero = length - length;
      const Float inverse = off_axis ? 1.0F / length : zero;
      r = off_axis ? length : zero;
      radial = {a.x * inverse, a.y * inverse, a.z * inverse};
      error = (SumOfSizes(v) + spread + solid.reach) * kChain + solid.rounding;
    }
    Float z, r, error;
    Vector radial;
  };
  static bool Moves(const WideSolid& solid) {
    return solid.half_way[0] != 0.0F || solid.half_way[1] != 0.0F || solid.half_way[2] != 0.0F;
  }
  // Where the solid goes by t half ways, a point p is to it as p - t half_way is to where it
  // stands: the way is one more half axis of each box, one more dimension of each triangle.
  static Vector HalfWay(const WideSolid& solid, const Float& zero) {
    return {zero + solid.half_way[0], zero + solid.half_way[1], zero + solid.half_way[2]};
  }
  // From the solid's origin; with what all of its parts need: how far it spreads, and its middle.
  template <int kAxes>
  struct Box {
    Box(const WideBoxes& boxes, int i, const WideSolid& solid)
        : centre(FromOrigin(LoadVector(boxes.centre, i), solid)) {
      for (int k = 0; k < 3; ++k) half[k] = LoadVector(boxes.half[k], i);
      if constexpr (kAxes == 4) half[3] = HalfWay(solid, centre.x - centre.x);
      spread = SumOfSizes(half[0]);
      for (int k = 1; k < kAxes; ++k) spread = spread + SumOfSizes(half[k]);
      middle = Place(centre, spread, solid);
    }
    Vector centre, half[kAxes];
    Float spread;
    Place middle;
  };
  template <bool kMoves>
  struct Triangle {
    Triangle(const WideTriangles& triangles, int i, const WideSolid& solid) {
      const Vector a = LoadVector(triangles.corner[0], i);
      corner = FromOrigin(a, solid);
      side[0] = Minus(LoadVector(triangles.corner[1], i), a);
      side[1] = Minus(LoadVector(triangles.corner[2], i), a);
      spread = SumOfSizes(side[0]) + SumOfSizes(side[1]);
      const Float zero = spread - spread;
      if constexpr (kMoves) {
        way = HalfWay(solid, zero);
        spread = spread + SumOfSizes(way);
      }
      middle = Place(At(zero + kThird, zero + kThird, zero), spread, solid);
    }
    Vector At(const Float& a, const Float& b, const Float& t) const {
      Vector p = {corner.x + a * side[0].x + b * side[1].x,
                  corner.y + a * side[0].y + b * side[1].y,
                  corner.z + a * side[0].z + b * side[1].z};
      if constexpr (kMoves) p = {p.x + t * way.x, p.y + t * way.y, p.z + t * way.z};
      return p;
    }
    Vector corner, side[2], way;
    Float spread;
    Place middle;
  };
  // Bounds as they come, and which of them are below `enough`.
  class Sorted {
   public:
    explicit Sorted(float enough) : enough_(enough) {}
    void Add(const Float& bound, int i, float* lower) {
      __builtin_memcpy(lower + i, &bound, sizeof(bound));
      const Mask near = ~(bound >= enough_);  // what is no number is not far
      near_.lanes |= Bits(near) << i;
      const Float none = bound - bound + kFar;
      const Float passed = near ? none : bound;
      for (int k = 0; k < N; ++k)
        near_.passed = passed[k] < near_.passed ? passed[k] : near_.passed;
    }
    const WideNear& Near() const { return near_; }

   private:
    float enough_;
    WideNear near_{0, kFar};
  };
  // A plane that supports a convex part, and how the distance bends there: along the profile, 0
  // beside a line.
  struct Plane {
    Float distance, normal_z, normal_r, curvature;
  };

  static Vector LoadVector(const float (&v)[3][kWide], int i) {
    return {*reinterpret_cast<const Float*>(v[0] + i), *reinterpret_cast<const Float*>(v[1] + i),
            *reinterpret_cast<const Float*>(v[2] + i)};
  }
  static Float Size(const Float& a) { return Most(a, -a); }
  static Float SumOfSizes(const Vector& v) { return Size(v.x) + Size(v.y) + Size(v.z); }
  static Float Least(const Float& a, const Float& b) { return a < b ? a : b; }
  static Float Most(const Float& a, const Float& b) { return b > a ? b : a; }
  // A bit for each lane that is true.
  static int Bits(const Mask& mask) {
#ifdef __SSE2__
    if constexpr (N == 4) return __builtin_ia32_movmskps(reinterpret_cast<const Float&>(mask));
#endif
#ifdef __AVX__
    if constexpr (N == 8) return __builtin_ia32_movmskps256(reinterpret_cast<const Float&>(mask));
#endif
    int bits = 0;
    for (int k = 0; k < N; ++k) bits |= mask[k] & (1 << k);
    return bits;
  }
  static bool Any(const Mask& mask) { return Bits(mask) != 0; }
  static Vector FromOrigin(const Vector& p, const WideSolid& solid) {
    return {p.x - solid.origin[0], p.y - solid.origin[1], p.z - solid.origin[2]};
  }
  static Vector Minus(const Vector& a, const Vector& b) {
    return {a.x - b.x, a.y - b.y, a.z - b.z};
  }
  static Float Dot(const Vector& a, const Vector& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
  static Float Along(const Vector& v, const WideSolid& solid) {
    return v.x * solid.axis[0] + v.y * solid.axis[1] + v.z * solid.axis[2];
  }
  static Vector Across(const Vector& v, const Float& z, const WideSolid& solid) {
    return {v.x - z * solid.axis[0], v.y - z * solid.axis[1], v.z - z * solid.axis[2]};
  }
  static Float Root(const Float& a) {
    Float root;
    for (int k = 0; k < N; ++k) root[k] = __builtin_sqrtf(a[k]);
    return root;
  }

  // The supporting plane of a convex part that is furthest from the place.
  static Plane Furthest(const Place& place, const WidePart& part) {
    const Float zero = place.z - place.z;
    Plane best = {zero - 1e30F, zero, zero, zero};
    Float length = zero + 1.0F;  // of the normal
    for (int i = 0; i < part.line_count; ++i) {
      const WideLine& line = part.lines[i];
      const Float distance = place.z * line.normal_z + place.r * line.normal_r - line.offset;
      const Mask better = distance > best.distance;
      best.distance = better ? distance : best.distance;
      best.normal_z = better ? zero + line.normal_z : best.normal_z;
      best.normal_r = better ? zero + line.normal_r : best.normal_r;
    }
    Mask round_is_best = zero > 0.0F;
    for (int i = 0; i < part.round_count; ++i) {
      const WideRound& round = part.rounds[i];
      const Float z = place.z - round.z;
      const Float r = place.r - round.r;
      const Float norm = Root(z * z + r * r);
      const Float distance = norm - round.radius;
      const Mask better = (distance > best.distance) & (norm > 1e-6F) &
                          (round.from_r * z - round.from_z * r >= 0.0F) &
                          (r * round.to_z - z * round.to_r >= 0.0F);
      best.distance = better ? distance : best.distance;
      best.normal_z = better ? z : best.normal_z;
      best.normal_r = better ? r : best.normal_r;
      length = better ? norm : length;
      round_is_best = round_is_best | better;
    }
    const Float inverse = 1.0F / length;
    best.normal_z = best.normal_z * inverse;
    best.normal_r = best.normal_r * inverse;
    best.curvature = round_is_best ? inverse : zero;
    return best;
  }

  static Vector Slope(const Plane& plane, const Place& place, const WideSolid& solid) {
    return {plane.normal_z * solid.axis[0] + plane.normal_r * place.radial.x,
            plane.normal_z * solid.axis[1] + plane.normal_r * place.radial.y,
            plane.normal_z * solid.axis[2] + plane.normal_r * place.radial.z};
  }

  // Two planes: about the centre, and about the point of the box that is nearest to the foot of the
  // centre on the solid.
  template <int kAxes>
  static Float BoundPart(const Box<kAxes>& box, const WideSolid& solid, const WidePart& part,
                         float enough) {
    const Float zero = box.spread - box.spread;
    const Plane plane = Furthest(box.middle, part);
    const Vector g = Slope(plane, box.middle, solid);
    Float along[kAxes];
    Float sizes = zero;
    for (int k = 0; k < kAxes; ++k) {
      along[k] = Dot(g, box.half[k]);
      sizes = sizes + Size(along[k]);
    }
    const Float lower = plane.distance - box.middle.error - sizes;
    const Mask open = lower < enough;
    if (!Any(open)) return lower;
    Float at[kAxes];
    Vector p = box.centre;
    for (int k = 0; k < kAxes; ++k) {
      const Vector& half = box.half[k];
      const Float foot = -plane.distance * along[k] / Most(Dot(half, half), zero + 1e-30F);
      at[k] = Least(Most(foot, zero - 1.0F), zero + 1.0F);
      p = {p.x + at[k] * half.x, p.y + at[k] * half.y, p.z + at[k] * half.z};
    }
    const Place near(p, box.spread, solid);
    const Plane other = Furthest(near, part);
    const Vector h = Slope(other, near, solid);
    Float least = other.distance - near.error;
    for (int k = 0; k < kAxes; ++k) {
      const Float slope = Dot(h, box.half[k]);
      least = least - at[k] * slope - Size(slope);
    }
    return open ? Most(lower, least) : lower;
  }

  // Newton's method in barycentric coordinates, as TriangleDescent does it; and by turns along the
  // way.
  template <bool kMoves>
  static Float BoundPart(const Triangle<kMoves>& triangle, const WideSolid& solid,
                         const WidePart& part, float enough) {
    constexpr int kSteps = kMoves ? 9 : 4;
    const Float zero = triangle.spread - triangle.spread;
    Float a = zero + kThird;
    Float b = a;
    Float t = zero;
    Place place = triangle.middle;
    Float lower = zero - 1e30F;
    Float upper = zero + 1e30F;
    Mask open = zero < 1.0F;  // a lane takes its steps whatever its neighbours do
    for (int step = 0;; ++step) {
      const Plane plane = Furthest(place, part);
      const Vector g = Slope(plane, place, solid);
      const Float ga = Dot(g, triangle.side[0]);
      const Float gb = Dot(g, triangle.side[1]);
      Float bound = plane.distance - place.error - a * ga - b * gb + Least(zero, Least(ga, gb));
      Float gt = zero;
      if constexpr (kMoves) {
        gt = Dot(g, triangle.way);
        bound = bound - t * gt - Size(gt);
      }
      lower = open ? Most(lower, bound) : lower;
      upper = Least(upper, plane.distance);
      // What is left may be below `enough` in truth.
      open = open & (lower < enough) & (upper - lower > 2.0F * place.error + kNear);
      if (step == kSteps || !Any(open)) return lower;
      const Bend bend(plane, place, solid);
      if (kMoves && step % 2 == 0) {
        const Float along = bend.Along(triangle.way, gt);
        t = Least(Most(t - gt / Most(along, zero + 1e-30F), zero - 1.0F), zero + 1.0F);
      } else {
        Step(bend.Over(triangle.side, ga, gb), &a, &b);
      }
      place = Place(triangle.At(a, b, t), triangle.spread, solid);
    }
  }

  // Slope and bend of a function of (a, b) about a place.
  struct Quadratic {
    Float a, b, aa, ab, bb;
  };

  // How the distance bends about a place: along its slope, along the profile and around the axis.
  struct Bend {
    Bend(const Plane& plane, const Place& place, const WideSolid& solid)
        : tangent{plane.normal_z * place.radial.x - plane.normal_r * solid.axis[0],
                  plane.normal_z * place.radial.y - plane.normal_r * solid.axis[1],
                  plane.normal_z * place.radial.z - plane.normal_r * solid.axis[2]},
          around{solid.axis[1] * place.radial.z - solid.axis[2] * place.radial.y,
                 solid.axis[2] * place.radial.x - solid.axis[0] * place.radial.z,
                 solid.axis[0] * place.radial.y - solid.axis[1] * place.radial.x},
          curvature(plane.curvature) {
      const Float zero = place.r - place.r;
      turn = plane.normal_r / Most(place.r, zero + 1e-6F);
      most = plane.curvature > 0.0F ? plane.curvature : turn;
    }
    Float Along(const Vector& way, const Float& slope) const {
      const Float t = Dot(tangent, way);
      const Float u = Dot(around, way);
      return most * slope * slope + curvature * t * t + turn * u * u;
    }
    Quadratic Over(const Vector (&side)[2], const Float& ga, const Float& gb) const {
      const Float ta = Dot(tangent, side[0]);
      const Float tb = Dot(tangent, side[1]);
      const Float ua = Dot(around, side[0]);
      const Float ub = Dot(around, side[1]);
      return {ga, gb, most * ga * ga + curvature * ta * ta + turn * ua * ua,
              most * ga * gb + curvature * ta * tb + turn * ua * ub,
              most * gb * gb + curvature * tb * tb + turn * ub * ub};
    }
    Vector tangent, around;
    Float curvature, turn, most;
  };

  static void Step(const Quadratic& q, Float* a, Float* b) {
    const Float zero = *a - *a;
    const Float determinant = q.aa * q.bb - q.ab * q.ab;
    const Float inner_a = *a + (q.ab * q.b - q.bb * q.a) / determinant;
    const Float inner_b = *b + (q.ab * q.a - q.aa * q.b) / determinant;
    const Mask inside = (determinant > 1e-6F * q.aa * q.bb) & (inner_a >= 0.0F) &
                        (inner_b >= 0.0F) & (inner_a + inner_b <= 1.0F);
    Float best_a = *a;
    Float best_b = *b;
    Float least = zero;
    constexpr float kCorner[4][2] = {{0, 0}, {1, 0}, {0, 1}, {0, 0}};
    for (int k = 0; k < 3; ++k) {
      const Float from_a = kCorner[k][0] - *a;
      const Float from_b = kCorner[k][1] - *b;
      const float way_a = kCorner[k + 1][0] - kCorner[k][0];
      const float way_b = kCorner[k + 1][1] - kCorner[k][1];
      const Float slope = way_a * (q.a + q.aa * from_a + q.ab * from_b) +
                          way_b * (q.b + q.ab * from_a + q.bb * from_b);
      const Float bend = way_a * way_a * q.aa + 2.0F * way_a * way_b * q.ab + way_b * way_b * q.bb;
      // Without a bend, to one of the ends.
      const Float t = Least(Most(-slope / Most(bend, zero + 1e-30F), zero), zero + 1.0F);
      const Float da = from_a + t * way_a;
      const Float db = from_b + t * way_b;
      const Float value =
          da * q.a + db * q.b + 0.5F * (q.aa * da * da + 2.0F * q.ab * da * db + q.bb * db * db);
      const Mask better = value < least;
      least = better ? value : least;
      best_a = better ? *a + da : best_a;
      best_b = better ? *b + db : best_b;
    }
    *a = inside ? inner_a : best_a;
    *b = inside ? inner_b : best_b;
  }

  template <typename Shape, typename Eight>
  static WideNear BoundAll(const Eight& eight, const WideSolid& solid, float enough, float* lower) {
    Sorted sorted(enough);
    for (int i = 0; i < kWide; i += N) {
      sorted.Add(Bound(Shape(eight, i, solid), solid, enough), i, lower);
    }
    return sorted.Near();
  }

  template <typename Shape>
  static Float Bound(const Shape& shape, const WideSolid& solid, float enough) {
    Float bound = BoundPart(shape, solid, solid.parts[0], enough);
    for (int i = 1; i < solid.part_count; ++i) {
      bound = Least(bound, BoundPart(shape, solid, solid.parts[i], enough));
    }
    if (solid.hull == nullptr || !Any(bound < 0.0F)) return bound;
    return bound < 0.0F ? BoundPart(shape, solid, *solid.hull, enough) : bound;
  }
};

}  // namespace
}  // namespace ncsim::collision
