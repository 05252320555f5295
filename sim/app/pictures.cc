// SPDX-License-Identifier: BSD-3-Clause
#include "sim/app/pictures.h"

#include <filesystem>

namespace ncsim::app {
namespace {

/// Instants at which the page shows the least clearance.
constexpr int kClearanceLooks = 1000;

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

void Discard(const std::string& path, std::ofstream* file) {
  if (!file->is_open()) return;
  file->close();
  std::error_code ignored;
  if (std::filesystem::is_regular_file(path, ignored)) std::filesystem::remove(path, ignored);
}

}  // namespace

Pictures::~Pictures() {
  Discard(options_.gltf, &gltf_);
  Discard(options_.report, &page_);
}

bool Pictures::Open(std::string* complaint) {
  return OpenFile(options_.gltf, &gltf_, complaint) && OpenFile(options_.report, &page_, complaint);
}

void Pictures::Start(const machine::Machine& machine, const machine::Scene& scene,
                     const machine::ToolTable& tools) {
  if (!wanted()) return;
  machine_ = &machine;
  scene_ = &scene;
  tools_ = &tools;
  recorder_.emplace(machine, scene, tools);
}

void Pictures::WritePage(const report::CheckResult& result, const SourceFiles& files,
                         SourceLines* texts, const report::Picture& picture) {
  report::Page page;
  page.result = &result;
  page.files = &files;
  page.picture = &picture;
  for (int file = 0; file < files.size(); ++file) {
    page.texts.push_back({files.name(file), texts->Text(file)});
  }
  if (!options_.interpret_only) {
    page.clearance = report::LookAtClearance(*machine_, *scene_, *tools_, picture.recording, result,
                                             kClearanceLooks);
  }
  report::WriteHtml(page, page_);
}

bool Pictures::Write(const report::CheckResult& result, const SourceFiles& files,
                     SourceLines* texts, const std::vector<int>& used_tools,
                     Diagnostics* diagnostics, std::string* complaint) {
  if (!wanted()) return true;
  const report::Picture picture =
      report::MakePicture(*machine_, machine::LoadVisuals(*machine_, diagnostics), *scene_, *tools_,
                          used_tools, recorder_->Finish());
  if (!options_.gltf.empty()) report::WriteGltf(picture, gltf_);
  if (!options_.report.empty()) WritePage(result, files, texts, picture);
  const bool gltf = CloseFile(options_.gltf, &gltf_, complaint);
  return CloseFile(options_.report, &page_, complaint) && gltf;
}

}  // namespace ncsim::app
