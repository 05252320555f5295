// SPDX-License-Identifier: BSD-3-Clause
// The animated glTF as another viewer reads it: against the trace, and before the Khronos
// validator.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cstring>
#include <nlohmann/json.hpp>

#include "tests/corpus/umc750_job.h"
#include "tests/report/shown_run.h"
#include "tests/report/tools.h"

namespace ncsim::report {
namespace {

using Json = nlohmann::json;
using Eigen::Isometry3d;
using Eigen::Quaterniond;
using Eigen::Vector3d;

/// A GLB file, read by what its specification says.
class Glb {
 public:
  explicit Glb(const std::string& bytes) {
    const std::uint32_t json_length = Word(bytes, 12);
    json_ = Json::parse(bytes.substr(20, json_length));
    binary_ = bytes.substr(20 + json_length + 8);
  }

  const Json& json() const { return json_; }

  std::vector<float> Floats(std::size_t accessor) const {
    const Json& data = json_["accessors"][accessor];
    const std::map<std::string, std::size_t> widths = {{"SCALAR", 1}, {"VEC3", 3}, {"VEC4", 4}};
    std::vector<float> floats(data["count"].get<std::size_t>() *
                              widths.at(data["type"].get<std::string>()));
    const std::size_t offset = json_["bufferViews"][data["bufferView"].get<int>()]["byteOffset"];
    std::memcpy(floats.data(), binary_.data() + offset, floats.size() * sizeof(float));
    return floats;
  }

  /// Where a node stands in the world at a time of the animation; metres.
  Isometry3d World(const std::string& name, double time) const {
    for (std::size_t i = 0; i < json_["nodes"].size(); ++i) {
      if (json_["nodes"][i].value("name", "") == name) return World(i, time);
    }
    ADD_FAILURE() << "no node " << name;
    return Isometry3d::Identity();
  }

  /// The scale of a node at that time; 1 where no track says otherwise.
  float Size(const std::string& name, double time) const {
    for (const Json& channel : json_["animations"][0]["channels"]) {
      const Json& target = channel["target"];
      if (target["path"] != "scale") continue;
      if (json_["nodes"][target["node"].get<std::size_t>()].value("name", "") != name) continue;
      return Track(channel, time, false)[0];
    }
    return 1.0F;
  }

 private:
  static std::uint32_t Word(const std::string& bytes, std::size_t at) {
    std::uint32_t word = 0;
    std::memcpy(&word, bytes.data() + at, sizeof(word));
    return word;
  }

  std::vector<float> Track(const Json& channel, double time, bool turns) const {
    const Json& sampler = json_["animations"][0]["samplers"][channel["sampler"].get<int>()];
    const std::vector<float> times = Floats(sampler["input"]);
    const std::vector<float> values = Floats(sampler["output"]);
    const std::size_t width = values.size() / times.size();
    std::size_t i = 0;
    while (i + 1 < times.size() && times[i + 1] <= time) ++i;
    const auto row = [&](std::size_t k) {
      return std::vector<float>(values.begin() + static_cast<std::ptrdiff_t>(k * width),
                                values.begin() + static_cast<std::ptrdiff_t>((k + 1) * width));
    };
    std::vector<float> value = row(i);
    if (i + 1 == times.size() || sampler["interpolation"] == "STEP") return value;
    const std::vector<float> next = row(i + 1);
    const auto part =
        static_cast<float>(std::max(0.0, (time - times[i]) / (times[i + 1] - times[i])));
    if (turns) {
      const Eigen::Quaternionf q =
          Eigen::Quaternionf(value.data()).slerp(part, Eigen::Quaternionf(next.data()));
      return {q.x(), q.y(), q.z(), q.w()};
    }
    for (std::size_t k = 0; k < width; ++k) value[k] += part * (next[k] - value[k]);
    return value;
  }

  Isometry3d World(std::size_t node, double time) const {
    const Json& data = json_["nodes"][node];
    std::vector<float> t = data.value("translation", std::vector<float>{0, 0, 0});
    std::vector<float> r = data.value("rotation", std::vector<float>{0, 0, 0, 1});
    for (const Json& channel : json_["animations"][0]["channels"]) {
      if (channel["target"]["node"] != node) continue;
      if (channel["target"]["path"] == "translation") t = Track(channel, time, false);
      if (channel["target"]["path"] == "rotation") r = Track(channel, time, true);
    }
    Isometry3d X = Isometry3d::Identity();
    X.translation() = Vector3d(t[0], t[1], t[2]);
    X.linear() = Quaterniond(r[3], r[0], r[1], r[2]).normalized().toRotationMatrix();
    for (std::size_t i = 0; i < json_["nodes"].size(); ++i) {
      for (const Json& child : json_["nodes"][i].value("children", Json::array())) {
        if (child == node) return World(i, time) * X;
      }
    }
    return X;
  }

