// What the abstract interpretation remembers of its computations is what it would compute anew.
#include "dialects/registry.h"
#include "inference/absint/abstract_state.h"
#include "inference/absint/refine.h"
#include "language/parse/parse.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <random>
#include <tuple>

namespace feedhold {
namespace {

const Dialect &dialect() { return *findDialect(allDialects(), "fanuc-30i"); }

/// Assignments to #10 that read #1, #2, #3 and a common variable in all ways.
constexpr std::string_view kProgram = "O1\n"
                                      "#10=#1\n#10=[#1]\n#10=#1+3\n#10=#1-#2\n#10=[#1+2]-[#2+2]\n#10=#1*#2+#3\n"
                                      "#10=#1/#2\n#10=#3/[#1-#2]\n#10=SQRT[ABS[#1-#100]]\n#10=#100-#1\n#10=FIX[#1]\n"
                                      "#10=[#1EQ#2]*5\n#10=[#1LT[#2+1]]\n#10=-#1\n#10=#2+0\n#10=#5001+#1\n#10=#[#1]\n"
                                      "#10=ATAN[#1]/[#2]\n#10=#1MOD3\n#10=#0\n#10=7\nM30\n";

class RememberedValues : public ::testing::Test {
protected:
  AbstractContext contextOf(AbstractInterpretation &interpretation, AbstractState &state, const Node &node) {
    return {interpretation, state, programs, programs.file(FileId(0)), modes, node.block};
  }
  /// Carries an assignment out; what it has left in #10, and whether it may have divided by zero.
  std::tuple<AbstractValue, bool, bool> carryOut(AbstractInterpretation &interpretation, const AbstractState &before,
                                                 const Node &node) {
    AbstractState state = before;
    AbstractContext context = contextOf(interpretation, state, node);
    interpretation.start();
    step(context, node.instruction, words);
    return {state.locals[10], interpretation.mayHaveDividedByZero(), interpretation.stopped()};
  }
  /// One of a few values, with one of a few symbols: so that patterns come again under other names.
  AbstractValue someValue(AbstractInterpretation &interpretation) {
    const std::array numbers = {AbstractNumber::any(), AbstractNumber::constant(2.0),
                                AbstractNumber::inInterval({0, 5}), AbstractNumber::integersIn({1, 40}),
                                AbstractNumber::constant(Decimal(25, 1))};
    const AbstractNumber &number = numbers[dice() % numbers.size()];
    const AbstractValue value = dice() % 3 == 0 ? AbstractValue::vacantOr(number) : AbstractValue::number(number);
    const std::uint32_t symbol = dice() % 2 == 0 ? symbolOfVariable(1 + dice() % 3) : kFirstFreshSymbol + dice() % 2;
    switch (dice() % 4) {
    case 0: return value;
    case 1: return value.isNumber() ? interpretation.number(static_cast<double>(dice() % 3)) : AbstractValue::vacant();
    default: return value.withOrigin(Origin{symbol, Rational(dice() % 2)});
    }
  }

  SourceFile source = SourceFile::fromText("t.nc", std::string(kProgram));
  SyntaxTree tree = parse(source, dialect());
  ProgramModel model = resolve(source, tree, dialect());
  ProgramSet programs{{{FileId(0), &source, &tree, &model, &dialect()}}, CallGraph({{FileId(0), "", "", &model}})};
  ModalTable modes{dialect()};
  ExecutedWords<AbstractInterpretation> words;
  std::mt19937 dice{20260101};
};

TEST_F(RememberedValues, AreThoseOfANewEvaluation) {
  AbstractInterpretation remembering(dialect());
  AbstractState state = entryState(remembering);
  std::size_t assignments = 0;
  for (int round = 0; round < 600; ++round) {
    for (const std::uint32_t local : {1U, 2U, 3U})
      state.locals[local] = someValue(remembering);
    state.variables.erase(100);
    if (dice() % 2 == 0)
      state.variables.set(100, someValue(remembering));
    state.havocked.clear();
    if (dice() % 4 == 0)
      state.havocked = {{100, 200}};
    for (const Node &node : programs.file(FileId(0)).cfg.nodes) {
      if (!std::holds_alternative<Assign>(node.instruction))
        continue;
      AbstractInterpretation fresh(dialect());
      EXPECT_EQ(carryOut(remembering, state, node), carryOut(fresh, state, node))
          << source.text(tree.blocks[node.block].span()) << " in round " << round;
      ++assignments;
    }
  }
  EXPECT_GE(assignments, 600U * 18);
}

TEST_F(RememberedValues, KeepTheirOwnSymbols) {
  AbstractInterpretation interpretation(dialect());
  AbstractState state = entryState(interpretation);
  const auto &nodes = programs.file(FileId(0)).cfg.nodes;
  const Node &copy =
      *std::ranges::find_if(nodes, [](const Node &node) { return std::holds_alternative<Assign>(node.instruction); });
  for (const std::uint32_t symbol : {kFirstFreshSymbol + 7, kFirstFreshSymbol + 8}) {
    state.locals[1] = AbstractValue::anyNumber().withOrigin(Origin{symbol, Rational(3)});
    const auto [value, divided, stopped] = carryOut(interpretation, state, copy);
    EXPECT_EQ(value.origin(), std::optional(Origin{symbol, Rational(3)}));
  }
}

} // namespace
} // namespace feedhold
