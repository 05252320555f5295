// SPDX-License-Identifier: BSD-3-Clause
// Makes tool assemblies out of what people know of them: cutter, shank and holder by diameters and
// heights.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "sim/machine/tool.h"

namespace ncsim::machine {

/// A piece of a shank or holder: diameters at its lower (toward the tip) and upper end, and its
/// height; mm.
struct Frustum {
  double lower = 0.0;
  double upper = 0.0;
  double height = 0.0;
};

struct CutterSpec {
  CutterType type = CutterType::kEnd;
  double diameter =
      0.0;  ///< mm; of a taper: of the tip, as if it were straight; of a chamfer: the largest.
  double corner_radius = 0.0;  ///< mm. Ball: half the diameter.
  double flute_length = 0.0;   ///< mm, from the tip.
  double point_angle = 0.0;    ///< rad; drill: the full angle of the point.
  double taper_angle = 0.0;    ///< rad; taper, chamfer: between the axis and the flank.
  double tip_diameter = 0.0;   ///< mm; chamfer: the flat of its tip.
};

struct ToolSpec {
  int number = 0;
  std::string name;
  double length = 0.0;  ///< mm, gauge line to tip.
  CutterSpec cutter;
  std::vector<Frustum> shank;   ///< From the flutes up; the last goes on to the holder. Empty: as
                                ///< wide as the flutes' end.
  std::vector<Frustum> holder;  ///< From its lower end up to the gauge line. Empty: none.
};

/// Builds profiles and registers (geometry = metal, wear = 0). Returns what makes no sense in the
/// spec, in words, and then leaves `tool` alone; "" for a tool that can be.
std::string MakeTool(const ToolSpec& spec, Tool* tool);

/// A holder that ships, from its lower end up to the gauge line; nullopt for an unknown name.
/// Nominal outlines.
std::optional<std::vector<Frustum>> HolderByName(const std::string& name);
std::vector<std::string> HolderNames();
/// What is taken for a holder that nobody names: of the spindle's interface ("BT40"; one that is
/// not known counts as CAT40), 100 mm long.
std::string AssumedHolder(const std::string& interface);
/// Where a job did not know the spindle when it assumed a holder: that of `interface` instead.
void ChangeAssumedHolder(const std::string& interface, Tool* tool);

/// A tool of which the program's comments say something, or nothing: what is not known (0 or "") is
/// assumed. Tool::assumed says everything that was taken. The holder is that of the spindle's
/// `interface`, or the longest of it that `length` has room for.
Tool AssumeTool(int number, const std::string& name, double diameter, double corner_radius,
                double length, const std::string& interface);

}  // namespace ncsim::machine
