// SPDX-License-Identifier: BSD-3-Clause
// A real cutter-location file of 70,944 records (an impeller, inches) held against itself, whole
// and with one thing changed.
#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <sstream>
#include <string>

#include "sim/app/app.h"

namespace ncsim {
namespace {

namespace fs = std::filesystem;

class ClCompare : public ::testing::Test {
 protected:
  void SetUp() override {
    const char* corpus = std::getenv("NCSIM_CORPUS");
    if (corpus == nullptr) GTEST_SKIP() << "NCSIM_CORPUS is not set";
    original_ = std::string(corpus) + "/clsf/creo-ncl/assets/finition.ncl";
    const auto* info = ::testing::UnitTest::GetInstance()->current_test_info();
    changed_ = (fs::temp_directory_path() /
                (std::string("ncsim_cl_") + info->name() + std::to_string(getpid()) + ".ncl"))
                   .string();
    std::ifstream in(original_, std::ios::binary);
    text_.assign(std::istreambuf_iterator<char>(in), {});
  }
  void TearDown() override { fs::remove(changed_); }

  void Replace(const std::string& from, const std::string& to) {
    const std::size_t at = text_.find(from);
    ASSERT_NE(at, std::string::npos) << from;
    text_.replace(at, from.size(), to);
  }
  int Compare() {
    std::ofstream(changed_, std::ios::binary) << text_;
    std::ostringstream out, err;
    const int code = app::Run({"compare", original_, changed_}, out, err);
    said_ = out.str() + err.str();
    return code;
  }

  std::string original_, changed_, text_, said_;
};

TEST_F(ClCompare, IsItself) {
  EXPECT_EQ(Compare(), app::kExitPass) << said_;
  EXPECT_NE(said_.find("6 runs of feeds, 505540 mm of "), std::string::npos) << said_;
}

// Line 30002, 0.05 inches (1.27 mm) off in Y, square to the cut.
TEST_F(ClCompare, APointThatIsOffIsFoundAtItsLine) {
  Replace("GOTO / 71.7577554945, -108.3898262571", "GOTO / 71.7577554945, -108.3398262571");
  EXPECT_EQ(Compare(), app::kExitFail);
  EXPECT_NE(said_.find(".ncl:30002:1: error: the tip goes 1.2"), std::string::npos) << said_;
  EXPECT_NE(said_.find("\nfail: 1 error, 0 unproven, 0 warnings; "), std::string::npos) << said_;
}

}  // namespace
}  // namespace ncsim
