// SPDX-License-Identifier: BSD-3-Clause
// Expected values: closed forms of tangent polygons, and the definition of a closed mesh.
#include "sim/collision/tessellate.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <utility>

#include "sim/collision/profile_shape.h"
#include "sim/collision/test_shapes.h"

namespace ncsim::collision {
namespace {

using machine::Profile;

bool Closed(const machine::TriangleMesh& mesh) {
  std::map<std::pair<int, int>, int> edges;
  for (const auto& t : mesh.triangles) {
    for (std::size_t k = 0; k < 3; ++k) ++edges[{t[k], t[(k + 1) % 3]}];
  }
  for (const auto& [edge, count] : edges) {
    const auto back = edges.find({edge.second, edge.first});
    if (count != 1 || back == edges.end() || back->second != 1) return false;
  }
  return true;
}

double Volume(const machine::TriangleMesh& mesh) {
  double six = 0.0;
  for (const auto& t : mesh.triangles) {
    const auto v = [&](std::size_t k) { return mesh.vertices[static_cast<std::size_t>(t[k])]; };
    six += v(0).dot(v(1).cross(v(2)));
  }
  return six / 6.0;
}

// No point of the mesh lies inside the solid, and none further out than the sagitta.
void ExpectEncloses(const Profile& profile, double length) {
  const machine::TriangleMesh mesh = Tessellate(profile, length);
  const ProfileShape shape(profile);
  EXPECT_TRUE(Closed(mesh));
  EXPECT_GT(Volume(mesh), 0.0) << "normals point inward";
  for (const auto& t : mesh.triangles) {
    for (int i = 0; i <= 4; ++i) {
      for (int j = 0; i + j <= 4; ++j) {
        const double u = i / 4.0;
        const double v = j / 4.0;
        const Eigen::Vector3d p = (1.0 - u - v) * mesh.vertices[static_cast<std::size_t>(t[0])] +
                                  u * mesh.vertices[static_cast<std::size_t>(t[1])] +
                                  v * mesh.vertices[static_cast<std::size_t>(t[2])];
        const double d = shape.exact().Distance(length - p.z(), std::hypot(p.x(), p.y()));
        ASSERT_GT(d, -1e-9) << p.transpose();
        ASSERT_LT(d, kSagitta) << p.transpose();
      }
    }
  }
}

TEST(TessellateTest, EnclosesCylinder) { ExpectEncloses(CylinderProfile(0, 40, 6), 120); }
TEST(TessellateTest, EnclosesBallNose) { ExpectEncloses(BallProfile(3, 20), 180); }
TEST(TessellateTest, EnclosesHolder) {
  ExpectEncloses(PolyProfile({{80, 0},
                              {80, 20},
                              {110, 25},
                              {110, 31.5},
                              {120, 31.5},
                              {120, 22},
                              {180, 34.9},
                              {180, 0}}),
                 180);
}
TEST(TessellateTest, EnclosesBullNose) {
  Profile profile;
  profile.elements.push_back({{0, 0}, {0, 8}, false, {0, 0}});
  profile.elements.push_back({{0, 8}, {2, 10}, true, {2, 8}});
  profile.elements.push_back({{2, 10}, {30, 10}, false, {0, 0}});
  ExpectEncloses(profile, 100);  // and is closed at the top, which the profile leaves open
}

TEST(TessellateTest, TipPointsDownTheSpindle) {
  const machine::TriangleMesh mesh = Tessellate(CylinderProfile(0, 40, 6), 120);
  double z_min = 1e9;
  double z_max = -1e9;
  for (const auto& v : mesh.vertices) {
    z_min = std::min(z_min, v.z());
    z_max = std::max(z_max, v.z());
  }
  EXPECT_DOUBLE_EQ(z_max, 120.0);
  EXPECT_DOUBLE_EQ(z_min, 80.0);
}

}  // namespace
}  // namespace ncsim::collision
