// SPDX-License-Identifier: BSD-3-Clause
#include "tests/bench/impeller_job.h"

#include <unistd.h>

#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <utility>

#include "sim/base/text.h"
#include "sim/base/units.h"
#include "sim/collision/tessellate.h"
#include "sim/control/controller.h"
#include "sim/machine/load.h"
#include "tests/bench/bench_machine.h"
#include "tests/bench/bench_mesh.h"
#include "tests/bench/impeller_path.h"

namespace ncsim::bench {
namespace {

namespace fs = std::filesystem;

constexpr double kFixtureHeight = 80.0;  // mm

/// About 10,000 triangles: a foot, a stem, and a flange under the part.
machine::TriangleMesh Fixture() {
  return RevolvedMesh({{0, 85}, {18, 85}, {22, 40}, {62, 36}, {66, 78}, {kFixtureHeight, 78}}, 6.0,
                      100);
}

std::string JobText(const ImpellerSpec& spec) {
  std::string text =
      "schema = 1\nunits = \"mm\"\nmodel = \"bench.urdf\"\n"
      "[start]\nX = 0.0\nY = 0.0\nZ = 0.0\nB = 0.0\nC = 0.0\n"
      "[offsets]\nG54 = { on = \"workpiece_mount\", xyz = [0.0, 0.0, " +
      Fixed(kFixtureHeight, 1) +
      "] }\n"
      "[[tool]]\nnumber = 1\nname = \"BALL 8\"\nlength = 160.0\n"
      "cutter = { type = \"ball\", diameter = 8.0, corner_radius = 4.0, flute_length = 20.0 }\n"
      "shank = [ { lower = 10.0, upper = 14.0, height = 18.0 },"
      " { lower = 16.0, upper = 16.0, height = 5.0 } ]\n"
      "holder = [ { lower = 34.0, upper = 40.0, height = 30.0 },"
      " { lower = 50.0, upper = 50.0, height = 50.0 },"
      " { lower = 63.0, upper = 63.0, height = 37.0 } ]\n"
      "[[fixture]]\nname = \"fixture\"\nmesh = \"fixture.stl\"\nunit = \"mm\"\n"
      "at = { on = \"workpiece_mount\" }\n";
  for (int i = 0; i < spec.studs; ++i) {
    const double angle = 2.0 * kPi * i / spec.studs;
    text += "[[fixture]]\nname = \"stud_" + std::to_string(i) +
            "\"\ncylinder = { diameter = 8.0, height = 20.0 }\n"
            "at = { on = \"workpiece_mount\", xyz = [" +
            Fixed(225.0 * std::cos(angle), 3) + ", " + Fixed(225.0 * std::sin(angle), 3) +
            ", 0.0] }\n";
  }
  return text + "[part]\nmesh = \"part.stl\"\nunit = \"mm\"\nat = { on = \"G54\" }\n" +
         "[check]\nclearance = " + Fixed(spec.clearance, 3) +
         "\npart_tolerance = 0.1\ngouge_tolerance = 0.1\ngouge = \"off\"\n"
         "[control]\n\"setting 9\" = \"mm\"\n\"setting 15\" = \"on\"\n\"setting 77\" = "
         "\"integer\"\n\"setting 85\" = 0.05\n\"setting 108\" = \"off\"\n"
         "\"setting 162\" = \"off\"\n\"setting 335\" = \"none\"\nblock_skip = \"off\"\n"
         "optional_stop = \"off\"\n";
}

bool Failed(const Diagnostics& diagnostics) {
  for (const Diagnostic& diagnostic : diagnostics.all()) {
    std::fprintf(stderr, "%s\n", ToString(diagnostic).c_str());
  }
  return diagnostics.has_errors();
}

class WindowSink : public control::RunSink {
 public:
  explicit WindowSink(const std::function<bool(const motion::Window&)>& on_window)
      : on_window_(&on_window) {}

  void OnMotion(const motion::Motion& motion) override {
    if (!going_) return;
    OnWindow(windows_.Add(motion));
  }
  void OnFinding(Finding finding) override {
    if (finding.severity != Severity::kError) return;
    failed_ = true;
    std::fprintf(stderr, "line %d: %s\n", finding.where.line, finding.message.c_str());
  }
  void Finish() { OnWindow(windows_.Take()); }
  bool failed() const { return failed_; }

 private:
  void OnWindow(const motion::Window& window) {
    if (going_ && !window.motions.empty()) going_ = (*on_window_)(window);
  }

  const std::function<bool(const motion::Window&)>* on_window_;
  motion::WindowCutter windows_;
  bool going_ = true;
  bool failed_ = false;
};

}  // namespace

BenchFolder::BenchFolder()
    : path_((fs::temp_directory_path() / ("ncsim_bench_" + std::to_string(getpid()))).string()) {
  fs::create_directories(path_);
}

BenchFolder::~BenchFolder() {
  std::error_code ignored;
  fs::remove_all(path_, ignored);
}

std::optional<BenchJob> MakeImpellerJob(const ImpellerSpec& spec, const std::string& folder) {
  const fs::path base(folder);
  fs::create_directories(base);
  BenchJob made;
  made.program = (base / "impeller.nc").string();
  made.model = (base / "bench.urdf").string();
  const std::string job_path = made.program + ".job.toml";
  if (!WriteMachine(base) ||
      !WriteStl(Impeller::Mesh(spec.triangles), (base / "part.stl").string()) ||
      !WriteStl(Fixture(), (base / "fixture.stl").string())) {
    std::fprintf(stderr, "%s: cannot be written\n", folder.c_str());
    return std::nullopt;
  }
  std::ofstream(job_path) << JobText(spec);
  ImpellerPath::Options options;
  options.allowance = spec.allowance;
  options.seed = spec.seed;
  std::ofstream program(made.program);
  ImpellerPath(options).Write(spec.blocks, program);
  program.close();

  Diagnostics diagnostics;
  std::optional<machine::Machine> machine = machine::LoadMachine(made.model, &diagnostics);
  std::optional<machine::Job> job = machine::LoadJob(job_path, &diagnostics);
  if (machine && job) made.scene = machine::BuildScene(*machine, *job, &diagnostics);
  if (Failed(diagnostics) || !machine || !job) return std::nullopt;
  made.machine = *std::move(machine);
  made.job = *std::move(job);
  return made;
}

BenchJob WithToolAsMeshes(BenchJob job) {
  machine::Tool& tool = job.job.tools.front();
  const std::pair<const char*, machine::Profile*> parts[] = {{"shank", &tool.shank},
                                                             {"holder", &tool.holder}};
  for (const auto& [name, profile] : parts) {
    machine::SceneBody body;
    body.name = std::string("mesh of ") + name;
    body.kind = machine::BodyKind::kFixture;
    body.link = job.machine.spindle_link;
    body.mesh = collision::Tessellate(*profile, tool.length);
    job.scene.bodies.push_back(std::move(body));
    profile->elements.clear();
  }
  return job;
}

bool ForEachWindow(const BenchJob& job,
                   const std::function<bool(const motion::Window&)>& on_window) {
  Diagnostics diagnostics;
  const auto program = nc::Program::Load(job.program, &diagnostics);
  if (Failed(diagnostics) || program == nullptr) return false;
  SourceFiles files;
  std::vector<control::PartFrame> frames;
  WindowSink sink(on_window);
  control::RunProgram(program, job.machine, job.job, {job.job.tools}, &files, &frames, &sink);
  sink.Finish();
  return !sink.failed();
}

}  // namespace ncsim::bench
