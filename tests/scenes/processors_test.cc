// SPDX-License-Identifier: BSD-3-Clause
// What is reported does not depend on the processor: the C library's functions with and without
// fused multiplication differ in last bits, and the kernel has code for processors with and without
// AVX2. glibc lets a program run as on an older processor (GLIBC_TUNABLES).
#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdio>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

namespace {

namespace fs = std::filesystem;

constexpr const char* kOldProcessor = "GLIBC_TUNABLES=glibc.cpu.hwcaps=-FMA,-FMA4,-AVX2,-AVX ";

/// What `command` writes to stdout.
std::string Output(const std::string& command) {
  std::string text;
  FILE* pipe = popen(command.c_str(), "r");
  if (pipe == nullptr) return "";
  char buffer[4096];
  for (std::size_t n = 0; (n = fread(buffer, 1, sizeof buffer, pipe)) > 0;) text.append(buffer, n);
  pclose(pipe);
  return text;
}

std::string Content(const fs::path& path) {
  std::stringstream text;
  text << std::ifstream(path).rdbuf();
  return text.str();
}

struct Told {
  std::string report, trace;
};

Told Check(const std::string& environment, const std::string& arguments) {
  const fs::path trace =
      fs::temp_directory_path() / ("ncsim_processors_" + std::to_string(getpid()) + ".csv");
  Told told;
  told.report = Output(environment + NCSIM_PROGRAM + " check " + arguments +
                       " --format json --trace " + trace.string());
  told.trace = Content(trace);
  fs::remove(trace);
  return told;
}

void SameOnOldAndNew(const std::string& arguments) {
  const Told here = Check("", arguments);
  const Told there = Check(kOldProcessor, arguments);
  EXPECT_GT(here.report.size(), 1000U);
  EXPECT_GT(here.trace.size(), 1000U);
  EXPECT_EQ(here.report, there.report);
  EXPECT_EQ(here.trace, there.trace);
}

TEST(Processors, ScenesAreToldAlike) {
  for (const char* scene :
       {"five_axis/dome.nc", "three_plus_two/angle_block.nc", "impeller_840d/impeller.mpf",
        "crash_gallery/collision.nc", "crash_gallery/gouge.nc"}) {
    SCOPED_TRACE(scene);
    SameOnOldAndNew(std::string(NCSIM_SOURCE_DIR) + "/scenes/" + scene);
  }
}

// The switch that this counts on is one: the two do not compute the same bits.
TEST(Processors, TheOldOneComputesOtherBits) {
  const std::string sines =
      R"(awk 'BEGIN { for (i = 1; i < 5000; ++i) printf "%.17g ", sin(0.37 * i) }')";
  const std::string here = Output(sines);
  EXPECT_GT(here.size(), 5000U);
  if (here == Output(kOldProcessor + sines)) GTEST_SKIP() << "this processor has no FMA";
}

}  // namespace
