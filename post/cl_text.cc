// SPDX-License-Identifier: BSD-3-Clause
#include "post/cl_text.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <utility>

#include "sim/base/text.h"

namespace ncsim::post {
namespace {

/// Of one statement; the longest of any manual has some forty.
constexpr std::size_t kMaxTokens = 1000;
/// Beyond it no number of a part or a machine lies, and products of some stay finite.
constexpr double kMaxNumber = 1e12;
/// What follows these is taken literally.
constexpr std::array<std::string_view, 6> kTextWords = {"INSERT", "LETTER", "PARTNO",
                                                        "PPRINT", "REMARK", "TITLES"};

bool IsBlank(char c) { return c == ' ' || c == '\t' || c == '\v' || c == '\f'; }

/// Of blanks alone what is left is empty, and stands at their end.
std::string_view Trim(std::string_view text) {
  while (!text.empty() && IsBlank(text.front())) text.remove_prefix(1);
  while (!text.empty() && IsBlank(text.back())) text.remove_suffix(1);
  return text;
}

bool IsWordCharacter(char c) { return IsDigit(c) || IsLetter(c) || c == '_' || c == '-'; }

/// Upper case, with one blank for several.
void SetMajor(std::string_view text, std::string* major) {
  major->clear();
  for (const char c : Trim(text)) {
    const bool blank = IsBlank(c);
    if (blank && major->back() == ' ') continue;
    *major += blank ? ' ' : Upper(c);
  }
}

bool ReadNumber(std::string_view text, double* number) {
  std::string_view digits = text;
  if (!digits.empty() && digits[0] == '+') digits.remove_prefix(1);
  // from_chars() would take "nan" and "inf" too.
  const std::size_t first = digits.substr(0, 1) == "-" ? 1 : 0;
  if (first >= digits.size() || !(IsDigit(digits[first]) || digits[first] == '.')) return false;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), *number);
  return error == std::errc() && end == digits.data() + digits.size() &&
         std::abs(*number) <= kMaxNumber;
}

/// Cuts a comment and a continuation off; sets whether there is one.
std::string_view CutEnd(std::string_view text, bool* goes_on, std::string_view* after) {
  *goes_on = false;
  *after = {};
  const std::size_t dollar = text.find('$');
  if (dollar == std::string_view::npos) return text;
  *goes_on = text.substr(dollar, 2) != "$$";
  if (*goes_on) *after = Trim(text.substr(dollar + 1));
  return text.substr(0, dollar);
}

}  // namespace

std::string Quoted(std::string_view text) {
  constexpr std::size_t kLongest = 40;
  std::string quoted = "'";
  for (const char c : text.substr(0, kLongest)) quoted += c >= ' ' && c <= '~' ? c : '?';
  return quoted + (text.size() > kLongest ? "...'" : "'");
}

ClText::ClText(std::shared_ptr<const nc::Program> program, Diagnostics* diagnostics)
    : program_(std::move(program)), diagnostics_(diagnostics), offset_(program_->begin()) {}

std::string_view ClText::NextRaw() {
  const std::string_view text = program_->text();
  const std::string_view raw = program_->Line(offset_);
  offset_ += raw.size();
  if (text.substr(offset_, 2) == "\r\n") ++offset_;
  offset_ = std::min(offset_ + 1, text.size());
  ++line_;
  if (offset_ - released_ > kReleaseBytes) {
    released_ = offset_;
    program_->Release(released_);
  }
  return raw;
}

void ClText::Error(std::string_view raw, std::string_view at, const std::string& message,
                   ClLine* line) {
  diagnostics_->Error(program_->name(), line_, static_cast<int>(at.data() - raw.data()) + 1,
                      message);
  line->kind = ClLine::Kind::kBroken;
}

