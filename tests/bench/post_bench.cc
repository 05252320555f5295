// SPDX-License-Identifier: BSD-3-Clause
// A cutter-location file of 70,944 lines (an impeller, five axes; with NCSIM_CORPUS) posted for the
// UMC-750: `items_per_second` is its lines a second, to be held beside the blocks a second of the
// interpreter in the same run (docs/performance.md).
#include <benchmark/benchmark.h>

#include <algorithm>
#include <cstdlib>
#include <memory>
#include <optional>
#include <string>

#include "post/post_options.h"
#include "post/post_program.h"
#include "sim/base/file.h"
#include "sim/machine/load.h"

namespace {

using namespace ncsim;

struct Impeller {
  Diagnostics diagnostics;
  std::optional<machine::Machine> machine;
  std::optional<post::PostData> post;
  std::shared_ptr<const nc::Program> cl;
  std::optional<post::PartGeometry> geometry;

  Impeller() {
    const char* corpus = std::getenv("NCSIM_CORPUS");
    if (corpus == nullptr) return;
    const std::string folder = std::string(NCSIM_SOURCE_DIR) + "/models/haas_umc750/";
    std::string reason;
    machine = machine::LoadMachine(folder + "umc750.urdf", &diagnostics);
    post = post::LoadPost(ReadFile(folder + "umc750.post.toml", 1 << 20, &reason).value_or(""),
                          "umc750.post.toml", {}, &diagnostics);
    cl =
        nc::Program::Load(std::string(corpus) + "/clsf/creo-ncl/assets/finition.ncl", &diagnostics);
    if (!machine || !post || cl == nullptr) return;
    constexpr double kGrid = 0.001 * 3.14159265358979 / 180.0;
    geometry.emplace(*machine, Eigen::Isometry3d::Identity(), kGrid);
  }
};

void BM_PostCorpusImpeller(benchmark::State& state) {
  static Impeller impeller;
  if (!impeller.geometry) {
    state.SkipWithError("NCSIM_CORPUS is not set");
    return;
  }
  post::PostJob job;
  job.cl = impeller.cl;
  job.post = &*impeller.post;
  job.geometry = &*impeller.geometry;
  job.cl_options.first_tool = 1;
  job.info.name = job.info.source = "impeller";
  job.info.number = 1;
  const std::string_view text = impeller.cl->text();
  const auto lines = std::count(text.begin(), text.end(), '\n');
  for (auto _ : state) {
    const auto program =
        post::PostProgram(job, post::PlanOptionsOf(*impeller.post, ""), &impeller.diagnostics);
    benchmark::DoNotOptimize(program.moves);
    if (impeller.diagnostics.has_errors())
      state.SkipWithError(ToString(impeller.diagnostics.all().front()).c_str());
  }
  state.SetItemsProcessed(state.iterations() * lines);
}
BENCHMARK(BM_PostCorpusImpeller)->Unit(benchmark::kMillisecond)->UseRealTime();

}  // namespace
