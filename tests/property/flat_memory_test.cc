// SPDX-License-Identifier: BSD-3-Clause
// Memory stays flat with the length of a program: what a hundred times more blocks adds in private
// memory is bounded by a few megabytes (the text itself is mapped).
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>

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
  const fs::path path =
      fs::temp_directory_path() / ("ncsim_flat_" + std::to_string(blocks) + ".nc");
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

}  // namespace
