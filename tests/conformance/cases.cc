// SPDX-License-Identifier: BSD-3-Clause
#include "tests/conformance/cases.h"

#include <algorithm>
#include <filesystem>

namespace ncsim::conformance {
namespace {

namespace fs = std::filesystem;

bool TakeSuffix(const std::string& suffix, std::string* text) {
  if (text->size() < suffix.size() ||
      text->compare(text->size() - suffix.size(), suffix.size(), suffix) != 0) {
    return false;
  }
  text->resize(text->size() - suffix.size());
  return true;
}

// "a__b" stands for a/b; "___" may be "/_" or "_/", whichever names a file of the corpus.
std::string WithSlashes(const fs::path& corpus, const std::string& name) {
  const std::size_t at = name.find("__");
  if (at == std::string::npos) return fs::exists(corpus / name) ? name : "";
  const std::string early = WithSlashes(corpus, name.substr(0, at) + "/" + name.substr(at + 2));
  if (!early.empty() || name.compare(at, 3, "___") != 0) return early;
  return WithSlashes(corpus, name.substr(0, at) + "_/" + name.substr(at + 3));
}

std::string AllSlashes(std::string name) {
  for (std::size_t at = name.find("__"); at != std::string::npos; at = name.find("__", at)) {
    name.replace(at, 2, "/");
  }
  return name;
}

// oracle/<path with __ for />.canon.gz, or .norm.canon.gz for what is under oracle/normalised.
void AddOracle(const fs::path& corpus, std::vector<Case>* cases) {
  const fs::path oracle = corpus / "linuxcnc" / "oracle";
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(oracle, error)) {
    std::string name = entry.path().filename().string();
    if (!TakeSuffix(".canon.gz", &name)) continue;
    const fs::path normalised = oracle / "normalised" / (name + ".ngc");
    const bool norm = TakeSuffix(".norm", &name);
    std::string path = WithSlashes(corpus, name);
    if (path.empty() && norm) path = AllSlashes(name);  // Only the normalised text is there.
    if (path.empty() || (norm && !fs::is_regular_file(normalised))) continue;
    const fs::path program = norm ? normalised : corpus / path;
    cases->push_back({path, program.string(), entry.path().string()});
  }
}

// tests/<dir>/expected beside its only .ngc or test.ngc; <x>.ngc.expected beside <x>.ngc.
void AddTests(const fs::path& corpus, std::vector<Case>* cases) {
  const fs::path tests = corpus / "linuxcnc" / "tests" / "tests";
  std::error_code error;
  for (const auto& entry : fs::recursive_directory_iterator(tests, error)) {
    const std::string file = entry.path().filename().string();
    fs::path program;
    if (file == "expected") {
      const fs::path folder = entry.path().parent_path();
      program = folder / "test.ngc";
      for (const auto& other : fs::directory_iterator(folder, error)) {
        if (!fs::exists(program) && other.path().extension() == ".ngc") program = other.path();
      }
    } else if (entry.path().extension() == ".expected") {
      program = entry.path();
      program.replace_extension();
    }
    if (!fs::is_regular_file(program)) continue;
    cases->push_back({fs::relative(program, corpus, error).generic_string(), program.string(),
                      entry.path().string()});
  }
}

}  // namespace

std::vector<Case> FindCases(const std::string& corpus) {
  std::vector<Case> cases;
  AddOracle(corpus, &cases);
  AddTests(corpus, &cases);
  std::sort(cases.begin(), cases.end(),
            [](const Case& a, const Case& b) { return a.name < b.name; });
  return cases;
}

}  // namespace ncsim::conformance
