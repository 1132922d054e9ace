// Contracts as the prover sees them, expressions in the library's own tree, and texts that nobody would write.
#include "dialects/registry.h"
#include "language/contract/constants.h"
#include "language/contract/contract.h"
#include "language/parse/parse.h"

#include <gtest/gtest.h>
#include <random>

namespace feedhold {
namespace {

const Dialect &fanuc() { return *findDialect(allDialects(), "fanuc-30i"); }

/// A program with what stands beside it, read.
class Contracts {
public:
  explicit Contracts(std::string text, std::vector<Sidecar> sidecars = {}, const Dialect &dialect = fanuc())
      : source_(SourceFile::fromText("part.nc", std::move(text))), tree_(parse(source_, dialect)),
        model_(resolve(source_, tree_, dialect)), contracts_(readContracts(source_, tree_, model_, dialect, sidecars)) {
  }

  const FileContracts &all() const { return contracts_; }
  const Contract &first() const { return contracts_.contracts.front(); }
  std::string dumped() const { return dump(contracts_, model_, tree_); }
  std::optional<Rational> value(ExpressionId id) const { return constantValue(contracts_.tree, id); }

private:
  SourceFile source_;
  SyntaxTree tree_;
  ProgramModel model_;
  FileContracts contracts_;
};

Sidecar sidecar(std::string text, std::optional<std::uint32_t> program = std::nullopt) {
  return {SourceFile::fromText("O9100.contract", std::move(text)), program};
}

TEST(Contract, AProgramWithoutClausesHasNone) {
  const Contracts contracts("O9100(SLOT)\n#1=2\nM99\n");
  EXPECT_TRUE(contracts.all().contracts.empty());
  EXPECT_EQ(contracts.all().of(ProgramId(0)), nullptr);
}

TEST(Contract, KeepsPlaceAndTextOfEachClause) {
  const Contracts contracts("O9100\n( @PARAM #21 DEPTH 0.5..50. MM )\n#1=#21\nM99\n");
  const EntryValue *depth = contracts.first().param(21);
  ASSERT_NE(depth, nullptr);
  const Clause &clause = contracts.all().clauses[depth->clause];
  EXPECT_EQ(clause.text, "@PARAM #21 DEPTH 0.5..50. MM");
  EXPECT_EQ(contracts.all().source(clause.source).position(clause.span.begin).line, 2u);
  EXPECT_EQ(depth->name, "DEPTH");
  EXPECT_EQ(depth->unit, Unit::Millimetre);
  const auto &range = std::get<Range>(depth->values);
  EXPECT_EQ(contracts.value(*range.low), Rational::make(1, 2));
  EXPECT_EQ(contracts.value(*range.high), Rational(50));
  EXPECT_EQ(contracts.first().param(22), nullptr);
}

TEST(Contract, IsNotSoundWhenAClauseIsLeftOut) {
  EXPECT_TRUE(Contracts("O1\n(@REQUIRE #1 GT 0)\n#2=#1\n").first().isSound);
  EXPECT_FALSE(Contracts("O1\n(@REQUIRE #1 GT)\n#2=#1\n").first().isSound);
  EXPECT_FALSE(Contracts("O1\n(@REQIRE #1 GT 0)\n#2=#1\n").first().isSound);
  EXPECT_FALSE(Contracts("O1\n(@PARAM #1 5..0)\n#2=#1\n").first().isSound);
  EXPECT_FALSE(Contracts("O1\n(@GUARDED)\n(@GUARDED)\n#2=#1\n").first().isSound);
  EXPECT_FALSE(
      Contracts("O1\n#2=#1\n", {{SourceFile::fromText("O1.contract", ""), 1, "permission denied"}}).first().isSound);
}

TEST(Contract, AToleranceIsTheOneThatIsStated) {
  const auto toleranceOf = [](const std::string &clauses) {
    const Contracts contracts("O1\n(@ENSURE POS[X] EQ #1)\n" + clauses + "\nG0X#1\nM99\n");
    return feedhold::toleranceOf(contracts.first(), fanuc());
  };
  EXPECT_EQ(toleranceOf(""), Decimal(1, 3));
  EXPECT_EQ(toleranceOf("(@MODAL G90 G21)"), Decimal(1, 3));
  EXPECT_EQ(toleranceOf("(@MODAL G90 G20)"), Decimal(1, 4));
  EXPECT_EQ(toleranceOf("(@MODAL G90 G20)\n(@TOLERANCE .05)"), Decimal(5, 2));
}

TEST(Contract, CornersAreSharpUnlessAClauseSaysOtherwise) {
  EXPECT_EQ(cornerOf(Contracts("O1\n(@REQUIRE #1 GT 0)\nG0X#1\nM99\n").first()), Decimal::fromInteger(0));
  EXPECT_EQ(cornerOf(Contracts("O1\n(@CORNER 0)\nG0X#1\nM99\n").first()), Decimal::fromInteger(0));
  EXPECT_EQ(cornerOf(Contracts("O1\n(@CORNER .05)\nG0X#1\nM99\n").first()), Decimal(5, 2));
}

TEST(Contract, WithinATolerance) {
  const auto isTrue = [](const std::string &condition) {
    const Contracts contracts("O1\n(@REQUIRE " + condition + ")\n#2=#1\nM99\n");
    EXPECT_TRUE(contracts.all().issues.empty()) << contracts.dumped();
    return constantTruth(contracts.all().tree, contracts.first().requirements.front().condition,
                         [](std::uint32_t) { return Rational(5); });
  };
  EXPECT_EQ(isTrue("#1 EQ 5.5 WITHIN .5"), true);
  EXPECT_EQ(isTrue("#1 EQ 4.5 WITHIN .5"), true);
  EXPECT_EQ(isTrue("#1 EQ 5.6 WITHIN .5"), false);
  EXPECT_EQ(isTrue("#1 EQ 4.4 WITHIN .5"), false);
  EXPECT_EQ(isTrue("#1 NE 5.5 WITHIN .5"), false);
  EXPECT_EQ(isTrue("#1 NE 4.4 WITHIN .5"), true);
  EXPECT_EQ(isTrue("[#1*2 EQ 9 WITHIN 2] AND [#1 GT 4]"), true);
  EXPECT_EQ(isTrue("[[#1 EQ 9 WITHIN 2] OR [2 NE #1 WITHIN 4]]"), false);
}

TEST(Contract, AWarningLeavesItSound) {
  const Contracts contracts("O1\n(@PARAM #7 0..5)\n#2=#1\nM99\n");
  ASSERT_EQ(contracts.all().issues.size(), 1u);
  EXPECT_EQ(contracts.all().issues.front().kind, ContractIssueKind::UnusedVariable);
  EXPECT_TRUE(contracts.first().isSound);
}

TEST(Contract, ReservedVariablesAreNoneOfTheProgram) {
  const Contracts contracts("O1\n(@ENSURE POS[Z] EQ ENTRY[Z]+OLD[#510])\n#510=1\nM99\n");
  const FileContracts &all = contracts.all();
  std::vector<std::uint32_t> numbers;
  for (std::size_t i = 0; i < all.tree.expressions.size(); ++i) {
    EXPECT_FALSE(variableNumber(all.tree, ExpressionId(i)));
    if (const auto number = reservedNumber(all.tree, ExpressionId(i)))
      numbers.push_back(*number);
  }
  EXPECT_EQ(numbers, (std::vector{positionVariable('Z'), entryVariable('Z'), oldVariable(510)}));
  EXPECT_EQ(std::get<PositionOf>(*reservedVariable(numbers[0])).axis, 'Z');
  EXPECT_EQ(std::get<EntryPositionOf>(*reservedVariable(numbers[1])).axis, 'Z');
  EXPECT_EQ(std::get<OldValueOf>(*reservedVariable(numbers[2])).variable, 510u);
  EXPECT_FALSE(reservedVariable(510));
  EXPECT_FALSE(reservedVariable(0x80000000));
}

TEST(Contract, ASidecarSpeaksOfItsProgramOnly) {
  const Contracts contracts("O9100\nM99\nO9200\n#1=#21\nM99\n", {sidecar("@PARAM #21 0..5\n", 9200)});
  EXPECT_EQ(contracts.all().of(ProgramId(0)), nullptr);
  ASSERT_NE(contracts.all().of(ProgramId(1)), nullptr);
  EXPECT_TRUE(Contracts("O9100\nM99\n", {sidecar("@PARAM #21 0..5\n", 9200)}).all().contracts.empty());
}

TEST(Contract, LineEndsAndMarksOfSidecars) {
  const Contracts contracts("O9100\n#1=#21+#22\nM99\n",
                            {sidecar("\xEF\xBB\xBF@PARAM #21 0..5\r\n\r\n  (@PARAM #22 1..2) ; both\r; end")});
  EXPECT_TRUE(contracts.all().issues.empty());
  EXPECT_EQ(contracts.first().params.size(), 2u);
}

TEST(Contract, ConstantConditions) {
  const Contracts contracts("O1\n(@REQUIRE [#1 LT 2] AND [[#2-1]/2 EQ 3])\n#3=#1+#2\nM99\n");
  const ExpressionId condition = contracts.first().requirements.front().condition;
  const auto truth = [&](std::optional<Rational> one, std::optional<Rational> two) {
    return constantTruth(contracts.all().tree, condition,
                         [&](std::uint32_t variable) { return variable == 1 ? one : two; });
  };
  EXPECT_EQ(truth(Rational(1), Rational(7)), true);
  EXPECT_EQ(truth(Rational(1), Rational(8)), false);
  EXPECT_EQ(truth(Rational(2), std::nullopt), false);
  EXPECT_EQ(truth(Rational(1), std::nullopt), std::nullopt);
}

TEST(Contract, ManyClausesAreReadInTimeThatGrowsWithTheirNumber) {
  std::string text = "O1\n";
  for (int i = 0; i < 20'000; ++i)
    text += "(@REQUIRE #1 GT 0)\n\n(@INVARIANT #1 GT 0)\nN" + std::to_string(i) + "\n(@PARAM #7 1..2)\n";
  EXPECT_EQ(Contracts(text).first().requirements.size(), 20'000u);
}

/// The first twenty begin a clause.
const std::vector<std::string> kPieces = {"@PARAM ",
                                          "@GLOBAL",
                                          "@REQUIRE ",
                                          "@MODAL",
                                          "@START ",
                                          "@TOOL ",
                                          "@KEEPIN A ",
                                          "@KEEPOUT B ",
                                          "@CLEARANCE ",
                                          "@TRAVEL ",
                                          "@LIMIT ",
                                          "@ENSURE ",
                                          "@ASSIGNS",
                                          "@GUARDED",
                                          "@ALARM",
                                          "@INVARIANT ",
                                          "@VARIANT ",
                                          "@CYCLIC",
                                          "@EVENTUALLY #1000 EQ 1",
                                          "@AT N30 ",
                                          "@ALLOW ",
                                          "#21",
                                          " #510 ",
                                          "0.5",
                                          "..",
                                          "...",
                                          "....",
                                          ".",
                                          "50.",
                                          "[",
                                          "]",
                                          "-",
                                          "/",
                                          ",",
                                          " IN ",
                                          " OPTIONAL",
                                          " MM",
                                          " EQ ",
                                          " AND ",
                                          "POS[X]",
                                          "OLD[#5",
                                          "ENTRY[",
                                          "X",
                                          " Y ",
                                          "Z-#26",
                                          " BOX ",
                                          " AT ",
                                          " RADIUS ",
                                          " WHERE ",
                                          "SPHERE ",
                                          "POLYGON ",
                                          "CYLINDER AXIS ",
                                          "IFF",
                                          " G90 ",
                                          "#",
                                          "@",
                                          ";",
                                          "(",
                                          " ",
                                          "\t",
                                          "\n",
                                          "N30",
                                          "WHILE[#1LT2]DO1\n",
                                          "END1\n",
                                          "O9100\n",
                                          "\xE9",
                                          "\x83\x5C",
                                          "\xEF\xBB\xBF",
                                          "FLAT",
                                          "999999999999",
                                          "SQRT[",
                                          "#<a>",
                                          "MODAL PRESERVED"};
constexpr std::size_t kBeginnings = 20;

/// Clauses cut, joined and mixed at random: each is read or has an issue, and every span lies in its text.
TEST(Contract, AnyTextIsRead) {
  std::mt19937 random(7);
  for (int round = 0; round < 4000; ++round) {
    const Dialect &dialect = *allDialects().dialects[random() % allDialects().dialects.size()];
    std::string text = "O9100\n";
    std::string beside;
    for (int i = 0; i < 12; ++i) {
      std::string clause;
      for (std::size_t k = random() % 8; k > 0; --k)
        clause += kPieces[random() % kPieces.size()];
      text += "(" + kPieces[random() % kBeginnings] + clause + ")\n";
      beside += kPieces[random() % kBeginnings] + clause + (random() % 4 == 0 ? "" : "\n");
    }
    const Contracts contracts(text, {sidecar(beside, 9100), sidecar(beside)}, dialect);
    for (const ContractIssue &issue : contracts.all().issues) {
      ASSERT_LE(issue.span.begin, issue.span.end);
      ASSERT_LE(issue.span.end, contracts.all().source(issue.source).text().size());
    }
    ASSERT_FALSE(contracts.dumped().empty());
  }
}

} // namespace
} // namespace feedhold
