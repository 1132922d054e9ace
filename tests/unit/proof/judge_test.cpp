// The judge, on verdicts that are false on purpose.
#include "proof/families/families.h"
#include "proof/prove/judge.h"
#include "unit/proof/explored.h"

#include <gtest/gtest.h>

namespace feedhold::prove {
namespace {

constexpr std::string_view kProgram = "O1\nIF[#1LE5]GOTO10\n#3000=7\nN10#2=1/#3\nWHILE[#4EQ1]DO1\nEND1\nM99\n";

SettledRows settledRows(Explored &program) {
  SettledRows settled;
  const ProofContext context = program.context();
  settleAll(context, stopQuestions(context), settled);
  settleLoops(context, settled);
  settleEnd(context, settled);
  return settled;
}

TEST(Judge, TrueVerdictsStand) {
  Explored program(kProgram);
  SettledRows settled = settledRows(program);
  EXPECT_EQ(settled.rows.size(), 4U); // the alarm, the division by zero, the loop, the end
  EXPECT_TRUE(judge(program.context(), settled.denials, settled.rows).empty());
}

TEST(Judge, AFalseProofIsWithdrawnAndTold) {
  Explored program(kProgram);
  SettledRows settled = settledRows(program);
  std::size_t falsified = 0;
  for (Obligation &row : settled.rows)
    if (row.verdict == Verdict::Refuted)
      row.verdict = ++falsified % 2 == 0 ? Verdict(verdict::Proved{}) : Verdict(verdict::Unreachable{});
  EXPECT_EQ(falsified, 4U);
  const std::vector<Contradiction> found = judge(program.context(), settled.denials, settled.rows);
  EXPECT_EQ(found.size(), falsified);
  for (const Obligation &row : settled.rows)
    EXPECT_TRUE(row.verdict == Verdict::Unknown) << row.claim;
}

/// What is left when the budget is used up has not been proved.
TEST(Settle, AsksAllGoalsOrGivesUp) {
  Explored program(kProgram);
  smt::TermStore &store = program.start.store();
  const smt::TermId x = store.variable("x", smt::Sort::Real), zero = store.number(smt::Number(0));
  const std::vector<smt::TermId> positive{store.less(zero, x)}, none;
  const smt::TermId cube = store.multiply(x, store.multiply(x, x));
  const Obligation row = program.subject.obligation(ObligationKind::Ensures, "a claim");
  const Question question{.row = row,
                          .goals = {{&positive, store.less(zero, store.add(cube, x))}, {&none, store.no()}},
                          .broken = [](const RunResult &, const GivenVariables &) { return std::nullopt; }};
  for (const std::uint64_t search : {1U, 10U, 100U, 1'000U, 1'000'000U}) {
    ProofContext context = program.context();
    context.budget.search = search;
    EXPECT_FALSE(settle(context, question).verdict.holds()) << search;
  }
}

TEST(Verdict, HasItsOwnDataAlone) {
  Verdict verdict = verdict::Proved{.why = "it falls", .bound = "5"};
  EXPECT_EQ(verdict.bound(), "5");
  verdict = Verdict::unknown("too long");
  EXPECT_EQ(verdict.bound(), "");
  EXPECT_FALSE(verdict.grade());
  EXPECT_EQ(verdict.reason(), "too long");
}

} // namespace
} // namespace feedhold::prove
