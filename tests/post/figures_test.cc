// SPDX-License-Identifier: BSD-3-Clause
// Three figures of a student's post for the UMC-750 (the project's first source paper), from
// cutter-location files that are rebuilt from the numbers printed in them. Left column of each: the
// machine builder's post.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <map>
#include <sstream>
#include <string>
#include <vector>

#include "sim/app/app.h"
#include "tests/post/post_rig.h"

namespace ncsim::posting {
namespace {

using ::testing::HasSubstr;

std::string Cl(const std::string& path) {
  return "TOOL PATH/OP1,TOOL,MILL\nTLDATA/MILL,0.5,0,3,0,0\nMSYS/0,0,0,1,0,0,0,1,0\nLOAD/TOOL,1\n"
         "SPINDL/RPM,5000,CLW\n" +
         path + "END-OF-PATH\n";
}

/// Its blocks without numbers.
std::vector<std::string> Blocks(const std::string& program) {
  std::vector<std::string> blocks;
  std::istringstream in(program);
  for (std::string line; std::getline(in, line);) {
    if (line.size() > 1 && line[0] == 'N') line = line.substr(line.find(' ') + 1);
    blocks.push_back(line);
  }
  return blocks;
}

std::map<char, double> Words(const std::string& block) {
  std::map<char, double> words;
  std::istringstream in(block);
  for (std::string word; in >> word;) words[word[0]] = std::strtod(word.c_str() + 1, nullptr);
  return words;
}

std::string Replaced(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from << " in\n" << text;
  if (at != std::string::npos) text.replace(at, from.size(), to);
  return text;
}

class Figures : public testing::Test {
 protected:
  Figures() : rig_("figures") {}
  void Post(const std::string& path, const std::string& mode) {
    way_ = {kUmc750, mode, {"--unit", "inch"}};
    cl_ = rig_.Write("part.cls", Cl(path));
    ASSERT_EQ(rig_.Post(cl_, way_), app::kExitPass) << rig_.said();
  }
  int CompareWith(const std::string& program) {
    rig_.Write(rig_.program().filename().string(), program);
    return rig_.Compare(cl_, way_);
  }

