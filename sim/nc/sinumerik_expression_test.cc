// SPDX-License-Identifier: BSD-3-Clause
// Expressions of the SINUMERIK 840D sl. "ONE" is the NC programming manual 12/2019.
#include <gtest/gtest.h>

#include <string>
#include <utility>

#include "sim/nc/sinumerik_value.h"

namespace ncsim::nc {
namespace {

/// R1 = 1, R2 = 2 ...; X, Y, Z are axes; SS is the string "abc".
class Names : public SinumerikReader {
 public:
  bool ReadName(std::string_view name, const std::vector<SinumerikValue>& indices,
                SinumerikValue* value, SinumerikFault* fault) override {
    if (name[0] == 'R') {
      *value = SinumerikValue::Real(indices.empty() ? name[1] - '0' : indices[0].number);
    } else if (name == "SS") {
      *value = SinumerikValue::String("abc");
    } else if (name.size() == 1) {
      *value = SinumerikValue::Axis(std::string(name));
    } else {
      fault->message = "no name";
      return false;
    }
    return true;
  }
  bool CallFunction(std::string_view, const std::vector<SinumerikValue>&, SinumerikValue*,
                    SinumerikFault* fault) override {
    fault->message = "no function";
    return false;
  }
};

/// "type value", or the alarm.
std::string Of(const std::string& text) {
  const auto program = Program::FromText("t", "R0=" + text);
  SinumerikBlock block;
  ParseSinumerikBlock(*program, 0, 1, &block);
  if (!block.errors.empty()) return block.errors.front().message;
  Names names;
  SinumerikValue value;
  SinumerikFault fault;
  if (!Evaluate(block, block.parts.at(0).expression, names, &value, &fault)) {
    const std::size_t at = fault.message.rfind("(alarm ");
    return at == std::string::npos ? fault.message : fault.message.substr(at + 7, 5);
  }
  return std::string(ToString(value.type)) + " " + ToText(value);
}

// ONE p. 444, from the highest: NOT B_NOT, * / DIV MOD, + -, B_AND, B_XOR, B_OR, AND, XOR, OR, <<,
// comparisons. Each line tells a level from the next.
TEST(SinumerikExpressionTest, Priorities) {
  EXPECT_EQ(Of("NOT 1+1"), "INT 1");            // (NOT 1) + 1
  EXPECT_EQ(Of("B_NOT 0*5"), "INT -5");         // (B_NOT 0) * 5
  EXPECT_EQ(Of("2+3*4"), "INT 14");             // 2 + (3*4)
  EXPECT_EQ(Of("7+9 DIV 2"), "INT 11");         // 7 + (9 DIV 2)
  EXPECT_EQ(Of("10-7 MOD 4"), "INT 7");         // 10 - (7 MOD 4)
  EXPECT_EQ(Of("4 B_AND 2+2"), "INT 4");        // 4 B_AND (2+2)
  EXPECT_EQ(Of("1 B_XOR 3 B_AND 2"), "INT 3");  // 1 B_XOR (3 B_AND 2)
  EXPECT_EQ(Of("1 B_OR 1 B_XOR 1"), "INT 1");   // 1 B_OR (1 B_XOR 1)
  EXPECT_EQ(Of("2 AND 1 B_OR 0"), "BOOL 1");    // 2 AND (1 B_OR 0)
  EXPECT_EQ(Of("1 XOR 0 AND 0"), "BOOL 1");     // 1 XOR (0 AND 0)
  EXPECT_EQ(Of("1 OR 1 XOR 1"), "BOOL 1");      // 1 OR (1 XOR 1)
  EXPECT_EQ(Of("\"A\"<<1 OR 0"), "STRING A1");  // "A" << (1 OR 0)
  EXPECT_EQ(Of("\"A\"<<1==\"A1\""), "BOOL 1");  // ("A"<<1) == "A1"
  EXPECT_EQ(Of("2==2 AND 1"), "BOOL 0");        // 2 == (2 AND 1): comparison binds weakest
  EXPECT_EQ(Of("(2==2) AND (1==1)"), "BOOL 1");
  EXPECT_EQ(Of("NOT R1>=0"), "BOOL 1");  // (NOT R1) >= 0
  EXPECT_EQ(Of("3>2>0"), "BOOL 1");      // from left to right: (3>2) > 0
}

TEST(SinumerikExpressionTest, LeftToRight) {
  EXPECT_EQ(Of("10-4-3"), "INT 3");
  EXPECT_EQ(Of("100/10/5"), "REAL 2");
  EXPECT_EQ(Of("17 MOD 10 MOD 4"), "INT 3");
}

TEST(SinumerikExpressionTest, IntAndReal) {
  EXPECT_EQ(Of("7/2"), "REAL 3.5");  // `/` of INT is REAL.
  EXPECT_EQ(Of("7 DIV 2"), "INT 3");
  EXPECT_EQ(Of("-7 DIV 2"), "INT -3");
  EXPECT_EQ(Of("7 MOD 4"), "INT 3");
  EXPECT_EQ(Of("1+1."), "REAL 2");
  EXPECT_EQ(Of("'H1F'+'B1010'"), "INT 41");
  EXPECT_EQ(Of("'HFFFFFFFF'"), "INT -1");
  EXPECT_EQ(Of("-.1EX-3"), "REAL -0.0001");
  EXPECT_EQ(Of("2147483647+1"), "14051");
  EXPECT_EQ(Of("1/0"), "14051");
  EXPECT_EQ(Of("R[R2+1]"), "REAL 3");
}

// PGA 03/2006 p. 1-23: with relative equality of 10^-12 the manual's own example,
// ABS(61.02 - 61.01) > 0.01, does not hold, though it does in plain floating point.
TEST(SinumerikExpressionTest, RealComparisonIsRelative) {
  EXPECT_EQ(Of("ABS(61.02-61.01)>0.01"), "BOOL 0");
  EXPECT_EQ(Of("ABS(61.02-61.01)==0.01"), "BOOL 1");
  EXPECT_EQ(Of("0.1+0.2==0.3"), "BOOL 1");
  EXPECT_EQ(Of("0.1+0.2<>0.3"), "BOOL 0");
  EXPECT_EQ(Of("1.0==1.00000000001"), "BOOL 0");
  EXPECT_EQ(Of("1EX-20==0.0"), "BOOL 0");  // Relative: nothing but 0 is equal to 0.
  EXPECT_EQ(Of("1000000000000.5>1000000000000.0"), "BOOL 0");
}

TEST(SinumerikExpressionTest, Functions) {
  EXPECT_EQ(Of("ATAN2(30.5,80.1)").substr(0, 12), "REAL 20.8455");  // ONE p. 387.
  EXPECT_EQ(Of("SIN(30)"), "REAL 0.5");
  EXPECT_EQ(Of("POT(3)"), "REAL 9");
  EXPECT_EQ(Of("SQRT(-1)"), "14051");
  EXPECT_EQ(Of("TRUNC(-3.7)"), "REAL -3");
  EXPECT_EQ(Of("ROUND(-2.5)"), "REAL -3");
  EXPECT_EQ(Of("ROUNDUP(3.1)"), "REAL 4");
  EXPECT_EQ(Of("ROUNDUP(-3.6)"), "REAL -3");
  EXPECT_EQ(Of("ABS(-5)"), "INT 5");
  EXPECT_EQ(Of("MINVAL(3,2)"), "INT 2");
  EXPECT_EQ(Of("MAXVAL(3,2.5)"), "INT 3");
  EXPECT_EQ(Of("BOUND(1,5,7)"), "INT 5");
  EXPECT_EQ(Of("LN(EXP(2))"), "REAL 2");
  EXPECT_EQ(Of("SIN()"), "14020");
  EXPECT_EQ(Of("SIN(1,2)"), "14020");
  EXPECT_EQ(Of("SIN(\"A\")"), "12150");
}

TEST(SinumerikExpressionTest, Strings) {
  EXPECT_EQ(Of("<<1<<\"/\"<<2.50"), "STRING 1/2.5");
  EXPECT_EQ(Of("SS<<X"), "STRING abcX");
  EXPECT_EQ(Of("STRLEN(SS)"), "INT 3");
  EXPECT_EQ(Of("TOUPPER(SS)"), "STRING ABC");
  EXPECT_EQ(Of("INDEX(SS,\"c\")"), "INT 2");
  EXPECT_EQ(Of("INDEX(SS,\"x\")"), "INT -1");
  EXPECT_EQ(Of("SUBSTR(SS,1)"), "STRING bc");
  EXPECT_EQ(Of("SUBSTR(SS,1,1)"), "STRING b");
  EXPECT_EQ(Of("ISNUMBER(\"-1.5EX2\")"), "BOOL 1");
  EXPECT_EQ(Of("ISNUMBER(\"1,5\")"), "BOOL 0");
  EXPECT_EQ(Of("NUMBER(\"-1.5EX2\")"), "REAL -150");
  EXPECT_EQ(Of("SS==\"abc\""), "BOOL 1");
  EXPECT_EQ(Of("SS==1"), "12150");
  EXPECT_EQ(Of("SS+1"), "12150");
  EXPECT_EQ(Of("AXNAME(\"x1\")"), "AXIS X1");
}

TEST(SinumerikExpressionTest, FramesAreChained) {
  const auto program = Program::FromText("t", "$P_UIFR[1]=CTRANS(X,-37.8,Y,25.16):CROT(Z,90)");
  SinumerikBlock block;
  ParseSinumerikBlock(*program, 0, 1, &block);
  ASSERT_TRUE(block.errors.empty());
  Names names;
  SinumerikValue value;
  SinumerikFault fault;
  ASSERT_TRUE(Evaluate(block, block.parts[0].expression, names, &value, &fault)) << fault.message;
  ASSERT_EQ(value.type, SinumerikType::kFrame);
  ASSERT_EQ(value.frame->chain.size(), 2u);
  EXPECT_EQ(value.frame->chain[0][1].name, "Y");
  EXPECT_EQ(value.frame->chain[0][1].tr, 25.16);
  EXPECT_EQ(value.frame->chain[1][0].rt, 90.0);
}

TEST(SinumerikExpressionTest, Conversion) {
  SinumerikValue to;
  EXPECT_EQ(Convert(SinumerikValue::Real(2.5), SinumerikType::kInt, &to), "");
  EXPECT_EQ(to.number, 3.0);  // ONE p. 62: REAL is rounded to INT.
  EXPECT_EQ(Convert(SinumerikValue::Real(-0.3), SinumerikType::kBool, &to), "");
  EXPECT_EQ(to.number, 1.0);
  EXPECT_NE(Convert(SinumerikValue::Real(3e9), SinumerikType::kInt, &to).find("12160"),
            std::string::npos);
  EXPECT_NE(Convert(SinumerikValue::String("1"), SinumerikType::kInt, &to).find("12150"),
            std::string::npos);
  EXPECT_EQ(Convert(SinumerikValue::String("A"), SinumerikType::kChar, &to), "");
  EXPECT_EQ(to.number, 65.0);
}

}  // namespace
}  // namespace ncsim::nc
