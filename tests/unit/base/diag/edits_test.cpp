// Fix-its applied to a text, conflicts between them, and the unified diff of the result.
#include "base/diag/edits.h"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <algorithm>
#include <charconv>
#include <string>
#include <vector>

namespace feedhold {
namespace {

FixIt fix(std::vector<Edit> edits) { return {FixSafety::Safe, "t", std::move(edits)}; }

TEST(ApplyFixes, ReplacesInsertsAndDeletes) {
  const std::vector<FixIt> fixes = {fix({{{4, 5}, "="}}), fix({{{0, 0}, "N1 "}}), fix({{{8, 9}, ""}})};
  const AppliedEdits result = applyFixes("#510-[0];;", fixes);
  EXPECT_EQ(result.text, "N1 #510=[0];");
  EXPECT_EQ(result.applied, 3U);
  EXPECT_EQ(result.conflicts, 0U);
}

TEST(ApplyFixes, LeavesOutAWholeFixThatOverlaps) {
  const std::vector<FixIt> fixes = {fix({{{2, 4}, "XX"}}), fix({{{0, 1}, "Y"}, {{3, 5}, "Y"}}), fix({{{0, 1}, "Z"}})};
  const AppliedEdits result = applyFixes("abcdef", fixes);
  EXPECT_EQ(result.text, "ZbXXef");
  EXPECT_EQ(result.applied, 2U);
  EXPECT_EQ(result.conflicts, 1U);
}

TEST(ApplyFixes, TouchingEditsDoNotOverlap) {
  const std::vector<FixIt> fixes = {fix({{{2, 4}, "XX"}}), fix({{{0, 2}, "YY"}}), fix({{{4, 4}, "<"}}),
                                    fix({{{2, 2}, ">"}})};
  const AppliedEdits result = applyFixes("abcdef", fixes);
  EXPECT_EQ(result.text, "YY>XX<ef");
  EXPECT_EQ(result.applied, 4U);
}

TEST(ApplyFixes, InsertionsAtOnePlace) {
  const std::vector<FixIt> two = {fix({{{1, 1}, "]"}}), fix({{{1, 1}, "]"}})};
  EXPECT_EQ(applyFixes("ab", two).text, "a]b");
  EXPECT_EQ(applyFixes("ab", two).conflicts, 1U);
  const std::vector<FixIt> one = {fix({{{1, 1}, "("}, {{1, 1}, ")"}})};
  EXPECT_EQ(applyFixes("ab", one).text, "a()b") << "one fix-it keeps its order";
  const std::vector<FixIt> inside = {fix({{{0, 2}, "X"}}), fix({{{1, 1}, "!"}})};
  EXPECT_EQ(applyFixes("ab", inside).conflicts, 1U);
}

TEST(ApplyFixes, AFixWithoutEditsIsNotApplied) {
  const std::vector<FixIt> fixes = {fix({})};
  EXPECT_EQ(applyFixes("ab", fixes).applied, 0U);
  EXPECT_EQ(applyFixes("ab", fixes).conflicts, 0U);
}

TEST(ApplyFixes, RefusesAWronglyBuiltFix) {
  const std::vector<FixIt> outside = {fix({{{1, 3}, "x"}})};
  EXPECT_DEATH(applyFixes("ab", outside), "outside of the text");
  const std::vector<FixIt> crossing = {fix({{{0, 2}, "x"}, {{1, 2}, "y"}})};
  EXPECT_DEATH(applyFixes("ab", crossing), "own edits overlap");
}

/// Byte by byte: which fix owns each byte, and what is put before it.
AppliedEdits naiveApply(const std::string &text, const std::vector<FixIt> &fixes) {
  std::vector<Edit> accepted;
  AppliedEdits result;
  for (const FixIt &f : fixes) {
    const Edit &edit = f.edits.front();
    const bool clash = std::ranges::any_of(accepted, [&](const Edit &other) {
      if (edit.span.empty() && other.span.empty())
        return edit.span.begin == other.span.begin;
      return std::max(edit.span.begin, other.span.begin) < std::min(edit.span.end, other.span.end) ||
             (edit.span.empty() && other.span.begin < edit.span.begin && edit.span.begin < other.span.end) ||
             (other.span.empty() && edit.span.begin < other.span.begin && other.span.begin < edit.span.end);
    });
    if (!clash)
      accepted.push_back(edit);
    clash ? ++result.conflicts : ++result.applied;
  }
  for (std::uint32_t at = 0; at <= text.size(); ++at) {
    for (const Edit &edit : accepted)
      if (edit.span.begin == at && edit.span.empty())
        result.text += edit.replacement;
    for (const Edit &edit : accepted)
      if (edit.span.begin == at && !edit.span.empty())
        result.text += edit.replacement;
    const bool replaced =
        std::ranges::any_of(accepted, [&](const Edit &edit) { return edit.span.begin <= at && at < edit.span.end; });
    if (at < text.size() && !replaced)
      result.text += text[at];
  }
  return result;
}

TEST(ApplyFixes, AgreesWithTheDefinition) {
  EXPECT_TRUE(rc::check("applyFixes is the byte-by-byte definition", [] {
    const auto text = *rc::gen::container<std::string>(rc::gen::elementOf(std::string("abcdefg\n")));
    const auto size = static_cast<std::uint32_t>(text.size());
    std::vector<FixIt> fixes;
    for (std::size_t i = 0, count = *rc::gen::inRange<std::size_t>(0, 12); i < count; ++i) {
      const auto begin = *rc::gen::inRange<std::uint32_t>(0, size + 1);
      const auto end = std::min(size, begin + *rc::gen::inRange<std::uint32_t>(0, 4));
      fixes.push_back(fix({{{begin, end}, *rc::gen::element<std::string>("", "X", "YZ\n")}}));
    }
    const AppliedEdits expected = naiveApply(text, fixes);
    const AppliedEdits result = applyFixes(text, fixes);
    RC_ASSERT(result.text == expected.text);
    RC_ASSERT(result.applied == expected.applied);
    RC_ASSERT(result.conflicts == expected.conflicts);
  }));
}

TEST(UnifiedDiff, OfEqualTextsIsEmpty) {
  EXPECT_EQ(unifiedDiff("a.nc", "G1\n", "G1\n"), "");
  EXPECT_EQ(unifiedDiff("a.nc", "", ""), "");
}

TEST(UnifiedDiff, ShowsThreeLinesOfContext) {
  EXPECT_EQ(unifiedDiff("dir/a.nc", "1\n2\n3\n4\n5\n6\n7\n8\n9\n", "1\n2\n3\n4\nX\n6\n7\n8\n9\n"),
            R"(--- a/dir/a.nc
+++ b/dir/a.nc
@@ -2,7 +2,7 @@
 2
 3
 4
-5
+X
 6
 7
 8
)");
}

TEST(UnifiedDiff, JoinsNearChangesAndPartsFarOnes) {
  const std::string before = "a\n1\n2\n3\n4\n5\n6\nb\n1\n2\n3\n4\n5\n6\n7\nc\n";
  const std::string after = "A\n1\n2\n3\n4\n5\n6\nB\n1\n2\n3\n4\n5\n6\n7\n";
  EXPECT_EQ(unifiedDiff("a.nc", before, after), R"(--- a/a.nc
+++ b/a.nc
@@ -1,11 +1,11 @@
-a
+A
 1
 2
 3
 4
 5
 6
-b
+B
 1
 2
 3
@@ -13,4 +13,3 @@
 5
 6
 7
-c
)");
}

TEST(UnifiedDiff, MarksAMissingLastLineFeed) {
  EXPECT_EQ(unifiedDiff("a.nc", "M30\n%", "M30\n%\n"), R"(--- a/a.nc
+++ b/a.nc
@@ -1,2 +1,2 @@
 M30
-%
\ No newline at end of file
+%
)");
}

TEST(UnifiedDiff, FromAndToNothing) {
  EXPECT_EQ(unifiedDiff("a.nc", "", "M30\n"), "--- a/a.nc\n+++ b/a.nc\n@@ -0,0 +1 @@\n+M30\n");
  EXPECT_EQ(unifiedDiff("a.nc", "M30\n", ""), "--- a/a.nc\n+++ b/a.nc\n@@ -1 +0,0 @@\n-M30\n");
}

TEST(UnifiedDiff, KeepsReturns) {
  EXPECT_EQ(unifiedDiff("a.nc", "G1\r\n", "G2\r\n"), "--- a/a.nc\n+++ b/a.nc\n@@ -1 +1 @@\n-G1\r\n+G2\r\n");
}

TEST(UnifiedDiff, NamesAbsolutePathsAndPathsWithSpaces) {
  EXPECT_EQ(unifiedDiff("/p/a b.nc", "1\n", "2\n"), "--- a/p/a b.nc\t\n+++ b/p/a b.nc\t\n@@ -1 +1 @@\n-1\n+2\n");
}

struct Reader {
  std::string_view rest;

