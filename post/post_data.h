// SPDX-License-Identifier: BSD-3-Clause
// A post as data (NAME.post.toml; docs/post.md): number formats, words, codes, the modes that the
// control has, and the blocks of a program as templates. One file a machine and control.
#pragma once

#include <array>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "post/block_template.h"
#include "post/cl_event.h"
#include "post/number_format.h"
#include "post/plan.h"
#include "post/values.h"
#include "sim/base/diagnostics.h"

namespace ncsim::post {

/// Of [blocks] and of the modes, which may have their own.
enum class Block : std::uint8_t {
  kProgramStart,
  kProgramEnd,
  kToolTableHead,
  kToolTableRow,
  kToolTableFoot,
  kToolChange,
  kOperationStart,
  kSafeStart,
  kOperationEnd,
  kCallOperation,
  kFileStart,
  kFileEnd,
  kSpindle,
  kCoolant,
  kRapid,
  kLine,
  kArc,
  kIndex,
  kRewind,
  kLeave,
  kHole,
  kCycleEnd,
  kDwell,
  kStop,
  kOptionalStop,
  kHome,
  kComment,
  kCode,
};
inline constexpr int kBlocks = static_cast<int>(Block::kCode) + 1;
struct BlockInfo {
  std::string_view name;
  unsigned scopes;
  bool required;  ///< In [blocks], or in each mode.
};
const std::array<BlockInfo, kBlocks>& BlockTable();
using Blocks = std::array<std::optional<BlockTemplate>, kBlocks>;

struct WordFormat {
  std::string name;     ///< In templates.
  std::string address;  ///< What stands before the number: "X", "A3=", "C=DC(".
  std::string suffix;   ///< What stands behind it: ")".
  Value value = Value::kX;
  int format = 0;        ///< Of PostData::formats.
  bool modal = true;     ///< Printed only when changed.
  bool wrap = false;     ///< Printed in [0, 360): the control goes the shortest way.
  std::string together;  ///< Words of the same name here print together.
};

struct CommentStyle {
  std::string open, close;
  std::string characters;  ///< Others print as '-'.
  bool upper = false;
  int length = 0;  ///< Of a text; 0: any.
};

struct LineNumbers {
  std::string prefix;  ///< "" for none.
  int start = 10, step = 10, highest = 99999;
  std::vector<std::string> without;  ///< Lines that begin so have none.
};

/// A way to program the machine.
struct PostMode {
  std::string name;
  PlanMode kind = PlanMode::kIndexed;
  enum class Frame : std::uint8_t {
    kFixed,   ///< The tool axis is Z of the program, always: three axes.
    kTurned,  ///< Directions of the machine from P's zero where the table has carried it (G254).
    kPlane,   ///< The directions of PlanIndex::plane_P (CYCLE800, ROT).
  } frame = Frame::kTurned;           ///< Of kIndexed.
  bool great_circle = false;          ///< kTcp: the control turns the tool axis on a great circle,
  double pole_limit = 0.0;            ///< but nearer to the pole by the rotary axes; rad.
  bool compensation = false;          ///< Cutter compensation.
  bool rate_alarm = false;            ///< The control does not slow down where an axis is too slow.
  std::vector<PlanPlane> arc_planes;  ///< None: no arcs.
  bool helices = false;
  bool cycles = false;
  bool inverse_time = false;    ///< Feeds that turn a rotary axis are in inverse time.
  bool per_revolution = false;  ///< Feeds per revolution.
  bool split_rapids = false;    ///< Rapids go up, across, down: in two blocks.
  Blocks blocks;
};

/// What an entry of [texts] or [functions] does.
struct PostText {
  enum class What : std::uint8_t {
    kIgnore,
    kComment,
    kWords,  ///< As it is where it is NC words, else a comment and a warning.
    kBlock,
  } what = What::kIgnore;
  BlockTemplate block;  ///< kBlock.
};

struct PostData {
  std::string name;
  std::string dialect;    ///< Of sim/nc: how what is written is read.
  std::string extension;  ///< Of the files: ".nc"
  ClUnit unit = ClUnit::kMillimetre;
  std::map<std::string, std::string> constants;  ///< Texts for {name}.
  std::vector<NumberFormat> formats;
  std::vector<WordFormat> words;
  /// Codes by group and key, as in GroupTable(); nullopt where the control has none.
  std::array<std::vector<std::optional<std::string>>, kGroups> codes;
  CommentStyle comments;
  LineNumbers numbers;
  std::vector<PostMode> modes;
  Blocks blocks;
  /// By the name of the kind, with "_dwell" or "_left" (tap) where that is another code.
  std::map<std::string, BlockTemplate> cycles;
  /// The cycle is called at each position that follows it (MCALL); a hole of another depth needs
  /// another call. Else its block is the first hole, and those that follow print what differs.
  bool modal_call = false;
  std::map<std::string, PostText> functions;  ///< By major word.
  std::map<cl::Text::Kind, PostText> texts;

  /// The first mode of a kind, or the one named where it is of that kind; nullptr without one.
  const PostMode* Mode(PlanMode kind, std::string_view preferred) const;
  const PostMode* ModeNamed(std::string_view name) const;
  /// The mode's own block, or the general one; nullptr without one.
  const BlockTemplate* Find(Block block, const PostMode* mode) const;
  /// The block that begins a cycle; nullptr where the post has none that says all of it, and `why`.
  const BlockTemplate* Cycle(const ClHoleCycle& cycle, bool counter_clockwise,
                             std::string* why) const;

  /// The first word of a value; nullptr without one.
  const WordFormat* FindWord(Value value) const;
  /// What the control reads of a coordinate: `number` (in the program's unit) as its word prints
  /// it.
  double AsPrinted(Value value, double number) const;
  /// Least step of a coordinate, in the program's unit; 0 without a word.
  double Increment(Value value) const;
  /// mm in the program's unit.
  double unit_mm() const;
};

std::string_view ToString(ClCycleKind kind);  // "bore_no_drag"

struct PostSettings {
  std::optional<ClUnit> unit;                    ///< None: as the file says.
  std::map<std::string, std::string> constants;  ///< Instead of those of the file.
};
/// Reads a post; nullopt (reported, with line and column) where it is wrong. `file` is its name for
/// the messages.
std::optional<PostData> LoadPost(const std::string& text, const std::string& file,
                                 const PostSettings& settings, Diagnostics* diagnostics);

}  // namespace ncsim::post
