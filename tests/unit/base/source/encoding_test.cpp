// Encodings: what a file is taken for, and what its bytes become in UTF-8.
#include "base/source/encoding.h"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <array>
#include <string>

namespace feedhold {
namespace {

// 「工具交換」 and half-width ドリル, in code page 932.
constexpr std::string_view kToolChange = "(\x8d\x48\x8b\xef\x8c\xf0\x8a\xb7)";
constexpr std::string_view kDrill = "(\xc4\xde\xd8\xd9)";

struct DetectionCase {
  std::string_view text;
  Encoding encoding;
};

TEST(Encoding, IsDetected) {
  constexpr std::array<DetectionCase, 16> kCases = {{
      {"", Encoding::Ascii},
      {"%\nO1000(TEST)\x01\x7f\n%", Encoding::Ascii},
      {"(\xc3\x98"
       "10)",
       Encoding::Utf8},
      {"\xef\xbb\xbfO1000", Encoding::Utf8},
      {"(\xe5\xb7\xa5)(\xf0\x9f\x94\xa7)", Encoding::Utf8},
      {kToolChange, Encoding::ShiftJis},
      {kDrill, Encoding::ShiftJis},
      {"(\x83h\x83\x8a\x83\x8b)", Encoding::ShiftJis}, // full-width katakana, trail bytes in ASCII
      {"(Fr\xe4sen)", Encoding::Latin1},               // E4 73 is a valid pair
      {"(L\xe4nge 45\xb0, \xd8"
       "10, \xb1"
       "0.1)",
       Encoding::Latin1},
      {"(Gr\xf6\xdf"
       "e, Pr\xfc"
       "fen, K\xfc"
       "hlung)",
       Encoding::Latin1},
      {"(100 \x80)", Encoding::Latin1},         // 80 begins nothing in Shift-JIS
      {"\xc0\x80\xff", Encoding::Latin1},       // overlong
      {"(\xed\xa0\x80\xff)", Encoding::Latin1}, // a surrogate
      {"(caf\xe9)", Encoding::Latin1},          // a lead byte and ")"
      {"\xe9", Encoding::Latin1},               // a lead byte at the end
  }};
  for (const DetectionCase &c : kCases)
    EXPECT_EQ(detectEncoding(c.text), c.encoding) << c.text;
}

TEST(Encoding, AHighByteIsSeenAnywhereInALongText) {
  for (std::size_t at = 0; at < 200; ++at) {
    std::string text(200, 'X');
    text[at] = '\xb0';
    EXPECT_EQ(detectEncoding(text), Encoding::Latin1) << at;
  }
}

TEST(Encoding, DecodesToUtf8) {
  EXPECT_EQ(toUtf8(kToolChange, Encoding::ShiftJis), "(工具交換)");
  EXPECT_EQ(toUtf8(kDrill, Encoding::ShiftJis), "(ﾄﾞﾘﾙ)");
  EXPECT_EQ(toUtf8("A\\~", Encoding::ShiftJis), "A\\~");
  EXPECT_EQ(toUtf8("\x81\x40\x81\x7e\x81\x80", Encoding::ShiftJis), "\u3000×÷"); // no character ends in 7F
  EXPECT_EQ(toUtf8("\xfa\x40\xf0\x40\xf9\xfc", Encoding::ShiftJis), "ⅰ\uE000\uE757");
  EXPECT_EQ(toUtf8("45\xb0 \x80 \x96", Encoding::Latin1), "45° € –");
  EXPECT_EQ(toUtf8("\xc3\x98 🔧", Encoding::Utf8), "Ø 🔧");
}

TEST(Encoding, ReplacesWhatDoesNotDecode) {
  EXPECT_EQ(toUtf8("\xb7\xa5X\xe5\xb7", Encoding::Utf8), "\uFFFD\uFFFDX\uFFFD\uFFFD");
  EXPECT_EQ(toUtf8("\xf4\x90\x80\x80", Encoding::Utf8), "\uFFFD\uFFFD\uFFFD\uFFFD");
  EXPECT_EQ(toUtf8("A\x8d", Encoding::ShiftJis), "A\uFFFD");
  EXPECT_EQ(toUtf8("\xff\x8d\x48", Encoding::ShiftJis), "\uFFFD工");
  EXPECT_EQ(toUtf8("\x85\x40\x84\xfc\xfc\xfc", Encoding::ShiftJis), "\uFFFD\uFFFD\uFFFD"); // no row, holes
  EXPECT_EQ(toUtf8("\x81", Encoding::Latin1), "\uFFFD");
}

TEST(Encoding, WalksCharacters) {
  EXPECT_EQ(characterLength("Ø", 0, Encoding::Utf8), 2U);
  EXPECT_EQ(characterLength("工", 0, Encoding::Utf8), 3U);
  EXPECT_EQ(characterLength("🔧", 0, Encoding::Utf8), 4U);
  EXPECT_EQ(characterLength("🔧", 1, Encoding::Utf8), 1U);
  EXPECT_EQ(characterLength(kToolChange, 1, Encoding::ShiftJis), 2U);
  EXPECT_EQ(characterLength(kDrill, 1, Encoding::ShiftJis), 1U);
  EXPECT_EQ(characterLength("\xe4s", 0, Encoding::Latin1), 1U);
}

TEST(Encoding, FindsTheBeginningOfACharacter) {
  const std::string text = "aØ工🔧b";
  constexpr std::array<std::size_t, 11> kBegins = {0, 1, 1, 3, 3, 3, 6, 6, 6, 6, 10};
  for (std::size_t at = 0; at < text.size(); ++at)
    EXPECT_EQ(characterBegin(text, 0, at, Encoding::Utf8), kBegins[at]) << at;
  // The trail byte 83 of the second character looks like the lead byte of a third.
  const std::string japanese = "\x83\x83\x83\x83X";
  EXPECT_EQ(characterBegin(japanese, 0, 3, Encoding::ShiftJis), 2U);
  EXPECT_EQ(characterBegin(japanese, 0, 4, Encoding::ShiftJis), 4U);
  EXPECT_EQ(characterBegin("\xe4s", 0, 1, Encoding::Latin1), 1U);
}

TEST(Encoding, Utf8OfAnyBytesIsUtf8) {
  EXPECT_TRUE(rc::check("whatever the bytes, the result is valid UTF-8", [] {
    const auto bytes = *rc::gen::container<std::string>(rc::gen::arbitrary<char>());
    for (const Encoding encoding : {Encoding::Utf8, Encoding::ShiftJis, Encoding::Latin1}) {
      const Encoding found = detectEncoding(toUtf8(bytes, encoding));
      RC_ASSERT(found == Encoding::Utf8 || found == Encoding::Ascii);
    }
    RC_ASSERT(toUtf8(bytes, detectEncoding(bytes)).size() >= bytes.size() / 2);
  }));
}

TEST(Encoding, EncodesEveryKindOfCodePoint) {
  std::string text;
  for (const char32_t codePoint : {U'A', U'Ø', U'工', U'🔧'})
    appendUtf8(text, codePoint);
  EXPECT_EQ(text, "AØ工🔧");
}

} // namespace
} // namespace feedhold
