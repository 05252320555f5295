// SPDX-License-Identifier: BSD-3-Clause
// Every struct is taken apart by a structured binding of all its members. One that is added does
// not compile until it stands here: either it is put in, or it is named and left out, because it
// follows from others or no outcome reads it (CacheTest.WhatKeysLeaveOutChangesNothing).
#include "sim/collision/content.h"

#include "sim/base/bytes.h"
#include "sim/collision/pair_check.h"

namespace ncsim::collision {

void PutDigest(const Digest& digest, ByteWriter* out) {
  for (const std::uint64_t word : digest.words) out->Put(word);
}

namespace {

template <class Derived>
void Put(const Eigen::MatrixBase<Derived>& matrix, ByteWriter* out) {
  out->Put(static_cast<int>(matrix.size()));
  for (Eigen::Index i = 0; i < matrix.size(); ++i) out->Put(matrix.derived().data()[i]);
}

void Put(const machine::Profile& profile, ByteWriter* out) {
  const auto& [elements] = profile;
  for (const machine::ProfileElement& element : elements) {
    const auto& [start, end, arc, centre] = element;
    Put(start, out);
    Put(end, out);
    out->Put(arc);
    if (arc) Put(centre, out);
  }
}

void Put(const kinematics::FiveAxis& five_axis, ByteWriter* out) {
  for (const double number : five_axis.Parameters()) out->Put(number);
}

void Put(const kinematics::KinematicTree& tree, ByteWriter* out) {
  for (const kinematics::Link& link : tree.links()) {
    const auto& [name, parent_joint] = link;
    out->Put(parent_joint);
  }
  for (const kinematics::Joint& joint : tree.joints()) {
    const auto& [name, type, parent, child, X_PJ, axis, lower, upper, index] = joint;
    out->Put(type);
    out->Put(parent);
    out->Put(child);
    Put(X_PJ.matrix(), out);
    Put(axis, out);
    out->Put(index);
  }
}

void Put(const machine::Machine& machine, ByteWriter* out) {
  // Which pairs there are and how clear they are to be, the pairs themselves say.
  const auto& [name, path, tree, five_axis, spindle, table, axes, bodies, disabled, margins, poses,
               control, nominal] = machine;
  Put(tree, out);
  out->Put(five_axis.has_value());
  if (five_axis.has_value()) Put(*five_axis, out);
  out->Put(spindle);
  out->Put(table);
  for (const machine::Axis& each : axes) {
    const auto& [letter, joint, rotary, lower, upper, rapid, acceleration, home] = each;
    out->Put(letter);
    out->Put(joint);
    out->Put(rotary);
  }
}

void Put(const machine::CheckSettings& settings, ByteWriter* out) {
  const auto& [clearance, margins, part_tolerance, gouge_tolerance, gouge, exact_below] = settings;
  out->Put(clearance);  // the margins are in it
  out->Put(part_tolerance);
  out->Put(gouge_tolerance);
  out->Put(gouge);
  out->Put(exact_below);
}

void Put(const Pair& pair, ByteWriter* out) {
  const auto& [role, tool, mesh_a, b, names, swept] = pair;
  out->Put(role);
  for (const std::string& name : names) out->PutText(name);
  out->Put(tool != nullptr);
  PutDigest(tool != nullptr ? tool->content : mesh_a->content, out);
  PutDigest(b->content, out);
  out->Put(swept != nullptr);
  if (swept == nullptr) return;
  // What the other body sweeps follows from it and the machine.
  const auto& [swept_body, mesh, mesh_is_a] = *swept;
  PutDigest(mesh->content, out);
  out->Put(mesh_is_a);
}

void PutCycle(int cycle, int first, ByteWriter* out) {
  out->Put(cycle != 0);
  out->Put(cycle != 0 ? cycle - first : 0);
}

class MotionWriter {
 public:
  MotionWriter(const RunPlace& place, ByteWriter* out) : cycle_(place.cycle), out_(out) {}

  void Put(const motion::Motion& motion) {
    const auto& [kind, where, path, start_time, duration, facts] = motion;
    const auto& [feed, tcp, spindle_on, brake_conflict, exact_stop, tool, offset, cycle,
                 names_linear, corner_rounding, orientation_tolerance, wrap_note] = facts;
    out_->Put(kind);
    out_->Put(path.index());
    std::visit(*this, path);
    out_->Put(spindle_on);
    PutCycle(cycle, cycle_, out_);
    out_->Put(corner_rounding);
    out_->Put(orientation_tolerance);
  }

