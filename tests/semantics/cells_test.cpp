// Numbers that name one cell, or may: what is written under one is not what it was under the other.
#include "semantics/language_sample.h"

#include <fmt/format.h>

namespace feedhold {
namespace {

struct Pair {
  std::uint32_t a;
  std::uint32_t b;
  bool same; // else perhaps
};

/// The first, the last and one in the middle of each row, both ways.
std::vector<Pair> pairsOf(const Dialect &dialect) {
  std::vector<Pair> pairs;
  for (const CellAlias &alias : dialect.aliases) {
    const std::uint32_t rows = (alias.last - alias.first) / alias.period;
    for (const std::uint32_t number :
         {alias.first, alias.first + rows / 2 * alias.period + alias.width / 2, alias.first + alias.width - 1}) {
      const std::uint32_t other = alias.cellOf(number).value_or(number);
      const bool same = cellOf(dialect, number) == cellOf(dialect, other);
      const auto perhaps = perhapsSameAs(dialect, cellOf(dialect, number));
      const bool counts = same || std::ranges::find(perhaps, cellOf(dialect, other)) != perhaps.end();
      if (counts && number != other && findVariable(dialect, number) && findVariable(dialect, other)) {
        pairs.push_back({number, other, same});
        pairs.push_back({other, number, same});
      }
    }
  }
  return pairs;
}

std::string writeBoth(std::string_view first, std::string_view second, std::uint32_t read) {
  return fmt::format("O1\n{}=5\n{}=7\nIF[#{}NE5]THEN#3000=1\nM30\n", first, second, read);
}
std::string numbered(std::uint32_t number) { return fmt::format("#{}", number); }

void expectNotKept(const Dialect &dialect, const std::string &text, bool isCertain) {
  const auto verdict = LanguageSample(dialect, {text}).userAlarm();
  ASSERT_TRUE(verdict) << dialect.id << "\n" << text;
  EXPECT_FALSE(holds(*verdict)) << dialect.id << "\n" << text;
  if (isCertain) {
    EXPECT_EQ(*verdict, prove::Verdict::Refuted) << dialect.id << "\n" << text;
  }
}

TEST(Cells, AWriteUnderOneNumberIsReadUnderTheOther) {
  for (const Dialect *dialect : macroBDialects())
    for (const Pair &pair : pairsOf(*dialect)) {
      const std::string text = writeBoth(numbered(pair.a), numbered(pair.b), pair.a);
      const LanguageSample sample(*dialect, {text});
      EXPECT_EQ(sample.run().end, RunEnd::UserAlarm) << dialect->id << "\n" << text;
      const auto told = sample.valueBefore("IF", pair.a);
      ASSERT_TRUE(told);
      EXPECT_TRUE(!told->isNumber() || told->number().contains(7)) << dialect->id << "\n" << text;
      expectNotKept(*dialect, text, pair.same);
    }
}

TEST(Cells, AnIndirectWriteMayReachAllNames) {
  for (const Dialect *dialect : macroBDialects())
    for (const Pair &pair : pairsOf(*dialect))
      expectNotKept(*dialect, writeBoth(numbered(pair.a), fmt::format("#[{}+#1]", pair.b), pair.a), false);
}

TEST(Cells, WordsAndTheirBits) {
  for (const Dialect *dialect : macroBDialects())
    for (const BitWord &row : dialect->bitWords)
      for (const std::uint32_t bit : {0U, row.sureBits - 1, row.bits - 1}) {
        const std::string word = numbered(row.word);
        const std::string cell = numbered(row.firstBit + bit);
        if (!findVariable(*dialect, row.firstBit + bit))
          continue;
        expectNotKept(*dialect, fmt::format("O1\n{}=0\n{}=1\nIF[{}NE0]THEN#3000=1\nM30\n", word, cell, word),
                      bit < row.sureBits);
        expectNotKept(*dialect,
                      fmt::format("O1\n{}=0\n{}={}\nIF[{}NE0]THEN#3000=1\nM30\n", cell, word, 1LL << bit, cell),
                      bit < row.sureBits);
        expectNotKept(*dialect, fmt::format("O1\n{}=0\n{}=#500\nIF[{}NE0]THEN#3000=1\nM30\n", cell, word, cell), false);
        expectNotKept(*dialect, fmt::format("O1\n{}=0\n#[{}+#1]=3\nIF[{}NE0]THEN#3000=1\nM30\n", cell, row.word, cell),
                      false);
      }
}

TEST(Cells, OneNumberIsAlwaysTheSame) {
  for (const Dialect *dialect : macroBDialects())
    for (const CellAlias &alias : dialect->aliases)
      for (std::uint32_t number = alias.first; number <= alias.last; ++number)
        EXPECT_EQ(cellOf(*dialect, cellOf(*dialect, number)), cellOf(*dialect, number)) << dialect->id << number;
}

TEST(Cells, GivenUnderEitherNumber) {
  const Dialect &dialect = *findDialect(allDialects(), "fanuc-30i");
  const LanguageSample sample(dialect, {"O1\n#100=#2001\nM30\n"});
  GivenVariables given;
  given.set(10001, ConcreteValue::of(4));
  EXPECT_EQ(sample.run(given).state.variables.find(100)->number, 4);
}

} // namespace
} // namespace feedhold
