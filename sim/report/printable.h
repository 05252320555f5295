// SPDX-License-Identifier: BSD-3-Clause
// Text of unknown origin on a terminal: programs carry comments in any encoding, and may be
// hostile.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace ncsim::report {

/// `text` with everything that is neither printable nor valid UTF-8 (control characters, escape
/// sequences, stray bytes) as
/// '?'. Tabs stay.
std::string Printable(std::string_view text);

/// Printable() as text of an XML or HTML element or attribute: nothing is left that XML forbids.
std::string Markup(std::string_view text);

/// The lines of `text`, each Printable(), without empty ones.
std::vector<std::string> PrintableLines(std::string_view text);

/// A source line cut to a window of at most `width` characters around `column` (from 1, in bytes),
/// with "..." where it was cut, and a second line with a caret under the column. Both are indented
/// by two blanks and end with a line end.
std::string LineWithCaret(std::string_view line, int column, std::size_t width = 100);

}  // namespace ncsim::report
