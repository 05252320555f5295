// SPDX-License-Identifier: BSD-3-Clause
#include "tests/report/shown_run.h"

#include <unistd.h>

#include <fstream>
#include <sstream>

#include "sim/app/app.h"

namespace ncsim::report {
namespace {

namespace fs = std::filesystem;

std::vector<TraceRow> ReadTrace(const fs::path& path) {
  std::vector<TraceRow> rows;
  std::ifstream in(path);
  std::string line;
  std::getline(in, line);  // file,line,kind,time_s,X,Y,Z,A,B,C,...; no name here needs quotes
  while (std::getline(in, line)) {
    std::vector<std::string> fields;
    std::istringstream text(line);
    for (std::string field; std::getline(text, field, ',');) fields.push_back(field);
    TraceRow row;
    row.line = std::stoi(fields.at(1));
    row.time = std::stod(fields.at(3));
    for (std::size_t i = 0; i < 6; ++i) {
      if (!fields.at(4 + i).empty()) row.axes["XYZABC"[i]] = std::stod(fields[4 + i]);
    }
    if (!row.axes.empty()) rows.push_back(std::move(row));
  }
  return rows;
}

}  // namespace

ShownRun::ShownRun(const fs::path& program, const std::vector<std::string>& options) {
  static int runs = 0;
  folder_ = fs::temp_directory_path() /
            ("ncsim_shown_" + std::to_string(getpid()) + "_" + std::to_string(++runs));
  fs::create_directories(folder_);
  const fs::path trace = folder_ / "run.csv";
  std::vector<std::string> args = {"check",  program.string(), "--trace",  trace.string(),
                                   "--gltf", gltf().string(),  "--report", html().string()};
  args.insert(args.end(), options.begin(), options.end());
  std::ostringstream out, err;
  exit_code_ = app::Run(args, out, err);
  messages_ = err.str() + out.str();
  trace_ = ReadTrace(trace);
}

ShownRun::~ShownRun() {
  std::error_code ignored;
  fs::remove_all(folder_, ignored);
}

fs::path ScenePath(const std::string& name) { return fs::path(NCSIM_SOURCE_DIR) / "scenes" / name; }

std::string ReadBytes(const fs::path& path) {
  std::stringstream bytes;
  bytes << std::ifstream(path, std::ios::binary).rdbuf();
  return bytes.str();
}

}  // namespace ncsim::report
