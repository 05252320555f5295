// SPDX-License-Identifier: BSD-3-Clause
// CYCLE800 on a machine with tables: retracts, turns the rotary axes so that the plane's normal
// points along the tool, and lays a frame into the plane (NC programming 12/2019, "Programming
// cycles externally"; SD55221; $TC_CARR of the swivel data record).
#include <Eigen/Geometry>
#include <cmath>
#include <utility>

#include "kinematics/reachable.h"
#include "sim/base/text.h"
#include "sim/base/units.h"
#include "sim/control/sinumerik_interpreter.h"

namespace ncsim::control {
namespace {

constexpr unsigned kOneSolution = 1U << 7;  ///< SD55221: at the pole either _DIR is the same.
constexpr unsigned kPoleBySign = 1U << 13;  ///< SD55221: at the pole -1 turns by 180 deg more.
constexpr unsigned kPoleIsLeft = 1U << 4;   ///< SD55221: at the pole the plane's turn is left out.
constexpr double kStandsThere = 1e-5;       // rad

bool IsZero(const SettableFrame& frame) {
  return (frame.Linear() - Eigen::Matrix3d::Identity()).isZero(0.0);
}

}  // namespace

/// "" or what keeps CYCLE800 from being simulated here.
std::string SinumerikInterpreter::CannotSwivel(const SinumerikCycleArguments& arguments) const {
  if (traori_) return "under TRAORI";
  if (arguments.empty()) return "";
  if (!Is(kSinComp, "G40")) return "with G41 or G42";
  const bool tables = parts_.frames->can_rotate() && parts_.frames->tool_is_upright();
  if (!tables || parts_.frames->five_axis().rotary().size() != 2) {
    return "on a machine without two rotary tables";
  }
  if (!IsZero(modal_.settable)) return "with a turned work offset (alarm 62186)";
  const AxisValues shift = modal_.settable.shift();
  if (shift[kA] != 0.0 || shift[kB] != 0.0 || shift[kC] != 0.0) {
    return "with a work offset of the rotary axes";
  }
  const auto parameter = UnsupportedSwivel(arguments, plane_);
  return parameter ? "with " + *parameter : "";
}

void SinumerikInterpreter::Swivel(const SinumerikCycleArguments& arguments,
                                  const SourcePosition& where) {
  if (const std::string why = CannotSwivel(arguments); !why.empty()) {
    return Unsupported("CYCLE800 " + why, where);
  }
  const std::string name(arguments.Text("_TC"));
  const bool deselects = arguments.empty() || name == "0";
  const bool additive = arguments.Whole("_ST") % 10 == 1;
  if (additive && !modal_.program.is_zero()) {
    return Unsupported("CYCLE800 with _ST = 1 behind TRANS, ROT ...", where);
  }
  SwivelPlane plane;
  JointVector joints = axes_.Joints(MachinePosition());
  if (!deselects) {
    if (!name.empty()) {
      log_.Assume("swivel data " + name, "the record \"" + name + "\" describes the tables", false);
    }
    const SwivelPlane from = additive ? swivel_.plane : SwivelPlane();
    if (!SolveSwivel(arguments, from, where, &plane, &joints)) return;
  }
  if (!RetractToSwivel(arguments, where)) return;
  if (arguments.Whole("_DIR") != 0 && !deselects) {
    TurnTables(axes_.Values(joints), Digit(arguments.Whole("_ST"), 1) == 1);
  }
  if (log_.stopped()) return;
  if (!additive) modal_.program = {};
  swivel_ = {!deselects, plane, axes_.Values(joints)};
  new_frame_ = frame_dirty_ = true;
  RefreshFrame();
}

/// The plane, and the rotary joints of `joints` set to where its normal points along the tool.
/// False: it has been said why not.
bool SinumerikInterpreter::SolveSwivel(const SinumerikCycleArguments& arguments,
                                       const SwivelPlane& from, const SourcePosition& where,
                                       SwivelPlane* plane, JointVector* joints) {
  const kinematics::FiveAxis& five_axis = parts_.frames->five_axis();
  const std::vector<int>& rotary = five_axis.rotary();
  std::string unsupported;
  std::optional<Eigen::Matrix3d> rotation;
  const bool direct = IsDirectSwivel(arguments);
  kinematics::RotarySolution asked;
  if (direct) {
    // The plane's axes are the machine's, when the tables have turned there.
    asked.angles = {Radians(arguments.Number("_A")), Radians(arguments.Number("_B"))};
    JointVector turned = *joints;
    for (std::size_t i = 0; i < rotary.size(); ++i) turned[rotary[i]] = asked.angles.at(i);
    rotation = from.rotation.transpose() *
               parts_.frames->OnTable({}, axes_.Values(turned)).linear.transpose();
  } else {
    rotation = SwivelRotation(arguments, &unsupported);
  }
  if (!rotation) {
    Unsupported("CYCLE800 with " + unsupported, where);
    return false;
  }
  *plane = from.Then(ShiftedPlane(arguments, *rotation));
  std::array<double, 2> here{};
  for (std::size_t i = 0; i < rotary.size(); ++i) here.at(i) = (*joints)[rotary[i]];
  const Eigen::Vector3d u_B = parts_.frames->DirectionInTable(plane->rotation.col(2)).normalized();
  std::vector<kinematics::RotarySolution> solutions =
      kinematics::ReachableRotary(five_axis, u_B, here, RotaryLimitsOf(*parts_.machine, five_axis));
  if (direct) {
    std::erase_if(solutions, [&](const kinematics::RotarySolution& solution) {
      return std::abs(std::remainder(solution.angles[0] - asked.angles[0], 2.0 * kPi)) >
             kStandsThere;
    });
  }
  if (solutions.empty()) {
    return Alarm(where, 61184,
                 "no position of the rotary axes within their limits turns the plane "
                 "to the tool");
  }
  const long direction = arguments.Whole("_DIR");
  std::optional<kinematics::RotarySolution> chosen;
  if (direction == 0) {
    chosen = StandingSwivel(solutions, here, where);
  } else if (direct && solutions.front().at_pole) {
    chosen = asked;
    chosen->angles[1] = here[1] + std::remainder(asked.angles[1] - here[1], 2.0 * kPi);
  } else {
    chosen = TurnedSwivel(std::move(solutions), here, *plane, arguments, where);
  }
  if (!chosen) return false;
  for (std::size_t i = 0; i < rotary.size(); ++i) (*joints)[rotary[i]] = chosen->angles.at(i);
  return true;
}

/// _DIR 0 moves nothing: the axes must stand there already.
std::optional<kinematics::RotarySolution> SinumerikInterpreter::StandingSwivel(
    const std::vector<kinematics::RotarySolution>& solutions, const std::array<double, 2>& here,
    const SourcePosition& where) {
  for (kinematics::RotarySolution solution : solutions) {
    const bool there = std::abs(solution.angles[0] - here[0]) <= kStandsThere &&
                       std::abs(solution.angles[1] - here[1]) <= kStandsThere;
    if (!there) continue;
    solution.angles = here;
    return solution;
  }
  Unsupported("CYCLE800 with _DIR = 0", where,
              "the rotary axes do not stand in the plane, and it does not turn them");
  return std::nullopt;
}

std::optional<kinematics::RotarySolution> SinumerikInterpreter::TurnedSwivel(
    std::vector<kinematics::RotarySolution> solutions, const std::array<double, 2>& here,
    const SwivelPlane& plane, const SinumerikCycleArguments& arguments,
    const SourcePosition& where) {
  const int reference = settings_.swivel_reference;
  if (solutions.front().at_pole)
    return PoleSwivel(solutions.front(), here, plane, arguments, where);
  if (solutions.size() > 1) {
    AssumeOfSwivel(kSwivelReference, reference != 0, "swivel direction",
                   "_DIR of CYCLE800 refers to the first rotary axis");
  }
  const int index = reference == 2 ? 1 : 0;
  const int joint = parts_.frames->five_axis().rotary()[static_cast<std::size_t>(index)];
  bool endless = false;
  for (int i = kA; i < kNumAxes; ++i) {
    if (axes_.joint(i) == joint)
      endless = settings_.rotary[static_cast<std::size_t>(i - kA)].modulo;
  }
  return ChooseSwivel(solutions, arguments.Whole("_DIR"), index, endless);
}

/// What the run owes to `setting`: the model's nominal value of it or, where nobody states one,
/// `instead`, which keeps the verdict from being pass.
void SinumerikInterpreter::AssumeOfSwivel(std::string_view setting, bool stated,
                                          std::string_view name, std::string_view instead) {
  if (!stated) return log_.Assume(name, std::string(instead), true);
  const auto nominal = settings_.swivel_nominal.find(std::string(setting));
  if (nominal != settings_.swivel_nominal.end()) log_.Assume(setting, nominal->second, false);
}

/// With the normal along the last rotary axis, that axis takes over the turn within the plane.
std::optional<kinematics::RotarySolution> SinumerikInterpreter::PoleSwivel(
    kinematics::RotarySolution solution, const std::array<double, 2>& here,
    const SwivelPlane& plane, const SinumerikCycleArguments& arguments,
    const SourcePosition& where) {
  const unsigned mask = settings_.swivel_mask.value_or(0);
  const auto residual = [&](double angle) {
    JointVector joints = axes_.Joints(AxisValues{});
    const std::vector<int>& rotary = parts_.frames->five_axis().rotary();
    joints[rotary[0]] = solution.angles[0];
    if (rotary.size() > 1) joints[rotary[1]] = angle;
    const Eigen::Matrix3d turned =
        parts_.frames->OnTable({}, axes_.Values(joints)).linear * plane.rotation;
    return std::atan2(turned(1, 0), turned(0, 0));
  };
  const double turn = residual(0.0);
  double angle = std::abs(residual(turn)) < std::abs(residual(-turn)) ? turn : -turn;
  if ((mask & kPoleIsLeft) != 0 && (mask & kPoleBySign) == 0 && std::abs(turn) > kStandsThere) {
    Unsupported("CYCLE800 about the tool with SD55221 bit 4 = 1", where);
    return std::nullopt;
  }
  if ((mask & kPoleBySign) != 0 && arguments.Whole("_DIR") < 0) {
    angle += kPi;
    if (!IsAxisByAxisSwivel(arguments)) {
      log_.Assume("swivel at the pole by another mode",
                  "with SD55221 bit 13, which is stated for turns axis by axis, CYCLE800 turns the "
                  "last table 180 degrees more with _DIR = -1 for a solid angle too",
                  true);
    }
  }
  AssumeOfSwivel(kSwivelMask, (mask & (kPoleBySign | kOneSolution)) != 0, "swivel at the pole",
                 "where the plane's normal is the axis of the last table, CYCLE800 turns that "
                 "table by the plane's turn in itself, and not by 180 deg more (SD55221 bits 7 and "
                 "13)");
  solution.angles[1] = angle + 2.0 * kPi * std::round((here[1] - angle) / (2.0 * kPi));
  return solution;
}

/// _FR: 0 not at all, 1 Z, 2 Z, then X and Y, 4 and 5 along the tool, as far as it goes or by
/// _FR_I.
bool SinumerikInterpreter::RetractToSwivel(const SinumerikCycleArguments& arguments,
                                           const SourcePosition& where) {
  const long way = arguments.Whole("_FR");
  if (way == 0) return true;
  if (arguments.Whole("_DIR") == 0 && arguments.Text("_TC") != "0") {
    Unsupported("CYCLE800 with a retraction and _DIR = 0", where);
    return false;
  }
  AxisValues target = MachinePosition();
  if (way == 4) {
    target[kZ] = axes_.data(kZ).upper;
  } else if (way == 5) {
    if (arguments.Number("_FR_I") < 0.0) return Alarm(where, 61190, "_FR_I is negative");
    target[kZ] += arguments.Length("_FR_I");
  } else if (way == 1 || way == 2) {
    for (const int axis : {kX, kY, kZ}) {
      const auto& stated = settings_.swivel_retract[static_cast<std::size_t>(axis)];
      target[static_cast<std::size_t>(axis)] = stated.value_or(axes_.data(axis).home);
      if (way == 1 && axis != kZ) continue;
      AssumeOfSwivel(kSwivelRetract.at(static_cast<std::size_t>(axis)), stated.has_value(),
                     "swivel retraction",
                     "CYCLE800 retracts to the model's home position ($TC_CARR38 to 40)");
    }
  } else {
    return Alarm(where, 61183, "_FR is none of 0, 1, 2, 4 and 5");
  }
  PushMachine(CommandKind::kMachineRapid, 1U << kZ, target);
  if (way == 2) PushMachine(CommandKind::kMachineRapid, 1U << kX | 1U << kY, target);
  return !log_.stopped();
}

/// `tracks`: the linear axes go with the part, so that the tip stays on it.
void SinumerikInterpreter::TurnTables(const AxisValues& target, bool tracks) {
  log_.Assume("swivel turn", "CYCLE800 turns the tables together, each the shortest way", false);
  unsigned named = 0;
  for (int axis = kA; axis < kNumAxes; ++axis) {
    if (axes_.has(axis)) named |= 1U << axis;
  }
  if (!tracks) return PushMachine(CommandKind::kMachineRapid, named, target);
  Frame frame = SuppressedFrame();
  frame.offset = modal_.settable.shift();
  frame.offset_index = frame_->offset_index;
  frame.tool_length = active_.length;
  frame.rotation = Frame::Rotation::kTcp;
  UseFrame(frame);
  command_.frame = frame_;
  command_.kind = CommandKind::kRapid;
  command_.named = static_cast<std::uint8_t>(named);
  command_.end = position_;
  for (std::size_t axis = kA; axis < kNumAxes; ++axis) command_.end[axis] = target[axis];
  contour_.Push(command_);
  position_ = command_.end;
}

}  // namespace ncsim::control