  std::string_view line() {
    const std::size_t length = std::min(rest.find('\n'), rest.size() - 1) + 1;
    const std::string_view result = rest.substr(0, length);
    rest.remove_prefix(length);
    return result;
  }
  bool done() const { return rest.empty(); }
};

struct Range {
  std::size_t start;
  std::size_t count = 1;
};

Range rangeIn(std::string_view header, char mark) {
  const char *end = header.data() + header.size();
  Range range{};
  const auto start = std::from_chars(header.data() + header.find(mark) + 1, end, range.start);
  range.count = 1;
  if (*start.ptr == ',')
    std::from_chars(start.ptr + 1, end, range.count);
  return range;
}

/// Applies a diff as strictly as `patch --fuzz=0` does; fails the test where the old text is not as the diff says.
std::string patched(const std::string &before, const std::string &diff) {
  Reader old{before};
  Reader lines{diff};
  std::string result;
  lines.line();
  lines.line();
  std::size_t oldLine = 1;
  std::size_t newLine = 1;
  const auto keep = [&] {
    result += old.line();
    ++oldLine;
    ++newLine;
  };
  while (!lines.done()) {
    const std::string_view header = lines.line();
    const Range from = rangeIn(header, '-');
    const Range to = rangeIn(header, '+');
    while (oldLine < from.start + (from.count == 0 ? 1 : 0))
      keep();
    EXPECT_EQ(newLine, to.start + (to.count == 0 ? 1 : 0)) << header;
    const std::size_t oldStop = oldLine + from.count;
    const std::size_t newStop = newLine + to.count;
    while (!lines.done() && !lines.rest.starts_with("@@")) {
      const char mark = lines.rest.front();
      std::string text(lines.line().substr(1));
      if (lines.rest.starts_with("\\ ")) {
        text.pop_back();
        lines.line();
      }
      if (mark != '+') {
        EXPECT_EQ(old.line(), text);
        ++oldLine;
      }
      if (mark != '-') {
        result += text;
        ++newLine;
      }
    }
    EXPECT_EQ(oldLine, oldStop);
    EXPECT_EQ(newLine, newStop);
  }
  return result + std::string(old.rest);
}

TEST(UnifiedDiff, LeadsFromOneTextToTheOther) {
  EXPECT_TRUE(rc::check("the hunks rebuild the new text", [] {
    const auto line =
        rc::gen::element<std::string>("\n", "G1\n", "G0\n", "M30\n", "X1\r\n", "N1\n", "N2\n", "N3\n", "N4\n");
    auto lines = *rc::gen::container<std::vector<std::string>>(line);
    std::string before;
    for (const std::string &text : lines)
      before += text;
    for (std::size_t i = 0, count = *rc::gen::inRange<std::size_t>(0, 6); i < count; ++i) {
      const auto at = *rc::gen::inRange<std::size_t>(0, lines.size() + 1);
      if (at < lines.size() && *rc::gen::arbitrary<bool>())
        lines.erase(lines.begin() + static_cast<std::ptrdiff_t>(at));
      else
        lines.insert(lines.begin() + static_cast<std::ptrdiff_t>(at), *line);
    }
    std::string after;
    for (const std::string &text : lines)
      after += text;
    if (*rc::gen::arbitrary<bool>())
      before += "%";
    if (*rc::gen::arbitrary<bool>())
      after += "%";
    const std::string diff = unifiedDiff("a.nc", before, after);
    RC_ASSERT(diff.empty() == (before == after));
    RC_ASSERT(patched(before, diff.empty() ? "\n\n" : diff) == after);
    RC_ASSERT(!testing::Test::HasFailure());
  }));
}

std::string repeated(const std::vector<std::string> &lines, std::size_t count) {
  std::string text;
  for (std::size_t i = 0; i < count; ++i)
    text += lines[i * i % lines.size()] + "\n";
  return text;
}

TEST(UnifiedDiff, WildlyDifferentTextsAreStillRight) {
  const std::string before = repeated({"a", "b", "c", "d", "e", "f", "g"}, 4000);
  const std::string after = repeated({"h", "b", "i", "c", "j"}, 5000);
  EXPECT_EQ(patched(before, unifiedDiff("a.nc", before, after)), after);
}

TEST(UnifiedDiff, IsShortForManyDistantChanges) {
  std::string before;
  std::string after;
  for (int i = 0; i < 30000; ++i) {
    const std::string line = "N" + std::to_string(i) + " G1 X" + std::to_string(i % 7) + "\n";
    before += line;
    after += i % 100 == 50 ? "(CHANGED)\n" : line;
  }
  const std::string diff = unifiedDiff("a.nc", before, after);
  EXPECT_EQ(std::ranges::count(diff, '\n'), 2 + 300 * 9);
  EXPECT_EQ(patched(before, diff), after);
}

} // namespace
} // namespace feedhold
