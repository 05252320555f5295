// SPDX-License-Identifier: BSD-3-Clause
#include "post/cl_flavour.h"

#include <algorithm>
#include <array>
#include <utility>

#include "post/cl_text.h"
#include "sim/base/text.h"

namespace ncsim::post {
namespace {

struct Sign {
  std::string_view begin;  ///< Of a line, upper case.
  ClFlavour flavour;
};
constexpr std::array<Sign, 12> kSigns = {{{"TOOL PATH", ClFlavour::kNx},
                                          {"END-OF-PATH", ClFlavour::kNx},
                                          {"TLDATA", ClFlavour::kNx},
                                          {"MSYS", ClFlavour::kNx},
                                          {"PPWORD", ClFlavour::kCreo},
                                          {"$$->", ClFlavour::kCreo},
                                          {"REMARK ->", ClFlavour::kCreo},
                                          {"TRNTYP", ClFlavour::kSolidWorksCam},
                                          {"CSI_SET_", ClFlavour::kSolidWorksCam},
                                          {"CYCLE/INIT", ClFlavour::kSolidWorksCam},
                                          {"CYCLE/DEEP2", ClFlavour::kSolidWorksCam},
                                          {"CYCLE/CLEAR", ClFlavour::kSolidWorksCam}}};
constexpr std::string_view kCreoName = "PRO/CLFILE";

/// `text` from its first character that is no blank, upper case, with one blank for several and
/// none around separators; no longer than needed to compare.
std::string Squeezed(std::string_view text) {
  constexpr std::size_t kLongest = 400;
  std::string out;
  bool blank = false;
  for (const char c : text.substr(0, kLongest)) {
    if (c == ' ' || c == '\t') {
      blank = !out.empty() && out.back() != '/' && out.back() != ',';
      continue;
    }
    if (blank && c != '/' && c != ',') out += ' ';
    blank = false;
    out += Upper(c);
  }
  return out;
}

bool StartsWith(std::string_view text, std::string_view begin) {
  return text.substr(0, begin.size()) == begin;
}

std::string At(std::string_view word, int line) {
  return std::string(word) + " at line " + std::to_string(line);
}

/// Points, the bulk of a file, say nothing.
bool MayTell(std::string_view raw) {
  const std::size_t first = raw.find_first_not_of(" \t");
  if (first == std::string_view::npos) return false;
  return std::string_view("TEMPRCFU$").find(Upper(raw[first])) != std::string_view::npos;
}

class Surveyor {
 public:
  void Look(std::string_view raw, int line) {
    const std::string text = Squeezed(raw);
    for (const Sign& sign : kSigns) {
      if (StartsWith(text, sign.begin)) Vote(sign.flavour, At(sign.begin, line));
    }
    const bool remark = StartsWith(text, "REMARK") || StartsWith(text, "$$");
    if (remark && text.find(kCreoName) != std::string::npos) {
      Vote(ClFlavour::kCreo, At(kCreoName, line));
    }
    if (StartsWith(text, "UNITS/") || StartsWith(text, "UNIT/")) {
      const std::string unit = text.substr(text.find('/') + 1);
      if (StartsWith(unit, "MM") || StartsWith(unit, "MILLIM")) {
        Say(&stated_, ClUnit::kMillimetre, At("UNITS/MM", line));
      } else if (StartsWith(unit, "IN")) {
        Say(&stated_, ClUnit::kInch, At("UNITS/INCHES", line));
      }
    }
    if (StartsWith(text, "FEDRAT/") || StartsWith(text, "CYCLE/")) LookForFeedUnit(text, line);
  }

  ClSurvey Result() {
    // Feed rates count only where there is no UNITS: they may have a unit of their own.
    if (stated_.unit && fed_.unit && stated_.unit != fed_.unit) {
      survey_.other_feed_unit = fed_.evidence;
    } else if (stated_.unit) {
      survey_.other_feed_unit = fed_.contradiction;
    }
    const Unit& unit = stated_.unit ? stated_ : fed_;
    survey_.unit = unit.unit;
    survey_.unit_evidence = unit.evidence;
    survey_.unit_contradiction = unit.contradiction;
    return survey_;
  }

 private:
  struct Unit {
    std::optional<ClUnit> unit;
    std::string evidence, contradiction;
  };

  static void Say(Unit* about, ClUnit unit, std::string evidence) {
    if (!about->unit) {
      about->unit = unit;
      about->evidence = std::move(evidence);
    } else if (about->unit != unit && about->contradiction.empty()) {
      about->contradiction = std::move(evidence);
    }
  }

  void LookForFeedUnit(std::string_view text, int line) {
    std::size_t begin = text.find('/');
    while (begin != std::string_view::npos) {
      const std::size_t end = text.find(',', begin + 1);
      const std::string_view word = text.substr(begin + 1, end - begin - 1);
      if (word == "MMPM" || word == "MMPR") Say(&fed_, ClUnit::kMillimetre, At(word, line));
      if (word == "IPM" || word == "IPR") Say(&fed_, ClUnit::kInch, At(word, line));
      begin = end;
    }
  }

  void Vote(ClFlavour flavour, std::string evidence) {
    if (survey_.flavour_evidence.empty()) {
      survey_.flavour = flavour;
      survey_.flavour_evidence = std::move(evidence);
    } else if (flavour != survey_.flavour && survey_.flavour_contradiction.empty()) {
      survey_.flavour_contradiction = std::move(evidence);
    }
  }

  ClSurvey survey_;
  Unit stated_, fed_;
};

}  // namespace

std::string_view ToString(ClFlavour flavour) {
  switch (flavour) {
    case ClFlavour::kNx:
      return "nx";
    case ClFlavour::kCreo:
      return "creo";
    case ClFlavour::kSolidWorksCam:
      return "solidworks";
    case ClFlavour::kApt:
      break;
  }
  return "apt";
}

ClSurvey Survey(const nc::Program& program) {
  Surveyor surveyor;
  const std::string_view text = program.text();
  std::size_t released = 0;
  int line = 0;
  for (std::size_t offset = program.begin(); offset < text.size();) {
    const std::string_view raw = program.Line(offset);
    ++line;
    if (MayTell(raw)) surveyor.Look(raw, line);
    offset += raw.size();
    if (text.substr(offset, 2) == "\r\n") ++offset;
    ++offset;
    if (offset - released > kReleaseBytes) program.Release(released = offset);
  }
  return surveyor.Result();
}

}  // namespace ncsim::post
