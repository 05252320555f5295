// SPDX-License-Identifier: BSD-3-Clause
#include <Eigen/LU>
#include <cmath>
#include <cstring>
#include <nlohmann/json.hpp>
#include <sstream>

#include "sim/base/units.h"
#include "sim/report/packed.h"
#include "sim/report/page.h"

namespace ncsim::report {
namespace {

using Json = nlohmann::ordered_json;
using Eigen::Vector3d;

constexpr double kVertexUnits = 1e3;     // a mm
constexpr double kClearanceUnits = 1e3;  // a mm

/// Columns behind each other; JSON says where each begins and how many numbers it has.
class Columns {
 public:
  template <typename Value>
  Json Add(std::size_t count, const Value& value) {
    const std::size_t begin = bytes_.size();
    PackedColumn column(&bytes_);
    for (std::size_t i = 0; i < count; ++i) column.Add(value(i));
    return {begin, count};
  }
  const std::string& bytes() const { return bytes_; }

 private:
  std::string bytes_;
};

Json Coordinates(const Vector3d& v) { return {v.x(), v.y(), v.z()}; }

/// A limit or nothing, in mm or degrees.
Json Limit(double value, bool rotary) {
  if (!std::isfinite(value)) return nullptr;
  return rotary ? Degrees(value) : value;
}

std::string_view Word(machine::BodyKind kind) {
  switch (kind) {
    case machine::BodyKind::kMachine:
      return "machine";
    case machine::BodyKind::kFixture:
      return "fixture";
    case machine::BodyKind::kPart:
      return "part";
    case machine::BodyKind::kStock:
      return "stock";
    case machine::BodyKind::kFlutes:
      return "flutes";
    case machine::BodyKind::kShank:
      return "shank";
    case machine::BodyKind::kHolder:
      return "holder";
  }
  return "";
}

Json Links(const machine::Machine& machine) {
  const kinematics::KinematicTree& tree = machine.tree;
  Json links = Json::array();
  for (const kinematics::Link& link : tree.links()) {
    Json item = {{"name", link.name}, {"parent", -1}, {"joint", -1}};
    if (link.parent_joint >= 0) {
      const kinematics::Joint& joint = tree.joints()[static_cast<std::size_t>(link.parent_joint)];
      const Eigen::Quaterniond q(joint.X_PJ.linear());
      item["parent"] = joint.parent_link;
      item["joint"] = joint.index;
      item["turns"] = joint.type == kinematics::JointType::kRevolute;
      item["place"] = Coordinates(joint.X_PJ.translation());
      item["rotation"] = {q.x(), q.y(), q.z(), q.w()};
      item["axis"] = Coordinates(joint.axis);
    }
    links.push_back(std::move(item));
  }
  return links;
}

Json Axes(const machine::Machine& machine) {
  Json axes = Json::array();
  for (const machine::Axis& axis : machine.axes) {
    axes.push_back({{"letter", std::string(1, axis.letter)},
                    {"joint", axis.joint},
                    {"rotary", axis.rotary},
                    {"lower", Limit(axis.lower, axis.rotary)},
                    {"upper", Limit(axis.upper, axis.rotary)}});
  }
  return axes;
}

Json Bodies(const Picture& picture, Columns* columns) {
  Json bodies = Json::array();
  for (const ShownBody& body : picture.bodies) {
    const auto coordinate = [&](int k) {
      return columns->Add(body.mesh.vertices.size(), [&](std::size_t i) {
        return std::llround(body.mesh.vertices[i][k] * kVertexUnits);
      });
    };
    Json vertices = {coordinate(0), coordinate(1), coordinate(2)};
    Json triangles = columns->Add(3 * body.mesh.triangles.size(), [&](std::size_t i) {
      return static_cast<std::int64_t>(body.mesh.triangles[i / 3][i % 3]);
    });
    bodies.push_back({{"name", body.name},
                      {"kind", Word(body.kind)},
                      {"link", body.link},
                      {"tool", body.tool},
                      {"color", body.color},
                      {"vertices", std::move(vertices)},
                      {"triangles", std::move(triangles)}});
  }
  return bodies;
}

Json Keys(const Recording& recording, Columns* columns) {
  const std::size_t count = recording.ticks.size();
  const auto joints = static_cast<std::size_t>(recording.num_joints);
  Json values = Json::array();
  for (std::size_t j = 0; j < joints; ++j) {
    values.push_back(columns->Add(
        count, [&](std::size_t i) { return std::int64_t{recording.values[i * joints + j]}; }));
  }
  return {{"ticks",
           columns->Add(count, [&](std::size_t i) { return std::int64_t{recording.ticks[i]}; })},
          {"values", std::move(values)},
          {"rotary", recording.rotary},
          {"end", recording.end}};
}

Json Steps(const Recording& recording, Columns* columns) {
  const std::vector<Step>& steps = recording.steps;
  const auto add = [&](const auto& field) {
    return columns->Add(steps.size(), [&](std::size_t i) { return std::int64_t{field(steps[i])}; });
  };
  return {{"begin", add([](const Step& s) { return s.begin; })},
          {"file", add([](const Step& s) { return s.where.file; })},
          {"line", add([](const Step& s) { return s.where.line; })},
          {"kind", add([](const Step& s) { return static_cast<int>(s.kind); })},
          {"tool", add([](const Step& s) { return s.tool; })}};
}

Json Clearance(const ClearanceTrack& track, Columns* columns) {
  const auto& samples = track.samples;
  const auto add = [&](const auto& field) {
    return columns->Add(samples.size(), [&](std::size_t i) { return field(samples[i]); });
  };
  return {
      {"ticks", add([](const auto& s) { return std::int64_t{s.tick}; })},
      {"values", add([](const auto& s) { return std::llround(s.clearance_mm * kClearanceUnits); })},
      {"pair", add([](const auto& s) { return std::int64_t{s.pair}; })},
      {"pairs", track.pairs}};
}

/// Where each finding's contact is in the machine frame: findings have it as the control would show
/// it.
Json Contacts(const Page& page) {
  const machine::Machine& machine = *page.picture->machine;
  Json contacts = Json::array();
  for (const Finding& finding : page.result->findings) {
    Json points = Json::array();
    motion::JointVector q = machine.Home();
    for (const auto& [letter, value] : finding.axes) {
      const machine::Axis* axis = machine.FindAxis(letter);
      if (axis != nullptr) q[axis->joint] = axis->rotary ? Radians(value) : value;
    }
    if (!finding.points.empty()) {
      const Vector3d origin = machine.Coordinates(Vector3d::Zero(), q);
      Eigen::Matrix3d shown;
      for (int k = 0; k < 3; ++k) {
        shown.col(k) = machine.Coordinates(Vector3d::Unit(k), q) - origin;
      }
      for (const std::array<double, 3>& p : finding.points) {
        points.push_back(Coordinates(shown.inverse() * (Vector3d(p[0], p[1], p[2]) - origin)));
      }
    }
    contacts.push_back(std::move(points));
  }
  return contacts;
}

}  // namespace

std::string PageData(const Page& page) {
  const Picture& picture = *page.picture;
  Columns columns;
  Json scene;
  scene["machine"] = {{"name", picture.machine->name},
                      {"spindle", picture.machine->spindle_link},
                      {"table", picture.machine->table_link},
                      {"links", Links(*picture.machine)},
                      {"axes", Axes(*picture.machine)}};
  scene["units"] = {{"ticks_per_s", kTicksPerSecond},
                    {"values_per_unit", kValuesPerUnit},
                    {"vertices_per_mm", kVertexUnits},
                    {"clearance_per_mm", kClearanceUnits},
                    {"shown_within_mm", kShownTolerance}};
  scene["kinds"] = {"rapid", "feed", "arc", "dwell", "toolchange"};
  scene["bodies"] = Bodies(picture, &columns);
  scene["tools"] = Json::array();
  for (const ShownTool& tool : picture.tools) {
    scene["tools"].push_back({{"number", tool.number},
                              {"name", tool.name},
                              {"length", tool.length},
                              {"diameter", tool.diameter}});
  }
  scene["keys"] = Keys(picture.recording, &columns);
  scene["steps"] = Steps(picture.recording, &columns);
  scene["clearance"] = Clearance(page.clearance, &columns);
  scene["contacts"] = Contacts(page);
  scene["texts"] = Json::array();
  for (const PageText& text : page.texts) {
    scene["texts"].push_back({{"name", text.name}, {"text", text.text}});
  }
  scene["summary"] = Summary(*page.result);
  std::ostringstream result;
  WriteJson(*page.result, *page.files, result);
  const std::string json = "{\"result\":" + result.str() + ",\"scene\":" +
                           scene.dump(-1, ' ', false, Json::error_handler_t::replace) + "}";
  const auto length = static_cast<std::uint32_t>(json.size());
  std::string data(sizeof(length), '\0');
  std::memcpy(data.data(), &length, sizeof(length));
  return data + json + columns.bytes();
}

}  // namespace ncsim::report
