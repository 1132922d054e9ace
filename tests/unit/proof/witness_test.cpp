// Witnesses: inputs are taken for what they show, and for nothing else.
#include "proof/replay/witness.h"

#include "unit/proof/explored.h"

#include <gtest/gtest.h>

namespace feedhold::prove {
namespace {

constexpr std::string_view kGuarded = "O1\nIF[#1EQ12345]THEN#3000=7\nM99\n";

Violation stopsWithAlarm() {
  return [](const RunResult &run) {
    return run.end == RunEnd::UserAlarm ? std::optional<std::string>("stops") : std::nullopt;
  };
}

/// The model in which the first argument is the number.
smt::Model modelOf(Explored &program, std::int64_t number) {
  const auto &inputs = program.start.interpretation().entryValues();
  smt::Model model;
  for (const auto &[variable, value] : inputs)
    if (variable == 1) {
      model[program.start.store()[value.number].name] = smt::Number(number);
      model[program.start.store()[value.vacant].name] = false;
    }
  return model;
}

TEST(Witness, AModelIsReplayed) {
  Explored program(kGuarded);
  const auto witness = program.runs()->fromModel(modelOf(program, 12345), stopsWithAlarm());
  ASSERT_TRUE(witness);
  EXPECT_EQ(witness->variables.find(1)->number, 12345);
}

TEST(Witness, AModelThatDoesNotDoItIsNone) {
  Explored program(kGuarded);
  EXPECT_FALSE(program.runs()->fromModel(modelOf(program, 5), stopsWithAlarm()));
  EXPECT_FALSE(program.runs()->replays().empty()); // kept for the judge
}

TEST(Witness, ItIsMadeAsPlainAsItCanBe) {
  Explored program("O1\nIF[#1GT500]THEN#3000=7\nM99\n");
  const auto witness = program.runs()->fromModel(modelOf(program, 987654), stopsWithAlarm());
  ASSERT_TRUE(witness);
  EXPECT_EQ(witness->variables.find(1)->number, 987650); // a digit less
}

TEST(Witness, InputsThatTheContractForbidsAreNone) {
  Explored program("O1\nIF[#1GT5]THEN#3000=7\nM99\n");
  program.runs();
  smt::TermStore &store = program.start.store();
  const smt::TermId input = program.start.interpretation().entryValues().begin()->second.number;
  std::vector<smt::Model> inputs;
  for (const WitnessSearch::Sample &sample : program.runs()->samples())
    inputs.push_back(program.runs()->modelOf(sample.given));
  const WitnessSearch small = program.runs()->narrowed(store.less(input, store.number(smt::Number(5))), inputs);
  EXPECT_FALSE(small.amongSamples(stopsWithAlarm()));
  EXPECT_FALSE(small.fromModel(modelOf(program, 9), stopsWithAlarm()));
  EXPECT_TRUE(program.runs()->amongSamples(stopsWithAlarm()));
}

TEST(Witness, WhatOnlyTheRoundingOfTheMachineMakesIsNone) {
  Explored program("O1\n#2=0.1+0.2\nIF[#2NE0.3]THEN#3000=7\nM99\n");
  EXPECT_FALSE(program.runs()->amongSamples(stopsWithAlarm()));
}

} // namespace
} // namespace feedhold::prove
