// SPDX-License-Identifier: BSD-3-Clause
// Holders that ship. Flanges: CAT40 after ANSI/ASME B5.50, BT40 after MAS 403 (25 mm thick, 2 mm
// from the gauge line), SK40 after DIN 69871, HSK-A63 after ISO 12164; V-grooves and keyways are
// filled. Collet chucks: nominal outlines of ER chucks (DIN 6499 nuts), nut and body as one
// cylinder.
#include <array>
#include <string_view>

#include "sim/machine/tool_library.h"

namespace ncsim::machine {
namespace {

struct Interface {
  std::string_view name;
  double gauge_diameter;  // at the gauge line; 0: the flange starts there
  double gap;             // gauge line to flange
  double flange_diameter;
  double flange_end;  // gauge line to the flange's lower face
};
constexpr std::array<Interface, 4> kInterfaces = {{{"CAT40", 44.45, 3.175, 63.5, 19.05},
                                                   {"BT40", 44.45, 2.0, 63.0, 27.0},
                                                   {"SK40", 44.45, 3.2, 63.55, 19.1},
                                                   {"HSK-A63", 0.0, 0.0, 63.0, 26.0}}};

struct Chuck {
  std::string_view name;
  double diameter;  // of nut and body
};
constexpr std::array<Chuck, 3> kChucks = {{{"ER16", 32.0}, {"ER25", 42.0}, {"ER32", 50.0}}};

constexpr std::array<int, 4> kGaugeLengths = {60, 70, 100, 160};

std::string Name(const Interface& interface, const Chuck& chuck, int length) {
  return std::string(interface.name) + "-" + std::string(chuck.name) + "-" + std::to_string(length);
}

}  // namespace

std::optional<std::vector<Frustum>> HolderByName(const std::string& name) {
  for (const Interface& interface : kInterfaces) {
    for (const Chuck& chuck : kChucks) {
      for (const int length : kGaugeLengths) {
        if (Name(interface, chuck, length) != name) continue;
        std::vector<Frustum> holder = {
            {chuck.diameter, chuck.diameter, length - interface.flange_end},
            {interface.flange_diameter, interface.flange_diameter,
             interface.flange_end - interface.gap}};
        if (interface.gap > 0.0) {
          holder.push_back({interface.gauge_diameter, interface.gauge_diameter, interface.gap});
        }
        return holder;
      }
    }
  }
  return std::nullopt;
}

std::vector<std::string> HolderNames() {
  std::vector<std::string> names;
  for (const Interface& interface : kInterfaces) {
    for (const Chuck& chuck : kChucks) {
      for (const int length : kGaugeLengths) names.push_back(Name(interface, chuck, length));
    }
  }
  return names;
}

std::string AssumedHolder(const std::string& interface) {
  const std::string name = interface + "-ER32-100";
  return HolderByName(name) ? name : "CAT40-ER32-100";
}

}  // namespace ncsim::machine
