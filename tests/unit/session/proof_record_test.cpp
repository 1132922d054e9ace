// Records of proofs: a run that contradicts a verdict is kept with it.
#include "findings/session/proof_record.h"

#include "dialects/registry.h"
#include "language/parse/parse.h"

#include <gtest/gtest.h>

namespace feedhold {
namespace {

TEST(ProofRecord, KeepsRunsThatContradictIt) {
  const Dialect &dialect = *findDialect(allDialects(), "fanuc-30i");
  const SourceFile source = SourceFile::fromText("t.nc", "O1\n#2=5/#1\nM30\n");
  const SyntaxTree tree = parse(source, dialect);
  const ProgramModel model = resolve(source, tree, dialect);
  const ProgramSet programs({{FileId(0), &source, &tree, &model, &dialect}}, CallGraph({{FileId(0), "", "", &model}}));

  prove::ProgramProof proof;
  proof.incomplete = "too many paths";
  prove::Witness run{.variables = {}, .end = RunEnd::Unmodelled, .happened = "divides by 0"};
  run.variables.set(1, {false, 0});
  proof.contradictions.push_back({"divide@1", "proved", run});
  proof.contradictions.push_back({"divide@2", "unreachable", run});
  const ProofSteps steps = {{"a claim", "a certificate"}};

  const std::string record = writeProofRecord(proof, &steps);
  const std::optional<RecordedProof> read = readProofRecord(record, programs);
  ASSERT_TRUE(read);
  EXPECT_EQ(read->steps, steps);
  EXPECT_EQ(read->proof.incomplete, proof.incomplete);
  ASSERT_EQ(read->proof.contradictions.size(), 2u);
  const prove::Contradiction &first = read->proof.contradictions.front();
  EXPECT_EQ(first.id, "divide@1");
  EXPECT_EQ(first.verdict, "proved");
  EXPECT_EQ(first.run.happened, "divides by 0");
  EXPECT_EQ(first.run.end, RunEnd::Unmodelled);
  EXPECT_EQ(first.run.variables.entries().size(), 1u);
  EXPECT_EQ(writeProofRecord(read->proof, &read->steps), record);
  for (std::size_t size = 0; size < record.size(); ++size)
    EXPECT_FALSE(readProofRecord(record.substr(0, size), programs)) << size;
}

} // namespace
} // namespace feedhold
