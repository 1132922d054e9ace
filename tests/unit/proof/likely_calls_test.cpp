#include "proof/replay/likely_calls.h"

#include "unit/proof/explored.h"

#include <gtest/gtest.h>

namespace feedhold::prove {
namespace {

GivenVariables call(const std::vector<std::pair<std::uint32_t, double>> &values) {
  GivenVariables given;
  for (const auto &[variable, value] : values)
    given.set(variable, ConcreteValue::of(value));
  return given;
}

/// #21 is needed; #9 has a default; #24 chooses a way; #500 is passed by no letter.
constexpr std::string_view kMacro = "O1\nIF[#9EQ#0]THEN#9=120\nIF[#21LE0]GOTO91\nIF[#24EQ1]GOTO10\nX[#21*#500]F#9\n"
                                    "N10M99\nN91#3000=1\n";

TEST(LikelyCalls, WhatTheProgramComputesWithIsNeeded) {
  const ParsedProgram program(kMacro);
  const LikelyCalls likely(program.set, program.main());
  EXPECT_LT(likely.distanceOf(call({{21, 1}})), likely.distanceOf({}));
  EXPECT_LT(likely.distanceOf(call({{21, 1}})), likely.distanceOf(call({{21, 1}, {24, 1}})));
  EXPECT_LT(likely.distanceOf(call({{21, 1}})), likely.distanceOf(call({{21, 1}, {9, 120}})));
  EXPECT_LT(likely.distanceOf(call({{21, 1}, {9, 120}})), likely.distanceOf(call({{21, 1}, {9, 1}})));
  EXPECT_EQ(likely.completed({}), call({{21, 1}}));
}

TEST(LikelyCalls, WhatTheGuardsRefuseIsFar) {
  const ParsedProgram program(kMacro);
  const LikelyCalls likely(program.set, program.main());
  EXPECT_LT(likely.distanceOf(call({{21, 12.3456}})), likely.distanceOf(call({{21, -1}})));
}

TEST(LikelyCalls, PlainNumbersAreNearer) {
  const ParsedProgram program(kMacro);
  const LikelyCalls likely(program.set, program.main());
  const std::vector<double> numbers{1, 10, 7, 0.25, 777, 12.345};
  for (std::size_t i = 1; i < numbers.size(); ++i)
    EXPECT_LT(likely.distanceOf(call({{21, numbers[i - 1]}})), likely.distanceOf(call({{21, numbers[i]}})));
}

TEST(LikelyCalls, AValueThatTheGuardsTakeIsChosen) {
  const ParsedProgram program("O1\nIF[#1EQ#0]GOTO91\nIF[[#1LT200]OR[#1GT300]]GOTO91\nM99\nN91#3000=1\n");
  EXPECT_EQ(LikelyCalls(program.set, program.main()).completed({}), call({{1, 200}}));
}

TEST(LikelyCalls, WhatCallsPassIsLikeliest) {
  const ParsedProgram program("O1\nX[#21*#7]\nM99\nO2\nG65P1D4.U2.\nG65P1U3.\nG65P1U3.\nM30\n");
  const LikelyCalls likely(program.set, program.main());
  EXPECT_EQ(likely.valuesOf(21), (std::vector<double>{3, 2}));
  EXPECT_EQ(likely.completed({}), call({{21, 3}})); // not all of them pass D
  EXPECT_EQ(likely.distanceOf(call({{21, 2}})), 0);
  EXPECT_LT(likely.distanceOf(call({{21, 2}})), likely.distanceOf(call({{21, 1}})));
}

TEST(LikelyCalls, WhatTheProgramSetsMayBeMissing) {
  const ParsedProgram program("O1\nIF[#9EQ#0]THEN#9=120\nIF[#9LT50]GOTO90\nX#21F#9\nM99\nN90#3000=1\nO2\n"
                              "G65P1U12.\nG65P1U12.F200.\nM30\n");
  const LikelyCalls likely(program.set, program.main());
  EXPECT_EQ(likely.distanceOf(call({{21, 12}})), 0);
  EXPECT_LT(likely.distanceOf(call({{21, 12}})), likely.distanceOf(call({{9, 120}, {21, 12}})));
}

TEST(LikelyCalls, AProgramThatTheOperatorStartsHasNoArguments) {
  const ParsedProgram program("O1\nX[1/#21]\nM30\n");
  const LikelyCalls likely(program.set, program.main());
  EXPECT_EQ(likely.distanceOf({}), 0);
  EXPECT_TRUE(likely.calls().empty());
}

} // namespace
} // namespace feedhold::prove
