// SPDX-License-Identifier: BSD-3-Clause
// Lower bounds of the signed distance from eight boxes, or eight triangles, to a solid of
// revolution, at once. Plain on purpose: translation units built for other processors include this
// and nothing that could leave their inline functions in the rest of the program.
#pragma once

namespace ncsim::collision {

inline constexpr int kWide = 8;

/// mm, from the mesh's origin.
struct alignas(32) WideBoxes {
  float centre[3][kWide];
  float half[3][3][kWide];  ///< [axis of the box][coordinate][box]: from the centre to a face.
};
struct alignas(32) WideTriangles {
  float corner[3][3][kWide];  ///< [corner][coordinate][triangle]
};

/// ConvexProfile's lines and rounds, with z from the solid's origin on its axis.
struct WideLine {
  float normal_z, normal_r, offset;
};
struct WideRound {
  float z, r, radius;
  float from_z, from_r, to_z, to_r;
};
struct WidePart {
  const WideLine* lines;
  int line_count;
  const WideRound* rounds;
  int round_count;
};

/// A solid and where it stands.
struct WideSolid {
  const WidePart* parts;  ///< Convex; the solid is their union.
  int part_count;
  /// Convex and around the solid; counts where a bound by the parts is negative, for the union is
  /// deeper than its parts. Null for a convex solid.
  const WidePart* hull;
  float origin[3];    ///< On the axis; from the mesh's origin, mm.
  float axis[3];      ///< Unit.
  float half_way[3];  ///< It goes from origin - half_way to origin + half_way, mm; 0: it stands.
  float reach;        ///< Greatest coordinate of the profile, mm.
  float rounding;     ///< Error of `origin` and of what is measured from it, mm.
};

/// Which of eight bounds are below what is enough, and what the others leave to be said.
struct WideNear {
  int lanes;     ///< A bit for each.
  float passed;  ///< The least of the others; 1e30 for none.
};

/// No point of box or triangle i has a smaller signed distance than lower[i] anywhere on the way of
/// the solid; rounding is taken off. The same bytes on every processor.
WideNear BoundBoxes(const WideBoxes& boxes, const WideSolid& solid, float enough, float* lower);
WideNear BoundTriangles(const WideTriangles& triangles, const WideSolid& solid, float enough,
                        float* lower);

/// One for each kind of processor.
struct WideBounds {
  WideNear (*boxes)(const WideBoxes&, const WideSolid&, float, float*);
  WideNear (*triangles)(const WideTriangles&, const WideSolid&, float, float*);
};
extern const WideBounds kWideBaseline;  ///< Four lanes.
extern const WideBounds kWideAvx2;      ///< Eight lanes; only where the processor has AVX2.

}  // namespace ncsim::collision
