// SPDX-License-Identifier: BSD-3-Clause
// Memory stays flat with the length of a program: what a hundred times more blocks adds in private
// memory is bounded by a few megabytes (the text itself is mapped).
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "post/cl_path.h"
#include "sim/control/controller.h"
#include "sim/machine/load.h"
#include "tests/bench/nc_samples.h"

namespace {

using namespace ncsim;
namespace fs = std::filesystem;

class CountingSink : public control::RunSink {
 public:
  void OnMotion(const motion::Motion&) override { ++motions; }
  void OnFinding(Finding) override {}
  int motions = 0;
};

/// Private (not file-backed) memory of this process, kB, from the kernel's own account.
long PrivateDirtyKilobytes() {
  std::ifstream in("/proc/self/smaps_rollup");
  for (std::string key; in >> key;) {
    long value = 0;
    if (key == "Private_Dirty:" && in >> value) return value;
  }
  return -1;
}

int Interpret(const machine::Machine& machine, int blocks) {
  const fs::path path = fs::temp_directory_path() / ("ncsim_flat_" + std::to_string(blocks) + "_" +
                                                     std::to_string(getpid()) + ".nc");
  std::ofstream(path) << bench::WavySurface(blocks);
  Diagnostics diagnostics;
  const auto program = nc::Program::Load(path.string(), &diagnostics);
  fs::remove(path);
  SourceFiles files;
  std::vector<control::PartFrame> frames;
  CountingSink sink;
  control::RunProgram(program, machine, machine::Job(), machine::ToolTable(), &files, &frames,
                      &sink);
  return sink.motions;
}

TEST(FlatMemory, AMillionBlocksNeedNoMoreThanTenThousand) {
  Diagnostics diagnostics;
  const auto machine = machine::LoadMachine(
      std::string(NCSIM_SOURCE_DIR) + "/models/haas_umc750/umc750.urdf", &diagnostics);
  ASSERT_TRUE(machine.has_value());
  EXPECT_GE(Interpret(*machine, 10'000), 10'000);
  const long before = PrivateDirtyKilobytes();
  ASSERT_GT(before, 0) << "this kernel has no smaps_rollup";
  EXPECT_GE(Interpret(*machine, 1'000'000), 1'000'000);
  EXPECT_LT(PrivateDirtyKilobytes() - before, 16 * 1024);
}

/// The path of a cutter-location file with as many points; its motions.
int ReadPoints(int points) {
  const fs::path path = fs::temp_directory_path() / ("ncsim_flat_" + std::to_string(points) + "_" +
                                                     std::to_string(getpid()) + ".cls");
  {
    std::ofstream out(path);
    out << "TOOL PATH/A,TOOL,T\nLOAD/TOOL,1\nFEDRAT/MMPM,100.\n";
    for (int i = 0; i < points; ++i) {
      out << "GOTO/" << i % 1000 << ".5,0.25," << i % 7 << ",0.6,0.0,0.8\n";
    }
    out << "END-OF-PATH\n";
  }
  Diagnostics diagnostics;
  const auto program = nc::Program::Load(path.string(), &diagnostics);
  fs::remove(path);
  post::ClPath cl_path(program, 0, {}, &diagnostics);
  int motions = 0;
  for (post::ClEvent event; cl_path.Next(&event);) {
    motions += std::holds_alternative<post::ClMotion>(event.what) ? 1 : 0;
  }
  EXPECT_TRUE(diagnostics.all().empty());
  return motions;
}

TEST(FlatMemory, AMillionPointsOfAClFileNeedNoMoreThanTenThousand) {
  EXPECT_EQ(ReadPoints(10'000), 10'000);
  const long before = PrivateDirtyKilobytes();
  ASSERT_GT(before, 0) << "this kernel has no smaps_rollup";
  EXPECT_EQ(ReadPoints(1'000'000), 1'000'000);
  EXPECT_LT(PrivateDirtyKilobytes() - before, 4 * 1024);
}

}  // namespace
