#include "inference/absint/kept_state.h"

#include "dialects/registry.h"
#include "findings/project/project.h"
#include "inference/absint/analysis.h"
#include "rules/registry.h"

#include <algorithm>
#include <filesystem>
#include <gtest/gtest.h>

namespace feedhold {
namespace {

/// Keeps all states of a walk, and copies of them.
class KeepsAll : public AnalysisVisitor {
public:
  void visit(Place, const AbstractState &state, std::span<const Place>) override {
    kept.push_back(keeper_.keep(state));
    copies.push_back(state);
  }
  std::vector<KeptState> kept;
  std::vector<AbstractState> copies;

private:
  StateKeeper keeper_;
};

TEST(KeptState, IsTheStateAgain) {
  std::size_t states = 0, values = 0, all = 0;
  for (const auto &entry : std::filesystem::recursive_directory_iterator(FEEDHOLD_SOURCE_DIR "/corpus")) {
    if (entry.path().extension() != ".nc")
      continue;
    const auto loaded = loadProject({.path = entry.path().string()}, {allDialects(), allRules()});
    const auto start = loaded ? startOf(*loaded.value(), std::nullopt) : std::nullopt;
    if (!start)
      continue;
    KeepsAll keeps;
    Analysis(*loaded.value()->set).walk(*start, keeps);
    for (std::size_t i = 0; i < keeps.kept.size(); ++i) {
      EXPECT_EQ(keeps.kept[i].state(), keeps.copies[i]) << entry.path() << " " << i;
      for (std::uint8_t group = 0; group < kModalGroups; ++group)
        EXPECT_EQ(keeps.kept[i].code(group), keeps.copies[i].codes[group]);
      values += keeps.kept[i].valueCount();
      forEachValue(keeps.copies[i], [&](const AbstractValue &) { ++all; });
      ++states;
    }
  }
  EXPECT_GT(states, 1000U);
  EXPECT_LT(values, all / 5); // little room
}

TEST(KeptState, VariablesComeAndGo) {
  AbstractInterpretation interpretation(*findDialect(allDialects(), "fanuc-30i"));
  AbstractState state = entryState(interpretation);
  StateKeeper keeper;
  const auto expectKept = [&] { EXPECT_EQ(keeper.keep(state).state(), state); };
  expectKept();
  for (const std::uint32_t variable : {500U, 100U, 700U}) {
    state.variables.set(variable, AbstractValue::vacant());
    expectKept();
  }
  state.variables.erase(500);
  state.havocked = {{500, 500}};
  expectKept();
  for (std::uint32_t variable = 101; variable < 200; ++variable) // more than is kept as a difference
    state.variables.set(variable, AbstractValue::vacant());
  expectKept();
  state.variables = {};
  expectKept();
  state.counters.resize(state.counters.size() + 1);
  expectKept();
}

} // namespace
} // namespace feedhold
