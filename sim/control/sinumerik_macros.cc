// SPDX-License-Identifier: BSD-3-Clause
#include "sim/control/sinumerik_macros.h"

#include <algorithm>
#include <array>

#include "sim/base/text.h"
#include "sim/nc/sinumerik_commands.h"
#include "sim/nc/sinumerik_token.h"

namespace ncsim::control {
namespace {

// What a program's text is searched for before it is run.
constexpr std::array<std::string_view, 21> kStructures = {
    "IF",   "ELSE",  "ENDIF",   "FOR",      "ENDFOR", "WHILE", "ENDWHILE",
    "LOOP", "UNTIL", "ENDLOOP", "REPEAT",   "CASE",   "PROC",  "REPEATB",
    "DEF",  "REDEF", "DEFINE",  "ENDLABEL", "EXTERN", "CALL",  "MCALL"};

/// The word at `at`: a name, or letters with their number (M6); "" where none begins.
std::string_view WordAt(std::string_view line, std::size_t at) {
  if (!nc::IsNameStart(line[at])) return {};
  std::size_t end = at + 1;
  const bool address = end < line.size() && IsDigit(line[end]);
  const auto goes_on = [&](char c) { return address ? IsDigit(c) : nc::IsNamePart(c); };
  while (end < line.size() && goes_on(line[end])) ++end;
  return line.substr(at, end - at);
}

bool IsStructure(std::string_view word) {
  return std::any_of(kStructures.begin(), kStructures.end(),
                     [&](std::string_view structure) { return nc::SameName(word, structure); });
}

/// Names that the control lets a macro have: its own words are no such, but M, H and L functions.
bool MayBeMacro(std::string_view name) {
  if (name.size() < 2) return false;
  const char letter = Upper(name[0]);
  if (IsDigit(name[1])) return letter == 'M' || letter == 'H' || letter == 'L';
  return nc::FindSinumerikCommand(name) == nullptr;
}

/// The line before its comment.
std::string_view WithoutComment(std::string_view line) {
  bool quoted = false;
  for (std::size_t i = 0; i < line.size(); ++i) {
    if (line[i] == '"') quoted = !quoted;
    if (line[i] == ';' && !quoted) return line.substr(0, i);
  }
  return line;
}

/// Calls `visit(word, offset)` for each word outside quotes; stops where it returns false.
template <typename Visit>
void EachWord(std::string_view line, Visit visit) {
  bool quoted = false;
  for (std::size_t i = 0; i < line.size();) {
    if (line[i] == '"') quoted = !quoted;
    const std::string_view word = quoted ? std::string_view() : WordAt(line, i);
    if (!word.empty() && !visit(word, i)) return;
    i += std::max<std::size_t>(1, word.size());
  }
}

}  // namespace

bool SinumerikMacros::Define(Scope scope, std::string_view line, std::string_view name) {
  line = WithoutComment(line);
  const auto at = static_cast<std::size_t>(name.data() - line.data());
  std::size_t body_at = std::string_view::npos;
  EachWord(line.substr(at + name.size()), [&](std::string_view word, std::size_t offset) {
    if (nc::SameName(word, "AS")) body_at = at + name.size() + offset + word.size();
    return body_at == std::string_view::npos;
  });
  const std::string key = nc::UpperName(name);
  bool plain = body_at != std::string_view::npos && MayBeMacro(name);
  const std::string_view body = plain ? line.substr(body_at) : std::string_view();
  EachWord(body, [&](std::string_view word, std::size_t) {
    plain = plain && !IsStructure(word) && bodies_.count({scope, nc::UpperName(word)}) == 0 &&
            named_.count(nc::UpperName(word)) == 0 && nc::UpperName(word) != key;
    return plain;
  });
  bool quoted = false;
  for (const char c : body) {
    if (c == '"') quoted = !quoted;
    if (c == ':' && !quoted) plain = false;  // A label, or a chain of frames.
  }
  if (plain) {
    bodies_[{scope, key}] = " " + std::string(body) + " ";
  } else {
    named_.insert(key);
  }
  return plain;
}

bool SinumerikMacros::IsNamedOnly(std::string_view name) const {
  return named_.count(nc::UpperName(name)) != 0;
}

std::optional<SinumerikMacros::Expanded> SinumerikMacros::Expand(Scope scope,
                                                                 std::string_view line) const {
  if (bodies_.empty()) return std::nullopt;
  Expanded expanded;
  bool found = false, defines = false;
  std::size_t done = 0;
  const auto copy_to = [&](std::size_t end) {
    for (; done < end; ++done) {
      expanded.line += line[done];
      expanded.columns.push_back(static_cast<int>(done) + 1);
    }
  };
  EachWord(WithoutComment(line), [&](std::string_view word, std::size_t at) {
    defines = defines || nc::SameName(word, "DEFINE");
    const auto macro = bodies_.find({scope, nc::UpperName(word)});
    if (macro == bodies_.end() || defines) return !defines;
    found = true;
    copy_to(at);
    expanded.line += macro->second;
    expanded.columns.resize(expanded.line.size(), static_cast<int>(at) + 1);
    done = at + word.size();
    return true;
  });
  if (!found || defines) return std::nullopt;
  copy_to(line.size());
  return expanded;
}

}  // namespace ncsim::control
