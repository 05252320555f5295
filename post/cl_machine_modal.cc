// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "post/cl_machine.h"
#include "post/cl_text.h"
#include "sim/base/units.h"

namespace ncsim::post {
namespace {

/// Directions of a frame are printed with four decimals or more.
constexpr double kFrameTolerance = 1e-3;

std::shared_ptr<const ClModal> StartModal() {
  auto modal = std::make_shared<ClModal>();
  modal->tool = std::make_shared<ClTool>();
  modal->operation = std::make_shared<ClOperation>();
  return modal;
}

/// The rotation with X along `x` and Y toward `y`; nothing where they are not unit and square.
std::optional<Eigen::Matrix3d> RotationOf(const Eigen::Vector3d& x, const Eigen::Vector3d& y) {
  if (std::abs(x.norm() - 1.0) > kFrameTolerance || std::abs(y.norm() - 1.0) > kFrameTolerance ||
      std::abs(x.dot(y)) > kFrameTolerance) {
    return std::nullopt;
  }
  Eigen::Matrix3d rotation;
  rotation.col(0) = x.normalized();
  rotation.col(2) = x.cross(y).normalized();
  rotation.col(1) = rotation.col(2).cross(rotation.col(0));
  return rotation;
}

Eigen::Isometry3d Pose(const Eigen::Matrix3d& rotation, const Eigen::Vector3d& origin) {
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.linear() = rotation;
  pose.translation() = origin;
  return pose;
}

/// TLDATA of a mill or a drill and CUTTER begin with diameter and corner radius.
bool BeginsWithDiameter(const std::string& kind) {
  for (const char* known : {"MILL", "DRILL", "CUTTER"}) {
    if (kind.rfind(known, 0) == 0) return true;
  }
  return false;
}

}  // namespace

ClMachine::ClMachine(std::string name, int file, const ClOptions& options, Diagnostics* diagnostics)
    : name_(std::move(name)),
      file_(file),
      options_(options),
      flavour_(options.flavour.value()),
      scale_(options.unit.value() == ClUnit::kInch ? kMmPerInch : 1.0),
      diagnostics_(diagnostics),
      modal_(StartModal()) {}

void ClMachine::End(int line) {
  where_ = {file_, std::max(line, 1), 1};
  if (circle_ && circle_->end) CloseArc();
  DropCircle();
  if (in_operation_) {
    Error("the file ends inside the operation " + Quoted(modal_->operation->name) +
          ": END-OF-PATH is missing");
  } else if (!ended_ && flavour_ != ClFlavour::kNx) {
    Error("the file ends without FINI");
  }
  if (!moved_) Error("a file without a motion");
  Emit(ClEnd{});
}

void ClMachine::BeginOperation(ClOperation operation) {
  const ClOperation& before = *modal_->operation;
  operation.index = before.index + 1;
  operation.where = where_;
  operation.X_AM = before.X_AM;
  begins_ = where_;
  ChangeModal([&operation](ClModal* modal) {
    modal->operation = std::make_shared<ClOperation>(std::move(operation));
  });
}

void ClMachine::On(cl::OperationBegin&& begin) {
  DropCircle();
  if (in_operation_) {
    Error("an operation begins inside " + Quoted(modal_->operation->name) +
          ": END-OF-PATH is missing");
  }
  ClOperation operation;
  operation.name = std::move(begin.name);
  BeginOperation(std::move(operation));
  if (flavour_ != ClFlavour::kNx) return;
  in_operation_ = true;
  rapid_ = false;
  axis_ = Eigen::Vector3d::UnitZ();
  if (!begin.tool.empty()) announced_.name = std::move(begin.tool);
}

void ClMachine::On(cl::OperationEnd&&) {
  DropCircle();
  if (!in_operation_) return Error("END-OF-PATH without its TOOL PATH");
  if (cycle_) Error("an operation ends inside a cycle: CYCLE/OFF is missing");
  if (rapid_) Error("an operation ends after RAPID, before its motion");
  cycle_.reset();
  rapid_ = false;
  in_operation_ = false;
  Emit(ClOperationEnd{});
}

void ClMachine::On(cl::End&&) {
  DropCircle();
  if (cycle_) Error("the file ends inside a cycle: CYCLE/OFF is missing");
  if (rapid_) Error("the file ends after RAPID, before its motion");
  ended_ = true;
}

void ClMachine::On(cl::Msys&& msys) {
  DropCircle();
  const auto rotation = RotationOf(msys.x, msys.y);
  if (!rotation) return Error("the axes of MSYS are not of length 1 and square to each other");
  const Eigen::Isometry3d X_AM = Pose(*rotation, msys.origin * scale_);
  const std::optional<Eigen::Isometry3d>& before = modal_->operation->X_AM;
  if (!before || before->matrix() != X_AM.matrix()) pose_.reset();
  ChangeModal([&X_AM](ClModal* modal) {
    auto operation = std::make_shared<ClOperation>(*modal->operation);
    operation->X_AM = X_AM;
    modal->operation = std::move(operation);
  });
}

void ClMachine::On(cl::Csys&& csys) {
  DropCircle();
  const std::array<double, 12>& row = csys.rows;
  const auto rotation = RotationOf({row[0], row[4], row[8]}, {row[1], row[5], row[9]});
  const Eigen::Vector3d z(row[2], row[6], row[10]);
  if (!rotation || (rotation->col(2) - z).norm() > 2.0 * kFrameTolerance) {
    return Error("the rows of CSYS are no rotation");
  }
  ClOperation operation;
  operation.setup = Pose(*rotation, Eigen::Vector3d(row[3], row[7], row[11]) * scale_);
  BeginOperation(std::move(operation));
}

void ClMachine::On(cl::ToolShape&& shape) { announced_.shape = std::move(shape); }

void ClMachine::ApplyAnnounced(ClTool* tool) {
  if (announced_.name) tool->name = *announced_.name;
  if (announced_.shape) {
    const std::vector<double>& values = announced_.shape->values;
    tool->kind = announced_.shape->kind;
    tool->values = values;
    tool->diameter.reset();
    tool->corner_radius.reset();
    if (BeginsWithDiameter(tool->kind)) {
      tool->diameter = values[0] * scale_;
      if (values.size() > 1) tool->corner_radius = values[1] * scale_;
    }
  }
  announced_ = {};
}

void ClMachine::SetTool(ClTool tool) {
  ChangeModal([&tool](ClModal* modal) { modal->tool = std::make_shared<ClTool>(std::move(tool)); });
}

void ClMachine::On(cl::LoadTool&& load) {
  DropCircle();
  const ClTool& before = *modal_->tool;
  const bool change = before.number != load.number;
  ClTool tool = change ? ClTool() : before;
  tool.number = load.number;
  tool.length_register = load.length_register;
  if (load.length) tool.length = *load.length * scale_;
  ApplyAnnounced(&tool);
  SetTool(std::move(tool));
  if (change) pose_.reset();
  Emit(ClToolLoad{change});
}

void ClMachine::BeforeMotion() {
  moved_ = true;
  if (flavour_ == ClFlavour::kNx && !in_operation_) {
    ErrorOnce(&said_.outside, "a motion outside of TOOL PATH and END-OF-PATH");
  }
  const ClTool& before = *modal_->tool;
  if (announced_.name || announced_.shape) {
    const bool other = announced_.name && before.number && *announced_.name != before.name &&
                       !(before.name.empty() && before.kind.empty());
    if (other && options_.need_tool) {
      Error("the operation uses the tool " + Quoted(*announced_.name) + " and loads none, with " +
            Quoted(before.name) + " in the spindle");
    }
    ClTool tool = before;
    ApplyAnnounced(&tool);
    SetTool(std::move(tool));
  }
  if (modal_->tool->number) return;
  if (options_.first_tool) {
    ClTool tool = *modal_->tool;
    tool.number = options_.first_tool;
    SetTool(std::move(tool));
    Emit(ClToolLoad{true});
  } else if (options_.need_tool) {
    ErrorOnce(&said_.tool, "a motion, and no tool is loaded: LOAD/TOOL or LOADTL is missing");
  }
}

void ClMachine::On(cl::Spindle&& spindle) {
  using Mode = cl::Spindle::Mode;
  if (spindle.mode == Mode::kOn) {
    if (!last_spindle_) return Error("SPINDL without a speed, and none before it");
    if (spindle.clockwise) last_spindle_->clockwise = spindle.clockwise;
    if (!spindle.range.empty()) last_spindle_->range = spindle.range;
    spindle = *last_spindle_;
  }
  if (spindle.mode == Mode::kRpm || spindle.mode == Mode::kSurface) {
    if (!spindle.clockwise) spindle.clockwise = !last_spindle_ || *last_spindle_->clockwise;
    last_spindle_ = spindle;
  }
  ChangeModal([&spindle](ClModal* modal) { modal->spindle = spindle; });
  Emit(std::move(spindle));
}

void ClMachine::On(cl::Coolant&& coolant) {
  ChangeModal([&coolant](ClModal* modal) { modal->coolant = coolant; });
  Emit(coolant);
}

void ClMachine::On(cl::CutterComp&& comp) {
  using Side = cl::CutterComp::Side;
  if (comp.side == Side::kOn) {
    if (!last_comp_) return Error("CUTCOM/ON, and no side before it");
    comp = *last_comp_;
  }
  if (comp.side != Side::kOff) last_comp_ = comp;
  ChangeModal([&comp](ClModal* modal) { modal->comp = comp; });
  Emit(comp);
}

}  // namespace ncsim::post
