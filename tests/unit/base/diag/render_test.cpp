// The picture of a diagnostic, compared whole.
#include "base/diag/render.h"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <algorithm>
#include <string>
#include <utility>

namespace feedhold {
namespace {

const SourceFile &noOtherFile(FileId) {
  static const SourceFile empty = SourceFile::fromText("none.nc", "");
  ADD_FAILURE() << "no label is in another file";
  return empty;
}

std::string picture(const std::string &text, const Diagnostic &diagnostic, const RenderOptions &options = {}) {
  return "\n" + render(diagnostic, {"error", "some-rule"}, SourceFile::fromText("a.nc", text), noOtherFile, options);
}

std::string lines(std::uint32_t count) {
  std::string text;
  for (std::uint32_t i = 0; i < count; ++i)
    text += "\n";
  return text;
}

TEST(Render, HeadPlaceCaretNoteAndFix) {
  Diagnostic diagnostic = {"`#510-[0-#6]` is a statement without `=`", {40, 41}};
  diagnostic.label = "expected `=` here";
  diagnostic.notes = {"stops with PS0133", "two\nlines"};
  diagnostic.fixes = {{FixSafety::NeedsReview, "write `=` instead of `-`", {}}, {FixSafety::Safe, "remove it", {}}};
  EXPECT_EQ(picture(lines(36) + "#510-[0-#6](Z-OFFSET)\n", diagnostic), R"(
error: `#510-[0-#6]` is a statement without `=` [some-rule]
  --> a.nc:37:5
   |
37 | #510-[0-#6](Z-OFFSET)
   |     ^ expected `=` here
   |
   = note: stops with PS0133
   = note: two
           lines
   = fix (needs review): write `=` instead of `-`
   = fix (safe): remove it
)");
}

TEST(Render, SecondLabelsOnTheirOwnLines) {
  Diagnostic diagnostic = {"m", {9, 11}};
  diagnostic.label = "here";
  diagnostic.labels = {{{0, 0}, "first"}, {{12, 14}, "next"}};
  EXPECT_EQ(picture(lines(9) + "G1\nX2\n", diagnostic), R"(
error: m [some-rule]
  --> a.nc:10:1
   |
 1 |
   | - first
...
10 | G1
   | ^^ here
11 | X2
   | -- next
)");
}

TEST(Render, SeveralLabelsOnOneLine) {
  Diagnostic diagnostic = {"m", {4, 7}};
  diagnostic.label = "second";
  diagnostic.labels = {{{0, 3}, "first"}, {{8, 11}, "third"}};
  EXPECT_EQ(picture("abc def ghi", diagnostic), R"(
error: m [some-rule]
 --> a.nc:1:5
  |
1 | abc def ghi
  | --- ^^^ --- third
  | |   |
  | |   second
  | first
)");
}

TEST(Render, OverlappingLabels) {
  Diagnostic diagnostic = {"m", {4, 7}};
  diagnostic.label = "inner";
  diagnostic.labels = {{{0, 11}, "outer"}};
  EXPECT_EQ(picture("abc def ghi", diagnostic), R"(
error: m [some-rule]
 --> a.nc:1:5
  |
1 | abc def ghi
  | ----^^^----
  | |   |
  | |   inner
  | outer
)");
}

TEST(Render, TwoLabelsFromTheSamePlace) {
  Diagnostic diagnostic = {"m", {4, 7}};
  diagnostic.label = "one";
  diagnostic.labels = {{{4, 7}, "two"}};
  EXPECT_EQ(picture("abc def", diagnostic), R"(
error: m [some-rule]
 --> a.nc:1:5
  |
1 | abc def
  |     ^^^ two
  |     |
  |     one
)");
}

TEST(Render, LabelsWithoutTextTakeNoRow) {
  Diagnostic diagnostic = {"m", {8, 11}};
  diagnostic.labels = {{{0, 3}, ""}, {{4, 5}, "this"}};
  EXPECT_EQ(picture("abc def ghi", diagnostic), R"(
error: m [some-rule]
 --> a.nc:1:9
  |
1 | abc def ghi
  | --- -   ^^^
  |     |
  |     this
)");
}

TEST(Render, LabelsInAnotherFile) {
  const SourceFile main = SourceFile::fromText("a.nc", "M98 P2\n");
  const SourceFile other = SourceFile::fromText("sub/b.nc", "O2\n\n\nM30\n");
  const SourceFile same = SourceFile::fromText("a.nc", "M98 P2\n");
  const auto fileOf = [&](FileId id) -> const SourceFile & { return id == FileId(1) ? other : same; };
  Diagnostic diagnostic = {"m", {4, 6}};
  diagnostic.label = "called here";
  diagnostic.labels = {
      {{5, 8}, "ends here", FileId(1)}, {{0, 3}, "the call", FileId(0)}, {{0, 2}, "begins", FileId(1)}};
  EXPECT_EQ("\n" + render(diagnostic, {"warning", "r"}, main, fileOf, {}), R"(
warning: m [r]
 --> a.nc:1:5
  |
1 | M98 P2
  | --- ^^ called here
  | |
  | the call
  |
 ::: sub/b.nc:4:1
  |
1 | O2
  | -- begins
...
4 | M30
  | --- ends here
)");
}

TEST(Render, SpanOverSeveralLines) {
  EXPECT_EQ(picture("IF[#1EQ1\r\nGOTO1\n", {"m", {2, 14}, "open"}), R"(
error: m [some-rule]
 --> a.nc:1:3
  |
1 | IF[#1EQ1
  |   ^^^^^^ open
)");
}

TEST(Render, EmptySpanAndEndOfFile) {
  EXPECT_EQ(picture("G1\n", {"m", {1, 1}}), R"(
error: m [some-rule]
 --> a.nc:1:2
  |
1 | G1
  |  ^
)");
  EXPECT_EQ(picture("G1", {"m", {2, 2}, "end"}), R"(
error: m [some-rule]
 --> a.nc:1:3
  |
1 | G1
  |   ^ end
)");
  EXPECT_EQ(picture("G1\n", {"m", {3, 3}, "end"}), R"(
error: m [some-rule]
 --> a.nc:2:1
  |
2 |
  | ^ end
)");
  EXPECT_EQ(picture("", {"m", {0, 0}}), R"(
error: m [some-rule]
 --> a.nc:1:1
  |
1 |
  | ^
)");
  EXPECT_EQ(picture("G1\r\n", {"m", {2, 4}, "line end"}), R"(
error: m [some-rule]
 --> a.nc:1:3
  |
1 | G1
  |   ^ line end
)");
}

TEST(Render, TabsReachTheNextStop) {
  EXPECT_EQ(picture("a\tG1\tX2", {"m", {5, 7}}), R"(
error: m [some-rule]
 --> a.nc:1:6
  |
1 | a   G1  X2
  |         ^^
)");
  EXPECT_EQ(picture("\tG1", {"m", {0, 1}}, {.tabWidth = 8}), R"(
error: m [some-rule]
 --> a.nc:1:1
  |
1 |         G1
  | ^^^^^^^^
)");
}

TEST(Render, WideAndCombiningCharacters) {
  EXPECT_EQ(picture("(工具)X1", {"m", {8, 10}}), R"(
error: m [some-rule]
 --> a.nc:1:5
  |
1 | (工具)X1
  |       ^^
)");
  EXPECT_EQ(picture("(工具)X1", {"m", {1, 7}}), R"(
error: m [some-rule]
 --> a.nc:1:2
  |
1 | (工具)X1
  |  ^^^^
)");
  EXPECT_EQ(picture("(e\u0301)X1", {"m", {5, 7}}), "\n"
                                                   "error: m [some-rule]\n"
                                                   " --> a.nc:1:5\n"
                                                   "  |\n"
                                                   "1 | (e\u0301)X1\n"
                                                   "  |    ^^\n");
}

TEST(Render, OtherEncodings) {
  EXPECT_EQ(picture("(\x8d\x48\x8b\xef\x8c\xf0\x8a\xb7)X1", {"m", {10, 12}}), R"(
error: m [some-rule]
 --> a.nc:1:7
  |
1 | (工具交換)X1
  |           ^^
)");
  EXPECT_EQ(picture("(Fr\xe4sen)X1", {"m", {8, 10}}), R"(
error: m [some-rule]
 --> a.nc:1:9
  |
1 | (Fräsen)X1
  |         ^^
)");
}

TEST(Render, ControlBytesAreVisible) {
  EXPECT_EQ(picture(std::string("G1\x1b[0m\0X\x7f", 9), {"`\x1b`", {7, 8}, "\x07"}), R"(
error: `␛` [some-rule]
 --> a.nc:1:8
  |
1 | G1␛[0m␀X␡
  |        ^ ␇
)");
  EXPECT_EQ(picture("(\u202E)X", {"m", {4, 5}}), R"(
error: m [some-rule]
 --> a.nc:1:3
  |
1 | (�)X
  |   ^
)");
}

TEST(Render, ByteOrderMarkIsNotShown) {
  EXPECT_EQ(picture("\xef\xbb\xbfO1", {"m", {4, 5}}), R"(
error: m [some-rule]
 --> a.nc:1:2
  |
1 | O1
  |  ^
)");
}

TEST(Render, LongLinesAreCut) {
  const std::string text = std::string(100, 'a') + "XYZ" + std::string(100, 'b');
  const RenderOptions narrow = {.maxLineWidth = 23};
  EXPECT_EQ(picture(text, {"m", {100, 103}, "here"}, narrow), R"(
error: m [some-rule]
 --> a.nc:1:101
  |
1 | …aaaaaaaaaXYZbbbbbbbbb…
  |           ^^^ here
)");
  EXPECT_EQ(picture(text, {"m", {0, 2}}, narrow), R"(
error: m [some-rule]
 --> a.nc:1:1
  |
1 | aaaaaaaaaaaaaaaaaaaaaa…
  | ^^
)");
  EXPECT_EQ(picture(text, {"m", {203, 203}}, narrow), R"(
error: m [some-rule]
 --> a.nc:1:204
  |
1 | …bbbbbbbbbbbbbbbbbbbbbb
  |                        ^
)");
}

TEST(Render, LabelsTooFarApartForOneWindow) {
  const std::string text = "X" + std::string(200, 'a') + "Y";
  Diagnostic diagnostic = {"m", {201, 202}, "here"};
  diagnostic.labels = {{{0, 1}, "far"}};
  EXPECT_EQ(picture(text, diagnostic, {.maxLineWidth = 20}), R"(
error: m [some-rule]
 --> a.nc:1:202
  |
1 | …aaaaaaaaaaaaaaaaaaY
  | -                  ^ here
  | |
  | far
)");
}

TEST(Render, OfAnEnormousLineOnlyAWindowIsShown) {
  std::string text = "a";
  for (int i = 0; i < 1'000'000; ++i)
    text += "°";
  const auto at = static_cast<std::uint32_t>(text.size());
  const std::string result = picture(text + "X" + text, {"m", {at, at + 1}});
  EXPECT_NE(result.find("°Xa°"), std::string::npos);
  EXPECT_LT(result.size(), 1000U);
}

TEST(Render, Colours) {
  const SourceFile source = SourceFile::fromText("a.nc", "G1 X2");
  Diagnostic diagnostic = {"m", {0, 2}, "one"};
  diagnostic.labels = {{{3, 5}, "two"}};
  diagnostic.notes = {"n"};
  const std::string expected = "<1;31>error<0><1>: m<0> [r]\n"
                               "<1;34> --><0> a.nc:1:1\n"
                               "<1;34>  |<0>\n"
                               "<1;34>1 |<0> G1 X2\n"
                               "<1;34>  |<0> <1;31>^^<0> <1;34>--<0> <1;34>two<0>\n"
                               "<1;34>  |<0> <1;31>|<0>\n"
                               "<1;34>  |<0> <1;31>one<0>\n"
                               "<1;34>  |<0>\n"
                               "<1;34>  = <0><1>note: <0>n\n";
  std::string shown;
  for (const char c : render(diagnostic, {"error", "r"}, source, noOtherFile, {.colour = true}))
    shown += c == '\x1b' ? '<' : c;
  std::string readable;
  for (std::size_t at = 0; at < shown.size(); ++at)
    if (shown[at] == '<') {
      const std::size_t end = shown.find('m', at);
      readable += "<" + shown.substr(at + 2, end - at - 2) + ">";
      at = end;
    } else {
      readable += shown[at];
    }
  EXPECT_EQ(readable, expected);
}

TEST(Render, AnyBytesAndSpansGivePrintableLines) {
  EXPECT_TRUE(rc::check("the output is UTF-8 without control characters", [] {
    const auto bytes = *rc::gen::container<std::string>(
        rc::gen::oneOf(rc::gen::arbitrary<char>(), rc::gen::elementOf(std::string("\n\r\tG1X"))));
    const auto size = static_cast<std::uint32_t>(bytes.size());
    const auto span = [&] {
      const auto begin = *rc::gen::inRange<std::uint32_t>(0, size + 1);
      return Span{begin, *rc::gen::inRange<std::uint32_t>(begin, size + 1)};
    };
    Diagnostic diagnostic = {"m", span(), "one"};
    diagnostic.labels = {{span(), "two"}, {span(), bytes}};
    diagnostic.notes = {bytes};
    const auto width = *rc::gen::inRange<std::uint32_t>(0, 60);
    const std::string result = picture(bytes, diagnostic, {.maxLineWidth = width});
    const Encoding encoding = detectEncoding(result);
    RC_ASSERT(encoding == Encoding::Ascii || encoding == Encoding::Utf8);
    RC_ASSERT(std::ranges::none_of(result, [](char c) { return c != '\n' && c >= 0 && c < ' '; }));
    RC_ASSERT(result.ends_with('\n'));
    RC_ASSERT(result.find('^') != std::string::npos);
  }));
}

} // namespace
} // namespace feedhold
