// SPDX-License-Identifier: BSD-3-Clause
#include "tests/post/post_rig.h"

#include <unistd.h>

#include <cstdlib>
#include <fstream>
#include <iterator>
#include <sstream>

#include "sim/app/app.h"

namespace ncsim::posting {
namespace {

namespace fs = std::filesystem;

std::string Model(const Way& way) { return std::string(NCSIM_SOURCE_DIR) + "/models/" + way.model; }

/// The number behind `name` in the text; -1 where it is not there.
double NumberBehind(const std::string& text, const std::string& name) {
  const std::size_t at = text.find(name);
  return at == std::string::npos ? -1.0 : std::strtod(text.c_str() + at + name.size(), nullptr);
}

}  // namespace

PostRig::PostRig(const std::string& name)
    : folder_(fs::temp_directory_path() / ("ncsim_post_" + name + std::to_string(getpid()))) {
  fs::create_directories(folder_);
}

PostRig::~PostRig() {
  std::error_code ignored;
  fs::remove_all(folder_, ignored);
}

int PostRig::Run(const std::vector<std::string>& arguments) {
  std::ostringstream out, err;
  const int code = app::Run(arguments, out, err);
  said_ = out.str() + err.str();
  return code;
}

fs::path PostRig::Write(const std::string& name, const std::string& text) const {
  const fs::path path = folder_ / name;
  std::ofstream(path, std::ios::binary) << text;
  return path;
}

int PostRig::Post(const fs::path& cl, const Way& way) {
  const bool haas = way.model == kUmc750;
  program_ = folder_ / (haas ? "program.nc" : "program.mpf");
  fs::remove(program_);
  std::vector<std::string> arguments = {"post",       cl.string(),    "--model",
                                        Model(way),   "--out",        program_.string(),
                                        "--no-check", "--first-tool", "1"};
  if (!way.mode.empty()) arguments.insert(arguments.end(), {"--mode", way.mode});
  arguments.insert(arguments.end(), way.more.begin(), way.more.end());
  return Run(arguments);
}

int PostRig::PostText(const std::string& text, const Way& way) {
  return Post(Write("part.cls", text), way);
}

int PostRig::Compare(const fs::path& cl, const Way& way) {
  const int code =
      Run({"compare", cl.string(), program_.string(), "--model", Model(way), "--assume", "all"});
  position_ = NumberBehind(said_, "largest deviation of the tip: ");
  angle_ = NumberBehind(said_, "largest deviation of the tool axis: ");
  return code;
}

std::string PostRig::Program() const {
  std::ifstream in(program_, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

}  // namespace ncsim::posting
