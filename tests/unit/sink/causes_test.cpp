// Which findings are told as one, and how a folder is summed up.
#include "surface/sink/causes.h"

#include "surface/sink/sink.h"

#include <gtest/gtest.h>

namespace feedhold {
namespace {

constexpr RuleInfo kUnset{"never-set-variable", Category::Variable, Severity::Warning, "Reports a variable."};
constexpr RuleInfo kLack{"unknown-g-code",     Category::Word, Severity::Warning, "Reports a code.", {},
                         CauseScope::OneFolder};
constexpr RuleInfo kText{"unexpected-text", Category::Syntax, Severity::Error, "Reports text."};

Finding finding(const RuleInfo &rule, const SourceFile &source, std::uint32_t line, std::string message) {
  Finding result{&rule, rule.severity, {}, {}};
  result.diagnostic.message = std::move(message);
  result.diagnostic.span = source.lineSpan(line);
  return result;
}

CheckedFile file(std::string path, std::string text) {
  return {path,
          SourceFile::fromText(path, std::move(text)),
          "fanuc-30i",
          DialectChoice::Guess,
          {},
          Severity::Warning,
          Severity::Warning,
          {}};
}

class Causes : public testing::Test {
protected:
  void add(std::size_t of, const RuleInfo &rule, std::uint32_t line, std::string message) {
    CheckedFile &file = result_.files[of];
    file.findings.push_back(finding(rule, file.source, line, std::move(message)));
  }
  std::vector<Cause> causes() const { return causesOf(report()); }
  Report report() const { return {.result = result_, .rules = rules_}; }

  CheckResult result_;
  RuleRegistry rules_{{}};
};

TEST_F(Causes, OneMessageInOneFile) {
  result_.files = {file("a.nc", "#1=#500\n#2=#501\n#3=#500\n")};
  add(0, kUnset, 1, "`#500` is never set");
  add(0, kUnset, 2, "`#501` is never set");
  add(0, kUnset, 3, "`#500` is never set");
  ASSERT_EQ(causes().size(), 2U);
  EXPECT_EQ(otherPlaces(causes()[0]), "the same in 1 more place: line 3");
  EXPECT_EQ(otherPlaces(causes()[1]), "");
}

TEST_F(Causes, OneThingThatAFolderLacks) {
  result_.files = {file("d/a.nc", "G229 X1.\n"), file("d/b.nc", "G21\nG229 X2.\n"), file("e/c.nc", "G229 X3.\n")};
  add(0, kLack, 1, "fanuc-30i does not have `G229`");
  add(1, kLack, 2, "fanuc-30i does not have `G229`");
  add(2, kLack, 1, "fanuc-30i does not have `G229`");
  ASSERT_EQ(causes().size(), 2U) << "another folder is another machine";
  EXPECT_EQ(otherPlaces(causes()[0]), "the same in 1 more place: d/b.nc:2");
}

TEST_F(Causes, OneLineInManyFiles) {
  result_.files = {file("a.nc", "#1=#500\n"), file("b.nc", "G21\n #1=#500\n"), file("c.nc", "#2=#500\n")};
  add(0, kUnset, 1, "`#500` is never set");
  add(1, kUnset, 2, "`#500` is never set");
  add(2, kUnset, 1, "`#500` is never set");
  ASSERT_EQ(causes().size(), 2U) << "another line is another cause";
  EXPECT_EQ(otherPlaces(causes()[0]), "the same in 1 more place: b.nc:2");
}

TEST_F(Causes, RowsOfATable) {
  result_.files = {file("a.nc", "1)A\n2)B\n\n3)C\n4)D\nG0X0\nG0Y0\nG0Z0\n5)E\n")};
  for (const auto &[line, text] : {std::pair{1, "`1)A`"}, {2, "`2)B`"}, {4, "`3)C`"}, {5, "`4)D`"}, {9, "`5)E`"}})
    add(0, kText, static_cast<std::uint32_t>(line), std::string("unexpected text ") + text);
  ASSERT_EQ(causes().size(), 2U) << "the last one is not a neighbour";
  EXPECT_EQ(otherPlaces(causes()[0]), "the same in 3 more places: lines 2, 4, 5");
}

TEST_F(Causes, ThreeNeighboursAreNoTable) {
  result_.files = {file("a.nc", "1)A\n2)B\n3)C\n")};
  for (std::uint32_t line = 1; line <= 3; ++line)
    add(0, kText, line, "unexpected text `" + std::to_string(line) + "`");
  EXPECT_EQ(causes().size(), 3U);
}

TEST_F(Causes, FilesInOneForeignLanguage) {
  result_.files = {file("a.mpf", "X1\n"), file("b.mpf", "Y1\n")};
  for (std::size_t i = 0; i < 2; ++i) {
    result_.files[i].foreign = "Sinumerik";
    add(i, kText, 1, "this is Sinumerik");
  }
  EXPECT_EQ(writeText(report()), "error: a.mpf: this is Sinumerik [unexpected-text]\n"
                                 "   = note: the same in 1 more place: b.mpf:1\n\n");
}

TEST_F(Causes, WorstProgramsComeFirst) {
  result_.files = {file("a.nc", "O1\n#1=#500\n"), file("b.nc", "O2\nG0\nO3\n?\n?\n")};
  result_.files[1].programs = {{"O2", result_.files[1].source.lineSpan(1)},
                               {"O3", result_.files[1].source.lineSpan(3)}};
  add(0, kUnset, 2, "`#500` is never set");
  add(1, kText, 4, "unexpected text");
  EXPECT_EQ(summary(report()).substr(0, 64), "worst first:\n  1 error    O3 in b.nc\n  1 warning  a.nc\n\n1 error,")
      << summary(report());
}

TEST_F(Causes, SubroutinesOfOWordsAreOneProgram) {
  result_.files = {file("a.nc", "O1\n#1=#500\n"), file("b.ngc", "o<x> sub\n?\no<x> endsub\n?\n")};
  result_.files[1].programs = {{"o<x>", result_.files[1].source.lineSpan(1)},
                               {"", result_.files[1].source.lineSpan(3)}};
  add(0, kUnset, 2, "`#500` is never set");
  add(1, kText, 2, "unexpected text");
  add(1, kText, 4, "other text");
  EXPECT_EQ(summary(report()).substr(0, 54), "worst first:\n  2 errors   b.ngc\n  1 warning  a.nc\n\n2 e")
      << summary(report());
}

} // namespace
} // namespace feedhold
