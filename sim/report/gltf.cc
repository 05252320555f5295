// SPDX-License-Identifier: BSD-3-Clause
// Binary glTF 2.0: a JSON chunk that says what lies where in a binary chunk.
#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>
#include <nlohmann/json.hpp>

#include "sim/report/picture.h"

namespace ncsim::report {
namespace {

using Json = nlohmann::ordered_json;
using Eigen::Quaterniond;
using Eigen::Vector3d;

static_assert(std::endian::native == std::endian::little, "glTF is little-endian");

constexpr double kMetresPerMm = 1e-3;
/// Between two keys a viewer turns the shorter way: they are never further apart, rad.
constexpr double kMostTurn = 1.5;
constexpr int kFloat = 5126, kUnsigned = 5125;  // component types
constexpr int kVertexTarget = 34962, kIndexTarget = 34963;

/// Of the JSON chunk, and what it refers to in the binary one.
class Document {
 public:
  Document() {
    json_["asset"] = {{"version", "2.0"}, {"generator", "ncsim"}};
    json_["scene"] = 0;
    json_["scenes"] = Json::array({{{"nodes", Json::array({0})}}});
    for (const char* list : {"nodes", "materials", "meshes", "accessors", "bufferViews"}) {
      json_[list] = Json::array();
    }
  }

  /// The index of what was added.
  std::size_t Add(const char* list, Json item) {
    json_[list].push_back(std::move(item));
    return json_[list].size() - 1;
  }
  Json& node(std::size_t i) { return json_["nodes"][i]; }
  Json& operator[](const char* key) { return json_[key]; }

  /// `data` in rows of `width` numbers; `target` 0 for what is no mesh. Bounds where asked.
  std::size_t AddFloats(const std::vector<float>& data, std::size_t width, int target,
                        bool bounds) {
    static constexpr std::array<const char*, 5> kTypes = {"", "SCALAR", "", "VEC3", "VEC4"};
    Json accessor = {{"bufferView", AddView(data.data(), data.size() * sizeof(float), target)},
                     {"componentType", kFloat},
                     {"count", data.size() / width},
                     {"type", kTypes.at(width)}};
    if (bounds) {
      std::vector<float> least(data.begin(), data.begin() + static_cast<std::ptrdiff_t>(width));
      std::vector<float> most = least;
      for (std::size_t i = 0; i < data.size(); ++i) {
        least[i % width] = std::min(least[i % width], data[i]);
        most[i % width] = std::max(most[i % width], data[i]);
      }
      accessor["min"] = least;
      accessor["max"] = most;
    }
    return Add("accessors", std::move(accessor));
  }

  std::size_t AddIndices(const std::vector<std::uint32_t>& data) {
    return Add(
        "accessors",
        {{"bufferView", AddView(data.data(), data.size() * sizeof(std::uint32_t), kIndexTarget)},
         {"componentType", kUnsigned},
         {"count", data.size()},
         {"type", "SCALAR"}});
  }

  void Write(std::ostream& out) {
    json_["buffers"] = Json::array({{{"byteLength", bytes_.size()}}});
    std::string text = json_.dump(-1, ' ', false, Json::error_handler_t::replace);
    text.resize((text.size() + 3) / 4 * 4, ' ');
    const auto word = [&](std::size_t value) {
      const auto bits = static_cast<std::uint32_t>(value);
      out.write(reinterpret_cast<const char*>(&bits), sizeof(bits));
    };
    out << "glTF";
    word(2);
    word(12 + 8 + text.size() + 8 + bytes_.size());
    word(text.size());
    out << "JSON" << text;
    word(bytes_.size());
    out.write("BIN\0", 4);
    out.write(bytes_.data(), static_cast<std::streamsize>(bytes_.size()));
  }

 private:
  std::size_t AddView(const void* data, std::size_t size, int target) {
    Json view = {{"buffer", 0}, {"byteOffset", bytes_.size()}, {"byteLength", size}};
    if (target != 0) view["target"] = target;
    const auto* begin = static_cast<const char*>(data);
    bytes_.insert(bytes_.end(), begin, begin + size);  // All numbers have four bytes.
    return Add("bufferViews", std::move(view));
  }

