// SPDX-License-Identifier: BSD-3-Clause
// The posts that ship.
#include <gtest/gtest.h>

#include <string>

#include "post/post_data.h"
#include "post/test_plan.h"

namespace ncsim::post {
namespace {

class Posts : public testing::TestWithParam<const char*> {};

TEST_P(Posts, LoadInBothUnits) {
  for (const ClUnit unit : {ClUnit::kMillimetre, ClUnit::kInch}) {
    Diagnostics diagnostics;
    PostSettings settings;
    settings.unit = unit;
    const auto post = LoadPost(ShippedPost(GetParam()), GetParam(), settings, &diagnostics);
    EXPECT_TRUE(post.has_value()) << AllOf(diagnostics);
    EXPECT_EQ(AllOf(diagnostics), "");
  }
}

INSTANTIATE_TEST_SUITE_P(Ship, Posts, testing::Values(kUmc750, kBcTable, kFanuc));

}  // namespace
}  // namespace ncsim::post
