// SPDX-License-Identifier: BSD-3-Clause
#include "sim/nc/program.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "sim/nc/program_index.h"

namespace ncsim::nc {
namespace {

class ProgramFileTest : public testing::Test {
 protected:
  void SetUp() override {
    path_ = testing::TempDir() + "ncsim_program_test_" +
            testing::UnitTest::GetInstance()->current_test_info()->name() + ".nc";
  }
  void TearDown() override { std::filesystem::remove(path_); }
  std::shared_ptr<const Program> LoadText(const std::string& text) {
    std::ofstream(path_, std::ios::binary) << text;
    return Program::Load(path_, &diagnostics_);
  }
  std::string Message() const {
    return diagnostics_.all().empty() ? "" : diagnostics_.all().front().message;
  }

  std::string path_;
  Diagnostics diagnostics_;
};

TEST_F(ProgramFileTest, ReadsLines) {
  const auto program = LoadText("%\r\nO1\r\nG0 X1\r\n%");
  ASSERT_NE(program, nullptr);
  EXPECT_EQ(program->name(), path_);
  EXPECT_EQ(program->Line(0), "%");
  EXPECT_EQ(program->LineByNumber(3), "G0 X1");
  EXPECT_EQ(program->LineByNumber(4), "%");
  EXPECT_EQ(program->LineByNumber(5), "");
  EXPECT_EQ(program->LineByNumber(0), "");
  EXPECT_FALSE(diagnostics_.has_errors());
}

TEST_F(ProgramFileTest, SkipsTheByteOrderMark) {
  const auto program = LoadText("\xEF\xBB\xBFG0 X1\n");
  ASSERT_NE(program, nullptr);
  EXPECT_EQ(program->LineByNumber(1), "G0 X1");
}

TEST_F(ProgramFileTest, OtherEncodingsAreFineInComments) {
  const auto program = LoadText("(Fr\xE4ser \xC3\xA4)\nG0 X1\n");
  ASSERT_NE(program, nullptr);
  Block block;
  ParseBlock(*program, 0, 1, &block);
  EXPECT_TRUE(block.errors.empty());
  ASSERT_EQ(block.comments.size(), 1u);
}

TEST_F(ProgramFileTest, EmptyIsReported) {
  EXPECT_EQ(LoadText(""), nullptr);
  EXPECT_EQ(Message(), "is empty");
}

TEST_F(ProgramFileTest, AByteOrderMarkAloneIsEmpty) {
  EXPECT_EQ(LoadText("\xEF\xBB\xBF"), nullptr);
  EXPECT_EQ(Message(), "is empty");
}

TEST_F(ProgramFileTest, BinaryIsReportedWithItsLine) {
  EXPECT_EQ(LoadText(std::string("G0\nX\0", 5)), nullptr);
  EXPECT_NE(Message().find("not a text"), std::string::npos);
  EXPECT_EQ(diagnostics_.all().front().line, 2);
}

TEST_F(ProgramFileTest, ANulFarIntoTheFileIsFound) {
  EXPECT_EQ(LoadText(std::string(3'000'000, '\n') + '\0'), nullptr);
  EXPECT_NE(Message().find("not a text"), std::string::npos);
}

TEST_F(ProgramFileTest, ReleasedTextCanStillBeRead) {
  std::string text;
  while (text.size() < 1'000'000) text += "G1 X1.5 Y2.5\n";
  const auto program = LoadText(text);
  ASSERT_NE(program, nullptr);
  program->Release(text.size());
  EXPECT_TRUE(program->text() == text);
}

TEST(ProgramTest, AFileThatIsNotThere) {
  Diagnostics diagnostics;
  EXPECT_EQ(Program::Load("/nonexistent/part.nc", &diagnostics), nullptr);
  EXPECT_TRUE(diagnostics.has_errors());
}

TEST(ProgramTest, AFolderIsNoProgram) {
  Diagnostics diagnostics;
  EXPECT_EQ(Program::Load(testing::TempDir(), &diagnostics), nullptr);
  EXPECT_EQ(diagnostics.all().front().message, "is a folder, not an NC program");
}

TEST(ProgramTest, EndlessDevicesAreNotReadToTheEnd) {
  Diagnostics diagnostics;
  EXPECT_EQ(Program::Load("/dev/zero", &diagnostics), nullptr);
  EXPECT_TRUE(diagnostics.has_errors());
}

TEST(ProgramIndexTest, ProgramsOfOneFile) {
  const auto program = Program::FromText(
      "test.nc", "%\nO1 (MAIN)\nN10 G0\nM30\nO200\nN10 G1\nM99\n%\n(TAIL)\n%\no00300\nM99\n%\n");
  const ProgramIndex index(*program);
  ASSERT_EQ(index.programs().size(), 3u);
  EXPECT_EQ(index.programs()[0].number, 1);
  EXPECT_EQ(index.FindProgram(200)->begin.line, 5);
  EXPECT_EQ(index.FindProgram(300)->begin.line, 11);
  EXPECT_EQ(index.FindProgram(4), nullptr);
  EXPECT_EQ(index.ProgramAt(program->text().find("G1")).number, 200);
}

TEST(ProgramIndexTest, BlocksAreFoundForwardThenFromTheTop) {
  const auto program =
      Program::FromText("test.nc", "N1 X1\nN5 X2\n/N7 X3\nN5 X4\n  (c) N9\nO2\nN1 X5\nN0 X6\n");
  const ProgramIndex index(*program);
  const ProgramRange& main = index.programs().at(0);
  const ProgramRange& second = index.programs().at(1);
  TextPosition at;
  using Search = ProgramIndex::Search;
  EXPECT_EQ(index.FindBlock(1, main, 6, &at), Search::kFound);
  EXPECT_EQ(at.line, 1);
  EXPECT_EQ(index.FindBlock(7, main, 0, &at), Search::kFound);
  EXPECT_EQ(at.line, 3);
  EXPECT_EQ(index.FindBlock(9, main, 0, &at), Search::kFound);
  EXPECT_EQ(index.FindBlock(5, main, 0, &at), Search::kAmbiguous);
  EXPECT_EQ(at.line, 2);
  EXPECT_EQ(index.FindBlock(5, main, 12, &at), Search::kAmbiguous);
  EXPECT_EQ(at.line, 4);
  EXPECT_EQ(index.FindBlock(1, second, second.begin.offset, &at), Search::kFound);
  EXPECT_EQ(at.line, 7);
  EXPECT_EQ(index.FindBlock(0, second, second.begin.offset, &at), Search::kFound);
  EXPECT_EQ(index.FindBlock(0, main, 0, &at), Search::kMissing);
  EXPECT_EQ(index.FindBlock(-1, main, 0, &at), Search::kMissing);
}

/// Characters of the line that no part of the block claims; "" where it has errors, which stand for
/// their rest.
std::string Unclaimed(std::string_view line, const Block& block) {
  if (!block.errors.empty()) return "";
  std::string rest(line);
  const auto claim = [&](std::size_t from, std::size_t size) {
    for (std::size_t i = from; i < std::min(rest.size(), from + size); ++i) rest[i] = ' ';
  };
  for (const Word& word : block.words)
    claim(static_cast<std::size_t>(word.column - 1), word.length);
  for (const Statement& statement : block.statements) {
    claim(static_cast<std::size_t>(statement.column - 1), statement.length);
  }
  for (const std::string_view comment : block.comments) {
    claim(static_cast<std::size_t>(comment.data() - line.data()) - 1, comment.size() + 2);
  }
  const auto claim_number = [&](char upper, char lower) {
    std::size_t i = std::min(rest.find(upper), rest.find(lower));
    if (i == std::string::npos) return;
    do {
      rest[i++] = ' ';
    } while (i < rest.size() && rest[i] >= '0' && rest[i] <= '9');
  };
  if (block.sequence >= 0) claim_number('N', 'n');
  if (block.program >= 0) claim_number('O', 'o');
  const auto claim_one = [&](char c) {
    const std::size_t i = rest.find(c);
    if (i != std::string::npos) rest[i] = ' ';
  };
  if (block.block_delete) claim_one('/');
  if (block.program_mark) claim_one('%');
  std::string left;
  for (const char c : rest) {
    if (c != ' ' && c != '\t' && c != '\f' && c != '\v' && c != ';') left += c;
  }
  return left;
}

// Every byte of every line of third-party programs is in a word, a statement, a comment or an
// error.
TEST(ProgramCorpusTest, NothingIsIgnored) {
  const char* corpus = std::getenv("NCSIM_CORPUS");
  if (corpus == nullptr) GTEST_SKIP() << "NCSIM_CORPUS is not set";
  int files = 0;
  std::int64_t lines = 0;
  for (const char* folder : {"haas", "fanuc", "linuxcnc"}) {
    const std::filesystem::path root = std::filesystem::path(corpus) / folder;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(root)) {
      if (!entry.is_regular_file()) continue;
      Diagnostics diagnostics;
      const auto program = Program::Load(entry.path().string(), &diagnostics);
      if (program == nullptr) {
        EXPECT_TRUE(diagnostics.has_errors()) << entry.path();
        continue;
      }
      ++files;
      Block block;
      std::size_t offset = program->begin();
      for (int line = 1; offset < program->text().size(); ++line) {
        ParseBlock(*program, offset, line, &block);
        const std::string_view text = program->Line(offset);
        ASSERT_EQ(Unclaimed(text, block), "") << entry.path() << ":" << line << ": " << text;
        ASSERT_GT(block.next, offset);
        offset = block.next;
        ++lines;
      }
    }
  }
  EXPECT_GT(files, 100);
  EXPECT_GT(lines, 100'000);
}

// A real five-axis program of an NX post for this control must have no syntax error at all.
TEST(ProgramCorpusTest, TheUmc750ProgramIsUnderstood) {
  const char* corpus = std::getenv("NCSIM_CORPUS");
  if (corpus == nullptr) GTEST_SKIP() << "NCSIM_CORPUS is not set";
  Diagnostics diagnostics;
  const auto program =
      Program::Load(std::string(corpus) +
                        "/haas/umc750-ubc/NCcodeForHAAS-UMC750Machine/FinalToolPath.stripped.nc",
                    &diagnostics);
  ASSERT_NE(program, nullptr);
  Block block;
  int line = 0;
  for (std::size_t offset = program->begin(); offset < program->text().size();
       offset = block.next) {
    ParseBlock(*program, offset, ++line, &block);
    ASSERT_TRUE(block.errors.empty()) << line << ": " << block.errors[0].message;
    ASSERT_TRUE(block.doubts.empty()) << line;
  }
  EXPECT_EQ(line, 16115);
}

}  // namespace
}  // namespace ncsim::nc
