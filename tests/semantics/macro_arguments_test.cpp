// In the block of a macro call every address but G, L, N, O and P passes an argument, whatever it means elsewhere: for
// the machine, for ranges and for proofs, on every control, by every way to call.
#include "semantics/language_sample.h"

#include <fmt/format.h>

namespace feedhold {
namespace {

constexpr std::string_view kAddresses = "ABCDEFHIJKMQRSTUVWXYZ";

/// What ends, calls, jumps, stops, starts the spindle or changes a tool where it is no argument.
constexpr std::array kValues = {"30.", "99.", "98.", "2.", "0.", "96.", "97.", "6.", "3.", "1."};

/// The caller goes on behind the call, and the callee has the value.
std::string callBy(std::string_view code, char address, std::string_view value, unsigned variable) {
  return fmt::format("O1\nG90G0X0.\n#101=0\n{}{}{}\nG0X1.\n#101=1\nIF[#100NE{}]THEN#3000=2\nIF[#101EQ1]THEN#3000=1\n"
                     "M30\nO2\n#100=#{}\nM99\n",
                     code, address, value, value, variable);
}

/// A machine on which G123 and M60 call O2 with arguments.
Dialect withCodeCalls(Dialect dialect) {
  dialect.switches.codeCalls = {{'G', 1230, 2, true}, {'M', 600, 2, true}};
  return dialect;
}

std::vector<std::string> callsOf(const Dialect &dialect) {
  std::vector<std::string> calls = {"G65P2", "G123", "M60"};
  if (findGCode(dialect, 660))
    calls.emplace_back("G66P2");
  return calls;
}

void expectPassed(const Dialect &dialect, const std::string &text) {
  const LanguageSample sample(dialect, {text});
  const RunResult result = sample.run();
  EXPECT_EQ(result.end, RunEnd::UserAlarm) << dialect.id << "\n" << text;
  EXPECT_EQ(result.alarmNumber, 1) << dialect.id << "\n" << text;
  EXPECT_TRUE(sample.valueBefore("IF[#101", 101)) << dialect.id << "\n" << text;
}

TEST(MacroArguments, EveryAddressOfEveryDialect) {
  for (const Dialect *plain : macroBDialects()) {
    const Dialect dialect = withCodeCalls(*plain);
    for (const std::string &call : callsOf(dialect))
      for (const char address : kAddresses)
        if (const std::uint8_t variable = argumentVariable(dialect, address))
          for (const char *value : {kValues[0], kValues[1], kValues[2]})
            expectPassed(dialect, callBy(call, address, value, variable));
  }
}

TEST(MacroArguments, EveryCodeThatEndsOrLeads) {
  for (const Dialect *plain : macroBDialects())
    for (const char *value : kValues)
      expectPassed(*plain, callBy("G65P2", 'M', value, argumentVariable(*plain, 'M')));
}

TEST(MacroArguments, ProofsSeeWhatStandsBehind) {
  for (const Dialect *dialect : macroBDialects())
    for (const char *value : {"30.", "99.", "98."}) {
      const LanguageSample sample(*dialect, {callBy("G65P2", 'M', value, 13)});
      EXPECT_EQ(sample.userAlarm(), prove::Verdict::Refuted) << dialect->id << " M" << value;
    }
}

TEST(MacroArguments, TheModelSeesNoCode) {
  for (const Dialect *dialect : macroBDialects()) {
    const LanguageSample sample(*dialect, {"O1\nG65P2M98.\nG65P2M99.\nM30\nO2\nM99\n"});
    const ProgramModel &model = *sample.set->file(FileId(0)).model;
    EXPECT_EQ(model.calls.size(), 2U) << dialect->id;
    EXPECT_FALSE(model.programs[ProgramId(0)].returns) << dialect->id;
  }
}

} // namespace
} // namespace feedhold
