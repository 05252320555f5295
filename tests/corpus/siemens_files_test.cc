// SPDX-License-Identifier: BSD-3-Clause
// Real programs of other machines on the shipped BC table machine: which run without
// `unsupported-code`, and why the others do not.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "sim/control/controller.h"
#include "sim/machine/load.h"

namespace ncsim {
namespace {

namespace fs = std::filesystem;

struct Outcome : control::RunSink {
  void OnMotion(const motion::Motion&) override {}
  void OnFinding(Finding finding) override {
    if (finding.rule == Rule::kUnsupportedCode) {
      unsupported.insert(finding.message.substr(0, finding.message.find(" was not simulated")));
    }
  }
  std::set<std::string> unsupported;
};

TEST(SiemensFiles, WhatIsNotSimulatedInThem) {
  const char* corpus = std::getenv("NCSIM_CORPUS");
  if (corpus == nullptr) GTEST_SKIP() << "NCSIM_CORPUS is not set";
  Diagnostics diagnostics;
  const auto machine = machine::LoadMachine(
      std::string(NCSIM_SOURCE_DIR) + "/models/bc_table_840d/bc_table_840d.urdf", &diagnostics);
  ASSERT_TRUE(machine.has_value());
  machine::ToolTable tools;
  for (int number = 1; number <= 16; ++number) {
    machine::Tool tool;
    tool.number = number;
    tool.length = tool.h_geometry = 100.0;
    tool.diameter = tool.d_geometry = 10.0;
    tools.tools.push_back(tool);
  }
  std::map<std::string, std::string> found;
  for (const char* folder : {"gcodeworkshop", "nx-840d", "spinner-u5-620"}) {
    for (const auto& entry :
         fs::recursive_directory_iterator(fs::path(corpus) / "siemens" / folder)) {
      static const std::set<std::string> kExtensions = {".mpf", ".MPF", ".nc", ".ptp", ".txt"};
      if (!entry.is_regular_file() || kExtensions.count(entry.path().extension().string()) == 0) {
        continue;
      }
      const auto program = nc::Program::Load(entry.path().string(), &diagnostics);
      ASSERT_NE(program, nullptr);
      Outcome outcome;
      SourceFiles files;
      std::vector<control::PartFrame> part_frames;
      control::RunProgram(program, *machine, {}, tools, &files, &part_frames, &outcome);
      std::string& text = found[entry.path().filename().string()];
      for (const std::string& name : outcome.unsupported) text += name + "\n";
    }
  }
  const std::map<std::string, std::string> expected = {};
  EXPECT_EQ(found, expected);
}

}  // namespace
}  // namespace ncsim
