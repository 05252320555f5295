// SPDX-License-Identifier: BSD-3-Clause
#include "sim/control/haas_block.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "sim/base/text.h"
#include "sim/base/units.h"
#include "sim/control/command.h"

namespace ncsim::control {
namespace {

// Beyond these no word of this control goes (a fourth of it is the manual's widest field).
constexpr double kLongest = 1.0e6;  // mm
constexpr double kWidest = 1.0e6;   // degrees
constexpr double kIncrementsPerDegree = 1e3;

int TimesTen(double number) { return static_cast<int>(std::lround(number * 10.0)); }

// Codes that are not simulated, but whose block moves as it would without them.
bool MovesAllTheSame(const nc::CodeSpec& spec) {
  return spec.number_x10 == 600 || spec.number_x10 == 1410 || spec.number_x10 == 1430;
}

std::string WordText(const ResolvedWord& word) {
  return std::string(1, word.address) + Short(word.value);
}

}  // namespace

std::string CodeName(char address, double number) {
  return std::string(1, address) + Short(number, 1);
}

CodeIndex::CodeIndex(const nc::Dialect& dialect) {
  for (const nc::CodeSpec& spec : dialect.codes) {
    std::vector<const nc::CodeSpec*>& table = spec.address == 'G' ? g_ : m_;
    const std::size_t at = static_cast<std::size_t>(spec.number_x10);
    if (table.size() <= at) table.resize(at + 1, nullptr);
    table[at] = &spec;
  }
}

const nc::CodeSpec* CodeIndex::Find(char address, double number) const {
  const std::vector<const nc::CodeSpec*>& table = address == 'G' ? g_ : m_;
  const double tenfold = number * 10.0;
  if (!(tenfold >= 0.0) || tenfold >= static_cast<double>(table.size())) return nullptr;
  const std::size_t at = static_cast<std::size_t>(std::lround(tenfold));
  if (at >= table.size() || std::abs(tenfold - std::round(tenfold)) > 1e-6) return nullptr;
  return table[at];
}

HaasBlock::HaasBlock(const CodeIndex& codes, const HaasSettings& settings,
                     std::vector<int> motionless_m, RunLog* log)
    : codes_(&codes), settings_(&settings), motionless_m_(std::move(motionless_m)), log_(log) {}

SourcePosition HaasBlock::WhereOf(const ResolvedWord& word) const {
  SourcePosition where = block_->where;
  if (word.column > 0) where.column = word.column;
  return where;
}

SourcePosition HaasBlock::WhereOf(char address) const {
  const ResolvedWord* word = Word(address);
  return word == nullptr ? where() : WhereOf(*word);
}

bool HaasBlock::Load(ResolvedBlock* block) {
  block_ = block;
  words_.fill(nullptr);
  commas_.fill(nullptr);
  num_g_ = 0;
  m_code_ = -1;
  has_m_ = false;
  axes_taken_ = false;
  for (ResolvedWord& word : block->words) {
    if (word.address < 'A' || word.address > 'Z' || word.address == 'G' || word.address == 'M') {
      continue;
    }
    ResolvedWord** place = &words_[static_cast<std::size_t>(word.address - 'A')];
    if (word.comma) {
      if (word.address != 'R' && word.address != 'C') continue;
      place = &commas_[word.address == 'R' ? 0 : 1];
    }
    if (*place == nullptr) *place = &word;
  }
  // Codes come second: one that is not simulated takes its words with it.
  for (ResolvedWord& word : block->words) {
    if (word.address == 'G' && !LoadG(&word)) return false;
    if (word.address == 'M' && !LoadM(&word)) return false;
  }
  return true;
}

bool HaasBlock::LoadG(ResolvedWord* word) {
  word->used = true;
  const nc::CodeSpec* spec = codes_->Find('G', word->value);
  if (spec == nullptr) {
    Unknown(word);
    return true;
  }
  const std::string_view name = spec->meaning;
  for (const CodeUse& other : g_codes()) {
    if (spec->group == 0 || other.spec->group != spec->group) continue;
    log_->Alarm(Rule::kControlAlarm, WhereOf(*word),
                CodeName('G', word->value) + " and " + CodeName('G', other.word->value) +
                    " in one block: both are of group " + std::to_string(spec->group));
    return false;
  }
  if (spec->support == nc::Support::kRejected) {
    log_->Alarm(Rule::kControlAlarm, WhereOf(*word),
                CodeName('G', word->value) + " (" + std::string(name) + ") is not accepted");
    return false;
  }
  if (num_g_ == g_codes_.size()) {
    log_->Alarm(Rule::kControlAlarm, WhereOf(*word), "too many G codes in one block");
    return false;
  }
  g_codes_[num_g_++] = {spec, word};
  if (spec->support == nc::Support::kUnsupported) Unsupported(*spec, word);
  if (spec->support == nc::Support::kNoMotionEffect) {
    Take(spec->words);
    if (spec->number_x10 == 1000) Take(kLetters);  // G100 X0.
  }
  return true;
}

bool HaasBlock::LoadM(ResolvedWord* word) {
  word->used = true;
  if (has_m_) {
    log_->Alarm(Rule::kControlAlarm, WhereOf(*word), "a second M code in one block");
    return false;
  }
  has_m_ = true;
  const nc::CodeSpec* spec = codes_->Find('M', word->value);
  const bool declared = std::find(motionless_m_.begin(), motionless_m_.end(),
                                  static_cast<int>(word->value)) != motionless_m_.end();
  if (declared && (spec == nullptr || spec->support == nc::Support::kUnsupported)) {
    Take(spec == nullptr ? "PQ" : spec->words);
    return true;
  }
  if (spec == nullptr) {
    Unknown(word);
    return true;
  }
  if (spec->support == nc::Support::kUnsupported) {
    Unsupported(*spec, word);
  } else {
    Take(spec->words);
    if (spec->support == nc::Support::kSimulated) m_code_ = TimesTen(word->value);
  }
  return true;
}

void HaasBlock::Unknown(ResolvedWord* word) {
  const std::string name = CodeName(word->address, word->value);
  log_->ReportOnce(name, Rule::kUnsupportedCode, WhereOf(*word),
                   name + " is not in the code list of this control");
  if (word->address == 'G') axes_taken_ = true;
}

void HaasBlock::Unsupported(const nc::CodeSpec& spec, ResolvedWord* word) {
  const std::string name = CodeName(spec.address, word->value);
  std::string message = name + " (" + std::string(spec.meaning) + ") is not simulated";
  if (!spec.note.empty()) message += ": " + std::string(spec.note);
  log_->ReportOnce(name, Rule::kUnsupportedCode, WhereOf(*word), std::move(message));
  Take(spec.words);
  if (spec.address == 'G' && !MovesAllTheSame(spec)) axes_taken_ = true;
  if (axes_taken_) Take(kLetters);
}

bool HaasBlock::HasAnyOf(std::string_view addresses) const {
  return std::any_of(addresses.begin(), addresses.end(), [this](char c) { return Has(c); });
}

unsigned HaasBlock::AxisWords() const {
  unsigned bits = 0;
  for (std::size_t i = 0; i < kNumAxes; ++i) {
    const ResolvedWord* word = Word(kLetters[i]);
    if (word != nullptr && !word->used) bits |= 1U << i;
  }
  return bits;
}

ResolvedWord* HaasBlock::TakeWord(char address) {
  ResolvedWord* word = Word(address);
  word->used = true;
  return word;
}

void HaasBlock::Take(std::string_view addresses) {
  for (const char address : addresses) {
    if (ResolvedWord* word = Word(address)) word->used = true;
  }
}

bool HaasBlock::InRange(const ResolvedWord& word, double limit) {
  if (std::abs(word.value) <= limit) return true;
  log_->Alarm(Rule::kControlAlarm, WhereOf(word),
              std::string(1, word.address) + ": value out of range");
  return false;
}

void HaasBlock::ReportScale(const ResolvedWord& word, double value, const char* setting) {
  const char* unit = word.address >= 'A' && word.address <= 'C' ? " deg"
                     : settings_->inch                          ? " in"
                                                                : " mm";
  const std::string message = WordText(word) + " has no decimal point: the control reads " +
                              Short(value, 7) + unit + (word.address == 'F' ? "/min" : "") + " (" +
                              setting + ")";
  const std::string kind = word.address == 'F'                          ? " F"
                           : word.address >= 'A' && word.address <= 'C' ? " angle"
                                                                        : " length";
  log_->ReportOnce(setting + kind, Rule::kNumberScale, WhereOf(word), message);
}

// Without a point the number counts increments, unless setting 162 is on (manual, setting 162). The
// manual leaves R and Q out of its list of addresses; practice differs, so they are not settled.
double HaasBlock::Scaled(const ResolvedWord& word, double per_unit) {
  if (word.has_point || word.value == 0.0 || settings_->default_float) return word.value;
  if (word.address == 'R' || word.address == 'Q') {
    const std::string key = std::string(1, word.address) + " without point";
    log_->ReportOnce(key, Rule::kUnsupportedCode, WhereOf(word),
                     WordText(word) + " has no decimal point: the manual does not settle how " +
                         std::string(1, word.address) + " is scaled then; taken as written");
    return word.value;
  }
  const double value = word.value / per_unit;
  ReportScale(word, value, "setting 162 is OFF");
  return value;
}

double HaasBlock::Length(char address) {
  const ResolvedWord& word = *TakeWord(address);
  if (!InRange(word, kLongest)) return 0.0;
  return Scaled(word, settings_->increments_per_unit()) * settings_->mm_per_unit();
}

double HaasBlock::Angle(char address) {
  const ResolvedWord& word = *TakeWord(address);
  if (!InRange(word, kWidest)) return 0.0;
  return Radians(Scaled(word, kIncrementsPerDegree));
}

double HaasBlock::Axis(int axis) {
  const char letter = kLetters[static_cast<std::size_t>(axis)];
  return axis <= kZ ? Length(letter) : Angle(letter);
}

double HaasBlock::Number(char address) { return TakeWord(address)->value; }

double HaasBlock::Seconds(char address) {
  const ResolvedWord& word = *TakeWord(address);
  if (!InRange(word, kLongest)) return 0.0;
  return std::max(0.0, word.has_point ? word.value : word.value * 1e-3);
}

double HaasBlock::FeedWord() {
  const ResolvedWord& word = *TakeWord('F');
  if (!InRange(word, kLongest)) return 0.0;
  if (word.has_point || word.value == 0.0 || settings_->integer_feed) return word.value;
  const double value = word.value / settings_->increments_per_unit();
  ReportScale(word, value, "setting 77 is DEFAULT");
  return value;
}

std::optional<double> HaasBlock::OptionalLength(char address) {
  if (!Has(address)) return std::nullopt;
  return Length(address);
}

std::optional<double> HaasBlock::CommaLength(char address) {
  ResolvedWord* word = commas_[address == 'R' ? 0 : 1];
  if (word == nullptr) return std::nullopt;
  word->used = true;
  if (!InRange(*word, kLongest)) return std::nullopt;
  return Scaled(*word, settings_->increments_per_unit()) * settings_->mm_per_unit();
}

std::optional<int> HaasBlock::Integer(char address, int lowest, int highest) {
  const ResolvedWord& word = *TakeWord(address);
  const double rounded = std::round(word.value);
  if (std::abs(word.value - rounded) < 1e-6 && rounded >= lowest && rounded <= highest) {
    return static_cast<int>(rounded);
  }
  log_->Alarm(Rule::kControlAlarm, WhereOf(word),
              WordText(word) + ": a whole number from " + std::to_string(lowest) + " to " +
                  std::to_string(highest) + " is needed");
  return std::nullopt;
}

void HaasBlock::ReportLeftovers(std::string_view missing_axes) {
  for (const ResolvedWord& word : block_->words) {
    if (word.used) continue;
    const std::string text = (word.comma ? "," : "") + WordText(word);
    std::string message;
    if (!word.comma && missing_axes.find(word.address) != std::string_view::npos) {
      message = text + ": this machine has no axis " + std::string(1, word.address);
    } else {
      message = text + " has no meaning for this control here";
    }
    log_->ReportOnce("left over " + text.substr(0, word.comma ? 2 : 1), Rule::kUnsupportedCode,
                     WhereOf(word), std::move(message));
  }
}

}  // namespace ncsim::control