  Json json_;
  std::string binary_;
};

/// Both models stand so that the gauge line's coordinates in the machine frame are X, Y, Z, and the
/// table has turned by Ry(-B) Rz(-C) (docs/notation.md).
void ExpectPose(const Glb& glb, const TraceRow& row, double mm) {
  Isometry3d X_Y_up = Isometry3d::Identity();
  X_Y_up.linear() = Eigen::AngleAxisd(-M_PI_2, Vector3d::UnitX()).toRotationMatrix();
  const Isometry3d X_WM = X_Y_up.inverse();
  const Vector3d gauge = 1e3 * (X_WM * glb.World("spindle_gauge", row.time)).translation();
  EXPECT_NEAR(gauge.x(), row.axes.at('X'), mm) << row.line;
  EXPECT_NEAR(gauge.y(), row.axes.at('Y'), mm) << row.line;
  EXPECT_NEAR(gauge.z(), row.axes.at('Z'), mm) << row.line;
  const double b = row.axes.at('B') * M_PI / 180.0, c = row.axes.at('C') * M_PI / 180.0;
  const Eigen::Matrix3d turned =
      (Eigen::AngleAxisd(-b, Vector3d::UnitY()) * Eigen::AngleAxisd(-c, Vector3d::UnitZ()))
          .toRotationMatrix();
  const Eigen::Matrix3d shown = (X_WM * glb.World("workpiece_mount", row.time)).linear();
  EXPECT_LT((shown - turned).norm(), 1e-3 * mm) << row.line;  // mm at a metre
}

void ExpectValid(const ShownRun& run) {
  const std::string missing = WhyNoPackages();
  if (!missing.empty()) GTEST_SKIP() << "the Khronos validator: " << missing;
  const Said said = RunNode("validate_gltf.cjs", Quoted(run.gltf().string()));
  EXPECT_EQ(said.exit_code, 0) << said.text;
}

TEST(GltfTest, TheFinalPoseIsThatOfTheTrace) {
  for (const char* scene : {"crash_gallery/collision.nc", "five_axis/dome.nc"}) {
    const ShownRun run(ScenePath(scene), {"--interpret-only"});
    ASSERT_FALSE(run.trace().empty()) << run.messages();
    ExpectPose(Glb(ReadBytes(run.gltf())), run.trace().back(), 1e-3);
  }
}

TEST(GltfTest, ThePoseOfEachBlockIsThatOfTheTrace) {
  const ShownRun run(ScenePath("five_axis/dome.nc"), {"--interpret-only"});
  const Glb glb(ReadBytes(run.gltf()));
  ASSERT_GT(run.trace().size(), 100U);
  // Keyframes keep 0.05 mm; a rapid goes another 0.05 mm in a tick.
  for (std::size_t i = 0; i < run.trace().size(); i += 7) ExpectPose(glb, run.trace()[i], 0.1);
}

TEST(GltfTest, AToolIsThereWhileItIsInTheSpindle) {
  const ShownRun run(ScenePath("three_plus_two/angle_block.nc"), {"--interpret-only"});
  const Glb glb(ReadBytes(run.gltf()));
  std::vector<std::string> tools;
  for (const Json& node : glb.json()["nodes"]) {
    const std::string name = node.value("name", "");
    if (name.starts_with("T") && name.find('.') == std::string::npos) tools.push_back(name);
  }
  ASSERT_GE(tools.size(), 2U);
  const double end = run.trace().back().time;
  std::map<std::string, int> seen;
  for (int i = 1; i < 200; ++i) {
    float shown = 0.0F;
    for (const std::string& tool : tools) {
      const float size = glb.Size(tool, end * i / 200.0);
      shown += size;
      if (size == 1.0F) ++seen[tool];
    }
    EXPECT_LE(shown, 1.0F) << i;
  }
  EXPECT_EQ(seen.size(), tools.size());
}

TEST(GltfTest, TheSameRunGivesTheSameBytes) {
  const ShownRun one(ScenePath("crash_gallery/collision.nc"), {"--jobs", "1"});
  const ShownRun two(ScenePath("crash_gallery/collision.nc"), {"--jobs", "2"});
  EXPECT_GT(ReadBytes(one.gltf()).size(), 100'000U);
  EXPECT_GT(ReadBytes(one.html()).size(), 100'000U);
  EXPECT_EQ(ReadBytes(one.gltf()), ReadBytes(two.gltf()));
  EXPECT_EQ(ReadBytes(one.html()), ReadBytes(two.html()));
}

TEST(GltfTest, TheKhronosValidatorPassesTheScenes) {
  for (const char* scene : {"crash_gallery/collision.nc", "three_plus_two/angle_block.nc",
                            "impeller_840d/impeller.mpf"}) {
    ExpectValid(ShownRun(ScenePath(scene), {"--interpret-only"}));
    if (IsSkipped()) return;
  }
}

class GltfOfTheUmc750Program : public ::testing::Test, public corpus::Umc750Job {
 protected:
  void TearDown() override { Remove(); }
};

TEST_F(GltfOfTheUmc750Program, EndsWhereTheTraceDoesAndIsValid) {
  if (!Prepare("ncsim_gltf_")) GTEST_SKIP() << "NCSIM_CORPUS is not set";
  WriteJob();
  const ShownRun run(Program(), {"--model", Model().string(), "--interpret-only"});
  ASSERT_GT(run.trace().size(), 15000U) << run.messages();
  ExpectPose(Glb(ReadBytes(run.gltf())), run.trace().back(), 1e-3);
  ExpectValid(run);
}

}  // namespace
}  // namespace ncsim::report
