// SPDX-License-Identifier: BSD-3-Clause
// Expected values: examples of the Haas NGC Mill Operator's Manual 2017 ("Functions", "Notes on
// Functions", "Operators", "Logical Operators"), else arithmetic.
#include "sim/nc/expression.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <string>
#include <vector>

#include "sim/base/text.h"
#include "sim/nc/program.h"

namespace ncsim::nc {
namespace {

class Variables : public VariableReader {
 public:
  bool Read(long number, MacroValue* value) override {
    if (number > 33) return false;
    const auto found = values.find(number);
    *value = found == values.end() ? MacroValue() : MacroValue(found->second);
    return true;
  }
  int address_decimals() const override { return decimals; }

  std::map<long, double> values;
  int decimals = 4;
};

/// Value as text, "empty", or "error: ...".
std::string Value(const std::string& expression, Variables variables = {}) {
  const auto program = Program::FromText("test.nc", "#1=" + expression);
  Block block;
  ParseBlock(*program, 0, 1, &block);
  if (!block.errors.empty()) return "syntax: " + block.errors[0].message;
  if (block.statements.size() != 1) return "more than the expression";
  MacroValue value;
  std::string error;
  if (!Evaluate(block.code, block.statements[0].value, variables, &value, &error)) {
    return "error: " + error;
  }
  return value ? Short(*value, 6) : "empty";
}

struct Case {
  const char* expression;
  const char* expected;
};

TEST(ExpressionTest, OperatorsAndFunctions) {
  const std::vector<Case> cases = {{"+1.23", "1.23"},
                                   {"-[COS[60]]", "-0.5"},
                                   {"27 MOD 20", "7"},   // "Arithmetic Operators"
                                   {"1.0 OR 2.0", "3"},  // "Logical Operators"
                                   {"5 AND 3", "1"},
                                   {"6 XOR 3", "5"},
                                   {"5.9 AND 3.9", "1"},   // The integer portion alone counts.
                                   {"[1.0 LT 5.0]", "1"},  // "Boolean Operators"
                                   {"[5 LE 5]", "1"},
                                   {"[5 GT 5]", "0"},
                                   {"[5 GE 5]", "1"},
                                   {"[5 NE 5]", "0"},
                                   {"[5 EQ 5]", "1"},
                                   {"SIN[30]", "0.5"},
                                   {"COS[90]", "0"},
                                   {"TAN[45]", "1"},
                                   {"ASIN[.5]", "30"},
                                   {"ACOS[.5]", "60"},
                                   {"ATAN[1]", "45"},
                                   {"ATAN[1]/2", "22.5"},
                                   {"ATAN[1]/[-1]", "135"},
                                   {"SQRT[2]", "1.414214"},
                                   {"ABS[-3.5]", "3.5"},
                                   {"ROUND[1.714]", "2"},  // "Notes on Functions"
                                   {"ROUND[3.1416]", "3"},
                                   {"ROUND[3.54]", "4"},  // "Fix vs. Round"
                                   {"FIX[3.54]", "3"},
                                   {"FIX[-3.54]", "-3"},
                                   {"2+3*4", "14"},
                                   {"[2+3]*4", "20"},
                                   {"2-3-4", "-5"},
                                   {"24/4/2", "3"},
                                   {"-2*-3", "6"},
                                   {"2*-[3+1]", "-8"},
                                   {"--3", "3"},
                                   {"1+1 EQ 2", "1"},
                                   {"sin[30]+abs[-1]", "1.5"}};
  for (const Case& row : cases) EXPECT_EQ(Value(row.expression), row.expected) << row.expression;
}

TEST(ExpressionTest, VariablesAndIndirection) {
  Variables variables;
  variables.values = {{1, 3.0}, {2, 5.5}, {3, 7.0}, {4, 2.0}};
  const std::vector<Case> cases = {{"#2", "5.5"},       {"#[#1]", "7"},       {"##1", "7"},
                                   {"#[#4+1]", "7"},    {"-#2", "-5.5"},      {"#[#1-1]*2", "11"},
                                   {"#[1.00001]", "3"}, {"SIN[#1*10]", "0.5"}};
  for (const Case& row : cases) {
    EXPECT_EQ(Value(row.expression, variables), row.expected) << row.expression;
  }
}

// "IF [#1 NE #0]" tests for a value; "anything but 0.0, or the undefined value #0" makes a
// condition true.
TEST(ExpressionTest, Undefined) {
  Variables variables;
  variables.values = {{2, 0.0}};
  const std::vector<Case> cases = {{"#0", "empty"},     {"#5", "empty"},     {"[#5]", "empty"},
                                   {"-#5", "empty"},    {"[#5 EQ #0]", "1"}, {"[#5 NE #0]", "0"},
                                   {"[#2 EQ #0]", "0"}, {"[#2 NE #0]", "1"}, {"[#5 EQ 0]", "0"},
                                   {"[#5 LT 1]", "1"},  {"[#5 GE 0]", "1"},  {"#5+1", "1"},
                                   {"#5*#5", "0"},      {"ABS[#5]", "0"}};
  for (const Case& row : cases) {
    EXPECT_EQ(Value(row.expression, variables), row.expected) << row.expression;
  }
}

TEST(ExpressionTest, Errors) {
  const std::vector<Case> cases = {
      {"1/0", "error: division by zero"},
      {"1/#5", "error: division by zero"},
      {"5 MOD 0", "error: division by zero"},
      {"SQRT[-1]", "error: SQRT of a negative number, -1"},
      {"ASIN[1.5]", "error: ASIN[1.5]: the argument is outside -1 to 1"},
      {"TAN[90]", "error: TAN[90] has no value"},
      {"TAN[-270]", "error: TAN[-270] has no value"},
      {"ATAN[0]/[0]", "error: ATAN[0]/[0] has no value"},
      {"#99", "error: #99 is not a variable of this control"},
      {"#[0-1]", "error: #[-1] is not a variable of this control"},
      {"#[1.5]", "error: #[1.5] is not a variable of this control"},
      {"#[#5]", "error: the number of a variable is undefined"},
      {"[999999999*999999999] AND 1",
       "error: an operand of AND, OR or XOR is too large to be an integer"},
      {"EXP[1]", "syntax: 'EXP' is not a function of this control"},
      {"FUP[1.2]", "syntax: 'FUP' is not a function of this control"},
      {"SIN 30", "syntax: SIN needs its argument in brackets [ ]"},
      {"1+", "syntax: the expression ends where a value is expected"},
      {"[1+2", "syntax: '[' is never closed"},
      {"[1 2]", "syntax: expected an operator or ']', found '2'"},
      {"[]", "syntax: expected a value, found ']'"},
      {"#1.5", "syntax: the number of a variable has no decimal point"},
      {"#-1", "syntax: '#' needs the number of a variable or a bracket after it"}};
  for (const Case& row : cases) EXPECT_EQ(Value(row.expression), row.expected) << row.expression;
}

TEST(ExpressionTest, OverflowIsAnError) {
  Variables variables;
  variables.values = {{1, 1e200}};
  EXPECT_EQ(Value("#1*#1", variables), "error: a value is too large for the control");
}

// "When ROUND is used in an address expression, metric and angle dimensions are rounded to
// three-place precision. For inch dimensions, four-place precision is the default."
TEST(ExpressionTest, RoundInAnAddress) {
  const auto program = Program::FromText("test.nc", "X[ROUND[#1]+ROUND[#1]]");
  Block block;
  ParseBlock(*program, 0, 1, &block);
  Variables variables;
  variables.values = {{1, 1.00333}};
  MacroValue value;
  std::string error;
  ASSERT_TRUE(Evaluate(block.code, block.words.at(0).expression, variables, &value, &error));
  EXPECT_NEAR(value.value(), 2.0066, 1e-12);
  variables.decimals = 3;
  ASSERT_TRUE(Evaluate(block.code, block.words.at(0).expression, variables, &value, &error));
  EXPECT_NEAR(value.value(), 2.006, 1e-12);
}

TEST(ExpressionTest, ManyOperandsAreRefused) {
  std::string nested;
  for (int i = 0; i < 31; ++i) nested += "1+[2*[";
  EXPECT_EQ(Value(nested).substr(0, 7), "syntax:");
  std::string flat = "1";
  for (int i = 0; i < 500; ++i) flat += "+1";
  EXPECT_EQ(Value(flat), "501");
}

}  // namespace
}  // namespace ncsim::nc
