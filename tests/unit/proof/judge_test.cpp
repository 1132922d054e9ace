// The judge, on verdicts that are false on purpose.
#include "dialects/registry.h"
#include "language/parse/parse.h"
#include "proof/prove/judge.h"
#include "proof/prove/obligations.h"
#include "proof/prove/proof_context.h"

#include <gtest/gtest.h>

namespace feedhold::prove {
namespace {

constexpr std::string_view kProgram = "O1\nIF[#1LE5]GOTO10\n#3000=7\nN10#2=1/#3\nM99\n";

struct Case {
  const Dialect &dialect = *findDialect(allDialects(), "fanuc-30i");
  SourceFile source = SourceFile::fromText("t.nc", std::string(kProgram));
  SyntaxTree tree = parse(source, dialect);
  ProgramModel model = resolve(source, tree, dialect);
  ProgramSet set{{{FileId(0), &source, &tree, &model, &dialect}}, CallGraph({{FileId(0), "", "", &model}})};
  Callee main{FileId(0), set.file(FileId(0)).cfg.entryOf(ProgramId(0)), ProgramId(0)};

  ProgramProof proof() const { return prove(set, main, nullptr, {.guards = InferGuards::No}); }
  std::vector<Contradiction> judged(std::vector<Obligation> &rows) const {
    const ProveOptions options;
    const ProofSubject subject{set, main, nullptr, options};
    ProofStart start(subject);
    const Exploration found = explore(start.reading(), set, main, start.entry(), start.exploreOptions(subject));
    const WitnessSearch witnesses = sampledRuns(subject, start, {});
    BrokenPromises promises(subject);
    LoopEnds ends;
    const ProofContext context{{subject, start, found}, witnesses, promises, ends, nullptr, options.budget};
    SettledRows settled;
    settleAll(context, stopQuestions(context), settled);
    return judge(context, settled.denials, rows);
  }
};

TEST(Judge, TrueVerdictsStand) {
  const Case given;
  std::vector<Obligation> rows = given.proof().obligations;
  EXPECT_TRUE(given.judged(rows).empty());
}

TEST(Judge, AFalseProofIsWithdrawnAndTold) {
  const Case given;
  std::vector<Obligation> rows = given.proof().obligations;
  std::size_t falsified = 0;
  for (Obligation &row : rows)
    if (row.verdict == Verdict::Refuted && ++falsified != 0)
      row.verdict = falsified % 2 == 0 ? Verdict(verdict::Proved{}) : Verdict(verdict::Unreachable{});
  EXPECT_EQ(falsified, 2U); // the alarm, and the division by zero
  const std::vector<Contradiction> found = given.judged(rows);
  EXPECT_EQ(found.size(), falsified);
  for (const Contradiction &each : found)
    for (const Obligation &row : rows)
      EXPECT_TRUE(row.id != each.id || row.verdict == Verdict::Unknown) << row.claim;
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
