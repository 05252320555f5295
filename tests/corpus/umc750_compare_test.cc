// SPDX-License-Identifier: BSD-3-Clause
// The real UMC-750 program held against itself, whole and with one thing changed.
#include <gtest/gtest.h>

#include <fstream>
#include <sstream>

#include "sim/app/app.h"
#include "tests/corpus/umc750_job.h"

namespace ncsim {
namespace {

class Umc750Compare : public ::testing::Test, public corpus::Umc750Job {
 protected:
  void SetUp() override {
    const auto* info = ::testing::UnitTest::GetInstance()->current_test_info();
    if (!Prepare(std::string("compare_") + info->name())) GTEST_SKIP() << "NCSIM_CORPUS is not set";
    WriteJob();
    std::filesystem::copy_file(Program(), Original());
  }
  void TearDown() override { Remove(); }

  std::filesystem::path Original() const { return folder_ / "original.nc"; }
  int Compare() {
    std::ostringstream out, err;
    const int code = app::Run({"compare", Original().string(), Program().string(), "--model",
                               Model().string(), "--job", JobFile().string()},
                              out, err);
    text_ = out.str() + err.str();
    return code;
  }
  std::string text_;
};

TEST_F(Umc750Compare, IsItself) {
  EXPECT_EQ(Compare(), app::kExitPass) << text_;
  EXPECT_NE(text_.find("\npass: 0 errors, 0 unproven, 0 warnings; 87 runs of feeds, "),
            std::string::npos)
      << text_;
}

// Line 9000 is "N44695 X.8594 Y1.0258 C-139.5", in the middle of a simultaneous cut.
TEST_F(Umc750Compare, AChangeIsFoundAtItsLine) {
  Replace(Program(), "N44695 X.8594 Y1.0258", "N44695 X.8694 Y1.0258");
  EXPECT_EQ(Compare(), app::kExitFail);
  EXPECT_NE(text_.find("part.nc:9000:1: error: the tip goes "), std::string::npos) << text_;
  EXPECT_NE(text_.find("\nfail: 1 error, 0 unproven, 0 warnings; "), std::string::npos) << text_;
}

TEST_F(Umc750Compare, ALineThatIsLeftOutIsFoundAtItsPlace) {
  Blank(9000);
  EXPECT_EQ(Compare(), app::kExitFail);
  EXPECT_NE(text_.find("original.nc:9000 is left out [path-deviation]"), std::string::npos)
      << text_;
  EXPECT_NE(text_.find("\nfail: 1 error, 0 unproven, 0 warnings; "), std::string::npos) << text_;
}

}  // namespace
}  // namespace ncsim
