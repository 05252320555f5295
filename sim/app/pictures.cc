// SPDX-License-Identifier: BSD-3-Clause
#include "sim/app/pictures.h"

namespace ncsim::app {
namespace {

bool OpenFile(const std::string& path, std::ofstream* file, std::string* complaint) {
  if (path.empty()) return true;
  file->open(path, std::ios::binary | std::ios::trunc);
  if (*file) return true;
  *complaint = path + ": error: cannot be written";
  return false;
}

bool CloseFile(const std::string& path, std::ofstream* file, std::string* complaint) {
  if (path.empty()) return true;
  file->close();
  if (*file) return true;
  *complaint = path + ": error: could not be written to its end";
  return false;
}

}  // namespace

bool Pictures::Open(std::string* complaint) { return OpenFile(options_.gltf, &gltf_, complaint); }

void Pictures::Start(const machine::Machine& machine, const machine::Scene& scene,
                     const machine::ToolTable& tools) {
  if (!wanted()) return;
  machine_ = &machine;
  scene_ = &scene;
  tools_ = &tools;
  recorder_.emplace(machine, scene, tools);
}

bool Pictures::Write(const std::vector<int>& used_tools, Diagnostics* diagnostics,
                     std::string* complaint) {
  if (!wanted()) return true;
  const report::Picture picture =
      report::MakePicture(*machine_, machine::LoadVisuals(*machine_, diagnostics), *scene_, *tools_,
                          used_tools, recorder_->Finish());
  if (!options_.gltf.empty()) report::WriteGltf(picture, gltf_);
  return CloseFile(options_.gltf, &gltf_, complaint);
}

}  // namespace ncsim::app
