// SPDX-License-Identifier: BSD-3-Clause
// The lines of a cutter-location file as statements: `MAJOR/minor,value,...`. Blanks are free
// around the separators, not inside numbers; `$$` begins a comment, `$` at the end of a line goes
// on in the next, case does not matter. `$$->` and `REMARK ->` are comments that carry data (Creo).
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "sim/base/diagnostics.h"
#include "sim/base/finding.h"
#include "sim/nc/program.h"

namespace ncsim::post {

/// The pages of what is read are given back in pieces of this size.
inline constexpr std::size_t kReleaseBytes = std::size_t{4} << 20;

/// What stands between two separators. Points into the text of the program.
struct ClToken {
  std::string_view text;  ///< Without blanks around it; may be empty.
  bool is_number = false;
  double number = 0.0;  ///< Finite.
  int line = 0, column = 0;
};

struct ClLine {
  enum class Kind : std::uint8_t {
    kStatement,
    kText,     ///< PARTNO, INSERT, PPRINT, ...: `text` is taken literally.
    kNumbers,  ///< No major word: one more point.
    kComment,  ///< $$
    kData,     ///< $$-> and REMARK ->
    kBroken,   ///< Reported already.
  } kind = Kind::kStatement;
  int line = 0, column = 0;     ///< Of its first character.
  std::string major;            ///< Upper case, blanks inside folded to one: "TOOL PATH".
  std::string_view text;        ///< What follows the major word and its slash on the first line.
  std::vector<ClToken> tokens;  ///< Of what follows, over all lines. Empty for kText and kComment.
};

class ClText {
 public:
  /// Trouble with the text itself goes to `diagnostics`.
  ClText(std::shared_ptr<const nc::Program> program, Diagnostics* diagnostics);
  /// The next line that is not blank; false at the end. `line` is used again: its memory stays.
  bool Next(ClLine* line);
  int lines() const { return line_; }  ///< Read so far.

 private:
  std::string_view NextRaw();
  void ReadStatement(std::string_view raw, std::string_view rest, ClLine* line);
  void ReadTokens(std::string_view raw, std::string_view rest, bool goes_on, ClLine* line);
  void Error(std::string_view raw, std::string_view at, const std::string& message, ClLine* line);

  std::shared_ptr<const nc::Program> program_;
  Diagnostics* diagnostics_;
  std::size_t offset_ = 0;
  std::size_t released_ = 0;
  int line_ = 0;
};

/// `text` in quotes for a message: what is not printable ASCII as '?', no longer than 40
/// characters.
std::string Quoted(std::string_view text);

}  // namespace ncsim::post
