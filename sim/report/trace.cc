// SPDX-License-Identifier: BSD-3-Clause
#include <charconv>
#include <cmath>

#include "sim/base/units.h"
#include "sim/report/result.h"

namespace ncsim::report {
namespace {

constexpr std::string_view kHeader = "file,line,kind,time_s,X,Y,Z,A,B,C,px,py,pz,ui,uj,uk,feed\n";
constexpr std::string_view kLetters = "XYZABC";

/// ",-12.345678": six decimals, never "-0.000000"; empty for what is not a finite number.
void AppendNumber(double value, std::string* row) {
  row->push_back(',');
  if (!std::isfinite(value)) return;
  if (std::abs(value) < 0.5e-6) value = 0.0;
  char buffer[400];  // The longest finite double has 309 digits before the point.
  const auto [end, error] =
      std::to_chars(buffer, buffer + sizeof(buffer), value, std::chars_format::fixed, 6);
  if (error == std::errc()) row->append(buffer, end);
}

/// RFC 4180: quoted where the name needs it.
void AppendName(const std::string& name, std::string* row) {
  if (name.find_first_of(",\"\r\n") == std::string::npos) {
    row->append(name);
    return;
  }
  row->push_back('"');
  for (const char c : name) {
    if (c == '"') row->push_back('"');
    row->push_back(c);
  }
  row->push_back('"');
}

}  // namespace

TraceWriter::TraceWriter(const machine::Machine& machine, std::ostream& out)
    : machine_(&machine), out_(&out) {
  for (std::size_t i = 0; i < axes_.size(); ++i) axes_.at(i) = machine.FindAxis(kLetters[i]);
  *out_ << kHeader;
}

void TraceWriter::Write(const motion::Motion& motion, const Eigen::Isometry3d& X_BP,
                        double tool_length, const SourceFiles& files) {
  const motion::JointVector& q = motion.q1();
  row_.clear();
  AppendName(files.name(motion.where.file), &row_);
  row_.push_back(',');
  row_ += std::to_string(motion.where.line);
  row_.push_back(',');
  row_ += motion::ToString(motion.kind);
  AppendNumber(motion.start_time + motion.duration, &row_);
  for (const machine::Axis* axis : axes_) {
    if (axis == nullptr) {
      row_.push_back(',');
    } else {
      AppendNumber(axis->rotary ? Degrees(q[axis->joint]) : q[axis->joint], &row_);
    }
  }
  const Eigen::Isometry3d X_MP = machine_->tree.Pose(machine_->table_link, q) * X_BP;
  const Eigen::Isometry3d X_PS =
      X_MP.inverse(Eigen::Isometry) * machine_->tree.Pose(machine_->spindle_link, q);
  const Eigen::Vector3d p_PT_P = X_PS * Eigen::Vector3d(0.0, 0.0, tool_length);
  const Eigen::Vector3d u_P =
      -X_PS.linear().col(2);  // Z_S points at the tool, the tool axis away from the tip.
  for (int i = 0; i < 3; ++i) AppendNumber(p_PT_P[i], &row_);
  for (int i = 0; i < 3; ++i) AppendNumber(u_P[i], &row_);
  AppendNumber(60.0 * motion.facts.feed, &row_);
  row_.push_back('\n');
  out_->write(row_.data(), static_cast<std::streamsize>(row_.size()));
}

}  // namespace ncsim::report
