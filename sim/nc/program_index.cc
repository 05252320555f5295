// SPDX-License-Identifier: BSD-3-Clause
#include "sim/nc/program_index.h"

#include <algorithm>
#include <limits>
#include <string_view>
#include <tuple>

#include "sim/nc/scanner.h"

namespace ncsim::nc {
namespace {

/// What a line begins with, as far as finding it goes; ParseBlock() judges it.
struct LineHead {
  bool mark = false;      ///< `%`
  long sequence = -1;     ///< N
  long program = -1;      ///< O
  bool has_more = false;  ///< Something else that is no comment.
};

void SkipComment(Scanner* scanner) {
  while (!scanner->AtEnd() && scanner->Peek() != ')') scanner->Advance();
  if (!scanner->AtEnd()) scanner->Advance();
}

LineHead ReadHead(Scanner* scanner) {
  LineHead head;
  while (true) {
    scanner->SkipSpaces();
    if (scanner->AtEnd()) return head;
    const char c = Upper(scanner->Peek());
    if (c == '(') {
      SkipComment(scanner);
    } else if (c == '%') {
      head.mark = true;
      return head;
    } else if (c == '/' || c == ';') {
      scanner->Advance();
    } else if (c == 'N' && head.sequence < 0 && head.program < 0) {
      scanner->Advance();
      head.sequence = scanner->ReadDigits();
      if (head.sequence < 0) break;
    } else if (c == 'O' && head.program < 0) {
      scanner->Advance();
      head.program = scanner->ReadDigits();
      if (head.program < 0) break;
    } else {
      break;
    }
  }
  head.has_more = true;
  return head;
}

}  // namespace

ProgramIndex::ProgramIndex(const Program& program) {
  const std::string_view text = program.text();
  ProgramRange current;
  current.begin = {program.begin(), 1};
  bool has_content = false;
  const auto close = [&](std::size_t end) {
    if (!has_content && current.number < 0) return;
    current.end = end;
    programs_.push_back(current);
  };
  TextPosition at = current.begin;
  std::size_t release = 0;
  constexpr std::size_t kReleaseStep = std::size_t{4} << 20;
  while (at.offset < text.size()) {
    Scanner scanner(text, at.offset);
    const LineHead head = ReadHead(&scanner);
    scanner.SkipToLineEnd();
    scanner.SkipLineEnd();
    if (head.mark || (head.program >= 0 && (has_content || current.number >= 0))) {
      close(at.offset);
      has_content = false;
      current.number = -1;
      current.begin = at;
      if (head.mark) current.begin = {at.offset + scanner.consumed(), at.line + 1};
    }
    if (head.program >= 0) current.number = head.program;
    if (head.sequence >= 0) {
      labels_.push_back({static_cast<std::uint32_t>(head.sequence), at.line, at.offset});
    }
    has_content = has_content || head.has_more || head.sequence >= 0;
    at.offset += scanner.consumed();
    ++at.line;
    if (at.offset - release > kReleaseStep) {
      release = at.offset;
      program.Release(release);
    }
  }
  close(text.size());
  if (programs_.empty()) programs_.push_back({-1, {program.begin(), 1}, text.size()});
  std::sort(labels_.begin(), labels_.end(), [](const Label& a, const Label& b) {
    return std::tie(a.number, a.offset) < std::tie(b.number, b.offset);
  });
}

const ProgramRange* ProgramIndex::FindProgram(long number) const {
  for (const ProgramRange& range : programs_) {
    if (range.number == number) return &range;
  }
  return nullptr;
}

const ProgramRange& ProgramIndex::ProgramAt(std::size_t offset) const {
  const auto after = std::upper_bound(
      programs_.begin(), programs_.end(), offset,
      [](std::size_t value, const ProgramRange& range) { return value < range.begin.offset; });
  return after == programs_.begin() ? *after : *(after - 1);
}

ProgramIndex::Search ProgramIndex::FindBlock(long number, const ProgramRange& range,
                                             std::size_t from, TextPosition* position) const {
  if (number < 0 || number > std::numeric_limits<std::int32_t>::max()) return Search::kMissing;
  const auto before = [](const Label& label, const std::pair<long, std::size_t>& key) {
    return std::pair<long, std::size_t>(label.number, label.offset) < key;
  };
  const auto at = [&](std::size_t offset) {
    return std::lower_bound(labels_.begin(), labels_.end(), std::pair(number, offset), before);
  };
  const auto inside = [&](auto label) {
    return label != labels_.end() && label->number == number && label->offset < range.end;
  };
  const auto first = at(range.begin.offset);
  if (!inside(first)) return Search::kMissing;
  const auto next = at(from);
  const auto found = inside(next) ? next : first;
  *position = {found->offset, found->line};
  return inside(first + 1) ? Search::kAmbiguous : Search::kFound;
}

}  // namespace ncsim::nc
