// SPDX-License-Identifier: BSD-3-Clause
#include "sim/compare/fault_log.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <tuple>
#include <utility>

#include "sim/base/text.h"
#include "sim/base/units.h"

namespace ncsim::compare {
namespace {

/// What a feed is wrong by when its unit is: and in words.
struct WrongUnit {
  double factor;
  const char* words;
};
constexpr std::array<WrongUnit, 4> kWrongUnits = {{
    {kMmPerInch, ": mm for inch"},
    {1.0 / kMmPerInch, ": inch for mm"},
    {60.0, ": a minute for a second"},
    {1.0 / 60.0, ": a second for a minute"},
}};

std::string UnitHint(double factor, double tolerance) {
  for (const WrongUnit& unit : kWrongUnits) {
    if (std::abs(factor / unit.factor - 1.0) <= tolerance) return unit.words;
  }
  return "";
}

}  // namespace

double AngleOf(double axis_distance) { return 2.0 * std::asin(std::min(1.0, 0.5 * axis_distance)); }
double AxisDistance(double angle) { return 2.0 * std::sin(0.5 * std::min(angle, kPi)); }

std::string FaultLog::Place(const SourcePosition& where) const {
  const std::string& path = files_->name(where.file);
  return path.substr(path.rfind('/') + 1) +
         (where.line > 0 ? ":" + std::to_string(where.line) : "");
}

std::string FaultLog::Message() const {
  if (open_.missing_to.line > 0) {
    const bool one = open_.missing_to.line == open_.reference.line;
    return one ? "behind this block the feed of " + Place(open_.reference) + " is missing"
               : "behind this block the feeds of " + Place(open_.reference) + " to line " +
                     std::to_string(open_.missing_to.line) + " are missing";
  }
  if (!open_.message.empty()) return open_.message + open_.hint;
  const Distance& apart = open_.apart;
  const bool tip = apart.position > tolerances_.position;
  const double angle = AngleOf(apart.axis);
  std::string text;
  if (tip || angle <= tolerances_.angle) {
    text = "the tip goes " + Fixed(apart.position, 3) + " mm away from the path of " +
           Place(open_.reference) + " (tolerance " + Short(tolerances_.position) + " mm)";
  }
  if (angle > tolerances_.angle) {
    text += text.empty() ? "the tool axis is " : ", the tool axis is ";
    text += Fixed(Degrees(angle), 3) + " deg off";
    if (!tip) text += " that of " + Place(open_.reference);
    text += " (tolerance " + Short(Degrees(tolerances_.angle)) + " deg)";
  }
  return text + open_.hint;
}

void FaultLog::Add(const Fault& fault) {
  const bool goes_on = run_.open() && open_.rule == fault.rule &&
                       (open_.missing_to.line > 0) == (fault.missing_to.line > 0);
  if (!goes_on) {
    Agree();
    open_ = fault;
    Finding finding = MakeFinding(fault.rule, fault.tested, "");
    finding.other = fault.reference;
    run_.Start(std::move(finding));
    run_.Add(fault.tested);
  } else {
    if (fault.message.empty()) open_.hint.clear();
    open_.missing_to = fault.missing_to;
    open_.apart.position = std::max(open_.apart.position, fault.apart.position);
    open_.apart.axis = std::max(open_.apart.axis, fault.apart.axis);
  }
  for (const SourcePosition& where : fault.blocks) run_.Add(where);
}

void FaultLog::Agree() {
  if (!run_.open()) return;
  run_.finding().message = Message();
  run_.Close(&findings_);
}

void FaultLog::Feed(const Piece& tested_piece, const Piece& reference_piece) {
  const double feed = tested_piece.feed, wanted = reference_piece.feed;
  const SourcePosition &tested = tested_piece.where, &reference = reference_piece.where;
  if (!(feed > 0.0) || !(wanted > 0.0)) return;
  const double off = std::abs(feed - wanted) - tested_piece.slack - reference_piece.slack;
  if (off <= std::max(tolerances_.feed_ratio * wanted, tolerances_.feed_resolution)) {
    feed_run_.Close(&findings_);
    return;
  }
  const double factor = feed / wanted;
  const bool goes_on =
      feed_run_.open() && std::abs(factor / feed_factor_ - 1.0) <= tolerances_.feed_ratio;
  if (!goes_on) {
    feed_run_.Close(&findings_);
    feed_factor_ = factor;
    Finding finding = MakeFinding(Rule::kFeedRate, tested,
                                  "the feed is " + Short(60.0 * feed, 1) + " mm/min, that of " +
                                      Place(reference) + " is " + Short(60.0 * wanted, 1) +
                                      UnitHint(factor, tolerances_.feed_ratio));
    finding.other = reference;
    feed_run_.Start(std::move(finding));
  }
  feed_run_.Add(tested);
}

/// A block of a subprogram or a loop may be wrong many times: it is one finding.
std::vector<Finding> FaultLog::Take() {
  Agree();
  feed_run_.Close(&findings_);
  using Key = std::tuple<Rule, int, int, int, int>;
  std::map<Key, std::pair<std::size_t, int>> known;  // place in `once`, times
  std::vector<Finding> once;
  for (Finding& finding : findings_) {
    const SourcePosition &at = finding.where, other = finding.other.value_or(SourcePosition());
    const Key key = {finding.rule, at.file, at.line, other.file, other.line};
    const auto [found, is_new] = known.try_emplace(key, once.size(), 1);
    if (is_new) {
      once.push_back(std::move(finding));
    } else {
      ++found->second.second;
    }
  }
  for (const auto& [key, entry] : known) {
    const auto [place, times] = entry;
    if (times > 1) once[place].message += " (" + std::to_string(times) + " times)";
  }
  findings_.clear();
  return once;
}

}  // namespace ncsim::compare
