// SPDX-License-Identifier: BSD-3-Clause
#include "sim/report/printable.h"

#include <algorithm>

namespace ncsim::report {
namespace {

bool IsContinuation(char c) { return (static_cast<unsigned char>(c) & 0xC0U) == 0x80U; }

/// Bytes of the valid multi-byte sequence that starts at `i`, or 0. The second byte's range shuts
/// out overlong forms, surrogates and C1 controls (Unicode 15, table 3-7).
std::size_t SequenceLength(std::string_view text, std::size_t i) {
  const auto byte = [&](std::size_t k) {
    return i + k < text.size() ? static_cast<unsigned>(static_cast<unsigned char>(text[i + k]))
                               : 0U;
  };
  const unsigned lead = byte(0), second = byte(1);
  std::size_t length = 0;
  unsigned low = 0x80, high = 0xBF;
  if (lead >= 0xC2 && lead <= 0xDF) {
    length = 2;
    if (lead == 0xC2) low = 0xA0;
  } else if (lead >= 0xE0 && lead <= 0xEF) {
    length = 3;
    if (lead == 0xE0) low = 0xA0;
    if (lead == 0xED) high = 0x9F;
  } else if (lead >= 0xF0 && lead <= 0xF4) {
    length = 4;
    if (lead == 0xF0) low = 0x90;
    if (lead == 0xF4) high = 0x8F;
  }
  if (length == 0 || i + length > text.size() || second < low || second > high) return 0;
  if (lead == 0xEF && second == 0xBF && byte(2) >= 0xBE) return 0;  // No characters: U+FFFE, FFFF.
  for (std::size_t k = 2; k < length; ++k) {
    if (!IsContinuation(text[i + k])) return 0;
  }
  return length;
}

}  // namespace

std::string Printable(std::string_view text) {
  std::string result;
  result.reserve(text.size());
  for (std::size_t i = 0; i < text.size();) {
    const auto byte = static_cast<unsigned char>(text[i]);
    std::size_t length = 1;
    if (byte < 0x80) {
      result.push_back((byte >= 0x20 && byte != 0x7F) || byte == '\t' ? text[i] : '?');
    } else if ((length = SequenceLength(text, i)) > 0) {
      result.append(text, i, length);
    } else {
      length = 1;
      result.push_back('?');
    }
    i += length;
  }
  return result;
}

std::string Markup(std::string_view text) {
  std::string escaped;
  for (const char c : Printable(text)) {
    switch (c) {
      case '&':
        escaped += "&amp;";
        break;
      case '<':
        escaped += "&lt;";
        break;
      case '>':
        escaped += "&gt;";
        break;
      case '"':
        escaped += "&quot;";
        break;
      default:
        escaped += c;
    }
  }
  return escaped;
}

std::vector<std::string> PrintableLines(std::string_view text) {
  std::vector<std::string> lines;
  while (!text.empty()) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    if (end > 0) lines.push_back(Printable(text.substr(0, end)));
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  return lines;
}

std::string LineWithCaret(std::string_view line, int column, std::size_t width) {
  const std::size_t at =
      std::min(line.size(), column > 0 ? static_cast<std::size_t>(column) - 1 : std::size_t{0});
  std::size_t begin = 0, end = line.size();
  if (line.size() > width) {
    begin = at > width / 2 ? at - width / 2 : 0;
    begin = std::min(begin, line.size() - width);
    end = begin + width;
  }
  const std::string_view before = begin > 0 ? "..." : "";
  const std::string lead = Printable(line.substr(begin, at - begin));
  std::string text = "  ";
  text.append(before).append(lead).append(Printable(line.substr(at, end - at)));
  text.append(end < line.size() ? "...\n" : "\n").append("  ").append(before.size(), ' ');
  for (const char c : lead) {
    if (!IsContinuation(c)) text.push_back(c == '\t' ? '\t' : ' ');
  }
  return text + "^\n";
}

}  // namespace ncsim::report
