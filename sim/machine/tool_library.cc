// SPDX-License-Identifier: BSD-3-Clause
#include "sim/machine/tool_library.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "sim/base/text.h"
#include "sim/base/units.h"

namespace ncsim::machine {
namespace {

constexpr double kCatalogueRounding = 1e-3;  // mm; of inch sizes that were rounded to mm
constexpr double kRounding = 1e-6;           // mm; of sums of stated lengths

/// Appends elements end to end; steps without length are left out.
class ProfileBuilder {
 public:
  explicit ProfileBuilder(double z) : at_(z, 0.0) {}

  void LineTo(double z, double r) {
    const Eigen::Vector2d end(z, r);
    if ((end - at_).norm() > 1e-12) profile_.elements.push_back({at_, end, false, {0.0, 0.0}});
    at_ = end;
  }
  void ArcTo(double z, double r, const Eigen::Vector2d& centre) {
    const Eigen::Vector2d end(z, r);
    if ((end - at_).norm() > 1e-12) profile_.elements.push_back({at_, end, true, centre});
    at_ = end;
  }
  Profile Close() {
    LineTo(at_.x(), 0.0);
    return std::move(profile_);
  }

 private:
  Eigen::Vector2d at_;
  Profile profile_;
};

/// Sum of heights.
double Height(const std::vector<Frustum>& frusta) {
  double height = 0.0;
  for (const Frustum& frustum : frusta) height += frustum.height;
  return height;
}

std::string CheckFrusta(const std::vector<Frustum>& frusta, const std::string& what) {
  for (const Frustum& frustum : frusta) {
    if (!(frustum.height > 0.0)) return "an element of the " + what + " has no height";
    if (frustum.lower < 0.0 || frustum.upper < 0.0 || frustum.lower + frustum.upper <= 0.0) {
      return "an element of the " + what + " has no diameter";
    }
  }
  return "";
}

/// The radius at the top of the flutes, or what is wrong with the cutter.
std::string CutterProfile(const CutterSpec& cutter, Profile* profile, double* top_radius) {
  const double radius = 0.5 * cutter.diameter;
  const double corner = cutter.corner_radius;
  const double top = cutter.flute_length;
  *top_radius = radius;
  ProfileBuilder builder(0.0);
  switch (cutter.type) {
    case CutterType::kEnd:
      builder.LineTo(0.0, radius);
      break;
    case CutterType::kBall:
    case CutterType::kBull:
      if (corner > top + kRounding) return "the flutes are shorter than the corner radius";
      builder.LineTo(0.0, radius - corner);
      builder.ArcTo(std::min(corner, top), radius, {corner, radius - corner});
      break;
    case CutterType::kDrill: {
      const double point = radius / std::tan(0.5 * cutter.point_angle);
      if (point > top + kRounding) return "the flutes are shorter than the drill's point";
      builder.LineTo(std::min(point, top), radius);
      break;
    }
    case CutterType::kTaper: {
      const double sine = std::sin(cutter.taper_angle), cosine = std::cos(cutter.taper_angle);
      const double z = corner * (1.0 - sine), r = radius - corner + corner * cosine;
      if (z > top + kRounding) return "the flutes are shorter than the corner radius";
      builder.LineTo(0.0, radius - corner);
      builder.ArcTo(z, r, {corner, radius - corner});
      *top_radius = r + std::max(0.0, top - z) * sine / cosine;
      break;
    }
    case CutterType::kChamfer: {
      const double tip = 0.5 * cutter.tip_diameter;
      const double flank = (radius - tip) / std::tan(cutter.taper_angle);
      if (flank > top + kRounding) {
        return "the flutes are shorter than the chamfer's flank (" + Short(flank) + " mm)";
      }
      builder.LineTo(0.0, tip);
      builder.LineTo(std::min(flank, top), radius);
      break;
    }
  }
  builder.LineTo(top, *top_radius);
  *profile = builder.Close();
  return "";
}

std::string CheckCutter(const CutterSpec& cutter) {
  if (!(cutter.diameter > 0.0)) return "the cutter has no diameter";
  if (!(cutter.flute_length > 0.0)) return "the cutter has no flutes";
  if (cutter.corner_radius < 0.0) return "the corner radius is negative";
  const double radius = 0.5 * cutter.diameter;
  if (cutter.corner_radius > radius + kCatalogueRounding) {
    return "the corner radius " + Short(cutter.corner_radius) + " is more than half the diameter " +
           Short(cutter.diameter);
  }
  switch (cutter.type) {
    case CutterType::kBall:
      return std::abs(cutter.corner_radius - radius) <= kCatalogueRounding
                 ? ""
                 : "the corner radius of a ball mill is half its diameter";
    case CutterType::kBull:
      return cutter.corner_radius > 0.0 ? "" : "a bull mill has a corner radius";
    case CutterType::kDrill:
      return cutter.point_angle > 0.0 && cutter.point_angle <= kPi
                 ? ""
                 : "the point angle must be above 0 and at most 180 degrees";
    case CutterType::kTaper:
    case CutterType::kChamfer:
      if (cutter.tip_diameter < 0.0 || cutter.tip_diameter >= cutter.diameter) {
        return "the tip is not narrower than the cutter";
      }
      return cutter.taper_angle > 0.0 && cutter.taper_angle < 0.5 * kPi - 1e-3
                 ? ""
                 : "the taper angle must be above 0 and below 90 degrees";
    case CutterType::kEnd:
      return cutter.corner_radius == 0.0 ? "" : "an end mill with a corner radius is a bull mill";
  }
  return "";
}

/// A stack of frusta from `z` up. The last one is made longer to end at `z_end`.
Profile Stack(double z, const std::vector<Frustum>& frusta, double z_end) {
  ProfileBuilder builder(z);
  for (const Frustum& frustum : frusta) {
    builder.LineTo(z, 0.5 * frustum.lower);
    z += frustum.height;
    builder.LineTo(z, 0.5 * frustum.upper);
  }
  builder.LineTo(z_end, 0.5 * frusta.back().upper);
  return builder.Close();
}

std::string CheckHeights(const ToolSpec& spec) {
  const double holder = Height(spec.holder);
  const double flutes = spec.cutter.flute_length;
  if (flutes + holder > spec.length + kRounding) {
    return "flutes (" + Short(flutes) + " mm) and holder (" + Short(holder) +
           " mm) are longer than the tool (" + Short(spec.length) + " mm)";
  }
  const double shank = Height(spec.shank);
  if (flutes + shank + holder > spec.length + kRounding) {
    return "flutes (" + Short(flutes) + " mm), shank (" + Short(shank) + " mm) and holder (" +
           Short(holder) + " mm) are longer than the tool (" + Short(spec.length) + " mm)";
  }
  return "";
}

}  // namespace

std::string MakeTool(const ToolSpec& spec, Tool* tool) {
  if (!(spec.length > 0.0)) return "the tool has no length";
  CutterSpec cutter = spec.cutter;
  if (cutter.type == CutterType::kBall && cutter.corner_radius == 0.0) {
    cutter.corner_radius = 0.5 * cutter.diameter;
  }
  for (const std::string& wrong : {CheckCutter(cutter), CheckFrusta(spec.shank, "shank"),
                                   CheckFrusta(spec.holder, "holder"), CheckHeights(spec)}) {
    if (!wrong.empty()) return wrong;
  }
  const double half = 0.5 * cutter.diameter;
  cutter.corner_radius =
      cutter.type == CutterType::kBall ? half : std::min(cutter.corner_radius, half);
  Tool made;
  double top_radius = 0.0;
  const std::string wrong = CutterProfile(cutter, &made.flutes, &top_radius);
  if (!wrong.empty()) return wrong;
  const double z_holder = spec.length - Height(spec.holder);
  if (z_holder > cutter.flute_length + kRounding) {
    std::vector<Frustum> shank = spec.shank;
    if (shank.empty()) {
      shank.push_back({2.0 * top_radius, 2.0 * top_radius, z_holder - cutter.flute_length});
    }
    made.shank = Stack(cutter.flute_length, shank, z_holder);
  }
  if (!spec.holder.empty()) made.holder = Stack(z_holder, spec.holder, spec.length);
  made.number = spec.number;
  made.name = spec.name;
  made.length = made.h_geometry = spec.length;
  made.diameter = made.d_geometry = cutter.diameter;
  made.type = cutter.type;
  *tool = std::move(made);
  return "";
}

namespace {

constexpr double kAssumedDiameter = 12.0;
constexpr double kAssumedLength = 180.0;
constexpr double kLeastStickOut = 5.0;

/// The assumed holder, or a shorter one that leaves room for flutes; `used` says which. Empty where
/// none fits.
std::vector<Frustum> HolderThatFits(const std::string& interface, double length,
                                    std::string* used) {
  const std::string longest = AssumedHolder(interface);
  const std::string stem = longest.substr(0, longest.rfind('-'));
  for (const std::string& name : {longest, stem + "-70", stem + "-60"}) {
    const std::optional<std::vector<Frustum>> holder = HolderByName(name);
    if (holder && Height(*holder) + kLeastStickOut <= length) {
      *used = name;
      return *holder;
    }
  }
  *used = "none";
  return {};
}

}  // namespace

// All that can be assumed are of one length, so nothing else of the tool changes.
void ChangeAssumedHolder(const std::string& interface, Tool* tool) {
  const std::string name = AssumedHolder(interface);
  if (tool->assumed_holder.empty() || tool->assumed_holder == name) return;
  tool->holder = Stack(tool->holder.z_min(), *HolderByName(name), tool->length);
  const std::size_t said = tool->assumed.find(tool->assumed_holder);
  if (said != std::string::npos) tool->assumed.replace(said, tool->assumed_holder.size(), name);
  tool->assumed_holder = name;
}

Tool AssumeTool(int number, const std::string& name, double diameter, double corner_radius,
                double length, const std::string& interface) {
  ToolSpec spec;
  spec.number = number;
  spec.name = name;
  CutterSpec& cutter = spec.cutter;
  cutter.diameter = diameter > 0.0 ? diameter : kAssumedDiameter;
  cutter.corner_radius = std::clamp(corner_radius, 0.0, 0.5 * cutter.diameter);
  const bool ball = cutter.corner_radius > 0.5 * cutter.diameter - 1e-3;
  cutter.type = ball ? CutterType::kBall
                     : (cutter.corner_radius > 0.0 ? CutterType::kBull : CutterType::kEnd);
  if (ball) cutter.corner_radius = 0.5 * cutter.diameter;
  spec.length = std::max(length > 0.0 ? length : kAssumedLength, cutter.corner_radius + 1.0);
  std::string used;
  spec.holder = HolderThatFits(interface, spec.length, &used);
  const double stick_out = spec.length - Height(spec.holder);
  cutter.flute_length =
      std::min(stick_out, std::max(3.0 * cutter.diameter, 2.0 * cutter.corner_radius));
  if (cutter.flute_length < cutter.corner_radius) {
    spec.holder.clear();  // a cutter wider than it sticks out
    used = "none";
    cutter.flute_length = spec.length;
  }
  Tool tool;
  MakeTool(spec, &tool);
  tool.assumed = "length " + Short(spec.length, 3) + " mm, " + (ball ? "ball " : "") + "diameter " +
                 Short(cutter.diameter, 3) + " mm, corner radius " +
                 Short(cutter.corner_radius, 3) + " mm, flutes " + Short(cutter.flute_length, 3) +
                 " mm, holder " + used;
  return tool;
}

}  // namespace ncsim::machine
