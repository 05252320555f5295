// SPDX-License-Identifier: BSD-3-Clause
#include "sim/base/diagnostics.h"

#include <gtest/gtest.h>

namespace ncsim {
namespace {

TEST(DiagnosticsTest, PrintsAsCompilersDoAndLeavesOutWhatIsNotKnown) {
  Diagnostics diagnostics;
  diagnostics.Warning("umc750.urdf", 12, 3, "axis is not a unit vector");
  EXPECT_FALSE(diagnostics.has_errors());
  diagnostics.Error("umc750.urdf", 14, 0, "no limits");
  diagnostics.Error("umc750.toml", 0, 0, "no such file");
  EXPECT_TRUE(diagnostics.has_errors());
  ASSERT_EQ(diagnostics.all().size(), 3u);
  EXPECT_EQ(ToString(diagnostics.all()[0]), "umc750.urdf:12:3: warning: axis is not a unit vector");
  EXPECT_EQ(ToString(diagnostics.all()[1]), "umc750.urdf:14: error: no limits");
  EXPECT_EQ(ToString(diagnostics.all()[2]), "umc750.toml: error: no such file");
}

}  // namespace
}  // namespace ncsim
