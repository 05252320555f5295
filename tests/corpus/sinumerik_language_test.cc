// SPDX-License-Identifier: BSD-3-Clause
// The SINUMERIK language against texts that nobody here wrote: the programs of the corpus, and the
// torture files of an editor's syntax definition, which mark in comments what is not legal.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "sim/control/sinumerik_test_run.h"
#include "sim/nc/sinumerik_block.h"

namespace ncsim {
namespace {

namespace fs = std::filesystem;

/// Blocks of the torture files that are unfinished on purpose and not marked as illegal (an editor
/// must colour what is being typed), though the control stops at them with alarm 12080.
struct Unfinished {
  std::string_view file;
  std::vector<int> lines;
};
const std::array<Unfinished, 8> kUnfinished = {{
    {"syntax_test_call.spf", {8, 12}},                           // CALL alone
    {"syntax_test_def.spf", {8, 12, 16, 20}},                    // DEF, DEF INT
    {"syntax_test_define.spf", {8, 12, 17, 21, 25, 29, 114}},    // DEFINE, DEFINE name [AS]
    {"syntax_test_extern.spf", {8, 12}},                         // EXTERN alone
    {"syntax_test_if.spf", {9, 15}},                             // IF alone
    {"syntax_test_operators.spf", {350}},                        // an array element alone
    {"syntax_test_proc.spf", {9, 15}},                           // PROC alone
    {"syntax_test_synact.spf", {149, 151, 154, 157, 161, 166}},  // IDS=, WHENEVER DO ...
}};

class SinumerikCorpus : public testing::Test {
 protected:
  void SetUp() override {
    const char* corpus = std::getenv("NCSIM_CORPUS");
    if (corpus == nullptr) GTEST_SKIP() << "NCSIM_CORPUS is not set";
    root_ = corpus;
  }

  std::vector<fs::path> Files(std::string_view folder) const {
    const std::set<std::string> extensions = {".mpf", ".MPF", ".spf", ".nc", ".ptp", ".txt"};
    std::vector<fs::path> files;
    for (const auto& entry : fs::recursive_directory_iterator(root_ / folder)) {
      if (entry.is_regular_file() && extensions.count(entry.path().extension().string()) != 0) {
        files.push_back(entry.path());
      }
    }
    std::sort(files.begin(), files.end());
    return files;
  }

  static std::shared_ptr<const nc::Program> Load(const fs::path& path) {
    Diagnostics diagnostics;
    auto program = nc::Program::Load(path.string(), &diagnostics);
    EXPECT_NE(program, nullptr) << path;
    return program;
  }