  Json json_;
  std::vector<char> bytes_;
};

Json Numbers(const Vector3d& v) { return {v.x(), v.y(), v.z()}; }
Json Numbers(const Quaterniond& q) { return {q.x(), q.y(), q.z(), q.w()}; }

double Linear(float srgb) {
  return srgb <= 0.04045F ? srgb / 12.92 : std::pow((srgb + 0.055) / 1.055, 2.4);
}

std::size_t AddMesh(const ShownBody& body, Document* document) {
  const double opacity = body.color[3];
  Json material = {
      {"name", body.name},
      {"doubleSided", true},
      {"pbrMetallicRoughness",
       {{"baseColorFactor",
         {Linear(body.color[0]), Linear(body.color[1]), Linear(body.color[2]), opacity}},
        {"metallicFactor", 0.1},
        {"roughnessFactor", 0.7}}}};
  if (opacity < 1.0) material["alphaMode"] = "BLEND";
  std::vector<float> positions;
  positions.reserve(3 * body.mesh.vertices.size());
  for (const Vector3d& v : body.mesh.vertices) {
    for (const double x : v) positions.push_back(static_cast<float>(x * kMetresPerMm));
  }
  std::vector<std::uint32_t> indices;
  indices.reserve(3 * body.mesh.triangles.size());
  for (const auto& triangle : body.mesh.triangles) {
    for (const int i : triangle) indices.push_back(static_cast<std::uint32_t>(i));
  }
  const std::size_t shown = document->Add("materials", std::move(material));
  const std::size_t position = document->AddFloats(positions, 3, kVertexTarget, true);
  const std::size_t index = document->AddIndices(indices);
  return document->Add(
      "meshes",
      {{"name", body.name},
       {"primitives",
        {{{"attributes", {{"POSITION", position}}}, {"indices", index}, {"material", shown}}}}});
}

/// Where a link stands in its parent's: metres.
struct LinkPose {
  Vector3d translation;
  Quaterniond rotation;
};

LinkPose PoseIn(const machine::Machine& machine, int joint, double value) {
  const Eigen::Isometry3d X = machine.tree.joints()[static_cast<std::size_t>(joint)].X_PJ *
                              machine.tree.JointTransform(joint, value);
  return {kMetresPerMm * X.translation(), Quaterniond(X.linear()).normalized()};
}

/// Keys of the whole program, closer where a joint turns far.
struct Keys {
  std::vector<float> seconds;
  std::vector<motion::JointVector> poses;
};

Keys DenseKeys(const Recording& recording) {
  Keys keys;
  const auto add = [&](double tick, motion::JointVector q) {
    auto time = static_cast<float>(tick / kTicksPerSecond);
    if (!keys.seconds.empty() && time <= keys.seconds.back()) {
      time = std::nextafter(keys.seconds.back(), std::numeric_limits<float>::infinity());
    }
    keys.seconds.push_back(time);
    keys.poses.push_back(std::move(q));
  };
  for (std::size_t i = 0; i < recording.ticks.size(); ++i) {
    motion::JointVector q = recording.Key(i);
    if (i > 0) {
      const motion::JointVector before = keys.poses.back();
      double turn = 0.0;
      for (Eigen::Index j = 0; j < q.size(); ++j) {
        if (!recording.rotary[static_cast<std::size_t>(j)]) continue;
        turn = std::max(turn, std::abs(q[j] - before[j]));
      }
      const int parts = static_cast<int>(std::ceil(turn / kMostTurn));
      const double tick = recording.ticks[i - 1];
      for (int part = 1; part < parts; ++part) {
        const double s = static_cast<double>(part) / parts;
        add(std::lerp(tick, static_cast<double>(recording.ticks[i]), s), before + s * (q - before));
      }
    }
    add(recording.ticks[i], std::move(q));
  }
  return keys;
}

/// One animation: a track for each joint that moves, and one for each tool that says when it is
/// there (core glTF cannot hide: what is not there has no size).
class Animation {
 public:
  Animation(const Picture& picture, Document* document)
      : picture_(picture), document_(document), keys_(DenseKeys(picture.recording)) {
    if (!keys_.seconds.empty()) times_ = document->AddFloats(keys_.seconds, 1, 0, true);
  }

  void Move(std::size_t node, int joint) {
    const kinematics::Joint& data =
        picture_.machine->tree.joints()[static_cast<std::size_t>(joint)];
    const auto value = [&](const motion::JointVector& q) { return q[data.index]; };
    const bool still = std::all_of(keys_.poses.begin(), keys_.poses.end(), [&](const auto& q) {
      return value(q) == value(keys_.poses.front());
    });
    if (keys_.poses.empty() || still) return;
    const bool turns = data.type == kinematics::JointType::kRevolute;
    std::vector<float> output;
    output.reserve(keys_.poses.size() * (turns ? 4 : 3));
    for (const motion::JointVector& q : keys_.poses) {
      const LinkPose pose = PoseIn(*picture_.machine, joint, value(q));
      if (turns) {
        for (const double x : pose.rotation.coeffs()) output.push_back(static_cast<float>(x));
      } else {
        for (const double x : pose.translation) output.push_back(static_cast<float>(x));
      }
    }
    AddTrack(node, turns ? "rotation" : "translation", "LINEAR", times_,
             document_->AddFloats(output, turns ? 4 : 3, 0, false));
  }

