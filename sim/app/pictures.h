// SPDX-License-Identifier: BSD-3-Clause
// What `check` writes for people to look at: --report and --gltf.
#pragma once

#include <fstream>
#include <optional>
#include <string>
#include <vector>

#include "sim/app/options.h"
#include "sim/app/program_input.h"
#include "sim/report/page.h"

namespace ncsim::app {

class Pictures {
 public:
  explicit Pictures(const CheckOptions& options) : options_(options) {}
  /// Files that were opened and not written go: a program that cannot be checked leaves none.
  ~Pictures();
  Pictures(const Pictures&) = delete;
  Pictures& operator=(const Pictures&) = delete;

  /// Before the run, so that a file that cannot be written is said at once. False, and a complaint.
  bool Open(std::string* complaint);
  bool wanted() const { return !options_.gltf.empty() || !options_.report.empty(); }
  /// Before the run, where pictures are wanted. All outlive this.
  void Start(const machine::Machine& machine, const machine::Scene& scene,
             const machine::ToolTable& tools);
  /// Null where no pictures are wanted.
  report::Recorder* recorder() { return recorder_ ? &*recorder_ : nullptr; }
  /// After the run. What the model's visual shapes lack goes to `diagnostics`. False, and a
  /// complaint, where a file could not be written.
  bool Write(const report::CheckResult& result, const SourceFiles& files, SourceLines* texts,
             const std::vector<int>& used_tools, Diagnostics* diagnostics, std::string* complaint);

 private:
  void WritePage(const report::CheckResult& result, const SourceFiles& files, SourceLines* texts,
                 const report::Picture& picture);

  const CheckOptions& options_;
  std::ofstream gltf_, page_;
  const machine::Machine* machine_ = nullptr;
  const machine::Scene* scene_ = nullptr;
  const machine::ToolTable* tools_ = nullptr;
  std::optional<report::Recorder> recorder_;
};

}  // namespace ncsim::app
