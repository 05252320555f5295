// SPDX-License-Identifier: BSD-3-Clause
#include <cstdint>
#include <limits>
#include <string>
#include <utility>

#include "sim/machine/settings_tables.h"

namespace ncsim::machine {
namespace {

/// MD20150 for groups whose G codes can be a start state: its index (the group's number less 1) and
/// the codes. Settable frames are added by number.
std::vector<std::pair<int, std::vector<std::string>>> StartGroups() {
  std::vector<std::string> frames = {"G500", "G54", "G55", "G56", "G57"};
  for (int number = 505; number <= 599; ++number) frames.push_back("G" + std::to_string(number));
  return {{0, {"G0", "G1"}},
          {5, {"G17", "G18", "G19"}},
          {6, {"G40"}},
          {7, std::move(frames)},
          {9, {"G60", "G64", "G641", "G642", "G643", "G644", "G645"}},
          {11, {"G601", "G602", "G603"}},
          {12, {"G70", "G71", "G700", "G710"}},
          {13, {"G90", "G91"}},
          {14, {"G93", "G94", "G95", "G96", "G97"}},
          {24, {"ORIWKS", "ORIMKS"}},
          {29, {"COMPOF", "COMPON", "COMPCURV", "COMPCAD", "COMPSURF"}},
          {49, {"ORIEULER", "ORIRPY", "ORIVIRT1", "ORIVIRT2", "ORIAXPOS", "ORIRPY2"}},
          {50, {"ORIVECT", "ORIAXES", "ORIPLANE"}},
          {54, {"RTLION", "RTLIOF"}},
          {58, {"DYNNORM", "DYNPOS", "DYNROUGH", "DYNSEMIFIN", "DYNFINISH", "DYNPREC"}}};
}

}  // namespace

std::vector<Setting> SinumerikSettings() {
  std::vector<Setting> settings;
  const auto whole = [&](std::string name, std::int64_t lowest, std::int64_t highest) {
    settings.push_back({std::move(name), SettingKind::kWhole, {}, lowest, highest});
  };
  const auto add = [&](std::string name, SettingKind kind) {
    settings.push_back({std::move(name), kind});
  };
  constexpr std::int64_t kMask = std::numeric_limits<std::uint32_t>::max();
  whole("MD10600", 1, 2);  // FRAME_ANGLE_INPUT_MODE
  whole("MD10602", 0, 3);  // FRAME_GEOAX_CHANGE_MODE
  whole("MD10760", 0, 3);  // G53_TOOLCORR
  for (auto& [index, codes] : StartGroups()) {
    settings.push_back({"MD20150[" + std::to_string(index) + "]", SettingKind::kWord, codes});
  }
  whole("MD20270", -2, 12);              // CUTTING_EDGE_DEFAULT
  whole("MD20730", 0, 1);                // G0_LINEAR_MODE
  add("MD21000", SettingKind::kLength);  // CIRCLE_ERROR_CONST
  add("MD21010", SettingKind::kNumber);  // CIRCLE_ERROR_FACTOR
  whole("MD21094", 0, 9999);             // ORIPATH_MODE
  whole("MD21100", 0, 1);                // ORIENTATION_IS_EULER
  whole("MD21102", 0, 1);                // ORI_DEF_WITH_G_CODE
  whole("MD21103", 0, 1);                // ORI_ANGLE_WITH_G_CODE
  whole("MD21104", 0, 1);                // ORI_IPO_WITH_G_CODE
  whole("MD21108", 0, 19999);            // POLE_ORI_MODE
  whole("MD21180", 0, 999);              // ROT_AX_SWL_CHECK_MODE
  whole("MD22550", 0, 1);                // TOOL_CHANGE_MODE
  whole("MD24000", 0, 1);                // FRAME_ADD_COMPONENTS
  whole("MD24100", 16, 72);              // TRAFO_TYPE_1
  add("MD24540", SettingKind::kAngle);   // TRAFO5_POLE_LIMIT_1
  for (const char axis : {'A', 'B', 'C'}) {
    const std::string index = std::string("[") + axis + "]";
    whole("MD30310" + index, 0, 1);               // ROT_IS_MODULO
    add("MD30330" + index, SettingKind::kAngle);  // MODULO_RANGE
    whole("MD30455" + index, 0, kMask);           // MISC_FUNCTION_MASK
  }
  for (const char point : {'0', '1', '2', '3'}) {  // FIX_POINT_POS
    const std::string name = std::string("MD30600[") + point + ",";
    for (const char axis : {'X', 'Y', 'Z'}) add(name + axis + "]", SettingKind::kLength);
    for (const char axis : {'A', 'B', 'C'}) add(name + axis + "]", SettingKind::kAngle);
  }
  whole("SD42440", 0, 1);                                         // FRAME_OFFSET_INCR_PROG
  whole("SD42442", 0, 1);                                         // TOOL_OFFSET_INCR_PROG
  whole("SD42940", -19, 19);                                      // TOOL_LENGTH_CONST
  whole("SD55221", 0, kMask);                                     // FUNCTION_MASK_SWIVEL_SET
  for (const int number : {55440, 55441, 55442, 55443, 55444}) {  // MILL_TOL_FACTOR_...
    add("SD" + std::to_string(number), SettingKind::kNumber);
  }
  // Of the swivel data record: where CYCLE800 retracts to, and the rotary axis that _DIR means.
  for (const int number : {38, 39, 40}) {
    add("TC_CARR" + std::to_string(number), SettingKind::kLength);
  }
  whole("swivel_reference", 1, 2);
  add("block_skip", SettingKind::kSwitch);  // "/" and "/0"
  for (int level = 1; level <= 9; ++level) {
    add("block_skip " + std::to_string(level), SettingKind::kSwitch);
  }
  add("optional_stop", SettingKind::kSwitch);
  add("software_version", SettingKind::kText);
  return settings;
}

}  // namespace ncsim::machine
