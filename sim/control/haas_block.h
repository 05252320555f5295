// SPDX-License-Identifier: BSD-3-Clause
// A Haas block as the interpreter takes it: its codes looked up in the table and held against the
// rules of a block, its words scaled to inside units, and what nobody has taken reported.
// Haas NGC Mill Operator's Manual 2017, "Introduction to G-Codes", settings 9, 77 and 162.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "sim/control/flow.h"
#include "sim/control/haas_settings.h"
#include "sim/control/run_log.h"
#include "sim/nc/code_table.h"

namespace ncsim::control {

struct CodeUse {
  const nc::CodeSpec* spec = nullptr;
  ResolvedWord* word = nullptr;
};

/// Constant-time look-up in a dialect's table.
class CodeIndex {
 public:
  explicit CodeIndex(const nc::Dialect& dialect);
  const nc::CodeSpec* Find(char address, double number) const;

 private:
  std::vector<const nc::CodeSpec*> g_, m_;  ///< By number_x10.
};

class HaasBlock {
 public:
  /// All outlive this. `motionless_m`: M codes that job or model declare to move nothing.
  HaasBlock(const CodeIndex& codes, const HaasSettings& settings, std::vector<int> motionless_m,
            RunLog* log);

  /// Sorts the words of `block`, which outlives the use of this. False: the control alarms.
  bool Load(ResolvedBlock* block);

  const SourcePosition& where() const { return block_->where; }
  SourcePosition WhereOf(const ResolvedWord& word) const;
  /// Where the word of that address stands; the block where it has none.
  SourcePosition WhereOf(char address) const;
  std::span<const CodeUse> g_codes() const { return {g_codes_.data(), num_g_}; }
  /// number_x10 of the block's M code; -1 for none. Only codes that the interpreter executes.
  int m_code() const { return m_code_; }
  /// True where a code that is not simulated has taken the block's axis words.
  bool axes_taken() const { return axes_taken_; }

  /// True where the block has the word and nobody has taken it.
  bool Has(char address) const { return Word(address) != nullptr && !Word(address)->used; }
  bool HasAnyOf(std::string_view addresses) const;
  /// Bit per AxisIndex of the axis words that nobody has taken.
  unsigned AxisWords() const;

  // Getters take the word; it must be there.
  double Length(char address);   ///< mm.
  double Angle(char address);    ///< rad.
  double Axis(int axis);         ///< mm or rad, by AxisIndex.
  double Number(char address);   ///< As written.
  double Seconds(char address);  ///< With a point seconds, without milliseconds (G04 P).
  double FeedWord();             ///< F as the control reads it (setting 77), unit of setting 9.
  std::optional<double> OptionalLength(char address);
  /// A whole number in [lowest, highest]; nullopt after an alarm.
  std::optional<int> Integer(char address, int lowest, int highest);
  std::optional<double> CommaLength(char address);  ///< `,R` or `,C`.
  void Take(std::string_view addresses);

  /// Whatever is left over is `unsupported-code`.
  void ReportLeftovers(std::string_view missing_axes);

 private:
  ResolvedWord* Word(char address) const { return words_[static_cast<std::size_t>(address - 'A')]; }
  ResolvedWord* TakeWord(char address);
  bool LoadG(ResolvedWord* word);
  bool LoadM(ResolvedWord* word);
  void Unsupported(const nc::CodeSpec& spec, ResolvedWord* word);
  void Unknown(ResolvedWord* word);
  double Scaled(const ResolvedWord& word, double per_unit);
  void ReportScale(const ResolvedWord& word, double value, const char* setting);
  bool InRange(const ResolvedWord& word, double limit);

  const CodeIndex* codes_;
  const HaasSettings* settings_;
  const std::vector<int> motionless_m_;
  RunLog* log_;
  ResolvedBlock* block_ = nullptr;
  std::array<ResolvedWord*, 26> words_{};  ///< First of each address but G, M and comma words.
  std::array<ResolvedWord*, 2> commas_{};  ///< ,R and ,C.
  std::array<CodeUse, 16> g_codes_{};
  std::size_t num_g_ = 0;
  int m_code_ = -1;
  bool has_m_ = false;
  bool axes_taken_ = false;
};

/// "G43", "G43.4", "M6".
std::string CodeName(char address, double number);

}  // namespace ncsim::control
