// SPDX-License-Identifier: BSD-3-Clause
// The posts that ship.
#include <gtest/gtest.h>

#include <string>

#include "post/post_data.h"
#include "sim/base/file.h"

namespace ncsim::post {
namespace {

class Posts : public testing::TestWithParam<const char*> {};

std::string Errors(const Diagnostics& diagnostics) {
  std::string all;
  for (const Diagnostic& one : diagnostics.all()) all += ToString(one) + "\n";
  return all;
}

TEST_P(Posts, LoadInBothUnits) {
  const std::string path = std::string(NCSIM_SOURCE_DIR) + "/models/" + GetParam();
  std::string reason;
  const auto text = ReadFile(path, 1 << 20, &reason);
  ASSERT_TRUE(text) << reason;
  for (const ClUnit unit : {ClUnit::kMillimetre, ClUnit::kInch}) {
    Diagnostics diagnostics;
    PostSettings settings;
    settings.unit = unit;
    const auto post = LoadPost(*text, GetParam(), settings, &diagnostics);
    EXPECT_TRUE(post.has_value()) << Errors(diagnostics);
    EXPECT_EQ(Errors(diagnostics), "");
  }
}

INSTANTIATE_TEST_SUITE_P(Ship, Posts,
                         testing::Values("haas_umc750/umc750.post.toml",
                                         "bc_table_840d/bc_table_840d.post.toml",
                                         "fanuc_3axis.post.toml"));

}  // namespace
}  // namespace ncsim::post
