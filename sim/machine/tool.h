// SPDX-License-Identifier: BSD-3-Clause
// Tools as the machine holds them: solids of revolution about the spindle axis (ISO 13399 words).
#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace ncsim::machine {

/// One element of a profile in the half plane (z, r): z from the tip toward the gauge line, r from
/// the axis; mm. A straight element, or an arc about `centre` (the corner radius of a ball or bull
/// nose), convex outward.
struct ProfileElement {
  Eigen::Vector2d start;  ///< (z, r)
  Eigen::Vector2d end;
  bool arc = false;
  Eigen::Vector2d centre = Eigen::Vector2d::Zero();
};

/// A closed solid of revolution. The elements run from the axis at the lower end to the axis at the
/// upper end with z never decreasing; the axis closes it.
struct Profile {
  std::vector<ProfileElement> elements;
  bool empty() const { return elements.empty(); }
  double z_min() const { return elements.front().start.x(); }
  double z_max() const { return elements.back().end.x(); }
};

enum class CutterType { kEnd, kBall, kBull, kDrill, kTaper, kChamfer };

/// A cutting edge's registers in the control (SINUMERIK: D1 ...), mm; geometry and wear add up.
struct ToolEdge {
  int number = 1;
  double length = 0.0, length_wear = 0.0;
  double diameter = 0.0, diameter_wear = 0.0;
};

/// A tool assembly. Profiles are measured from the TIP (z = 0) up to the gauge line (z = length).
struct Tool {
  int number = 0;
  std::string name;
  double length = 0.0;    ///< Gauge line to tip, mm: the metal.
  double diameter = 0.0;  ///< Cutting diameter, mm.
  CutterType type = CutterType::kEnd;
  Profile flutes;
  Profile shank;
  Profile holder;
  // The control's registers where they differ from the metal; geometry defaults to length and
  // diameter.
  double h_geometry = 0.0, h_wear = 0.0, d_geometry = 0.0, d_wear = 0.0;
  /// Ascending numbers. Empty where the job states none: then those four are the registers of D1.
  std::vector<ToolEdge> edges;
  /// Non-empty: shape or length were assumed or read from the program's header; why, in words.
  std::string assumed;
  /// Name of the holder, where a job's tool states none; it is in `assumed`, too.
  std::string assumed_holder;
};

struct ToolTable {
  std::vector<Tool> tools;  ///< Ascending numbers.
  const Tool* Find(int number) const;
};

/// What reports call the flutes, shank or holder (`part`) of a tool: "T3.holder".
std::string ToolBodyName(int number, std::string_view part);

}  // namespace ncsim::machine
