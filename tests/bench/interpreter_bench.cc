// SPDX-License-Identifier: BSD-3-Clause
// Interpretation alone, beside `rs274 -g` on the same file in the same run. `items_per_second` is
// blocks a second; the ratio of the two is the figure that counts (docs/performance.md). With
// NCSIM_CORPUS the real UMC-750 program runs too.
#include <benchmark/benchmark.h>

#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>

#include "sim/control/controller.h"
#include "sim/machine/load.h"
#include "tests/bench/nc_samples.h"

namespace {

using namespace ncsim;
namespace fs = std::filesystem;

class NullSink : public control::RunSink {
 public:
  void OnMotion(const motion::Motion& motion) override {
    benchmark::DoNotOptimize(motion.duration);
  }
  void OnFinding(Finding) override {}
};

const machine::Machine& Umc750() {
  static const machine::Machine umc750 = [] {
    Diagnostics diagnostics;
    auto loaded = machine::LoadMachine(
        std::string(NCSIM_SOURCE_DIR) + "/models/haas_umc750/umc750.urdf", &diagnostics);
    if (!loaded) std::abort();
    return *std::move(loaded);
  }();
  return umc750;
}

/// Written once a run, removed at its end.
const std::string& SampleFile() {
  static const struct Sample {
    std::string path = (fs::temp_directory_path() / "ncsim_bench_wavy.ngc").string();
    Sample() { std::ofstream(path) << bench::WavySurface(1'000'000); }
    ~Sample() { fs::remove(path); }
  } sample;
  return sample.path;
}

std::uint64_t Interpret(const std::string& path) {
  Diagnostics diagnostics;
  const auto program = nc::Program::Load(path, &diagnostics);
  if (!program) return 0;
  SourceFiles files;
  std::vector<control::PartFrame> frames;
  NullSink sink;
  return control::RunProgram(program, Umc750(), machine::Job(), machine::ToolTable(), &files,
                             &frames, &sink)
      .blocks;
}

void BM_InterpretMillionBlocks(benchmark::State& state) {
  std::uint64_t blocks = 0;
  for (auto _ : state) blocks += Interpret(SampleFile());
  state.SetItemsProcessed(static_cast<std::int64_t>(blocks));
}
BENCHMARK(BM_InterpretMillionBlocks)->Unit(benchmark::kMillisecond)->UseRealTime();

void BM_Rs274MillionBlocks(benchmark::State& state) {
  // rs274 does not know the Haas's O word as a program number; -t needs a tool table with T1.
  const fs::path folder = fs::temp_directory_path();
  const std::string input = (folder / "ncsim_bench_rs274.ngc").string();
  const std::string table = (folder / "ncsim_bench_rs274.tbl").string();
  std::ofstream(table) << "T1 P1 Z100.0 D10.0\n";
  {
    std::string text = bench::WavySurface(1'000'000);
    text.erase(text.find('O'), text.find('\n', text.find('O')) - text.find('O'));
    std::ofstream(input) << text;
  }
  const std::string command = "rs274 -t " + table + " -g " + input + " > /dev/null 2>&1";
  for (auto _ : state) {
    if (std::system(command.c_str()) != 0) state.SkipWithError("rs274 is not installed");
  }
  state.SetItemsProcessed(static_cast<std::int64_t>(state.iterations()) * 1'000'008);
  fs::remove(input);
  fs::remove(table);
}
BENCHMARK(BM_Rs274MillionBlocks)->Unit(benchmark::kMillisecond)->UseRealTime();

void BM_InterpretCorpusUmc750(benchmark::State& state) {
  const char* corpus = std::getenv("NCSIM_CORPUS");
  const std::string path = std::string(corpus ? corpus : "") +
                           "/haas/umc750-ubc/NCcodeForHAAS-UMC750Machine/FinalToolPath.stripped.nc";
  if (!corpus || !fs::exists(path)) {
    state.SkipWithError("NCSIM_CORPUS is not set");
    return;
  }
  std::uint64_t blocks = 0;
  for (auto _ : state) blocks += Interpret(path);
  state.SetItemsProcessed(static_cast<std::int64_t>(blocks));
}
BENCHMARK(BM_InterpretCorpusUmc750)->Unit(benchmark::kMillisecond)->UseRealTime();

}  // namespace

BENCHMARK_MAIN();
