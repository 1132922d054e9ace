// A number that several programs have: which of them a call runs is not known.
#include "semantics/language_sample.h"

namespace feedhold {
namespace {

const std::string kCaller = "O1\n#100=1\nG65P2A3.\n#101=#100\nIF[#100EQ1]GOTO10\n#3000=1\nN10M30\n";
const std::string kWide = "O2\n(@PARAM #1 1..5)\n#100=1\nM99\n";
const std::string kNarrow = "O2\n(@PARAM #1 1..2)\n#100=2\nM99\n";

std::vector<prove::Obligation> contractRows(const LanguageSample &sample) {
  std::vector<prove::Obligation> rows;
  for (const prove::Obligation &row : sample.obligations())
    if (row.kind == prove::ObligationKind::CallMeetsContract)
      rows.push_back(row);
  return rows;
}

TEST(DuplicatePrograms, NoneIsFollowed) {
  const Dialect &dialect = *findDialect(allDialects(), "fanuc-30i");
  for (const std::vector<std::string> &files :
       {std::vector{kCaller, kWide, kNarrow}, std::vector{kCaller, kNarrow, kWide},
        std::vector{kCaller + kWide + kNarrow}}) {
    const LanguageSample sample(dialect, files);
    EXPECT_EQ(sample.run().end, RunEnd::Unmodelled);
    const auto told = sample.valueBefore("#101", 100);
    EXPECT_TRUE(told && !told->isNumber());
    EXPECT_EQ(sample.userAlarm(), prove::Verdict::Unknown);
  }
}

TEST(DuplicatePrograms, TheContractOfEachIsAsked) {
  const LanguageSample sample(*findDialect(allDialects(), "fanuc-30i"), {kCaller, kWide, kNarrow});
  const std::vector<prove::Obligation> rows = contractRows(sample);
  ASSERT_FALSE(rows.empty());
  EXPECT_TRUE(std::ranges::any_of(rows, [](const prove::Obligation &row) { return !holds(row.verdict); }));
}

TEST(DuplicatePrograms, AModalCallOfOneIsNotFollowed) {
  const LanguageSample sample(*findDialect(allDialects(), "fanuc-30i"),
                              {"O1\n#100=1\nG66P2A3.\nG0X1.\nG67\n#101=#100\nM30\n", kWide, kNarrow});
  EXPECT_EQ(sample.run().end, RunEnd::Unmodelled);
  const auto told = sample.valueBefore("#101", 100);
  EXPECT_TRUE(told && !told->isNumber());
}

TEST(DuplicatePrograms, OneInTheFileOfTheCallerComesFirst) {
  const LanguageSample sample(*findDialect(allDialects(), "fanuc-30i"), {kCaller + kWide, kNarrow});
  EXPECT_EQ(sample.run().end, RunEnd::M30);
}

} // namespace
} // namespace feedhold