  /// `node` has a size while T`tool` is in the spindle.
  void Show(std::size_t node, int tool) {
    std::vector<float> seconds, output;
    bool there = false;
    for (const Step& step : picture_.recording.steps) {
      const bool now = step.tool == tool;
      if (!seconds.empty() && now == there) continue;
      const auto time = static_cast<float>(step.begin / kTicksPerSecond);
      if (!seconds.empty() && time <= seconds.back()) {
        seconds.pop_back();
        output.resize(output.size() - 3);
      }
      seconds.push_back(time);
      output.insert(output.end(), 3, now ? 1.0F : 0.0F);
      there = now;
    }
    if (seconds.empty()) return;
    AddTrack(node, "scale", "STEP", document_->AddFloats(seconds, 1, 0, true),
             document_->AddFloats(output, 3, 0, false));
  }

  void Finish() {
    if (channels_.empty()) return;
    (*document_)["animations"] =
        Json::array({{{"name", "program"}, {"channels", channels_}, {"samplers", samplers_}}});
  }

 private:
  void AddTrack(std::size_t node, const char* path, const char* interpolation, std::size_t input,
                std::size_t output) {
    channels_.push_back(
        {{"sampler", samplers_.size()}, {"target", {{"node", node}, {"path", path}}}});
    samplers_.push_back({{"input", input}, {"output", output}, {"interpolation", interpolation}});
  }

  const Picture& picture_;
  Document* document_;
  Keys keys_;
  std::size_t times_ = 0;
  Json channels_ = Json::array();
  Json samplers_ = Json::array();
};

void AddChild(std::size_t parent, std::size_t child, Document* document) {
  document->node(parent)["children"].push_back(child);
}

/// Node 1 + i is link i; node 0 turns Z up into Y up.
void AddLinks(const Picture& picture, Animation* animation, Document* document) {
  const kinematics::KinematicTree& tree = picture.machine->tree;
  const double half = std::sqrt(0.5);
  document->Add("nodes", {{"name", picture.machine->name}, {"rotation", {-half, 0.0, 0.0, half}}});
  const motion::JointVector q =
      picture.recording.ticks.empty() ? picture.machine->Home() : picture.recording.Key(0);
  for (std::size_t i = 0; i < tree.links().size(); ++i) {
    Json node = {{"name", tree.links()[i].name}};
    const int joint = tree.links()[i].parent_joint;
    std::size_t parent = 0;
    if (joint >= 0) {
      const kinematics::Joint& data = tree.joints()[static_cast<std::size_t>(joint)];
      const LinkPose pose = PoseIn(*picture.machine, joint, data.index < 0 ? 0.0 : q[data.index]);
      node["translation"] = Numbers(pose.translation);
      node["rotation"] = Numbers(pose.rotation);
      parent = 1 + static_cast<std::size_t>(data.parent_link);
    }
    const std::size_t index = document->Add("nodes", std::move(node));
    AddChild(parent, index, document);
    if (joint >= 0 && tree.joints()[static_cast<std::size_t>(joint)].index >= 0) {
      animation->Move(index, joint);
    }
  }
}

void AddBodies(const Picture& picture, Animation* animation, Document* document) {
  std::vector<std::pair<int, std::size_t>> tools;  // node of each
  for (const ShownTool& tool : picture.tools) {
    std::string name = "T" + std::to_string(tool.number);
    if (!tool.name.empty()) name += " " + tool.name;
    const std::size_t node = document->Add("nodes", {{"name", name}});
    tools.emplace_back(tool.number, node);
    AddChild(1 + static_cast<std::size_t>(picture.machine->spindle_link), node, document);
    animation->Show(node, tool.number);
  }
  for (const ShownBody& body : picture.bodies) {
    std::size_t parent = 1 + static_cast<std::size_t>(body.link);
    for (const auto& [number, node] : tools) {
      if (number == body.tool) parent = node;
    }
    const std::size_t mesh = AddMesh(body, document);
    AddChild(parent, document->Add("nodes", {{"name", body.name}, {"mesh", mesh}}), document);
  }
}

}  // namespace

void WriteGltf(const Picture& picture, std::ostream& out) {
  Document document;
  Animation animation(picture, &document);
  AddLinks(picture, &animation, &document);
  AddBodies(picture, &animation, &document);
  animation.Finish();
  document.Write(out);
}

}  // namespace ncsim::report
