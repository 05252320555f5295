// SPDX-License-Identifier: BSD-3-Clause
// The main job on a real program that nobody here wrote: right as it is, and wrong with one thing
// wrong at a time. Expected rules and lines come from reading the program; see the comment at each
// case.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "sim/app/app.h"
#include "tests/corpus/umc750_job.h"

namespace {

using namespace ncsim;
using nlohmann::json;

class Umc750Verdict : public ::testing::Test, protected corpus::Umc750Job {
 protected:
  void SetUp() override {
    if (!Prepare(::testing::UnitTest::GetInstance()->current_test_info()->name())) {
      GTEST_SKIP() << "NCSIM_CORPUS is not set";
    }
  }
  void TearDown() override { Remove(); }

  /// Runs `ncsim check`; the JSON report.
  json Check(int expected_exit, const std::vector<std::string>& more = {}) {
    WriteJob();
    std::ostringstream out, err;
    std::vector<std::string> args = {"check",          Program().string(), "--model",
                                     Model().string(), "--format",         "json"};
    args.insert(args.end(), more.begin(), more.end());
    const int code = ncsim::app::Run(std::move(args), out, err);
    EXPECT_EQ(code, expected_exit) << err.str() << out.str().substr(0, 4000);
    return json::parse(out.str(), nullptr, false);
  }

