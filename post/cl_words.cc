// SPDX-License-Identifier: BSD-3-Clause
#include "post/cl_words.h"

#include <algorithm>
#include <iterator>

namespace ncsim::post {
namespace {

using Use = ClWord::Use;

template <class Record>
ClStatement Bare(ClArguments&) {
  return Record{};
}

ClStatement ParseStop(ClArguments&) { return cl::Stop{false}; }

ClStatement ParseOptionalStop(ClArguments&) { return cl::Stop{true}; }

constexpr std::string_view kMoves = "shifts or turns the coordinates of what follows";
constexpr std::string_view kCompiler = "is for an APT processor: motion that is not computed yet";
constexpr std::string_view kProgram = "calls or defines a program";

constexpr ClWord kWords[] = {
    {"AUXFUN", Use::kRead, "M code", ParseAuxiliary},
    {"CALLSUB", Use::kRefused, kProgram},
    {"CALSUB", Use::kRefused, kProgram},
    {"CAMERA", Use::kIgnored, "display"},
    {"CIRCLE", Use::kRead, "the next GOTO is the end of a circle or helix", ParseCircle},
    {"CLAMP", Use::kPassed, "brakes"},
    {"CLEARP", Use::kPassed, "clearance plane"},
    {"COOLNT", Use::kRead, "coolant", ParseCoolant},
    {"COPY", Use::kRefused, kMoves},
    {"COUPLE", Use::kPassed, "feed coupled to the spindle"},
    {"CSI_SET_EXTENSION_LENGTH", Use::kIgnored, "tool assembly"},
    {"CSI_SET_FLUTE_LENGTH", Use::kIgnored, "tool assembly"},
    {"CSYS", Use::kRead, "which way the set-up lies", ParseCsys},
    {"CUTCOM", Use::kRead, "cutter compensation", ParseCutterComp},
    {"CUTTER", Use::kRead, "shape of a tool", ParseCutter},
    {"CYCLE", Use::kRead, "hole cycle", ParseCycle},
    {"DEFSUB", Use::kRefused, kProgram},
    {"DELAY", Use::kRead, "dwell", ParseDelay},
    {"DISPLY", Use::kIgnored, "display"},
    {"DNTCUT", Use::kRefused, kCompiler},
    {"END", Use::kPassed, "end of the program"},
    {"END-OF-PATH", Use::kRead, "end of an operation", Bare<cl::OperationEnd>},
    {"ENDSUB", Use::kRefused, kProgram},
    {"FEDRAT", Use::kRead, "feed rate", ParseFeed},
    {"FINI", Use::kRead, "end of the file", Bare<cl::End>},
    {"FROM", Use::kRead, "where the tool stands", ParseFrom},
    {"GODLTA", Use::kRead, "motion by a distance", ParseGoDelta},
    {"GOFWD", Use::kRefused, kCompiler},
    {"GOHOME", Use::kRead, "motion to a home position", ParseGoHome},
    {"GOTO", Use::kRead, "motion", ParseGoto},
    {"HEAD", Use::kPassed, "which head"},
    {"INDEX", Use::kRefused, kMoves},
    {"INDIRV", Use::kRefused, kCompiler},
    {"INTOL", Use::kIgnored, "tolerance of the points"},
    {"LEADER", Use::kIgnored, "paper tape"},
    {"LINTOL", Use::kPassed, "tolerance of the post"},
    {"LOAD", Use::kRead, "tool change", ParseLoad},
    {"LOADTL", Use::kRead, "tool change", ParseLoadTool},
    {"MACHIN", Use::kIgnored, "name of a post"},
    {"MODE", Use::kPassed, "mode of the machine"},
    {"MSYS", Use::kRead, "coordinate system of the points", ParseMsys},
    {"MULTAX", Use::kRead, "points carry tool axes", ParseMultiAxis},
    {"OPSKIP", Use::kPassed, "block skip"},
    {"OPSTOP", Use::kRead, "optional stop", ParseOptionalStop},
    {"ORIGIN", Use::kRefused, kMoves},
    {"OUTTOL", Use::kIgnored, "tolerance of the points"},
    {"PAINT", Use::kIgnored, "display"},
    {"PPFUN", Use::kPassed, "function of a post"},
    {"PPWORD", Use::kIgnored, "vocabulary"},
    {"PREFUN", Use::kRead, "G code", ParsePreparatory},
    {"RAPID", Use::kRead, "the next motion is a rapid", ParseRapid},
    {"RESET", Use::kPassed, "of the machine"},
    {"RETRCT", Use::kPassed, "retract to the clearance plane"},
    {"REWIND", Use::kPassed, "rewind"},
    {"ROTABL", Use::kPassed, "turns a table"},
    {"ROTATE", Use::kPassed, "turns a table or a head"},
    {"ROTHED", Use::kPassed, "turns a head"},
    {"ROTSYS", Use::kRefused, kMoves},
    {"SAFETY", Use::kPassed, "safe position"},
    {"SELECT", Use::kRead, "the next tool", ParseSelect},
    {"SEQNO", Use::kPassed, "block numbers"},
    {"SET", Use::kPassed, "state of the post"},
    {"SPINDL", Use::kRead, "spindle", ParseSpindle},
    {"STOP", Use::kRead, "program stop", ParseStop},
    {"SWITCH", Use::kPassed, "of the machine"},
    {"THREAD", Use::kRefused, "cuts a thread in turning"},
    {"TLAXIS", Use::kRefused, kCompiler},
    {"TLCOMP", Use::kRefused, "is compensation of a system that is not known"},
    {"TLDATA", Use::kRead, "shape of a tool", ParseToolData},
    {"TMARK", Use::kPassed, "mark of a tape"},
    {"TOLER", Use::kIgnored, "tolerance of the points"},
    {"TOOL PATH", Use::kRead, "begin of an operation", ParseOperationBegin},
    {"TRACUT", Use::kRefused, kMoves},
    {"TRANS", Use::kRefused, kMoves},
    {"TRNTYP", Use::kIgnored, "how CSYS is to be taken"},
    {"TURRET", Use::kRead, "tool change", ParseLoadTool},
    {"ULOCKX", Use::kPassed, "of the machine"},
    {"UNIT", Use::kRead, "unit of lengths", ParseUnits},
    {"UNITS", Use::kRead, "unit of lengths", ParseUnits},
    {"UNLOAD", Use::kPassed, "tool out of the spindle"},
};

}  // namespace

std::string_view ToString(ClWord::Use use) {
  switch (use) {
    case Use::kRead:
      return "read";
    case Use::kPassed:
      return "passed on";
    case Use::kIgnored:
      return "no effect";
    case Use::kRefused:
      break;
  }
  return "refused";
}

std::span<const ClWord> ClWords() { return kWords; }

const ClWord* FindClWord(std::string_view major) {
  const auto at =
      std::lower_bound(std::begin(kWords), std::end(kWords), major,
                       [](const ClWord& word, std::string_view name) { return word.major < name; });
  return at != std::end(kWords) && at->major == major ? at : nullptr;
}

}  // namespace ncsim::post