  PostRig rig_;
  Way way_;
  std::filesystem::path cl_;
};

// Figure 10: "B82.875 C-180." of the builder's post, "B82.8750 C-180.0000" of the student's. C180.
// is the same position, and so is what they write.
TEST_F(Figures, TheSameAxisAtC180AndAtMinusC180) {
  Post(
      "RAPID\nGOTO/-4,1,2,-0.9922757,0,0.1240558\nFEDRAT/IPM,20\nGOTO/-3,1,2\nGOTO/-3,2,2\nRAPID\n"
      "GOTO/-4,2,2\n",
      "indexed");
  const std::string program = rig_.Program();
  const bool positive = program.find("B82.874 C180.") != std::string::npos ||
                        program.find("B82.875 C180.") != std::string::npos;
  EXPECT_EQ(rig_.Compare(cl_, way_), app::kExitPass) << rig_.said();
  std::size_t at = program.find(positive ? "C180." : "C-180.");
  ASSERT_NE(at, std::string::npos) << program;
  const std::size_t begin = program.rfind('B', at);
  EXPECT_NEAR(std::strtod(program.c_str() + begin + 1, nullptr), 82.875, 0.0011);
  for (const char* written : {"B82.875 C180.", "B82.875 C-180.", "B82.8750 C-180.0000"}) {
    std::string other = program;
    const std::size_t end = other.find_first_of(" \n", at);
    other.replace(begin, end - begin, written);
    EXPECT_EQ(CompareWith(other), app::kExitPass) << written << "\n" << rig_.said();
  }
}

// Figure 17: N190 to N225 of the builder's post, arcs about the corners of a pocket.
TEST_F(Figures, TheArcsOfTheCorners) {
  // Centres are the printed starts and I, J. NX turns by the right hand about -(i, j, k).
  Post(
      "RAPID\nGOTO/.799,.8754,4,0,0,1\nFEDRAT/IPM,20\nGOTO/.799,.8754,3\n"
      "CIRCLE/.8922,.8687,3,0,0,-1,.0934,.0060,.5,.5,0\nGOTO/.8154,.8153,3\n"
      "CIRCLE/.8671,.8878,3,0,0,-1,.0890,.0060,.5,.5,0\nGOTO/.8729,.799,3\n"
      "GOTO/3.1246,.799,3\n"
      "CIRCLE/3.1313,.8922,3,0,0,-1,.0934,.0060,.5,.5,0\nGOTO/3.1847,.8154,3\n"
      "CIRCLE/3.1122,.8671,3,0,0,-1,.0890,.0060,.5,.5,0\nGOTO/3.201,.8729,3\n"
      "GOTO/3.201,3.1246,3\n"
      "CIRCLE/3.1079,3.1313,3,0,0,-1,.0933,.0060,.5,.5,0\nGOTO/3.1845,3.1847,3\n"
      "CIRCLE/3.1329,3.1124,3,0,0,-1,.0888,.0060,.5,.5,0\nGOTO/3.1272,3.201,3\n"
      "RAPID\nGOTO/3.1272,3.201,4\n",
      "three");
  const char* const kPrinted[] = {
      "G03 X.8154 Y.8153 I.0932 J-.0067",   "G03 X.8729 Y.799 I.0517 J.0725",
      "G03 X3.1847 Y.8154 I.0067 J.0932",   "G03 X3.201 Y.8729 I-.0725 J.0517",
      "G03 X3.1845 Y3.1847 I-.0931 J.0067", "G03 X3.1272 Y3.201 I-.0516 J-.0723"};
  std::vector<std::string> arcs;
  for (const std::string& block : Blocks(rig_.Program())) {
    if (block.find(" I") != std::string::npos) arcs.push_back(block);
  }
  ASSERT_EQ(arcs.size(), std::size(kPrinted));
  EXPECT_THAT(arcs[0], HasSubstr(kPrinted[0]));
  for (std::size_t i = 0; i < arcs.size(); ++i) {
    auto words = Words(arcs[i]);
    auto printed = Words(kPrinted[i]);
    // A word that has not changed is not printed again.
    for (const char letter : {'X', 'Y', 'I', 'J'}) {
      if (words.count(letter) == 0) continue;
      EXPECT_NEAR(words[letter], printed[letter], 0.00011) << arcs[i] << " " << kPrinted[i];
    }
  }
  EXPECT_EQ(rig_.Compare(cl_, way_), app::kExitPass) << rig_.said();
}

// Figure 15. The builder's chords go down by .0329 a fifth of 104 degrees, which gives the start;
// the student's arc has the centre, and no Z.
TEST_F(Figures, TheHelixIsAHelix) {
  Post(
      "RAPID\nGOTO/2.3803,2.2763,4,0,0,1\nFEDRAT/IPM,9.8\nGOTO/2.3803,2.2763,3.1\n"
      "CIRCLE/2.1865,2.,3.1,0,0,-1,.3375,.0060,.5,.5,0\nGOTO/1.849,2.,2.9026\n"
      "GOTO/1.849,1.849,2.9026\nGOTO/2.151,1.849,2.9026\nRAPID\nGOTO/2.151,1.849,4\n",
      "three");
  const std::string program = rig_.Program();
  const std::string helix = "G03 X1.849 Y2. Z2.9026 I-.1938 J-.2763";
  ASSERT_THAT(program, HasSubstr(helix));
  EXPECT_EQ(rig_.Compare(cl_, way_), app::kExitPass) << rig_.said();
  EXPECT_LE(rig_.position(), 0.005 + 0.00254);

  // As printed, and with the way down in a block of its own, as its text says.
  const std::string flat = "G03 X1.8490 Y2.0000 I-0.1938 J-0.2763";
  for (const std::string& down : {std::string(), std::string("\nG01 Z2.9026")}) {
    const std::string printed = Replaced(program, helix, flat + down);
    const auto line =
        std::count(printed.begin(),
                   printed.begin() + static_cast<std::ptrdiff_t>(printed.find(flat)), '\n') +
        1;
    EXPECT_EQ(CompareWith(printed), app::kExitFail);
    EXPECT_THAT(rig_.said(), HasSubstr(rig_.program().string() + ":" + std::to_string(line) +
                                       ":1: error: the tip goes "));
    EXPECT_THAT(rig_.said(), HasSubstr("part.cls:10"));
  }
}

}  // namespace
}  // namespace ncsim::posting