  static bool Has(const json& report, const std::string& rule, int line) {
    for (const json& finding : report["findings"]) {
      if (finding["rule"] == rule && finding["line"] == line) return true;
    }
    return false;
  }
  static bool HasRule(const json& report, const std::string& rule) {
    for (const json& finding : report["findings"]) {
      if (finding["rule"] == rule) return true;
    }
    return false;
  }
  static std::string Errors(const json& report) {
    std::string text;
    for (const json& finding : report["findings"]) {
      if (finding["severity"] != "warning") {
        text += std::to_string(finding["line"].get<int>()) + ": " +
                finding["message"].get<std::string>() + "\n";
      }
    }
    return text;
  }
};

TEST_F(Umc750Verdict, AsItIsItPasses) {
  const json report = Check(0);
  EXPECT_EQ(report["verdict"], "pass") << Errors(report);
  EXPECT_GE(report["clearances"].size(), 10u);
  for (const json& clearance : report["clearances"]) {
    EXPECT_LE(clearance["proven_mm"].get<double>(), clearance["seen_mm"].get<double>() + 1e-9);
  }
}

// The program works with its zero one inch above the bottom of a 4 x 4 x 4 in blank: line 37 rapids
// to Z3.1, and the blank's top is at Z3. Nothing touches it before line 38, the first feed.
TEST_F(Umc750Verdict, WithABlankItReachesTheFirstCut) {
  scene_.riser_height = 124.5;
  scene_.body = StockBody("{ on = \"G54\", xyz = [50.8, 50.8, -25.4] }");
  Keep(120);
  const json report = Check(0);
  EXPECT_TRUE(report["findings"].empty()) << report["findings"];
}

// With the blank's bottom at the program's zero its top is at Z4, and the rapid of line 37 to Z3.1
// plunges into it.
TEST_F(Umc750Verdict, ABlankAnInchHigherIsHitByTheRapid) {
  scene_.body = StockBody();
  Keep(120);
  const json report = Check(1);
  EXPECT_TRUE(Has(report, "stock-contact", 37)) << Errors(report);
}

// Closed form: at B82.875 C-180 a part zero 240 mm out along X brings Z to -484.1 at line 1392,
// beyond the limit of -444.5 (M = P + R (w - P) + q + L).
TEST_F(Umc750Verdict, PartOffCentreOvertravels) {
  scene_.part_xyz = "[189.2, -50.8, 150.0]";
  const json report = Check(1, {"--interpret-only"});
  EXPECT_TRUE(Has(report, "travel-limit", 1392)) << Errors(report);
}

// At B90 C0 the tool lies along X over the riser, its axis Z.88 in = 22.4 mm above it; the holder's
// nut (radius 25, 80 mm behind the tip) gets over a riser of radius 130 in the first block that
// takes the tip to less than 50 mm from the centre: line 2789, X3.6149 (2788: 130.4 mm).
TEST_F(Umc750Verdict, WideRiserIsHit) {
  scene_.riser_diameter = 260.0;
  Keep(2800);
  const json report = Check(1);
  EXPECT_TRUE(Has(report, "collision", 2789)) << Errors(report);
}

// Line 2708 goes to X2 Y2 Z5 at B82.875 C0, above the centre. The rim of a holder of radius 150 is
// there at r = 80 sin B + 150 cos B = 98.0 mm and z = 127 + 80 cos B - 150 sin B = -11.9 mm, inside
// the riser (radius 100, top at -0.1).
TEST_F(Umc750Verdict, WideHolderHitsTheRiser) {
  scene_.holder_t3 = "[ { lower = 300.0, upper = 300.0, height = 100.0 } ]";
  Keep(2720);
  const json report = Check(1);
  EXPECT_TRUE(Has(report, "collision", 2708)) << Errors(report);
}

// Line 1671 starts at the tool-change pose. From X0 Y0 the dog-leg runs out X and Y together first
// and then goes on in one of them across the part's corner; the straight line stays clear.
TEST_F(Umc750Verdict, ToolChangePoseMakesTheDogLegHit) {
  Replace(folder_ / "model/umc750.toml", "X = -736.6", "X = 0.0");
  Replace(folder_ / "model/umc750.toml", "Y = -203.2", "Y = 0.0");
  Keep(1680);
  const json report = Check(1);
  EXPECT_TRUE(Has(report, "rapid-contact", 1671)) << Errors(report);
}

TEST_F(Umc750Verdict, ToolChangePoseIsClearWithLinearRapids) {
  Replace(folder_ / "model/umc750.toml", "X = -736.6", "X = 0.0");
  Replace(folder_ / "model/umc750.toml", "Y = -203.2", "Y = 0.0");
  scene_.extra = "[control]\n\"setting 335\" = \"linear\"\n";
  Keep(1680);
  const json report = Check(0);
  EXPECT_FALSE(HasRule(report, "rapid-contact")) << Errors(report);
}

// Haas NGC Mill Operator's Manual 2017, G234: cannot be used together with G254.
TEST_F(Umc750Verdict, G254LeftActiveMeetsG234) {
  Blank(1653);  // N8070 G255
  const json report = Check(1, {"--interpret-only"});
  EXPECT_TRUE(Has(report, "control-alarm", 1670)) << Errors(report);
}

// 20 mm lower than the part stands, line 37 rapids to 17.5 mm below the blank's top.
TEST_F(Umc750Verdict, OffsetTooLowHitsTheBlankInRapid) {
  scene_.part_xyz = "[-50.8, -50.8, 130.0]";
  scene_.body = StockBody("{ on = \"workpiece_mount\", xyz = [0.0, 0.0, 124.6] }");
  scene_.riser_height = 124.5;
  Keep(120);
  const json report = Check(1);
  EXPECT_TRUE(Has(report, "stock-contact", 37)) << Errors(report);
}

// N180 X.799 (line 55) is the first block that goes to the outline of the cavity, 20 mm deeper than
// meant.
TEST_F(Umc750Verdict, OffsetTooLowGougesThePart) {
  scene_.part_xyz = "[-50.8, -50.8, 130.0]";
  scene_.body = PartBody("{ on = \"workpiece_mount\", xyz = [-50.8, -50.8, 150.0] }");
  Keep(120);
  const json report = Check(1);
  EXPECT_TRUE(Has(report, "gouge", 55)) << Errors(report);
}

// Line 12861 is the first that turns B beyond 90 (B93.722).
TEST_F(Umc750Verdict, TiltBeyondItsLimit) {
  Replace(Model(), "2.0943951023931953", "1.5707963267948966");
  const json report = Check(1, {"--interpret-only"});
  EXPECT_TRUE(Has(report, "travel-limit", 12861)) << Errors(report);
}

}  // namespace
