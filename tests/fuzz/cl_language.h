// SPDX-License-Identifier: BSD-3-Clause
// Cutter-location files that are in order, and what is put into them to make others.
#pragma once

#include <array>
#include <string_view>

#include "tests/fuzz/mutate.h"

namespace ncsim {

inline constexpr std::array<std::string_view, 5> kClSeeds = {
    "TOOL PATH/OP,TOOL,T1\nTLDATA/MILL,10.0,5.0,35.0,0.0,0.0\nMSYS/0,0,15.1884,1,0,0,0,1,0\n"
    "$$ centerline data\nLOAD/TOOL,1,ADJUST,1\nSPINDL/RPM,1000,CLW\nRAPID\nGOTO/10,0,5,0,0,1\n"
    "FEDRAT/MMPM,250.0\nCIRCLE/0,0,0,0,0,1,10,0.06,0.5,10,1,TIMES,3\nGOTO/0,10,0\n"
    "CUTCOM/LEFT,1,XYPLAN\nGOTO/0,20,0,0.6,0,0.8\nGOHOME/0,0,100\nEND-OF-PATH\n",
    "TOOL PATH/H,TOOL,D\nLOAD/TOOL,2\nFROM/0,0,90\nRAPID\nGOTO/0,0,50\n"
    "CYCLE/DRILL,DEEP,RAPTO,3,FEDTO,-33.0043,RTRCTO,AUTO,MMPM,250.,STEP,5,4,DWELL,REV,2\n"
    "GOTO/66,0,20\nGOTO/1,2,3\nCYCLE/OFF\nDELAY/2\nEND-OF-PATH\n",
    "PARTNO / MFG0001\n$$* Pro/CLfile Version\n$$-> FEATNO / 7\nMACHIN / UNCX01, 1\nUNITS / "
    "INCHES\n"
    "LOADTL / 2, OSETNO, 2\n$$-> CUTTER / 6.0\n$$-> CSYS / 1,0,0,0, $\n 0,1,0,0, $\n 0,0,1,0\n"
    "MULTAX / ON\nSPINDL / RPM, 7957.7,  CLW\nRAPID\nGOTO / 245.1, -22.7, 43.5,  $\n0.6, 0, 0.8\n"
    "FEDRAT / 10, IPM\nGOTO / 10,0,0\nCIRCLE / 0,0,0,0,0,-1,10\nGOTO / 0,-10,0\n-10,0,0\n0,10,0\n"
    "CYCLE/TAP,DEPTH,9,CLEAR,2,TPI,20\nGOTO/1,1,1\nCYCLE/OFF\nFINI\n",
    "PARTNO/1\nUNIT/MM\nINSERT/3MM DRILL\nCUTTER/3.,0,1.5,.62132,22.5,0,46.\nLOAD/TOOL,14\n"
    "CSI_SET_FLUTE_LENGTH/16.\nSELECT/TOOL,11\nCOOLNT/FLOOD\nTRNTYP/WORLD,0,0,0\n"
    "CSYS/0,0,-1.,0,-1.,0,0,0,0,1.,0,0\nRAPID/\nGOTO/1,2,25.,-1,0,0\nCYCLE/INIT\n"
    "CYCLE/DEEP2,FEDTO,24.6205,1STPECK,5.,SUBPECK,2.,MMPM,670.56,RAPTO,3.,RTRCTO,25.\n"
    "GOTO/1,2,0,-1,0,0\nCYCLE/OFF\nFEDRAT/9.,MMPM\nGOTO/2,0,0\nCIRCLE/0,0,0,0,0,1.\nGOTO/2,0,0\n"
    "FINI\n",
    "UNITS/MM\nTURRET/3\nAUXFUN/8,NEXT\nPREFUN/68\nROTATE/TABLE,ATANGL,90\nSET/MODE,1\nOPSTOP\n"
    "FEDRAT/PERMIN,5\nGOTO/1,1,1\nGODLTA/1,0,0\nGODLTA/-2\nGOHOME/Z\nFINI\n"};

inline constexpr std::array<std::string_view, 34> kClTokens = {"GOTO/",
                                                               "CIRCLE/",
                                                               "RAPID\n",
                                                               "TIMES,",
                                                               "$\n",
                                                               "$$",
                                                               "$$-> ",
                                                               "REMARK ",
                                                               "CYCLE/",
                                                               "CYCLE/OFF\n",
                                                               "END-OF-PATH\n",
                                                               "FINI\n",
                                                               "TOOL PATH/",
                                                               "MSYS/",
                                                               "nan",
                                                               "inf",
                                                               "1e308",
                                                               "-1e308",
                                                               "1e-320",
                                                               "9999999999",
                                                               "0,0,0",
                                                               "0,0,2",
                                                               ",,",
                                                               "\n1,2,3\n",
                                                               "\r",
                                                               "\r\n",
                                                               "FROM/",
                                                               "LOAD/TOOL,",
                                                               "MMPM",
                                                               "IPM",
                                                               "IPR",
                                                               "AUTO",
                                                               "GODLTA/",
                                                               "UNITS/INCHES\n"};

inline const FuzzLanguage kClLanguage = {kClSeeds, kClTokens, ",/$9-E. \n"};

}  // namespace ncsim
