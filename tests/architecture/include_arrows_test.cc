// SPDX-License-Identifier: BSD-3-Clause
// The arrows of docs/architecture.md, held against the includes: a module may use only what is
// listed for it, and a third-party library is met in its own module and nowhere else.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <regex>
#include <set>
#include <string>
#include <vector>

namespace {

namespace fs = std::filesystem;

const std::map<std::string, std::set<std::string>> kArrows = {
    {"sim/base", {}},
    {"kinematics", {"sim/base"}},
    {"sim/nc", {"sim/base"}},
    {"sim/machine", {"sim/base", "kinematics"}},
    {"sim/motion", {"sim/base", "kinematics", "sim/machine"}},
    {"sim/checks", {"sim/base", "kinematics", "sim/machine", "sim/motion"}},
    {"sim/collision", {"sim/base", "kinematics", "sim/machine", "sim/motion"}},
    {"sim/control", {"sim/base", "kinematics", "sim/nc", "sim/machine", "sim/motion"}},
    {"post", {"sim/base", "kinematics", "sim/nc", "sim/machine", "sim/motion"}},
    {"sim/compare",
     {"sim/base", "kinematics", "sim/nc", "sim/machine", "sim/motion", "sim/control", "post"}},
    {"sim/report",
     {"sim/base", "kinematics", "sim/machine", "sim/motion", "sim/checks", "sim/collision",
      "sim/compare"}},
    {"sim/nightly", {"sim/base", "sim/report"}},
    {"sim/app",
     {"sim/base", "kinematics", "sim/nc", "sim/machine", "sim/motion", "sim/control", "sim/checks",
      "sim/collision", "sim/compare", "sim/report", "sim/nightly", "post"}},
};

struct Library {
  std::string include_pattern;
  std::string module;  // the only one that may include it
  int max_files;       // heavy headers are kept in few files
};
const std::vector<Library> kLibraries = {
    {"fcl/", "sim/collision", 2},
    {"oneapi/tbb", "sim/collision", 3},  // batches, the trees of meshes, how many threads
    {"assimp/", "sim/machine", 1},
    {"urdf_parser/", "sim/machine", 1},
    {"urdf_model/", "sim/machine", 1},
    {"tinyxml2", "sim/machine", 2},
    {"toml\\+\\+|toml\\.hpp", "sim/base", 1},
    {"xxhash", "sim/base", 1},
    {"CLI/", "sim/app", 1},
    {"sqlite3", "sim/nightly", 1},
    {"nlohmann/", "sim/report", 3},
    {"zlib", "sim/report", 1},
};

struct Include {
  std::string file;    // relative to the root
  std::string module;  // of the file
  std::string target;  // as written
  bool test = false;
};

std::string ModuleOf(const std::string& path) {
  std::string best;
  for (const auto& [module, uses] : kArrows) {
    if (path.rfind(module + "/", 0) == 0 && module.size() > best.size()) best = module;
  }
  return best;
}

std::vector<Include> ReadIncludes(const std::string& root_folder) {
  const fs::path root(NCSIM_SOURCE_DIR);
  const std::regex pattern(R"re(^\s*#include\s*[<"]([^">]+)[">])re");
  std::vector<Include> includes;
  for (const auto& entry : fs::recursive_directory_iterator(root / root_folder)) {
    const std::string extension = entry.path().extension().string();
    if (extension != ".h" && extension != ".cc" && extension != ".def") continue;
    const std::string file = fs::relative(entry.path(), root).generic_string();
    std::ifstream in(entry.path());
    for (std::string line; std::getline(in, line);) {
      std::smatch match;
      if (std::regex_search(line, match, pattern)) {
        includes.push_back({file, ModuleOf(file), match[1],
                            file.find("_test.cc") != std::string::npos ||
                                file.find("test_") != std::string::npos});
      }
    }
  }
  return includes;
}

std::vector<Include> AllIncludes() {
  std::vector<Include> all = ReadIncludes("sim");
  for (const char* folder : {"kinematics", "post"}) {
    const std::vector<Include> more = ReadIncludes(folder);
    all.insert(all.end(), more.begin(), more.end());
  }
  return all;
}

TEST(Architecture, EveryIncludeFollowsAnArrow) {
  const std::vector<Include> includes = AllIncludes();
  ASSERT_GT(includes.size(), 100u) << "the scan found hardly anything: is the path right?";
  for (const Include& include : includes) {
    const std::string target = ModuleOf(include.target);
    if (target.empty() || target == include.module) continue;
    EXPECT_TRUE(kArrows.at(include.module).count(target))
        << include.file << " includes " << include.target << ": no arrow from " << include.module
        << " to " << target << " in docs/architecture.md";
  }
}

TEST(Architecture, EachLibraryIsMetInItsModuleOnly) {
  const std::vector<Include> includes = AllIncludes();
  for (const Library& library : kLibraries) {
    const std::regex pattern("^(" + library.include_pattern + ")");
    std::set<std::string> files;
    for (const Include& include : includes) {
      if (!std::regex_search(include.target, pattern)) continue;
      EXPECT_EQ(include.module, library.module) << include.file << " includes " << include.target;
      if (!include.test) files.insert(include.file);
    }
    EXPECT_LE(static_cast<int>(files.size()), library.max_files) << library.include_pattern;
    EXPECT_FALSE(files.empty()) << library.include_pattern << " is met nowhere: drop it here";
  }
}

// The scan itself must be able to fail.
TEST(Architecture, AForbiddenArrowWouldBeSeen) {
  EXPECT_EQ(ModuleOf("sim/collision/checker.h"), "sim/collision");
  EXPECT_EQ(ModuleOf("fcl/fcl.h"), "");
  EXPECT_FALSE(kArrows.at("sim/collision").count("sim/control"));
  EXPECT_FALSE(kArrows.at("sim/nc").count("sim/machine"));
}

// What `check --inputs` lists is whole only if nothing looks at a file without sim/base/file.h.
TEST(Architecture, InputsAreLookedAtThroughTheLog) {
  const fs::path root(NCSIM_SOURCE_DIR);
  const std::regex pattern(
      R"re(ifstream|fopen|is_regular_file|is_directory|exists\(|directory_iterator|getenv|[^\w.]open\()re");
  // The first logs what it maps; the second opens /dev/null.
  const std::set<std::string> exempt = {"sim/nc/program.cc", "sim/machine/mesh_import.cc"};
  std::vector<fs::path> files = {root / "sim/app/program_input.cc", root / "sim/app/nominal.cc",
                                 root / "sim/app/tool_source.cc"};
  for (const char* folder : {"sim/nc", "sim/machine", "sim/motion", "sim/control", "sim/checks",
                             "sim/collision", "kinematics"}) {
    for (const auto& entry : fs::recursive_directory_iterator(root / folder)) {
      files.push_back(entry.path());
    }
  }
  ASSERT_GT(files.size(), 100U);
  std::set<std::string> found;
  for (const fs::path& path : files) {
    const std::string file = fs::relative(path, root).generic_string();
    if (path.extension() != ".cc" && path.extension() != ".h") continue;
    if (file.find("_test.cc") != std::string::npos || file.find("/test_") != std::string::npos) {
      continue;
    }
    std::ifstream in(path);
    for (std::string line; std::getline(in, line);) {
      if (!std::regex_search(line, pattern)) continue;
      found.insert(file);
      EXPECT_TRUE(exempt.count(file)) << file << ": " << line;
    }
  }
  EXPECT_EQ(found, exempt) << "the scan must be able to find something";
}

TEST(Architecture, FilesStayReadable) {
  const fs::path root(NCSIM_SOURCE_DIR);
  for (const char* folder : {"sim", "kinematics", "post", "tests"}) {
    for (const auto& entry : fs::recursive_directory_iterator(root / folder)) {
      const std::string extension = entry.path().extension().string();
      if (extension != ".h" && extension != ".cc") continue;
      std::ifstream in(entry.path());
      const auto lines = std::count(std::istreambuf_iterator<char>(in), {}, '\n');
      EXPECT_LE(lines, 600) << entry.path();
    }
  }
}

}  // namespace
