// SPDX-License-Identifier: BSD-3-Clause
// The major words of a cutter-location file: the one table of what is read, passed on, of no
// effect, and refused. docs/cl-files.md is held against it.
#pragma once

#include <optional>
#include <span>
#include <string_view>

#include "post/cl_arguments.h"
#include "post/cl_record.h"

namespace ncsim::post {

struct ClWord {
  enum class Use {
    kRead,     ///< By `parse`.
    kPassed,   ///< Handed to the post as it is written.
    kIgnored,  ///< Of no effect on the motion.
    kRefused,  ///< Known, and an error: `meaning` says why.
  };
  std::string_view major;
  Use use;
  std::string_view meaning;
  ClStatement (*parse)(ClArguments&) = nullptr;
};

/// "read", "passed on", "no effect", "refused"
std::string_view ToString(ClWord::Use use);

/// In alphabetic order.
std::span<const ClWord> ClWords();
/// Null for a word that is not in the table.
const ClWord* FindClWord(std::string_view major);

// The parse functions of the table. cl_words_motion.cc:
ClStatement ParseCircle(ClArguments& arguments);
ClStatement ParseCsys(ClArguments& arguments);
ClStatement ParseDelay(ClArguments& arguments);
ClStatement ParseFeed(ClArguments& arguments);
ClStatement ParseFrom(ClArguments& arguments);
ClStatement ParseGoDelta(ClArguments& arguments);
ClStatement ParseGoHome(ClArguments& arguments);
ClStatement ParseGoto(ClArguments& arguments);
ClStatement ParseMsys(ClArguments& arguments);
ClStatement ParseMultiAxis(ClArguments& arguments);
ClStatement ParseOperationBegin(ClArguments& arguments);
ClStatement ParsePoint(ClArguments& arguments);
ClStatement ParseRapid(ClArguments& arguments);
ClStatement ParseUnits(ClArguments& arguments);
// cl_words_machine.cc:
ClStatement ParseAuxiliary(ClArguments& arguments);
ClStatement ParseCoolant(ClArguments& arguments);
ClStatement ParseCutter(ClArguments& arguments);
ClStatement ParseCutterComp(ClArguments& arguments);
ClStatement ParseLoad(ClArguments& arguments);
ClStatement ParseLoadTool(ClArguments& arguments);
ClStatement ParsePreparatory(ClArguments& arguments);
ClStatement ParseSelect(ClArguments& arguments);
ClStatement ParseSpindle(ClArguments& arguments);
ClStatement ParseToolData(ClArguments& arguments);
// cl_words_cycle.cc:
ClStatement ParseCycle(ClArguments& arguments);

/// MMPM, IPM, MMPR, IPR, PERMIN, PERREV: takes it where it is the next value.
std::optional<ClFeedUnit> TakeFeedUnit(ClArguments& arguments);

}  // namespace ncsim::post
