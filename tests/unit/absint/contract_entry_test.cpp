// The state of an entry holds each call that the contract allows.  Which calls those are is asked of the exact
// interpretation of contracts, which shares no code with the analysis.
#include "inference/absint/contract_entry.h"

#include "dialects/registry.h"
#include "inference/absint/analysis.h"
#include "language/contract/constants.h"
#include "language/parse/parse.h"
#include "language/syntax/tree.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <random>

namespace feedhold {
namespace {

const Dialect &fanuc() { return *findDialect(allDialects(), "fanuc-30i"); }

class Program {
public:
  explicit Program(std::string clauses)
      : source_(SourceFile::fromText("O9100.nc", "O9100\n" + std::move(clauses) + "#1=#1\nM99\n")),
        tree_(parse(source_, fanuc())), model_(resolve(source_, tree_, fanuc())),
        contracts_(readContracts(source_, tree_, model_, fanuc())), set_(files(), graph()) {}

  const FileContracts &contracts() const { return contracts_; }
  const Contract &contract() const { return contracts_.contracts.front(); }
  AbstractState entry() const {
    Analysis analysis(set_);
    return analysis.entryState({FileId(0), set_.file(FileId(0)).cfg.entryOf(ProgramId(0)), ProgramId(0)}, &contracts_);
  }

private:
  std::vector<ProgramFile> files() const {
    std::vector<ProgramFile> all;
    all.push_back({FileId(0), &source_, &tree_, &model_, &fanuc()});
    return all;
  }
  CallGraph graph() const { return CallGraph({{FileId(0), "", "O9100", &model_}}); }

  SourceFile source_;
  SyntaxTree tree_;
  ProgramModel model_;
  FileContracts contracts_;
  ProgramSet set_;
};

using Arguments = std::map<std::uint32_t, Rational>;

bool allows(const FileContracts &contracts, const Contract &contract, const Arguments &arguments) {
  const ValueOfVariable valueOf = [&](std::uint32_t variable) -> std::optional<Rational> {
    const auto found = arguments.find(variable);
    return found == arguments.end() ? std::nullopt : std::optional(found->second);
  };
  const auto value = [&](ExpressionId id) { return constantValue(contracts.tree, id, valueOf).value(); };
  const auto keeps = [&](const EntryValue &param) {
    const Rational &given = arguments.at(param.variable);
    if (param.unit == Unit::Integer && !given.isInteger())
      return false;
    if (const auto *range = std::get_if<Range>(&param.values))
      return (!range->low || value(*range->low) <= given) && (!range->high || given <= value(*range->high));
    const auto *list = std::get_if<ValueList>(&param.values);
    return !list || std::ranges::any_of(list->values, [&](ExpressionId id) { return value(id) == given; });
  };
  return std::ranges::all_of(contract.params, keeps) &&
         std::ranges::all_of(contract.requirements, [&](const ContractCondition &requirement) {
           return constantTruth(contracts.tree, requirement.condition, valueOf).value();
         });
}

constexpr const char *kContracts[] = {
    "(@PARAM #1 0.1..5)\n(@PARAM #2 #1..9)\n",
    "(@PARAM #2 [#1/3]..[#1*3])\n(@PARAM #1 0.3..7.7)\n",
    "(@PARAM #1 IN 0.1,0.7,3)\n(@PARAM #2 -3..3 INT)\n",
    "(@PARAM #1)\n(@PARAM #2)\n(@REQUIRE [#1 GT 0] AND [#1 LT #2])\n",
    "(@PARAM #1)\n(@PARAM #2 ..6)\n(@REQUIRE [[#1+#2] LE 1] OR [#1 EQ 2.5])\n",
    "(@PARAM #1 -10..10)\n(@PARAM #2)\n(@REQUIRE [#1*#1] LE #2)\n(@REQUIRE #2 LE 4)\n",
};

TEST(ContractEntry, HoldsEachCallThatTheContractAllows) {
  std::mt19937 random(1);
  const auto tenths = [&] { return *Rational::make(static_cast<int>(random() % 201) - 100, 10); };
  for (const char *clauses : kContracts) {
    const Program program(clauses);
    ASSERT_TRUE(program.contract().isSound) << clauses;
    const AbstractState entry = program.entry();
    int allowed = 0;
    int cutOff = 0;
    for (int i = 0; i < 20'000; ++i) {
      const Arguments arguments{{1, tenths()}, {2, tenths()}};
      const auto holds = [&](const auto &argument) {
        const AbstractValue &value = entry.locals[argument.first];
        return value.isNumber() && value.number().contains(argument.second.toDouble());
      };
      const bool isHeld = std::ranges::all_of(arguments, holds);
      cutOff += isHeld ? 0 : 1;
      if (!allows(program.contracts(), program.contract(), arguments))
        continue;
      ++allowed;
      EXPECT_TRUE(isHeld) << clauses << arguments.at(1).toDouble() << " " << arguments.at(2).toDouble();
    }
    EXPECT_GT(allowed, 0) << clauses;
    EXPECT_GT(cutOff, 1000) << clauses;
  }
}

TEST(ContractEntry, TakesModesAndTheStart) {
  const Program program("(@MODAL G91 G18)\n(@START X1.5 Z[#26*2])\n(@PARAM #26 1..2)\n");
  const AbstractState entry = program.entry();
  const ModalTable modes(fanuc());
  const auto isOnly = [&](ModalKind kind, CodeAction action) {
    const CodeSet &codes = entry.codes[*modes.groupOf(kind)];
    return !codes.mayBeAtEntry() && codes.codes() == modes.maskOf(kind, {action});
  };
  EXPECT_TRUE(isOnly(ModalKind::Distance, CodeAction::Incremental));
  EXPECT_TRUE(isOnly(ModalKind::Plane, CodeAction::PlaneZX));
  EXPECT_TRUE(entry.codes[*modes.groupOf(ModalKind::Units)].mayBeAtEntry());
  EXPECT_EQ(entry.at(Axis::X).number().constantValue(), 1.5);
  EXPECT_EQ(entry.at(Axis::Z).number().interval(), (Interval{2, 4}));
  EXPECT_TRUE(entry.at(Axis::Y).number().isInterval());
}

TEST(ContractEntry, AMappingOfTheCallerIsNotTakenForOneOfTheProgram) {
  const Program program("(@MODAL G68 G51 G51.1)\n");
  ASSERT_TRUE(program.contract().isSound);
  const AbstractState entry = program.entry();
  const ModalTable modes(fanuc());
  for (const ModalKind kind : {ModalKind::Rotation, ModalKind::Scaling, ModalKind::Mirror})
    EXPECT_EQ(entry.codes[*modes.groupOf(kind)], CodeSet::atEntry()) << nameOf(kind);
}

TEST(ContractEntry, LeavesOutWhatNoCallCanKeep) {
  const AbstractState entry = Program("(@PARAM #1 0..5)\n(@REQUIRE #1 GT 9)\n(@REQUIRE #1 GE 2)\n").entry();
  EXPECT_EQ(entry.locals[1].number().interval(), (Interval{2, 5}));
}

} // namespace
} // namespace feedhold
