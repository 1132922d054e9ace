// Text helpers: case, trimming, suggestions, the stable hash, globs.
#include "base/support/text.h"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <array>

namespace feedhold {
namespace {

TEST(Text, ChangesCaseOfAsciiOnly) {
  EXPECT_EQ(toUpper("g65 p9810 \xe4z@[`{"), "G65 P9810 \xe4Z@[`{");
  EXPECT_EQ(toLower("WHILE[#1 \xc4Z@[`{"), "while[#1 \xc4z@[`{");
}

TEST(Text, TrimsBothEnds) {
  EXPECT_EQ(trimmed(" \t G1 X2\r\n"), "G1 X2");
  EXPECT_EQ(trimmed(" \r\n"), "");
  EXPECT_EQ(trimmed(""), "");
  EXPECT_EQ(trimmed("M30"), "M30");
}

TEST(Text, SuggestsTheNearestWord) {
  constexpr std::array<std::string_view, 4> kWords = {"WHILE", "GOTO", "SETVN", "POPEN"};
  EXPECT_EQ(nearestWord("WHIEL", kWords), "WHILE");
  EXPECT_EQ(nearestWord("GTO", kWords), "GOTO");
  EXPECT_EQ(nearestWord("GOTO", kWords), "GOTO");
  EXPECT_EQ(nearestWord("DPRNT", kWords), std::nullopt);
  EXPECT_EQ(nearestWord("while", kWords), std::nullopt);
  EXPECT_EQ(nearestWord("", kWords), std::nullopt);
  EXPECT_EQ(nearestWord("GOTO", {}), std::nullopt);
}

TEST(Text, SuggestsTheFirstOfEquallyNearWords) {
  constexpr std::array<std::string_view, 3> kWords = {"ABX", "ABY", "ABZ"};
  EXPECT_EQ(nearestWord("ABC", kWords), "ABX");
}

TEST(Text, HashIsFnv1a) {
  // Values published with the algorithm (Fowler, Noll, Vo; test vectors of draft-eastlake-fnv).
  EXPECT_EQ(stableHash(""), 0xcbf29ce484222325ULL);
  EXPECT_EQ(stableHash("a"), 0xaf63dc4c8601ec8cULL);
  EXPECT_EQ(stableHash("foobar"), 0x85944171f73967e8ULL);
}

TEST(Text, HashContinuesFromASeed) { EXPECT_EQ(stableHash("bar", stableHash("foo")), stableHash("foobar")); }

struct GlobCase {
  std::string_view pattern;
  std::string_view path;
  bool matches;
};

TEST(Text, GlobKnowsFolders) {
  constexpr std::array<GlobCase, 22> kCases = {{
      {"*.nc", "a.nc", true},
      {"*.nc", "dir/a.nc", false},
      {"**/*.nc", "a.nc", true},
      {"**/*.nc", "x/y/a.nc", true},
      {"x/**", "x/y/a.nc", true},
      {"x/**", "y/x/a.nc", false},
      {"x/**/z", "x/z", true},
      {"x/**/z", "x/a/b/z", true},
      {"x/**/z", "x/az", false},
      {"x**z", "xa/bz", true},
      {"O????", "O0140", true},
      {"O????", "O014", false},
      {"a?b", "a/b", false},
      {"", "", true},
      {"", "a", false},
      {"*", "", true},
      {"**", "a/b/c", true},
      {"a.nc", "a-nc", false},
      {"[a]", "[a]", true},
      {"*a*b*", "xxaxxbxx", true},
      {"*a*b*", "xxbxxaxx", false},
      {"**/x/**/y", "x/x/q/y", true},
  }};
  for (const GlobCase &c : kCases)
    EXPECT_EQ(globMatches(c.pattern, c.path), c.matches) << c.pattern << " against " << c.path;
}

TEST(Text, ManyStarsDoNotBlowUp) {
  const std::string path(2000, 'a');
  std::string pattern;
  for (int i = 0; i < 100; ++i)
    pattern += "*a";
  EXPECT_FALSE(globMatches(pattern + "b", path));
  EXPECT_TRUE(globMatches(pattern, path));
}

TEST(Text, DecimalTextIsWhatAControlShows) {
  EXPECT_EQ(decimalText(-2.665e-15, 4), "0");
  EXPECT_EQ(decimalText(12.5, 4), "12.5");
  EXPECT_EQ(decimalText(-0.00051, 4), "-0.0005");
  EXPECT_EQ(decimalText(100, 0), "100");
}

TEST(Text, APathMatchesItself) {
  EXPECT_TRUE(rc::check("a path without stars matches itself and no longer path", [] {
    const auto path = *rc::gen::container<std::string>(rc::gen::elementOf(std::string("abO0./ -_")));
    RC_ASSERT(globMatches(path, path));
    RC_ASSERT(!globMatches(path, path + "x"));
    RC_ASSERT(globMatches("**", path));
  }));
}

} // namespace
} // namespace feedhold