  fs::path root_;
};

/// Whether one of the comments behind the block marks a part of it as illegal: "; ^^^ a.b
/// invalid.illegal", but not "; ^^^ a.b - invalid.illegal".
bool MarksIllegal(std::string_view comment) {
  const std::size_t at = comment.find("invalid.illegal");
  return at != std::string_view::npos &&
         comment.substr(0, at).find(" - ") == std::string_view::npos;
}

/// Lines of a torture file: those with a syntax error, and those whose comments say so.
struct Torture {
  std::set<int> failed, illegal;
  int blocks = 0;
};

Torture Read(const nc::Program& program) {
  Torture torture;
  nc::SinumerikBlock block;
  int line = 0;
  int last_block = 0;
  for (std::size_t at = program.begin(); at < program.text().size(); at = block.next) {
    nc::ParseSinumerikBlock(program, at, ++line, &block);
    const std::string_view text = program.Line(at);
    if (!text.empty() && text[0] == ';') {
      if (MarksIllegal(text)) torture.illegal.insert(last_block);
      continue;
    }
    if (text.empty()) continue;
    last_block = line;
    ++torture.blocks;
    if (!block.errors.empty()) torture.failed.insert(line);
  }
  return torture;
}

TEST_F(SinumerikCorpus, TheTortureFilesParseOrFailAsTheirCommentsSay) {
  int files = 0;
  int blocks = 0;
  int failed = 0;
  for (const fs::path& path : Files("siemens/s840d-syntax")) {
    const auto program = Load(path);
    ASSERT_NE(program, nullptr);
    Torture torture = Read(*program);
    ++files;
    blocks += torture.blocks;
    failed += static_cast<int>(torture.failed.size());
    for (const Unfinished& unfinished : kUnfinished) {
      if (path.filename().string() != unfinished.file) continue;
      torture.illegal.insert(unfinished.lines.begin(), unfinished.lines.end());
    }
    for (const int line : torture.illegal) {
      EXPECT_EQ(torture.failed.count(line), 1U) << path.filename() << ":" << line << " is illegal";
    }
    for (const int line : torture.failed) {
      EXPECT_EQ(torture.illegal.count(line), 1U) << path.filename() << ":" << line << " is legal";
    }
  }
  RecordProperty("files", files);
  RecordProperty("blocks", blocks);
  RecordProperty("failed", failed);
  EXPECT_EQ(files, 14);
  EXPECT_GT(blocks, 250);
}

TEST_F(SinumerikCorpus, EveryProgramIsReadWhole) {
  int files = 0;
  std::map<std::string, std::vector<int>> wrong;
  for (const char* folder : {"siemens", "seed004"}) {
    for (const fs::path& path : Files(folder)) {
      if (path.string().find("s840d-syntax/gcode") != std::string::npos) continue;
      const auto program = Load(path);
      ASSERT_NE(program, nullptr);
      nc::SinumerikBlock block;
      int line = 0;
      ++files;
      for (std::size_t at = program->begin(); at < program->text().size(); at = block.next) {
        nc::ParseSinumerikBlock(*program, at, ++line, &block);
        if (!block.errors.empty()) wrong[path.filename().string()].push_back(line);
      }
    }
  }
  EXPECT_EQ(files, 20);  // 13 of the paper, 6 of machines and posts, and the editor's example.
  for (const auto& [file, lines] : wrong) ADD_FAILURE() << file << ":" << lines.front();
}

/// What the flow says of a program, and how far it comes.
struct Followed {
  std::vector<std::string> findings;  ///< "line rule".
  control::SinumerikEvent last = control::SinumerikEvent::kEnd;
  int steps = 0;
};

Followed Follow(const std::shared_ptr<const nc::Program>& program) {
  Followed followed;
  control::SinumerikTestSystem system;
  SourceFiles files;
  control::SinumerikFlow flow(program, {}, &system, &files, [&](const Finding& finding) {
    followed.findings.push_back(std::to_string(finding.where.line) + " " +
                                std::string(Info(finding.rule).id));
  });
  control::SinumerikStep step;
  for (followed.last = flow.Next(&step); followed.last == control::SinumerikEvent::kStep;
       followed.last = flow.Next(&step)) {
    ++followed.steps;
    flow.PathMotionDone();
  }
  return followed;
}

TEST_F(SinumerikCorpus, EveryProgramIsFollowedToItsEnd) {
  std::map<std::string, int> unsupported;
  std::vector<std::string> stopped;
  for (const char* folder : {"siemens", "seed004"}) {
    for (const fs::path& path : Files(folder)) {
      if (path.string().find("s840d-syntax") != std::string::npos) continue;
      const Followed followed = Follow(Load(path));
      const std::string name = path.filename().string();
      EXPECT_GT(followed.steps, 30) << path;
      for (const std::string& finding : followed.findings) {
        if (finding.find("unsupported-code") != std::string::npos) ++unsupported[name];
        if (finding.find("control-alarm") != std::string::npos) stopped.push_back(name + finding);
      }
      const bool ended = followed.last == control::SinumerikEvent::kEnd;
      EXPECT_EQ(ended, stopped.empty() || stopped.back().rfind(name, 0) != 0) << path;
    }
  }
  // FAZOWANIE, L54 and L55 are subprograms of the machine's user; M202(...) calls one of its
  // builder; TRAOOF is a slip of its author's.
  const std::map<std::string, int> expected = {{"Cincinnati_Lamb_FTV5_840D_sample.mpf", 2},
                                               {"Cincinnati_Lamb_FTV5_840D_sample.ptp", 6},
                                               {"SINUMERIK840D.nc", 8}};
  EXPECT_EQ(unsupported, expected);
  // G503: the control has G500 and G505 to G599 (alarm 12470).
  const std::vector<std::string> alarms = {"Cincinnati_Lamb_FTV5_840D_sample.ptp431 control-alarm"};
  EXPECT_EQ(stopped, alarms);
}

}  // namespace
}  // namespace ncsim
