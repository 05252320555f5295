// SPDX-License-Identifier: BSD-3-Clause
// Flow and variables of a SINUMERIK program: which block comes next, and what its words are worth.
// Knows no modal state and no axes but their names.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "sim/base/finding.h"
#include "sim/nc/program.h"
#include "sim/nc/sinumerik_block.h"
#include "sim/nc/sinumerik_commands.h"
#include "sim/nc/sinumerik_value.h"

namespace ncsim::control {

enum class SinumerikItemKind : std::uint8_t {
  kCommand,  ///< A G code, by number or name; or a frame statement (TRANS), whose values follow it.
  kWord,     ///< An address with its value.
  kCall,     ///< A predefined subprogram or cycle: TRAORI, MSG, CYCLE83 ...
};

/// A part of a block whose value is known.
struct SinumerikItem {
  SinumerikItemKind kind = SinumerikItemKind::kWord;
  nc::SinumerikModifier modifier = nc::SinumerikModifier::kNone;
  char letter = 0;          ///< kWord: of a one-letter address, upper case; else 0.
  bool is_integer = false;  ///< kWord: written without a point.
  bool is_text = false;     ///< kWord: the value is not a number; see SinumerikStep::text().
  bool used = false;        ///< Set by whoever consumed it. What is left is `unsupported-code`.
  int extension = -1;       ///< kWord: 1 for M1=6, X1=, S1=; -1 for none.
  int column = 0;           ///< From 1.
  double value = 0.0;       ///< kWord: the number.
  const nc::SinumerikCommand* command = nullptr;  ///< kCommand, kCall, and words of more letters.
  std::string_view name;                          ///< As written: "X1", "CR", "TRAORI".
  /// In SinumerikStep::values: of a kCall its arguments, omitted ones marked; of a kWord its
  /// indices (AX[X1]=, FA[X]=), and behind them a value that is no number.
  std::size_t first_value = 0, value_count = 0;
};

/// A modal call: MCALL NAME(arguments).
struct SinumerikModalCall {
  std::string name;                               ///< Upper case; "" for none.
  const nc::SinumerikCommand* command = nullptr;  ///< Of a cycle that the control has.
  std::vector<nc::SinumerikValue> arguments;      ///< As they were at the MCALL.
  SourcePosition where;                           ///< Of the MCALL.
};

/// A block to execute.
struct SinumerikStep {
  SourcePosition where;        ///< Column 1 of the block.
  long sequence = -1;          ///< N.
  int skip_level = -1;         ///< `/`: the flow has already left out what the switches say.
  bool in_subprogram = false;  ///< M2 and M30 return from it.
  std::vector<SinumerikItem> items;
  std::vector<nc::SinumerikValue> values;
  std::string_view comment;

  /// The first word with that letter and no extension that is not used; null for none.
  SinumerikItem* Find(char letter);
  const nc::SinumerikValue& argument(const SinumerikItem& item, std::size_t i) const {
    return values[item.first_value + i];
  }
  /// Of an item with is_text.
  const nc::SinumerikValue& text(const SinumerikItem& item) const {
    return values[item.first_value + item.value_count];
  }
};

/// What the interpreter knows and the language asks for.
class SinumerikSystem {
 public:
  enum class Access {
    kDone,
    kUnknown,  ///< ncsim does not know it: `unsupported-code`, and the program goes no further.
    kAlarm,    ///< The message says which.
  };
  virtual ~SinumerikSystem() = default;
  /// `name` (upper case) is an axis of the channel: X, B, X1, a machine axis.
  virtual bool IsAxis(std::string_view name) const = 0;
  /// System variables, `$` and upper case ("$P_UIFR", "$AA_IM"). A read of a position makes the
  /// controller send on what waits.
  virtual Access Read(std::string_view name, const std::vector<nc::SinumerikValue>& indices,
                      nc::SinumerikValue* value, std::string* message) = 0;
  virtual Access Write(std::string_view name, const std::vector<nc::SinumerikValue>& indices,
                       const nc::SinumerikValue& value, std::string* message) = 0;
  /// The program reads an R parameter that it has not set: the control keeps it over power-off, so
  /// that 0 is an assumption. Once a parameter.
  virtual void AssumeZero(const std::string& name) = 0;
};

/// A run is stopped after this many blocks: a loop that does not end.
inline constexpr std::uint64_t kMaxSinumerikBlocks = 50'000'000;

struct SinumerikFlowOptions {
  unsigned skip_levels = 0;  ///< Bit n: the operator skips `/n`.
  std::uint64_t max_blocks = kMaxSinumerikBlocks;
  std::size_t r_parameters = 1000;  ///< MD28050.
  std::vector<std::string> subprogram_folders;
};

enum class SinumerikEvent {
  kStep,      ///< A block with something to execute.
  kSave,      ///< A subprogram with SAVE begins: remember modal G codes and programmable frame.
  kRestore,   ///< It ended.
  kModalEnd,  ///< The subprogram that PathMotionDone() has called ended.
  kEnd,       ///< M30, M2, M17, or the end of the main program's text.
  kStopped,   ///< An alarm has been reported as a finding; the program goes no further.
};

/// Runs a program. Use: while ((event = Next(&step)) != kEnd and != kStopped) { ... }. Blocks that
/// have nothing for the controller (assignments, jumps, definitions, calls) are not handed out;
/// what jumps, calls or returns acts when Next() is called again. M17, M2 and M30 are handed out
/// with `used` set; the flow has taken them.
///
/// What the control does and we cannot know is `unsupported-code`, and the program goes on behind
/// it: a subprogram that is not found, a synchronised action, an interrupt. A syntax error or an
/// alarm stops; further syntax errors of the same text are then reported too, up to a bound.
class SinumerikFlow {
 public:
  using Report = std::function<void(Finding)>;
  /// Adds the names of the texts to `files`, the main program's first.
  SinumerikFlow(std::shared_ptr<const nc::Program> main, SinumerikFlowOptions options,
                SinumerikSystem* system, SourceFiles* files, Report report);
  ~SinumerikFlow();

  SinumerikEvent Next(SinumerikStep* step);
  /// Call after a block with path motion. A modal subprogram of the user's will be run next; a
  /// modal cycle of the control's is returned, to be executed now. Null: nothing (more) to do.
  const SinumerikModalCall* PathMotionDone();
  /// The block's further motions wait for Next(): a modal subprogram is about to run, or runs, or
  /// the program has stopped.
  bool busy() const;
  std::uint64_t blocks_executed() const;  ///< Lines read.
  /// The value of a user variable or R parameter, for tests; false: not defined.
  bool ReadVariable(std::string_view name, nc::SinumerikValue* value);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace ncsim::control