/// The tokens of one line, to the first thing that is wrong. `goes_on`: a comma at the end
/// separates what the next line begins with.
void ClText::ReadTokens(std::string_view raw, std::string_view rest, bool goes_on, ClLine* line) {
  while (true) {
    const std::size_t comma = rest.find(',');
    ClToken token;
    token.text = Trim(rest.substr(0, comma));
    token.line = line_;
    token.column = static_cast<int>(token.text.data() - raw.data()) + 1;
    token.is_number = ReadNumber(token.text, &token.number);
    if (line->kind != ClLine::Kind::kData &&
        std::any_of(token.text.begin(), token.text.end(), IsBlank)) {
      return Error(raw, token.text, Quoted(token.text) + " has a blank inside: a comma is missing",
                   line);
    }
    if (line->tokens.size() == kMaxTokens) {
      return Error(raw, rest,
                   "a statement of more than " + std::to_string(kMaxTokens) + " values is not read",
                   line);
    }
    line->tokens.push_back(token);
    if (comma == std::string_view::npos) return;
    rest.remove_prefix(comma + 1);
    if (goes_on && Trim(rest).empty()) return;
  }
}

/// The lines of a statement. `rest`: what follows the major word on the first one, `raw`.
void ClText::ReadStatement(std::string_view raw, std::string_view rest, ClLine* line) {
  bool separated = true;  // from the value before, by a comma
  bool goes_on = true;
  while (true) {
    std::string_view after;
    rest = CutEnd(rest, &goes_on, &after);
    // The lines of a broken statement are passed over.
    if (line->kind != ClLine::Kind::kBroken) {
      const std::string_view values = Trim(rest);
      if (!after.empty()) {
        Error(raw, after, Quoted(after) + " after the '$' that continues the statement", line);
      } else if (!separated && !values.empty() && values[0] != ',') {
        Error(raw, values, "a comma is missing between the lines", line);
      } else if (!values.empty()) {
        ReadTokens(raw, separated ? rest : values.substr(1), goes_on, line);
        separated = values.back() == ',';
      } else if (!goes_on && separated && !line->tokens.empty()) {
        Error(raw, values, "nothing follows the comma of the line before", line);
      }
    }
    if (!goes_on) return;
    if (offset_ >= program_->text().size()) {
      return Error(raw, raw.substr(raw.size()), "the file ends where a statement goes on", line);
    }
    rest = raw = NextRaw();
  }
}

bool ClText::Next(ClLine* line) {
  std::string_view raw, text;
  do {
    if (offset_ >= program_->text().size()) return false;
    raw = NextRaw();
    text = Trim(raw);
  } while (text.empty());
  line->kind = ClLine::Kind::kStatement;
  line->line = line_;
  line->column = static_cast<int>(text.data() - raw.data()) + 1;
  line->major.clear();
  line->text = {};
  line->tokens.clear();

  std::size_t word = 0;
  while (word < text.size() && IsWordCharacter(text[word])) ++word;
  bool data = text.substr(0, 4) == "$$->";
  if (data) {
    text.remove_prefix(4);
  } else if (text.substr(0, 2) == "$$") {
    line->kind = ClLine::Kind::kComment;
    line->text = Trim(text.substr(2));
    return true;
  } else {
    SetMajor(text.substr(0, word), &line->major);
    if (std::find(kTextWords.begin(), kTextWords.end(), line->major) != kTextWords.end()) {
      line->kind = ClLine::Kind::kText;
      line->text = Trim(text.substr(word));
      data = line->major == "REMARK" && line->text.substr(0, 2) == "->";
      if (!data) {
        if (line->text.substr(0, 1) == "/") line->text = Trim(line->text.substr(1));
        return true;
      }
      text = line->text.substr(2);
    }
  }
  if (!data && (IsDigit(text[0]) || text[0] == '.' || text[0] == '-' || text[0] == '+')) {
    line->kind = ClLine::Kind::kNumbers;
    line->major.clear();
    ReadStatement(raw, text, line);
    return true;
  }
  if (data) line->kind = ClLine::Kind::kData;
  const std::size_t end = std::min(text.find_first_of("/$"), text.size());
  SetMajor(text.substr(0, end), &line->major);
  const bool slash = text.substr(end, 1) == "/";
  std::string_view rest = text.substr(slash ? end + 1 : end);
  bool goes_on = false;
  std::string_view after;
  line->text = Trim(CutEnd(rest, &goes_on, &after));
  ReadStatement(raw, rest, line);
  return true;
}

}  // namespace ncsim::post
