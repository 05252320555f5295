// SPDX-License-Identifier: BSD-3-Clause
// The job of the collision benchmark: impeller, fixture, ball mill in a holder, ten machine links,
// and a five-axis program of any length. One text is the program for all who take part.
#pragma once

#include <functional>
#include <optional>
#include <string>

#include "sim/machine/job.h"
#include "sim/machine/machine.h"
#include "sim/machine/scene.h"
#include "sim/machine/tool.h"
#include "sim/motion/window.h"

namespace ncsim::bench {

struct ImpellerSpec {
  int blocks = 100'000;
  int triangles = 100'000;  ///< Of the part.
  int studs = 0;            ///< Further fixtures on the platter's rim: more pairs.
  double clearance = 2.0;   ///< mm; the near-miss threshold.
  double allowance = 0.5;   ///< mm between the ball and the part.
  unsigned seed = 1;
};

/// A folder of its own below the system's, removed at the end.
class BenchFolder {
 public:
  BenchFolder();
  ~BenchFolder();
  BenchFolder(const BenchFolder&) = delete;
  BenchFolder& operator=(const BenchFolder&) = delete;
  const std::string& path() const { return path_; }

 private:
  std::string path_;
};

struct BenchJob {
  std::string program;  ///< Path; its job file stands beside it.
  std::string model;    ///< Path.
  machine::Machine machine;
  machine::Job job;
  machine::Scene scene;
};

/// Writes the files of a job into `folder` and loads them; trouble is written to stderr.
std::optional<BenchJob> MakeImpellerJob(const ImpellerSpec& spec, const std::string& folder);

/// The same job with shank and holder as meshes on the spindle: the checker then has FCL alone for
/// them, as for machine links.
BenchJob WithToolAsMeshes(BenchJob job);

/// Interprets the program and hands on its motions in windows, until `on_window` returns false.
/// Returns false where the control reports an error.
bool ForEachWindow(const BenchJob& job,
                   const std::function<bool(const motion::Window&)>& on_window);

}  // namespace ncsim::bench
