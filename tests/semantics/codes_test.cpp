// No code of a table is passed over in silence: what is not followed is told, and forgets what it may change.
#include "semantics/language_sample.h"

#include <fmt/format.h>

namespace feedhold {
namespace {

std::string nameOf(char address, const Code &code) {
  return code.tenths % 10 == 0 ? fmt::format("{}{}", address, code.tenths / 10)
                               : fmt::format("{}{}.{}", address, code.tenths / 10, code.tenths % 10);
}

template <typename Visit> void forEachCode(Visit &&visit) {
  for (const Dialect *dialect : allDialects().dialects) {
    for (const Code &code : dialect->gCodes)
      visit(*dialect, 'G', code);
    for (const Code &code : dialect->mCodes)
      visit(*dialect, 'M', code);
  }
}

TEST(Codes, EachIsClassified) {
  forEachCode([](const Dialect &dialect, char address, const Code &code) {
    EXPECT_NE(code.action, CodeAction::Unclassified) << dialect.id << " " << nameOf(address, code);
    const bool acts = code.action != CodeAction::ByRole;
    const bool byRole = code.role != CodeRole::Plain && code.role != CodeRole::Motion && code.role != CodeRole::Arc &&
                        code.role != CodeRole::CannedCycle && code.role != CodeRole::CoordinateShift;
    EXPECT_TRUE(acts || byRole) << dialect.id << " " << nameOf(address, code) << ": no role says what it does";
  });
}

TEST(Codes, WhatIsNotFollowedIsTold) {
  forEachCode([](const Dialect &dialect, char address, const Code &code) {
    const bool isModelled = code.action != CodeAction::Unmodelled && code.action != CodeAction::Anything &&
                            code.action != CodeAction::InterruptOn;
    const bool leaves = code.role == CodeRole::ProgramStop || code.role == CodeRole::ProgramEnd;
    if (isModelled || leaves || code.tenths >= 10000)
      return;
    const std::string name = nameOf(address, code);
    const LanguageSample sample(dialect, {fmt::format("#500=1\n#100=1\n{}\n#101=1\nM2\n", name)});
    EXPECT_FALSE(sample.run().notes.empty()) << dialect.id << " " << name;
    const auto told = sample.valueBefore("#101", 100);
    if (code.action == CodeAction::InterruptOn) {
      EXPECT_TRUE(sample.gaveUp) << dialect.id << " " << name;
    }
    if (code.action == CodeAction::Anything) {
      EXPECT_TRUE(told && !told->isNumber()) << dialect.id << " " << name;
    }
  });
}

TEST(Codes, AnArmedInterruptLeavesNoClaim) {
  for (const std::string_view id : {"fanuc-30i", "fanuc-0i", "mitsubishi-m700"}) {
    const LanguageSample sample(*findDialect(allDialects(), id),
                                {"O1\n#100=1\nM96P2\nG1X1.F100.\n#101=1/#100\nIF[#100EQ0]THEN#3000=1\nM97\nM30\n"
                                 "O2\n#100=0\nM99\n"});
    for (const prove::Obligation &row : sample.obligations())
      EXPECT_EQ(row.verdict, prove::Verdict::Unknown) << id << ": " << row.claim;
  }
}

TEST(Codes, ParametersSetByTheProgramLeaveNoClaim) {
  const LanguageSample sample(*findDialect(allDialects(), "fanuc-30i"),
                              {"O1\nG10L50\nN6000R1\nG11\nIF[#1EQ#1]GOTO10\n#3000=1\nN10M30\n"});
  EXPECT_EQ(sample.userAlarm(), prove::Verdict::Unknown);
}

} // namespace
} // namespace feedhold
