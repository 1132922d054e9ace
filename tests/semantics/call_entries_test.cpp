// Each entry of a called program is asked about: repetitions, modal calls, calls of which little is known.
#include "dialects/registry.h"
#include "language/contract/contract.h"
#include "language/parse/parse.h"
#include "proof/prove/prove.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace feedhold::prove {
namespace {

/// The rows of the first program of a text.
std::vector<Obligation> rowsOf(const std::string &text) {
  const Dialect &dialect = *findDialect(allDialects(), "fanuc-30i");
  const SourceFile source = SourceFile::fromText("t.nc", text);
  const SyntaxTree tree = parse(source, dialect);
  const ProgramModel model = resolve(source, tree, dialect);
  const ProgramSet set({{FileId(0), &source, &tree, &model, &dialect}}, CallGraph({{FileId(0), "", "", &model}}));
  const FileContracts contracts = readContracts(source, tree, model, dialect);
  const Callee main{FileId(0), set.file(FileId(0)).cfg.entryOf(ProgramId(0)), ProgramId(0)};
  return prove(set, main, &contracts, {.guards = InferGuards::No, .contractsOf = {&contracts}}).obligations;
}

/// Absent: there is no row on calls that says so; the worst of several.
std::optional<Verdict> callVerdict(const std::string &text, const std::string &claim) {
  std::optional<Verdict> worst;
  for (const Obligation &row : rowsOf(text))
    if (row.kind == ObligationKind::CallMeetsContract && row.claim.find(claim) != std::string::npos)
      worst = worst && holds(row.verdict) ? worst : std::optional(row.verdict);
  return worst;
}
std::optional<Verdict> contractVerdict(const std::string &text) { return callVerdict(text, "satisfies the contract"); }

const std::string kNoModalCall = "no modal call is active";

// ---- repetitions ----

std::string countsStored(std::string_view call, std::string_view range) {
  return "O1\n#501=2\n" + std::string(call) + "\nM30\nO20\n(@GLOBAL #501 " + std::string(range) +
         ")\n#501=#501+2\nM99\n";
}

TEST(CallEntries, EachRepetitionMeetsTheContract) {
  EXPECT_EQ(contractVerdict(countsStored("G65P20L4", "0..8")), Verdict::Proved);
  EXPECT_EQ(contractVerdict(countsStored("G65P20L5", "0..8")), Verdict::Refuted);
  EXPECT_EQ(contractVerdict(countsStored("M98P20L4", "0..8")), Verdict::Proved);
  EXPECT_EQ(contractVerdict(countsStored("M98P20L5", "0..8")), Verdict::Refuted);
}

TEST(CallEntries, RepetitionsOfUnknownNumber) {
  EXPECT_EQ(contractVerdict(countsStored("G65P20L#7", "0..8")), Verdict::Unknown);
  EXPECT_EQ(contractVerdict(countsStored("M98P20L500", "0..8")), Verdict::Unknown);
  EXPECT_EQ(contractVerdict(countsStored("M98P20L0", "3..8")), std::nullopt); // nothing is called
}

TEST(CallEntries, ASubprogramLeavesItsLocals) {
  const auto text = [](std::string_view repeats) {
    return "O1\n#4=10\nM98P20L" + std::string(repeats) + "\nM30\nO20\n(@PARAM #4 8..10)\n#4=#4-1\nM99\n";
  };
  EXPECT_EQ(contractVerdict(text("3")), Verdict::Proved);
  EXPECT_EQ(contractVerdict(text("4")), Verdict::Refuted);
}

/// Whether the second repetition has the arguments again is not known of all controls.
TEST(CallEntries, AMacroMayFindWhatTheLastRepetitionLeft) {
  const auto text = [](std::string_view rest) {
    return "O1\nG65P20A1.L2\nM30\nO20\n(@PARAM #1 1..2)\n" + std::string(rest) + "\nM99\n";
  };
  EXPECT_EQ(contractVerdict(text("#1=#1+1")), Verdict::Proved);
  EXPECT_NE(contractVerdict(text("#1=#1+2")), Verdict::Proved);
  EXPECT_NE(contractVerdict(text("#1=#0")), Verdict::Proved);
}

TEST(CallEntries, ModesThatARepetitionLeaves) {
  const std::string text = "O1\nG90\nG65P20L2\nM30\nO20\n(@MODAL G90)\nG91\n";
  EXPECT_EQ(contractVerdict(text + "M99\n"), Verdict::Refuted);
  EXPECT_EQ(contractVerdict(text + "G90\nM99\n"), Verdict::Proved);
}

// ---- modal calls ----

TEST(CallEntries, RepetitionsOfAModalCall) {
  const auto text = [](std::string_view call) {
    return "O1\n#502=0\n" + std::string(call) + "\nG0X1.\nG67\nM30\nO30\n(@GLOBAL #502 0..1)\n#502=#502+1\nM99\n";
  };
  EXPECT_EQ(contractVerdict(text("G66P30L2")), Verdict::Proved);
  EXPECT_EQ(contractVerdict(text("G66P30L3")), Verdict::Refuted);
}

std::string movesInSubprogram(std::string_view argument) {
  return "O1\nG66P30B" + std::string(argument) +
         "\nM98P20\nG67\nM30\nO20\nG0X1.\nX2.\nM99\nO30\n(@PARAM #2 0..5)\nM99\n";
}

TEST(CallEntries, AModalCallInACalledProgramIsTheCallers) {
  EXPECT_EQ(contractVerdict(movesInSubprogram("5.")), Verdict::Proved);
  EXPECT_EQ(contractVerdict(movesInSubprogram("6.")), Verdict::Refuted);
}

/// What is proved of O20 by itself holds where its movements call no macro.
TEST(CallEntries, AProgramCalledUnderAModalCall) {
  EXPECT_EQ(callVerdict(movesInSubprogram("5."), kNoModalCall), Verdict::Unknown);
  EXPECT_EQ(callVerdict("O1\nG66P30\nG67\nM98P20\nM30\nO20\nG0X1.\nM99\nO30\nM99\n", kNoModalCall), std::nullopt);
  EXPECT_EQ(callVerdict("O1\nIF[#1GT1]GOTO5\nG66P30\nN5M98P20\nM30\nO20\nG0X1.\nM99\nO30\nM99\n", kNoModalCall),
            Verdict::Unknown);
}

TEST(CallEntries, AModalCallThatACalledProgramLeaves) {
  const std::string text = "O1\nM98P40\nM98P20\nM30\nO20\nG0X1.\nM99\nO30\nM99\nO40\nG66P30\nM99\n";
  EXPECT_EQ(callVerdict(text, kNoModalCall), Verdict::Unknown);
}

TEST(CallEntries, AModalCallInAModalCall) {
  const std::string text = "O1\nG66P30\nG66P31\nG0X1.\nM30\nO30\nM99\nO31\nG0X2.\nM99\n";
  EXPECT_EQ(callVerdict(text, "when O31 is called"), Verdict::Unknown); // its movement calls O30
  EXPECT_EQ(callVerdict(text, "when O30 is called"), std::nullopt);
}

/// The unknown program may move, in whatever mode.
TEST(CallEntries, AModalCallInAProgramThatIsNotThere) {
  const std::string text = "O1\nG90\nG66P30\nM98P7777\nG67\nM30\nO30\n(@MODAL G90)\nM99\n";
  EXPECT_EQ(contractVerdict(text), Verdict::Unknown);
}

TEST(CallEntries, ANumberThatIsComputed) {
  const std::string text = "O1\n(@PARAM #1 20..21 INT)\nG65P#1A1.\nM30\n"
                           "O20\n(@PARAM #1 0..9)\nM99\nO21\n(@PARAM #1 5..9)\nM99\n";
  EXPECT_TRUE(callVerdict(text, "the contract of O20"));
  EXPECT_EQ(callVerdict(text, "the contract of O21"), Verdict::Refuted);
}

// ---- L of a modal call is a part of the state like any other ----

/// The first movement calls O30 once, the later ones three times.
TEST(CallEntries, RepetitionsThatChangeInALoop) {
  const std::string text = "O1\n#4=1\n#11=0\nM98P40\nWHILE[#11LT4]DO1\n#11=#11+1\n#110=0\nG0Y#11\n"
                           "IF[#110GE3]THEN#3000=9(THREE)\nG67\n#4=3\nM98P40\nEND1\nM30\n"
                           "O30\n#110=#110+1\nM99\nO40\nG66P30L#4\nM99\n";
  for (const Obligation &row : rowsOf(text)) {
    const bool isTheAlarm = row.kind == ObligationKind::AlarmUnreachable;
    EXPECT_FALSE(isTheAlarm && holds(row.verdict)) << row.claim;
  }
}

} // namespace
} // namespace feedhold::prove
