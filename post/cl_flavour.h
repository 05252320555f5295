// SPDX-License-Identifier: BSD-3-Clause
// Which system wrote a cutter-location file. The systems use the same words with different
// meanings, so this decides how three of them are read:
//
//                          NX             Creo           SolidWorks CAM
//   CIRCLE turns about     -(i,j,k)       (i,j,k)        (i,j,k)         by the right hand
//   GOTO without i,j,k     last axis      (0,0,1)        (0,0,1)
//   depth of a CYCLE       signed         unsigned       unsigned
//
// The sense of NX: its help says "axis vector (assuming a clockwise direction)"; Creo's: "CL Output
// for Circular Interpolation"; SolidWorks CAM's: its files, whose lines run into their arcs
// tangentially in that sense (tests/corpus).
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "post/cl_record.h"
#include "sim/nc/program.h"

namespace ncsim::post {

enum class ClFlavour : std::uint8_t {
  kNx,
  kCreo,
  kSolidWorksCam,
  kApt,  ///< None of them: where it matters is an error.
};
/// "nx", "creo", "solidworks", "apt"
std::string_view ToString(ClFlavour flavour);
/// Of a file by its own words: TOOL PATH, TLDATA, MSYS, END-OF-PATH (NX); PPWORD, PRO/CLFILE,
/// `$$->` (Creo); TRNTYP, CSI_SET_*, CYCLE/INIT (SolidWorks CAM).
struct ClSurvey {
  ClFlavour flavour = ClFlavour::kApt;
  std::string flavour_evidence;       ///< "TOOL PATH at line 1"; "" for kApt.
  std::string flavour_contradiction;  ///< Words of a second system; "" where there are none.
  std::optional<ClUnit> unit;         ///< UNITS; else of the feed rates where all agree.
  std::string unit_evidence;          ///< "UNITS at line 66", "MMPM at line 13"; "" without a unit.
  std::string other_feed_unit;     ///< "IPM at line 87" of a file that UNITS says is in mm; or "".
  std::string unit_contradiction;  ///< "IPM at line 87"; "" where all agree.
};
/// Looks through the whole text.
ClSurvey Survey(const nc::Program& program);

}  // namespace ncsim::post
