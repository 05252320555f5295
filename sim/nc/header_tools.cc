// SPDX-License-Identifier: BSD-3-Clause
#include "sim/nc/header_tools.h"

#include <algorithm>
#include <charconv>
#include <optional>
#include <string_view>
#include <utility>

#include "sim/nc/scanner.h"
#include "sim/nc/sinumerik_block.h"

namespace ncsim::nc {
namespace {

constexpr int kMaxLines = 10000;
constexpr std::size_t kMaxTools = 1000;

std::string_view Trim(std::string_view text) {
  while (!text.empty() && IsSpace(text.front())) text.remove_prefix(1);
  while (!text.empty() && IsSpace(text.back())) text.remove_suffix(1);
  return text;
}

std::vector<std::string_view> Split(std::string_view text) {
  std::vector<std::string_view> parts;
  while (true) {
    text = Trim(text);
    if (text.empty()) return parts;
    const auto space = std::find_if(text.begin(), text.end(), IsSpace);
    const auto size = static_cast<std::size_t>(space - text.begin());
    parts.push_back(text.substr(0, size));
    text.remove_prefix(size);
  }
}

/// The whole of `text`, not negative.
std::optional<double> ToNumber(std::string_view text) {
  double value = 0.0;
  const auto [end, error] =
      std::from_chars(text.data(), text.data() + text.size(), value, std::chars_format::fixed);
  const bool whole = error == std::errc() && end == text.data() + text.size();
  if (!whole || !(value >= 0.0 && value <= kMaxNumber)) return std::nullopt;
  return value;
}

std::optional<int> ToToolNumber(std::string_view text) {
  const auto digit = [](char c) { return IsDigit(c); };
  if (text.empty() || text.size() > 8 || !std::all_of(text.begin(), text.end(), digit)) {
    return std::nullopt;
  }
  return static_cast<int>(*ToNumber(text));
}

/// `1  BALL_MILL  0.236  0` under the headings `TOOL-NO. TOOL-NAME DIAMETER OFFSET`. A number's
/// heading is found by counting from the right, since names have spaces.
std::optional<HeaderTool> ReadSummaryRow(std::string_view comment,
                                         const std::vector<std::string>& headings) {
  const std::vector<std::string_view> parts = Split(comment);
  if (parts.size() < headings.size() || headings.size() < 3) return std::nullopt;
  const std::optional<int> number = ToToolNumber(parts[0]);
  if (!number) return std::nullopt;
  HeaderTool tool;
  tool.number = *number;
  bool has_diameter = false;
  const std::size_t columns = headings.size() - 2;
  const std::size_t first = parts.size() - columns;
  for (std::size_t i = 1; i < first; ++i) {
    if (i > 1) tool.name += ' ';
    tool.name += parts[i];
  }
  for (std::size_t i = 0; i < columns; ++i) {
    const std::string& heading = headings[i + 2];
    const std::optional<double> value = ToNumber(parts[first + i]);
    if (!value) continue;
    if (heading.find("DIA") != std::string::npos) {
      tool.diameter = *value;
      has_diameter = true;
    } else if (heading.find("COR") != std::string::npos) {
      tool.corner_radius = *value;
      tool.has_corner_radius = true;
    }
  }
  if (!has_diameter) return std::nullopt;
  return tool;
}

/// `T1 D=0.5 CR=0.25 TAPER=118deg - ZMIN=-0.45 - ball end mill`.
std::optional<HeaderTool> ReadAutodeskLine(std::string_view comment) {
  comment = Trim(comment);
  if (comment.size() < 2 || Upper(comment[0]) != 'T') return std::nullopt;
  const std::vector<std::string_view> parts = Split(comment.substr(1));
  if (parts.empty()) return std::nullopt;
  const std::optional<int> number = ToToolNumber(parts[0]);
  if (!number) return std::nullopt;
  HeaderTool tool;
  tool.number = *number;
  bool has_diameter = false;
  for (const std::string_view part : parts) {
    const std::size_t equals = part.find('=');
    if (equals == std::string_view::npos) continue;
    const std::string key = Upper(part.substr(0, equals));
    const std::optional<double> value = ToNumber(part.substr(equals + 1));
    if (!value) continue;
    if (key == "D") {
      tool.diameter = *value;
      has_diameter = true;
    } else if (key == "CR") {
      tool.corner_radius = *value;
      tool.has_corner_radius = true;
    }
  }
  if (!has_diameter) return std::nullopt;
  const std::size_t last = comment.rfind(" - ");
  if (last != std::string_view::npos) {
    const std::string_view name = Trim(comment.substr(last + 3));
    if (name.find('=') == std::string_view::npos) tool.name = std::string(name);
  }
  return tool;
}

bool MovesAnAxis(const Block& block) {
  return std::any_of(block.words.begin(), block.words.end(), [](const Word& word) {
    return std::string_view("XYZABCUVW").find(word.address) != std::string_view::npos;
  });
}

class HeaderReader {
 public:
  void Read(std::string_view comment, int line) {
    const std::string upper = Upper(comment);
    if (upper.find("END OF TOOL TABLE") != std::string::npos) {
      in_table_ = false;
    } else if (upper.find("TOOL TABLE") != std::string::npos) {
      in_table_ = true;
      headings_.clear();
    } else if (in_table_ && headings_.empty()) {
      ReadHeadings(upper);
    } else {
      Add(in_table_ ? ReadSummaryRow(comment, headings_) : ReadAutodeskLine(comment), line);
    }
  }
  std::vector<HeaderTool> Take() { return std::move(tools_); }

 private:
  void ReadHeadings(const std::string& upper) {
    for (const std::string_view heading : Split(upper)) headings_.emplace_back(heading);
    const bool known = headings_.size() >= 3 && headings_[0].find("TOOL") == 0;
    if (!known) headings_.clear();
  }

  /// The first line about a tool counts; some posts repeat it at every operation.
  void Add(std::optional<HeaderTool> tool, int line) {
    if (!tool || tools_.size() >= kMaxTools) return;
    for (const HeaderTool& known : tools_) {
      if (known.number == tool->number) return;
    }
    tool->line = line;
    tools_.push_back(std::move(*tool));
  }

  bool in_table_ = false;
  std::vector<std::string> headings_;  ///< Upper case.
  std::vector<HeaderTool> tools_;
};

/// A part of a block that gives an axis a value.
bool IsAxis(const SinumerikPart& part) {
  return std::string_view("XYZABCUVW").find(part.letter) != std::string_view::npos &&
         part.letter != 0;
}

}  // namespace

std::vector<HeaderTool> ReadSinumerikHeaderTools(const Program& program) {
  HeaderReader reader;
  SinumerikBlock block;
  std::size_t offset = program.begin();
  for (int line = 1; line <= kMaxLines && offset < program.text().size(); ++line) {
    ParseSinumerikBlock(program, offset, line, &block);
    if (std::any_of(block.parts.begin(), block.parts.end(), IsAxis)) break;
    reader.Read(block.comment, line);
    offset = block.next;
  }
  return reader.Take();
}

std::vector<HeaderTool> ReadHeaderTools(const Program& program) {
  HeaderReader reader;
  Block block;
  std::size_t offset = program.begin();
  for (int line = 1; line <= kMaxLines && offset < program.text().size(); ++line) {
    ParseBlock(program, offset, line, &block);
    if (MovesAnAxis(block)) break;
    for (const std::string_view comment : block.comments) reader.Read(comment, line);
    offset = block.next;
  }
  return reader.Take();
}

}  // namespace ncsim::nc
