// SPDX-License-Identifier: BSD-3-Clause
// `--cache` on the real program, edited as somebody at a CAM system would.
#include <gtest/gtest.h>

#include <cstdio>
#include <sstream>
#include <string>
#include <vector>

#include "sim/app/app.h"
#include "tests/corpus/umc750_job.h"

namespace {

using namespace ncsim;

class Umc750Cache : public ::testing::Test, protected corpus::Umc750Job {
 protected:
  void SetUp() override {
    if (!Prepare(::testing::UnitTest::GetInstance()->current_test_info()->name())) {
      GTEST_SKIP() << "NCSIM_CORPUS is not set";
    }
  }
  void TearDown() override { Remove(); }

  /// The report; with the cache, how many outcomes were not known in computed_.
  std::string Check(bool cached) {
    WriteJob();
    std::ostringstream out, err;
    const std::string cache = (folder_ / "cache").string();
    std::vector<std::string> args = {"check",          Program().string(), "--model",
                                     Model().string(), "--format",         "json"};
    if (cached) args.insert(args.end(), {"--cache", cache});
    ncsim::app::Run(std::move(args), out, err);
    if (!cached) return out.str();
    const std::string said = err.str().substr(std::min(err.str().size(), cache.size()));
    unsigned known = 0;
    EXPECT_EQ(std::sscanf(said.c_str(), ": cache: %u of %u outcomes were known", &known, &all_), 2)
        << err.str();
    computed_ = all_ - known;
    return out.str();
  }

  unsigned all_ = 0, computed_ = 0;
};

TEST_F(Umc750Cache, AnEditIsCheckedAgainAndTheRestIsKnown) {
  const std::string plain = Check(false);
  EXPECT_EQ(Check(true), plain);
  EXPECT_EQ(computed_, all_);
  EXPECT_EQ(Check(true), plain);
  EXPECT_EQ(computed_, 0u);
  // One feed of 16,000 blocks.
  Replace(Program(), "N39700 X2.6275", "N39700 X2.6375");
  const std::string edited = Check(true);
  EXPECT_GT(computed_, 0u);
  EXPECT_LT(computed_, all_ / 6);
  EXPECT_EQ(Check(false), edited);
  // A block more, and lines above all.
  Replace(Program(), "N39700 X2.6375", "(a)\nN39699 X2.63\nN39700 X2.6375");
  Replace(Program(), "%\n", "%\n(b)\n(c)\n");
  const std::string longer = Check(true);
  EXPECT_LT(computed_, all_ / 4);
  EXPECT_EQ(Check(false), longer);
}

TEST_F(Umc750Cache, AnotherHolderIsChecked) {
  Keep(4000);
  Check(true);
  scene_.holder_t3 = "[{ lower = 40.0, upper = 50.0, height = 60.0 }]";
  const std::string warm = Check(true);
  EXPECT_GT(computed_, 0u);
  EXPECT_EQ(Check(false), warm);
}

}  // namespace
