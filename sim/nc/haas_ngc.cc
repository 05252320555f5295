// SPDX-License-Identifier: BSD-3-Clause
// Haas NGC Mill Operator's Manual 2017, "List of G-codes" and "List of M-codes": every code of both
// lists, and the codes that posts for this control emit and only other software versions know.
// Sorted by address and number.
#include <array>

#include "sim/nc/code_table.h"

namespace ncsim::nc {
namespace {

constexpr Support kSim = Support::kSimulated;
constexpr Support kNone = Support::kNoMotionEffect;
constexpr Support kUnsup = Support::kUnsupported;

constexpr std::string_view kProbe = "probing: where the axes stop depends on the part";
constexpr std::string_view kVectorCycle = "tool-vector cycle of a tilting head";
constexpr std::string_view kNewer = "not in the 2017 manual: another software version";
constexpr std::string_view kRelay = "switches an output; what hangs on it is not simulated";
constexpr std::string_view kDefault = "power-up state";
constexpr std::string_view kDefaultGuess = "power-up state by practice: the manual names none";

constexpr CodeSpec G(int number, int group, Support support, std::string_view words,
                     std::string_view meaning, std::string_view note = "") {
  return {'G', number * 10, group, false, support, words, meaning, note};
}
constexpr CodeSpec Default(CodeSpec spec) {
  spec.is_default = true;
  if (spec.note.empty()) spec.note = kDefaultGuess;
  return spec;
}
constexpr CodeSpec M(int number, Support support, std::string_view words, std::string_view meaning,
                     std::string_view note = "") {
  return {'M', number * 10, 0, false, support, words, meaning, note};
}

constexpr std::array kCodes = {
    Default(G(0, 1, kSim, "", "Rapid motion positioning")),
    G(1, 1, kSim, "L", "Linear interpolation motion"),
    G(2, 1, kSim, "IJKRL", "Circular interpolation motion CW"),
    G(3, 1, kSim, "IJKRL", "Circular interpolation motion CCW"),
    G(4, 0, kSim, "P", "Dwell"),
    G(9, 0, kSim, "", "Exact stop"),
    G(10, 0, kSim, "LPR", "Set offsets"),
    G(12, 0, kSim, "IKQDL", "Circular pocket milling CW"),
    G(13, 0, kSim, "IKQDL", "Circular pocket milling CCW"),
    Default(G(17, 2, kSim, "", "XY plane selection", kDefault)),
    G(18, 2, kSim, "", "XZ plane selection"),
    G(19, 2, kSim, "", "YZ plane selection"),
    Default(G(20, 6, kSim, "", "Select inches",
              "a check: alarms where it disagrees with setting 9, which also gives the default")),
    G(21, 6, kSim, "", "Select metric", "a check: alarms where it disagrees with setting 9"),
    G(28, 0, kSim, "", "Return to machine zero point"),
    G(29, 0, kSim, "", "Return from reference point"),
    G(31, 0, kUnsup, "", "Feed until skip", kProbe),
    G(35, 0, kUnsup, "D", "Automatic tool diameter measurement", kProbe),
    G(36, 0, kUnsup, "", "Automatic work offset measurement", kProbe),
    G(37, 0, kUnsup, "H", "Automatic tool offset measurement", kProbe),
    Default(G(40, 7, kSim, "", "Cutter compensation cancel", kDefault)),
    G(41, 7, kSim, "D", "2D cutter compensation left"),
    G(42, 7, kSim, "D", "2D cutter compensation right"),
    G(43, 8, kSim, "H", "Tool length compensation + (add)"),
    G(44, 8, kSim, "H", "Tool length compensation - (subtract)"),
    G(47, 0, kUnsup, "PEIJR", "Text engraving", "the control's font is not published"),
    Default(G(49, 8, kSim, "", "G43/G44/G143 cancel")),
    Default(G(50, 11, kNone, "", "Cancel scaling", "scaling is never on: G51 is unsupported")),
    G(51, 11, kUnsup, "P", "Scaling"),
    G(52, 0, kSim, "", "Set work coordinate system",
      "group 12 under setting 33 YASNAC, which this software does not offer"),
    G(53, 0, kSim, "", "Non-modal machine coordinate selection"),
    Default(G(54, 12, kSim, "", "Select work coordinate system #1")),
    G(55, 12, kSim, "", "Select work coordinate system #2"),
    G(56, 12, kSim, "", "Select work coordinate system #3"),
    G(57, 12, kSim, "", "Select work coordinate system #4"),
    G(58, 12, kSim, "", "Select work coordinate system #5"),
    G(59, 12, kSim, "", "Select work coordinate system #6"),
    G(60, 0, kUnsup, "", "Uni-directional positioning"),
    G(61, 15, kSim, "", "Exact stop mode"),
    Default(G(64, 15, kSim, "", "G61 cancel")),
    G(65, 0, kSim, "PLABCDEFHIJKMQRSTUVWXYZ", "Macro subprogram call option",
      "a macro that the control has and no folder here has is unsupported-code"),
    G(66, 0, kUnsup, "P", "Modal macro call", kNewer),
    G(67, 0, kUnsup, "", "Modal macro call cancel", kNewer),
    G(68, 16, kSim, "R", "Rotation"),
    Default(G(69, 16, kSim, "", "Cancel G68 rotation")),
    G(70, 0, kSim, "IJL", "Bolt hole circle"),
    G(71, 0, kSim, "IJKL", "Bolt hole arc"),
    G(72, 0, kSim, "IJL", "Bolt holes along an angle"),
    G(73, 9, kSim, "IJKLPQR", "High-speed peck drilling canned cycle"),
    G(74, 9, kSim, "JLR", "Reverse tap canned cycle"),
    G(76, 9, kSim, "IJLPQR", "Fine boring canned cycle"),
    G(77, 9, kSim, "IJLQR", "Back bore canned cycle"),
    Default(G(80, 9, kSim, "", "Canned cycle cancel")),
    G(81, 9, kSim, "ELR", "Drill canned cycle"),
    G(82, 9, kSim, "ELPR", "Spot drill canned cycle"),
    G(83, 9, kSim, "EIJKLPQR", "Normal peck drilling canned cycle"),
    G(84, 9, kSim, "EJLR", "Tapping canned cycle"),
    G(85, 9, kSim, "LR", "Boring canned cycle"),
    G(86, 9, kSim, "LR", "Bore and stop canned cycle"),
    G(89, 9, kSim, "LPR", "Bore in, dwell, bore out canned cycle"),
    Default(G(90, 3, kSim, "", "Absolute position command")),
    G(91, 3, kSim, "", "Incremental position command"),
    G(92, 0, kSim, "", "Set work coordinate systems shift value"),
    G(93, 5, kSim, "", "Inverse time feed mode"),
    Default(G(94, 5, kSim, "", "Feed per minute mode")),
    G(95, 5, kSim, "", "Feed per revolution"),
    Default(G(98, 10, kSim, "", "Canned cycle initial point return")),
    G(99, 10, kSim, "", "Canned cycle R plane return"),
    G(100, 0, kNone, "", "Cancel mirror image", "mirroring is never on: G101 is unsupported"),
    G(101, 0, kUnsup, "", "Enable mirror image"),
    G(103, 0, kNone, "P", "Limit block buffering",
      "look-ahead changes no motion; macros are evaluated block by block"),
    G(107, 0, kUnsup, "QR", "Cylindrical mapping"),
    G(110, 12, kSim, "", "#7 coordinate system"),
    G(111, 12, kSim, "", "#8 coordinate system"),
    G(112, 12, kSim, "", "#9 coordinate system"),
    G(113, 12, kSim, "", "#10 coordinate system"),
    G(114, 12, kSim, "", "#11 coordinate system"),
    G(115, 12, kSim, "", "#12 coordinate system"),
    G(116, 12, kSim, "", "#13 coordinate system"),
    G(117, 12, kSim, "", "#14 coordinate system"),
    G(118, 12, kSim, "", "#15 coordinate system"),
    G(119, 12, kSim, "", "#16 coordinate system"),
    G(120, 12, kSim, "", "#17 coordinate system"),
    G(121, 12, kSim, "", "#18 coordinate system"),
    G(122, 12, kSim, "", "#19 coordinate system"),
    G(123, 12, kSim, "", "#20 coordinate system"),
    G(124, 12, kSim, "", "#21 coordinate system"),
    G(125, 12, kSim, "", "#22 coordinate system"),
    G(126, 12, kSim, "", "#23 coordinate system"),
    G(127, 12, kSim, "", "#24 coordinate system"),
    G(128, 12, kSim, "", "#25 coordinate system"),
    G(129, 12, kSim, "", "#26 coordinate system"),
    G(136, 0, kUnsup, "", "Automatic work offset center measurement", kProbe),
    G(141, 7, kUnsup, "DIJK", "3D+ cutter compensation"),
    G(143, 8, kUnsup, "H", "5-axis tool length compensation +", "for machines with a tilting head"),
    G(150, 0, kUnsup, "DIJKLPQRS", "General purpose pocket milling"),
    G(153, 9, kUnsup, "EIJKLPQ", "5-axis high speed peck drilling canned cycle", kVectorCycle),
    G(154, 12, kSim, "P", "Select work coordinates P1-P99"),
    G(155, 9, kUnsup, "EJL", "5-axis reverse tap canned cycle", kVectorCycle),
    G(161, 9, kUnsup, "EL", "5-axis drill canned cycle", kVectorCycle),
    G(162, 9, kUnsup, "ELP", "5-axis spot drill canned cycle", kVectorCycle),
    G(163, 9, kUnsup, "EIJKLPQ", "5-axis normal peck drilling canned cycle", kVectorCycle),
    G(164, 9, kUnsup, "EJL", "5-axis tapping canned cycle", kVectorCycle),
    G(165, 9, kUnsup, "EL", "5-axis boring canned cycle", kVectorCycle),
    G(166, 9, kUnsup, "EL", "5-axis bore and stop canned cycle", kVectorCycle),
    G(169, 9, kUnsup, "ELP", "5-axis bore and dwell canned cycle", kVectorCycle),
    G(174, 0, kUnsup, "", "CCW non-vertical rigid tap", kVectorCycle),
    G(184, 0, kUnsup, "", "CW non-vertical rigid tap", kVectorCycle),
    G(187, 0, kSim, "EP", "Setting the smoothness level"),
    G(188, 0, kUnsup, "", "Get program from PST", "the pallet table is not known here"),
    G(234, 8, kSim, "H", "Tool center point control (TCPC) (UMC)"),
    G(253, 0, kUnsup, "", "Orient spindle normal to feature coordinate system", kNewer),
    G(254, 23, kSim, "", "Dynamic work offset (DWO) (UMC)"),
    Default(G(255, 23, kSim, "", "Cancel dynamic work offset (DWO) (UMC)")),
    G(266, 0, kUnsup, "", "Visible axes linear rapid motion", kNewer),
    G(268, 2, kUnsup, "IJKQ", "Enable feature coordinate system", kNewer),
    G(269, 2, kUnsup, "", "Disable feature coordinate system", kNewer),

    M(0, kSim, "", "Stop program"),
    M(1, kSim, "", "Optional program stop"),
    M(2, kSim, "", "Program end"),
    M(3, kSim, "", "Spindle forward"),
    M(4, kSim, "", "Spindle reverse"),
    M(5, kSim, "", "Spindle stop"),
    M(6, kSim, "", "Tool change"),
    M(7, kNone, "", "Shower coolant on"),
    M(8, kNone, "", "Coolant on"),
    M(9, kNone, "", "Coolant off"),
    M(10, kSim, "", "Engage 4th axis brake"),
    M(11, kSim, "", "Release 4th axis brake"),
    M(12, kSim, "", "Engage 5th axis brake"),
    M(13, kSim, "", "Release 5th axis brake"),
    M(16, kSim, "", "Tool change"),
    M(19, kSim, "PR", "Orient spindle"),
    M(21, kNone, "", "Optional user M function with M-Fin", kRelay),
    M(22, kNone, "", "Optional user M function with M-Fin", kRelay),
    M(23, kNone, "", "Optional user M function with M-Fin", kRelay),
    M(24, kNone, "", "Optional user M function with M-Fin", kRelay),
    M(25, kNone, "", "Optional user M function with M-Fin", kRelay),
    M(29, kNone, "P", "Set output relay with M-Fin", kRelay),
    M(30, kSim, "", "Program end and reset"),
    M(31, kNone, "", "Chip conveyor forward"),
    M(33, kNone, "", "Chip conveyor stop"),
    M(34, kNone, "", "Coolant increment", "turns the coolant nozzle"),
    M(35, kNone, "", "Coolant decrement", "turns the coolant nozzle"),
    M(36, kUnsup, "", "Pallet part ready", "pallet change"),
    M(39, kUnsup, "", "Rotate tool turret"),
    M(41, kSim, "", "Low gear override"),
    M(42, kSim, "", "High gear override"),
    M(46, kUnsup, "PQ", "Jump if pallet loaded", kNewer),
    M(48, kUnsup, "", "Validity check of the program", kNewer),
    M(50, kUnsup, "P", "Pallet change", kNewer),
    M(51, kNone, "", "Set optional user M-code", kRelay),
    M(52, kNone, "", "Set optional user M-code", kRelay),
    M(53, kNone, "", "Set optional user M-code", kRelay),
    M(54, kNone, "", "Set optional user M-code", kRelay),
    M(55, kNone, "", "Set optional user M-code", kRelay),
    M(59, kNone, "P", "Set output relay", kRelay),
    M(61, kNone, "", "Clear optional user M-code", kRelay),
    M(62, kNone, "", "Clear optional user M-code", kRelay),
    M(63, kNone, "", "Clear optional user M-code", kRelay),
    M(64, kNone, "", "Clear optional user M-code", kRelay),
    M(65, kNone, "", "Clear optional user M-code", kRelay),
    M(69, kNone, "P", "Clear output relay", kRelay),
    M(73, kNone, "", "Tool air blast (TAB) on"),
    M(74, kNone, "", "Tool air blast (TAB) off"),
    M(75, kUnsup, "", "Set G35 or G136 reference point", kProbe),
    M(78, kUnsup, "", "Alarm if skip signal found", kProbe),
    M(79, kUnsup, "", "Alarm if skip signal not found", kProbe),
    M(80, kNone, "", "Auto door open", "the door stays outside the working space"),
    M(81, kNone, "", "Auto door close", "the door stays outside the working space"),
    M(82, kUnsup, "", "Tool unclamp", "drops the tool"),
    M(83, kNone, "P", "Auto air gun on"),
    M(84, kNone, "", "Auto air gun off"),
    M(86, kUnsup, "", "Tool clamp"),
    M(88, kSim, "", "Through-spindle coolant on", "stops the spindle"),
    M(89, kSim, "", "Through-spindle coolant off", "stops the spindle; it does not start again"),
    M(95, kNone, "", "Sleep mode", "its duration is not part of the machine time"),
    M(96, kUnsup, "PQ", "Jump if no input", "inputs are not known here"),
    M(97, kSim, "PL", "Local subprogram call"),
    M(98, kSim, "PL", "Subprogram call"),
    M(99, kSim, "P", "Subprogram return or loop"),
    M(104, kUnsup, "", "Extend tool-setting probe arm", kNewer),
    M(105, kUnsup, "", "Retract tool-setting probe arm", kNewer),
    M(109, kUnsup, "P", "Interactive user input", "the operator's answer is not known here"),
    M(130, kNone, "", "Display media"),
    M(131, kNone, "", "Cancel display media"),
    M(138, kNone, "PE", "Spindle speed variation on"),
    M(139, kNone, "", "Spindle speed variation off"),
};

constexpr std::string_view kNotes =
    R"md(## How the text is read

Source: Haas NGC Mill Operator's Manual 2017, "Macros (Optional)", "M97" to "M99", "G65". Where it
leaves something open, ncsim takes the reading that cannot hide a crash, and says so.

- A space between an address and its number (`X 0`) is an error, as the manual's chapter "Editing"
  says. `X #1` and `X [..]` are fine. Lower case letters count as upper case.
- An address that stands twice in a block is an error, but for G, M, and the I J K of a macro
  call.
- `;` ends a block; only a comment may follow it on its line.
- A computed word is rounded to the last place of its address ("Address Substitution"): 4 places
  inch, 3 places mm and degrees, whole numbers for D, H, L, S, T. `ROUND` in an address rounds to
  the same places.
- `#0` is undefined: an address given an undefined value is dropped, `EQ` and `NE` tell undefined
  from 0, and in all other operations it counts as 0.
- Operators: functions before `* / MOD AND`, before `+ - OR XOR`, before comparisons, which is
  Fanuc's order; the manual has none. An expression in which `AND`, `OR` or `XOR` stands beside
  another operator without brackets, and `ATAN[a]/[b]`, are therefore `unsupported-code` beside
  their value.
- A common variable that the program reads before it sets it is undefined by assumption: the
  control keeps these over power-off.
- `GOTO` and `M99 P` look for the block number from the current block to the program's end, then
  from its beginning. A number that stands more than once is `unsupported-code`. `M99 P` in a
  subprogram jumps in that subprogram.
- Subprograms are looked for in the calling file, in the main program's file, in its folder, then
  in the folders that job and model name. One that is not found is `unsupported-code`, and the
  program goes on behind the call.
- `M99` in the main program ends the check: the control would start the program again.
- Calls may be nested 10 deep, G65 9 deep, loops 3 deep in each subprogram. A program that has not
  ended after 50 million blocks is stopped, and `unsupported-code` says so.
)md";

}  // namespace

const Dialect& HaasNgc() {
  static const Dialect dialect = {"haas-ngc", "Haas NGC mill (2017)", kCodes, kNotes};
  return dialect;
}

}  // namespace ncsim::nc