  void operator()(const motion::AxisLinear& line) {
    const auto& [q0, q1] = line;
    PutAll(q0, q1);
  }
  void operator()(const motion::DogLeg& rapid) {
    const auto& [q0, q1, duration, ramp] = rapid;
    PutAll(q0, q1, duration, ramp);
  }
  void operator()(const motion::AxisArc& arc) {
    const auto& [q0, q1, centre, e1, e2, pitch, end_error, radius, phi0, sweep, linear] = arc;
    PutAll(q0, q1, centre, e1, e2, pitch, end_error);
    for (const double number : {radius, phi0, sweep}) out_->Put(number);
    for (const int joint : linear) out_->Put(joint);
  }
  // A line leaves the arc's members unset.
  void operator()(const motion::TcpCurve& curve) {
    const auto& [frame, great_circle, q0, q1, arc, p0_B, p1_B, centre, e1, e2, pitch, end_error,
                 radius, phi0, sweep] = curve;
    PutFrame(frame.get());
    // Which one it is follows from the control's axes and the rotary joints at its ends.
    out_->Put(great_circle != nullptr);
    PutAll(q0, q1);
    out_->Put(arc);
    if (!arc) return PutAll(p0_B, p1_B);
    PutAll(centre, e1, e2, pitch, end_error);
    for (const double number : {radius, phi0, sweep}) out_->Put(number);
  }

 private:
  template <class... Vectors>
  void PutAll(const Vectors&... vectors) {
    (collision::Put(vectors, out_), ...);
  }

  // Many motions share one.
  void PutFrame(const motion::TcpFrame* frame) {
    if (frame != frame_) {
      const auto& [control, length, centre_error] = *frame;
      ByteWriter out;
      collision::Put(control, &out);
      out.Put(length);
      out.Put(centre_error);
      frame_ = frame;
      frame_content_ = DigestOf(out.bytes());
    }
    collision::PutDigest(frame_content_, out_);
  }

  int cycle_;
  ByteWriter* out_;
  const motion::TcpFrame* frame_ = nullptr;
  Digest frame_content_;
};

}  // namespace

Digest ContentOf(const machine::SceneBody& body) {
  const auto& [name, kind, link, mesh, defect] = body;
  const auto& [vertices, triangles, watertight] = mesh;
  ByteWriter out;
  out.PutText(name);
  out.Put(kind);
  out.Put(link);
  out.Put(watertight);
  out.PutText(defect);
  out.Put(vertices.size());
  for (const Eigen::Vector3d& vertex : vertices) Put(vertex, &out);
  for (const std::array<int, 3>& triangle : triangles) {
    for (const int corner : triangle) out.Put(corner);
  }
  return DigestOf(out.bytes());
}

Digest ContentOf(const ToolBody& body, const machine::Profile& profile) {
  const auto& [name, kind, tool, length, reach, extent, shape, fcl, thin, content] = body;
  ByteWriter out;
  out.PutText(name);
  out.Put(kind);
  out.Put(length);
  out.Put(extent.link);
  out.Put(thin);
  Put(profile, &out);
  return DigestOf(out.bytes());
}

Digest ContentOf(const PairSetup& setup) {
  const auto& [machine, settings, pair, path, swept_path, smoothing] = setup;
  ByteWriter out;
  Put(*machine, &out);
  Put(settings, &out);
  Put(pair, &out);
  return DigestOf(out.bytes());
}

RunPlace PlaceOf(const motion::Travel& run, std::uint64_t number) {
  RunPlace place;
  place.number = number;
  place.size = run.size();
  for (std::size_t i = 0; i < run.size() && place.cycle == 0; ++i) {
    place.cycle = run[i].facts.cycle;
  }
  return place;
}

Digest ContentOf(const motion::Travel& run, const RunPlace& place) {
  ByteWriter out;
  out.Put(run.tool_length());
  MotionWriter motions(place, &out);
  for (std::size_t i = 0; i < run.size(); ++i) motions.Put(run[i]);
  return DigestOf(out.bytes());
}

Digest ContentOf(const PairCarry& carry, const BlankState* blank, const RunPlace& place) {
  const auto& [least, reference, feeds, warned] = carry;
  const auto& [after_feed, feed_depth, depth, cycle, cycle_depth] = reference.memory();
  ByteWriter out;
  for (const double number : {least, feed_depth, depth, cycle_depth, feeds}) out.Put(number);
  out.Put(after_feed);
  out.Put(warned);
  // Without a cycle in the run, whatever number this one has.
  PutCycle(cycle, place.cycle != 0 ? place.cycle : cycle, &out);
  if (blank == nullptr) return DigestOf(out.bytes());
  const auto& [cut, motion, s] = *blank;
  const bool before = cut && motion < place.number;
  out.Put(cut);
  out.Put(before);
  if (cut && !before) {
    out.Put(motion - place.number);
    out.Put(s);
  }
  return DigestOf(out.bytes());
}

}  // namespace ncsim::collision
