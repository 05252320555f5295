// SPDX-License-Identifier: BSD-3-Clause
#include "sim/nc/sinumerik_index.h"

#include <algorithm>
#include <array>
#include <tuple>
#include <utility>

#include "sim/base/text.h"
#include "sim/nc/sinumerik_token.h"

namespace ncsim::nc {
namespace {

using PartKind = SinumerikPartKind;

/// NC programming 12/2019, "Control structures".
constexpr std::size_t kMaxNesting = 16;

constexpr std::array<std::string_view, 12> kStructures = {
    "IF",       "ELSE", "ENDIF",   "FOR",    "ENDFOR", "WHILE",
    "ENDWHILE", "LOOP", "ENDLOOP", "REPEAT", "UNTIL",  "ENDLABEL"};

/// What a line begins with, as far as finding it goes; ParseSinumerikBlock() judges it.
struct BlockHead {
  bool header = false;
  long number = -1;
  std::string_view label;
  bool structure = false;  ///< A word of a control structure stands first.
};

BlockHead ReadBlockHead(Scanner* scanner) {
  BlockHead head;
  scanner->SkipSpaces();
  if (scanner->Peek() == '%') {
    head.header = true;
    return head;
  }
  if (scanner->Peek() == '/') {
    scanner->Advance();
    scanner->ReadDigits();
    scanner->SkipSpaces();
  }
  const char c = Upper(scanner->Peek());
  if ((c == 'N' || c == ':') && IsDigit(scanner->PeekAfter(1))) {
    scanner->Advance();
    head.number = scanner->ReadDigits();
    scanner->SkipSpaces();
  }
  std::string_view name = PeekName(*scanner);
  if (!name.empty() && name[0] != '$' && scanner->PeekAfter(name.size()) == ':') {
    head.label = name;
    scanner->Advance(name.size() + 1);
    scanner->SkipSpaces();
    name = PeekName(*scanner);
  }
  if (name.size() < 2 || name.size() > 8) return head;
  for (const std::string_view structure : kStructures) {
    head.structure = head.structure || SameName(name, structure);
  }
  return head;
}

/// "_N_SHAFT123_MPF" -> "SHAFT123".
SinumerikSection SectionOf(std::string_view header) {
  SinumerikSection section;
  section.name = UpperName(header);
  if (section.name.rfind("_N_", 0) == 0) section.name.erase(0, 3);
  const std::size_t size = section.name.size();
  if (size >= 4 && section.name[size - 4] == '_') {
    section.is_main = section.name.compare(size - 4, 4, "_MPF") == 0;
    section.name.erase(size - 4);
  }
  return section;
}

/// The kind that ends what `kind` begins.
PartKind EndOf(PartKind kind) {
  switch (kind) {
    case PartKind::kIf:
      return PartKind::kEndIf;
    case PartKind::kFor:
      return PartKind::kEndFor;
    case PartKind::kWhile:
      return PartKind::kEndWhile;
    case PartKind::kLoop:
      return PartKind::kEndLoop;
    default:
      return PartKind::kUntil;
  }
}

bool Begins(PartKind kind) {
  return kind == PartKind::kIf || kind == PartKind::kFor || kind == PartKind::kWhile ||
         kind == PartKind::kLoop || kind == PartKind::kRepeat;
}

bool Ends(PartKind kind) {
  return kind == PartKind::kEndIf || kind == PartKind::kEndFor || kind == PartKind::kEndWhile ||
         kind == PartKind::kEndLoop || kind == PartKind::kUntil;
}

SinumerikPartner Failed(int alarm, std::string text) {
  SinumerikPartner partner;
  partner.error = AlarmText(alarm, std::move(text));
  return partner;
}

}  // namespace

SinumerikIndex::SinumerikIndex(const Program& program) {
  constexpr std::size_t kReleaseStep = std::size_t{4} << 20;
  const std::string_view text = program.text();
  TextPosition at = {program.begin(), 1};
  sections_.push_back({});
  sections_.back().begin = at;
  std::size_t release = 0;
  while (at.offset < text.size()) {
    AddLine(program, at);
    Scanner scanner(text, at.offset);
    scanner.SkipToLineEnd();
    scanner.SkipLineEnd();
    at.offset += scanner.consumed();
    ++at.line;
    if (at.offset - release > kReleaseStep) {
      release = at.offset;
      program.Release(release);
    }
  }
  Close(text.size());
  std::sort(numbers_.begin(), numbers_.end(), [](const Place& a, const Place& b) {
    return std::tie(a.number, a.offset) < std::tie(b.number, b.offset);
  });
}

void SinumerikIndex::AddLine(const Program& program, TextPosition at) {
  Scanner scanner(program.text(), at.offset);
  const BlockHead head = ReadBlockHead(&scanner);
  if (head.header) {
    ParseSinumerikBlock(program, at.offset, at.line, &block_);
    // What stands before the first header is no program, unless there is something in it.
    Close(at.offset);
    if (at.offset == program.begin()) sections_.clear();
    sections_.push_back(SectionOf(block_.header));
    sections_.back().begin = {block_.next, at.line + 1};
    return;
  }
  if (head.number >= 0) {
    numbers_.push_back({static_cast<std::uint32_t>(head.number), at.line, at.offset});
  }
  if (!head.label.empty()) labels_[UpperName(head.label)].push_back({0, at.line, at.offset});
  if (!head.structure) return;
  ParseSinumerikBlock(program, at.offset, at.line, &block_);
  if (block_.parts.empty()) return;
  const PartKind kind = block_.parts.front().kind;
  if (kind == PartKind::kEndLabel) labels_["ENDLABEL"].push_back({0, at.line, at.offset});
  AddStructure(kind, at);
}

void SinumerikIndex::AddStructure(PartKind kind, TextPosition at) {
  if (Begins(kind)) {
    if (open_.size() >= kMaxNesting) {
      partners_[at.offset] = Failed(12641, "control structures are nested deeper than 16 levels");
    }
    open_.push_back({kind, at, std::nullopt});
  } else if (kind == PartKind::kElse) {
    if (open_.empty() || open_.back().kind != PartKind::kIf || open_.back().else_block) {
      partners_[at.offset] = Failed(12640, "ELSE without its IF");
      return;
    }
    open_.back().else_block = at;
  } else if (Ends(kind)) {
    if (open_.empty() || EndOf(open_.back().kind) != kind) {
      partners_[at.offset] = Failed(12640, "the end of a control structure without its begin");
      return;
    }
    const Open open = open_.back();
    open_.pop_back();
    SinumerikPartner begin;
    begin.other = at;
    begin.else_block = open.else_block;
    SinumerikPartner end;
    end.other = open.at;
    partners_.emplace(open.at.offset, begin);  // Keeps an error that stands there.
    partners_.emplace(at.offset, end);
    if (!open.else_block) return;
    SinumerikPartner middle;
    middle.other = at;
    partners_.emplace(open.else_block->offset, middle);
  }
}

/// At the end of a program.
void SinumerikIndex::Close(std::size_t end) {
  for (const Open& open : open_) {
    partners_[open.at.offset] = Failed(12640, "the control structure has no end");
    if (open.else_block) {
      partners_[open.else_block->offset] = Failed(12640, "the control structure has no end");
    }
  }
  open_.clear();
  sections_.back().end = end;
}

const SinumerikSection* SinumerikIndex::Find(std::string_view name) const {
  if (name.empty()) return nullptr;
  for (const SinumerikSection& section : sections_) {
    if (section.name == name) return &section;
  }
  return nullptr;
}

const SinumerikSection& SinumerikIndex::SectionAt(std::size_t offset) const {
  const auto after = std::upper_bound(sections_.begin(), sections_.end(), offset,
                                      [](std::size_t value, const SinumerikSection& section) {
                                        return value < section.begin.offset;
                                      });
  return after == sections_.begin() ? *after : *(after - 1);
}

std::span<const SinumerikIndex::Place> SinumerikIndex::Places(std::string_view label) const {
  const bool is_number =
      label.size() > 1 && IsDigit(label[1]) && (Upper(label[0]) == 'N' || label[0] == ':');
  if (!is_number) {
    const auto found = labels_.find(UpperName(label));
    if (found == labels_.end()) return {};
    return found->second;
  }
  Scanner scanner(label, 1);
  const long number = scanner.ReadDigits();
  if (number < 0 || !scanner.AtEnd()) return {};
  const auto key = static_cast<std::uint32_t>(number);
  const auto first = std::lower_bound(
      numbers_.begin(), numbers_.end(), key,
      [](const Place& place, std::uint32_t value) { return place.number < value; });
  const auto last = std::upper_bound(
      first, numbers_.end(), key,
      [](std::uint32_t value, const Place& place) { return value < place.number; });
  return {first, last};
}

std::optional<TextPosition> SinumerikIndex::FindForward(std::string_view label, std::size_t from,
                                                        std::size_t end) const {
  const std::span<const Place> places = Places(label);
  const auto found = std::lower_bound(places.begin(), places.end(), from, IsBefore);
  if (found == places.end() || found->offset >= end) return std::nullopt;
  return TextPosition{found->offset, found->line};
}

std::optional<TextPosition> SinumerikIndex::FindBackward(std::string_view label, std::size_t begin,
                                                         std::size_t from) const {
  const std::span<const Place> places = Places(label);
  const auto after = std::lower_bound(places.begin(), places.end(), from, IsBefore);
  if (after == places.begin() || (after - 1)->offset < begin) return std::nullopt;
  return TextPosition{(after - 1)->offset, (after - 1)->line};
}

const SinumerikPartner* SinumerikIndex::Partner(std::size_t offset) const {
  const auto found = partners_.find(offset);
  return found == partners_.end() ? nullptr : &found->second;
}

}  // namespace ncsim::nc
