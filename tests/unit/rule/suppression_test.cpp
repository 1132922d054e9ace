// Suppression comments: what they cover, how they are written, and what is said about those that are wrong.
#include "dialects/registry.h"
#include "findings/rule/run_rules.h"
#include "findings/rule/suppression.h"
#include "language/parse/parse.h"
#include "rules/registry.h"

#include <gtest/gtest.h>
#include <map>

namespace feedhold {
namespace {

/// A program on its own, with all rules or some of them.
class Checked {
public:
  explicit Checked(std::string text, std::vector<std::string_view> only = {})
      : source_(SourceFile::fromText("part.nc", std::move(text))), tree_(parse(source_, dialect())),
        model_(resolve(source_, tree_, dialect())), graph_({ModelledFile{FileId(0), "", "part", &model_}}) {
    for (const RegisteredRule &entry : allRules().rules)
      if (only.empty() || std::find(only.begin(), only.end(), entry.rule->info.name) != only.end())
        rules_.push_back(entry.rule);
  }

  SuppressionResult result() const {
    return applySuppressions(runRules(rules_, context()), context(), allRules(), rules_);
  }
  std::vector<Suppression> suppressions() const { return findSuppressions(context()); }

private:
  static const Dialect &dialect() { return *findDialect(allDialects(), "fanuc-30i"); }
  FileContext context() const { return {FileId(0), source_, dialect(), tree_, model_, graph_}; }

  SourceFile source_;
  SyntaxTree tree_;
  ProgramModel model_;
  CallGraph graph_;
  std::vector<const Rule *> rules_;
};

std::map<std::string, int> counts(const std::vector<RawFinding> &findings) {
  std::map<std::string, int> result;
  for (const RawFinding &finding : findings)
    ++result[std::string(finding.rule->name)];
  return result;
}

std::map<std::string, int> counts(const std::vector<SuppressedFinding> &findings) {
  std::vector<RawFinding> raw;
  for (const SuppressedFinding &suppressed : findings)
    raw.push_back(suppressed.finding);
  return counts(raw);
}

using Counts = std::map<std::string, int>;

TEST(Suppression, OnTheBlockItself) {
  const SuppressionResult result = Checked("O1\n#510-#6(@ALLOW missing-equals WANTED)\n#511-#6\nM30\n").result();
  EXPECT_EQ(counts(result.suppressed), (Counts{{"missing-equals", 1}}));
  EXPECT_EQ(counts(result.kept), (Counts{{"missing-equals", 1}}));
}

TEST(Suppression, OnALineOfItsOwnItCoversTheNextBlockThatDoesSomething) {
  const std::string program = "O1\n(@ALLOW missing-equals WANTED)\n(ANOTHER)\n\n#510-#6\n#511-#6\nM30\n";
  EXPECT_EQ(counts(Checked(program).result().kept), (Counts{{"missing-equals", 1}}));
}

TEST(Suppression, ForTheWholeProgramAndNoOther) {
  const std::string program = "O1\n#510-#6\n(@ALLOW-PROGRAM missing-equals WANTED)\n#511-#6\nM30\nO2\n#512-#6\nM30\n";
  const SuppressionResult result = Checked(program, {"missing-equals"}).result();
  EXPECT_EQ(result.suppressed.size(), 2U);
  EXPECT_EQ(result.kept.size(), 1U);
}

TEST(Suppression, UpperCaseAndSeveralRules) {
  const std::vector<Suppression> found =
      Checked("O1\n( @allow MISSING-EQUALS , Missing-Label OLD CODE )\nM30\n").suppressions();
  ASSERT_EQ(found.size(), 2U);
  EXPECT_EQ(found[0].rule, "missing-equals");
  EXPECT_EQ(found[1].rule, "missing-label");
  EXPECT_EQ(found[1].reason, "OLD CODE");
}

TEST(Suppression, OtherCommentsAreNone) {
  EXPECT_TRUE(Checked("O1\n(@ALLOWED missing-equals)\n(ALLOW missing-equals)\nM30\n").suppressions().empty());
}

TEST(Suppression, UnusedHasASafeFixThatTakesItOut) {
  const SuppressionResult result =
      Checked("O1\n#510=#6(@ALLOW missing-equals WANTED)\nM30\n", {"missing-equals", "unused-suppression"}).result();
  ASSERT_EQ(counts(result.kept), (Counts{{"unused-suppression", 1}}));
  ASSERT_EQ(result.kept[0].diagnostic.fixes.size(), 1U);
  EXPECT_EQ(result.kept[0].diagnostic.fixes[0].safety, FixSafety::Safe);
}

TEST(Suppression, OfARuleThatDidNotRunIsNotCalledUnused) {
  EXPECT_TRUE(
      Checked("O1\n#510=#6(@ALLOW missing-equals WANTED)\nM30\n", {"unused-suppression"}).result().kept.empty());
}

TEST(Suppression, WithoutReasonAndWithAnUnknownRule) {
  EXPECT_EQ(counts(Checked("O1\n#510-#6(@ALLOW missing-equals)\nM30\n").result().kept),
            (Counts{{"suppression-without-reason", 1}}));
  const SuppressionResult unknown = Checked("O1\n(@ALLOW mising-equals WANTED)\nM30\n").result();
  ASSERT_EQ(counts(unknown.kept), (Counts{{"unknown-suppressed-rule", 1}}));
  EXPECT_EQ(unknown.kept[0].diagnostic.notes[0], "did you mean `missing-equals`?");
}

} // namespace
} // namespace feedhold
