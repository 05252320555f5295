// SPDX-License-Identifier: BSD-3-Clause
// For this module's tests: where the files are, and what was reported.
#pragma once

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "sim/base/diagnostics.h"

namespace ncsim::machine {

/// A file of tests/reject.
inline std::string RejectFile(const std::string& name) {
  return std::string(NCSIM_SOURCE_DIR) + "/tests/reject/" + name;
}

/// "" where the corpus is absent.
inline std::string CorpusFile(const std::string& name) {
  const char* corpus = std::getenv("NCSIM_CORPUS");
  return corpus == nullptr || *corpus == '\0' ? "" : std::string(corpus) + "/" + name;
}

#define NCSIM_REQUIRE_CORPUS()                                      \
  if (CorpusFile("").empty())                                       \
  GTEST_SKIP() << "NCSIM_CORPUS is not set: third-party files not " \
                  "read"

/// What was reported, without folders: "model.urdf:4: error: ...".
inline std::vector<std::string> Reported(const Diagnostics& diagnostics) {
  std::vector<std::string> texts;
  for (Diagnostic diagnostic : diagnostics.all()) {
    diagnostic.file = std::filesystem::path(diagnostic.file).filename().string();
    texts.push_back(ToString(diagnostic));
  }
  return texts;
}

/// A folder of its own for each test, removed at the end.
class TempFolder {
 public:
  TempFolder() {
    const auto* info = ::testing::UnitTest::GetInstance()->current_test_info();
    std::string name = std::string(info->test_suite_name()) + "." + info->name();
    for (char& c : name) c = c == '/' ? '_' : c;
    path_ = std::filesystem::path(::testing::TempDir()) / ("ncsim_" + name);
    std::filesystem::remove_all(path_);
    std::filesystem::create_directories(path_);
  }
  ~TempFolder() { std::filesystem::remove_all(path_); }
  TempFolder(const TempFolder&) = delete;
  TempFolder& operator=(const TempFolder&) = delete;

  std::string Write(const std::string& name, const std::string& bytes) const {
    const std::filesystem::path path = path_ / name;
    std::filesystem::create_directories(path.parent_path());
    std::ofstream(path, std::ios::binary) << bytes;
    return path.string();
  }
  std::string path() const { return path_.string(); }

 private:
  std::filesystem::path path_;
};

}  // namespace ncsim::machine
