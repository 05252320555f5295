// SPDX-License-Identifier: BSD-3-Clause
// Ranges and aliases: Haas NGC Mill Operator's Manual 2017, "Macro Variables Table".
#include "sim/control/macro_variables.h"

#include <gtest/gtest.h>

#include <vector>

namespace ncsim::control {
namespace {

class NoSystem : public SystemVariables {
 public:
  bool Read(long number, nc::MacroValue*) override {
    asked.push_back(number);
    return false;
  }
  bool Write(long number, nc::MacroValue) override {
    asked.push_back(number);
    return false;
  }
  void AssumeUndefined(long number) override { assumed.push_back(number); }
  int length_decimals() const override { return 3; }
  std::vector<long> assumed;
  std::vector<long> asked;
};

class MacroVariablesTest : public testing::Test {
 protected:
  nc::MacroValue Value(long number) {
    nc::MacroValue value = -99.0;
    EXPECT_TRUE(variables_.Read(number, &value)) << number;
    return value;
  }

  FlowOptions options_;
  NoSystem system_;
  MacroVariables variables_{options_, &system_};
};

TEST_F(MacroVariablesTest, LegacyNumbersAreAliases) {
  for (const long number : {100L, 199L, 500L, 699L, 800L, 999L}) {
    ASSERT_TRUE(variables_.Write(number, static_cast<double>(number)));
    EXPECT_EQ(Value(number + 10000), static_cast<double>(number));
  }
  ASSERT_TRUE(variables_.Write(10000, 1.0));
  EXPECT_EQ(Value(10000), 1.0);
  EXPECT_TRUE(system_.asked.empty());
}

TEST_F(MacroVariablesTest, WhatIsNotTheFlowsIsTheControllers) {
  nc::MacroValue value;
  for (const long number : {34L, 99L, 200L, 499L, 700L, 799L, 1000L, 3001L, 5021L, 9999L, 11000L}) {
    EXPECT_FALSE(variables_.Read(number, &value)) << number;
    EXPECT_FALSE(variables_.Write(number, 1.0)) << number;
    EXPECT_EQ(system_.asked.back(), number);
  }
}

TEST_F(MacroVariablesTest, LocalsOfEachLevel) {
  ASSERT_TRUE(variables_.Write(33, 5.0));
  LocalVariables arguments;
  arguments[1] = 2.0;
  variables_.PushLocals(arguments);
  EXPECT_EQ(Value(1), 2.0);
  EXPECT_EQ(Value(33), std::nullopt);
  variables_.PopLocals();
  EXPECT_EQ(Value(33), 5.0);
  EXPECT_EQ(Value(1), std::nullopt);
}

TEST_F(MacroVariablesTest, SwitchesOfTheOperator) {
  EXPECT_EQ(Value(3032), 0.0);
  EXPECT_EQ(Value(3033), 0.0);
  options_.block_delete = true;
  options_.optional_stop = true;
  EXPECT_EQ(Value(3032), 1.0);
  EXPECT_EQ(Value(3033), 1.0);
  EXPECT_FALSE(variables_.Write(3032, 0.0));
  EXPECT_TRUE(variables_.Write(3003, 1.0));
  EXPECT_EQ(Value(3003), 1.0);
  EXPECT_TRUE(variables_.Write(3004, 7.0));
  EXPECT_EQ(Value(3004), 7.0);
  EXPECT_EQ(Value(3030), 0.0);
  EXPECT_FALSE(variables_.Write(0, 1.0));
}

TEST_F(MacroVariablesTest, CommonsReadBeforeTheyAreSetAreNamedOnce) {
  Value(500);
  Value(10500);
  variables_.Write(501, 1.0);
  Value(501);
  Value(500);
  EXPECT_EQ(system_.assumed, std::vector<long>{500});
}

// "Rounded to the least significant digit": four places inch, three mm and degrees; offsets and
// tools are integers.
TEST_F(MacroVariablesTest, PlacesOfAnAddress) {
  EXPECT_EQ(variables_.DecimalsOf('X'), 3);
  EXPECT_EQ(variables_.DecimalsOf('B'), 3);
  EXPECT_EQ(variables_.DecimalsOf('D'), 0);
  EXPECT_EQ(variables_.DecimalsOf('G'), 1);
  variables_.SetAddress('T');
  EXPECT_EQ(variables_.address_decimals(), 0);
}

}  // namespace
}  // namespace ncsim::control
