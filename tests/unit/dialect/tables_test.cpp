// The tables of every dialect: in order, without overlap, complete where other libraries rely on them.
#include "dialects/registry.h"

#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <set>
#include <sstream>
#include <string>

namespace feedhold {
namespace {

struct Row {
  std::string_view id;
  std::string_view folder;
};

void PrintTo(const Row &row, std::ostream *out) { *out << row.id; }

constexpr Row kRows[] = {
#define DIALECT(function, id, folder) {id, folder},
#include "dialects/dialects.def"
};

class EveryDialect : public testing::TestWithParam<Row> {
protected:
  const Dialect &dialect() const { return *findDialect(allDialects(), GetParam().id); }
};

std::string testName(const testing::TestParamInfo<Row> &row) {
  std::string name(row.param.id);
  for (char &c : name)
    c = c == '-' ? '_' : c;
  return name;
}

std::vector<Row> macroBRows() {
  std::vector<Row> rows;
  for (const Row &row : kRows)
    if (!findDialect(allDialects(), row.id)->grammar.oWords)
      rows.push_back(row);
  return rows;
}

/// Those whose macro language is Macro B.
class EveryMacroBDialect : public EveryDialect {};

INSTANTIATE_TEST_SUITE_P(Tables, EveryDialect, testing::ValuesIn(kRows), testName);
INSTANTIATE_TEST_SUITE_P(Tables, EveryMacroBDialect, testing::ValuesIn(macroBRows()), testName);

TEST_P(EveryDialect, CodesAreInOrderAndUnique) {
  for (const std::span<const Code> codes : {dialect().gCodes, dialect().mCodes}) {
    ASSERT_FALSE(codes.empty());
    for (std::size_t i = 1; i < codes.size(); ++i)
      EXPECT_LT(codes[i - 1].tenths, codes[i].tenths);
    for (const Code &code : codes)
      EXPECT_FALSE(code.meaning.empty()) << code.tenths;
  }
}

TEST_P(EveryDialect, VariablesAreInOrderWithoutOverlap) {
  const std::span<const VariableRange> ranges = dialect().variables;
  for (std::size_t i = 0; i < ranges.size(); ++i) {
    EXPECT_LE(ranges[i].first, ranges[i].last);
    if (i > 0) {
      EXPECT_LT(ranges[i - 1].last, ranges[i].first);
    }
  }
}

TEST_P(EveryDialect, PredefinedNamesAreInOrderAndReadOnly) {
  const std::span<const PredefinedName> names = dialect().predefinedNames;
  for (std::size_t i = 0; i < names.size(); ++i) {
    const VariableRange &row = names[i].row;
    EXPECT_TRUE(i == 0 || names[i - 1].row.name < row.name) << row.name;
    EXPECT_EQ(predefinedNamed(dialect(), row.name), row.first);
    EXPECT_EQ(findVariable(dialect(), row.first), &row);
    EXPECT_EQ(row.access, VariableAccess::ReadOnly);
    EXPECT_FALSE(row.meaning.empty()) << row.name;
    const bool isOfCode = names[i].source == NameSource::CodeInForce || names[i].source == NameSource::CodeTenths ||
                          names[i].source == NameSource::CodeWhole;
    EXPECT_TRUE(!isOfCode || findGCode(dialect(), static_cast<std::uint16_t>(names[i].detail))) << row.name;
    const bool isOfVariable = names[i].source == NameSource::Variable;
    EXPECT_TRUE(!isOfVariable || findVariable(dialect(), cellOf(dialect(), row.first))) << row.name;
  }
}

TEST_P(EveryDialect, KnowsTheCodesThatTheModelAsksFor) {
  std::set<CodeRole> roles;
  for (const Code &code : dialect().gCodes)
    roles.insert(code.role);
  for (const Code &code : dialect().mCodes)
    roles.insert(code.role);
  for (const CodeRole role : {CodeRole::Motion, CodeRole::Arc, CodeRole::Dwell, CodeRole::DataSetting,
                              CodeRole::CannedCycle, CodeRole::SubprogramCall, CodeRole::Return, CodeRole::ProgramEnd,
                              CodeRole::ProgramStop, CodeRole::MachinePosition, CodeRole::Skip})
    EXPECT_TRUE(roles.contains(role)) << static_cast<int>(role);
  EXPECT_EQ(roles.contains(CodeRole::MacroCall), !dialect().grammar.oWords);
}

TEST_P(EveryMacroBDialect, VariablesEveryMacroUses) {
  EXPECT_EQ(findVariable(dialect(), 0)->kind, VariableKind::Vacant);
  EXPECT_EQ(findVariable(dialect(), 0)->access, VariableAccess::ReadOnly);
  EXPECT_EQ(findVariable(dialect(), 33)->kind, VariableKind::Local);
  EXPECT_EQ(findVariable(dialect(), 34), nullptr);
  EXPECT_EQ(findVariable(dialect(), 99), nullptr);
  EXPECT_EQ(findVariable(dialect(), 500)->kind, VariableKind::Retentive);
  EXPECT_EQ(findVariable(dialect(), kAlarmVariable)->access, VariableAccess::WriteOnly);
  EXPECT_EQ(findVariable(dialect(), kMessageVariable)->access, VariableAccess::WriteOnly);
  EXPECT_EQ(findVariable(dialect(), 4001)->access, VariableAccess::ReadOnly);
  EXPECT_EQ(findVariable(dialect(), 5001)->access, VariableAccess::ReadOnly);
  EXPECT_EQ(findVariable(dialect(), 5221)->access, VariableAccess::ReadWrite);
}

TEST_P(EveryMacroBDialect, ArgumentLettersAreThoseOfAssignmentOne) {
  const std::string_view letters = "ABCIJKDEFHMQRSTUVWXYZ";
  const int variables[] = {1, 2, 3, 4, 5, 6, 7, 8, 9, 11, 13, 17, 18, 19, 20, 21, 22, 23, 24, 25, 26};
  for (std::size_t i = 0; i < letters.size(); ++i)
    EXPECT_EQ(dialect().argumentVariables[static_cast<std::size_t>(letters[i] - 'A')], variables[i]) << letters[i];
  for (const char letter : {'G', 'L', 'N', 'O', 'P'})
    EXPECT_EQ(dialect().argumentVariables[static_cast<std::size_t>(letter - 'A')], 0) << letter;
}

TEST_P(EveryMacroBDialect, AndBindsAsAMultiplication) {
  EXPECT_EQ(precedenceOf(dialect(), OperatorKind::And), precedenceOf(dialect(), OperatorKind::Multiply));
  EXPECT_GT(precedenceOf(dialect(), OperatorKind::And), precedenceOf(dialect(), OperatorKind::Add));
  EXPECT_EQ(precedenceOf(dialect(), OperatorKind::Or), precedenceOf(dialect(), OperatorKind::Add));
  EXPECT_GT(precedenceOf(dialect(), OperatorKind::Or), precedenceOf(dialect(), OperatorKind::Equal));
  EXPECT_GT(precedenceOf(dialect(), OperatorKind::Equal), 0);
}

TEST_P(EveryDialect, NoAlarmHasTwoNumbers) {
  std::set<AlarmKind> kinds;
  for (const AlarmNumber &alarm : dialect().alarms)
    EXPECT_TRUE(kinds.insert(alarm.kind).second) << alarm.number;
}

TEST_P(EveryDialect, HasAParityPageThatNamesIt) {
  const std::filesystem::path page =
      std::filesystem::path(FEEDHOLD_SOURCE_DIR) / "dialects" / GetParam().folder / "parity.md";
  std::ifstream file(page);
  ASSERT_TRUE(file) << page;
  std::ostringstream text;
  text << file.rdbuf();
  EXPECT_NE(text.str().find("`" + std::string(GetParam().id) + "`"), std::string::npos) << page;
  EXPECT_NE(text.str().find("## Not modelled"), std::string::npos) << page;
}

const Dialect &dialectNamed(std::string_view id) { return *findDialect(allDialects(), id); }

TEST(Dialect, IsFoundByItsId) {
  EXPECT_EQ(findDialect(allDialects(), "fanuc-99i"), nullptr);
  EXPECT_EQ(dialectNamed("haas-ngc").id, "haas-ngc");
  EXPECT_EQ(allDialects().dialects.front()->id, "fanuc-30i");
}

TEST(Dialect, MillsAndLathesReadTheSameNumberDifferently) {
  EXPECT_EQ(findGCode(dialectNamed("fanuc-30i"), 900)->group, 3);
  EXPECT_EQ(findGCode(dialectNamed("fanuc-30i-lathe"), 900)->role, CodeRole::CannedCycle);
  EXPECT_EQ(findGCode(dialectNamed("fanuc-0i-lathe"), 710)->role, CodeRole::Contour);
  EXPECT_EQ(findGCode(dialectNamed("haas-ngc"), 710)->role, CodeRole::CannedCycle);
  EXPECT_EQ(findGCode(dialectNamed("fanuc-30i"), 540)->group, 14);
  EXPECT_EQ(findGCode(dialectNamed("mitsubishi-m700"), 540)->group, 12);
  EXPECT_EQ(formatOf(dialectNamed("fanuc-30i"), 'H').kind, AddressKind::Integer);
  EXPECT_EQ(formatOf(dialectNamed("fanuc-30i-lathe"), 'H').kind, AddressKind::Flexible);
}

TEST(Dialect, DecimalCodesAndScreenCodesAreCodes) {
  EXPECT_EQ(findGCode(dialectNamed("fanuc-30i"), 541)->group, 14);
  EXPECT_EQ(findGCode(dialectNamed("fanuc-30i"), 661)->role, CodeRole::ModalCallEach);
  EXPECT_EQ(findGCode(dialectNamed("fanuc-0i"), 19020)->meaning, "MANUAL GUIDE i blank: rectangular block");
  EXPECT_EQ(findGCode(dialectNamed("fanuc-30i"), 1540), nullptr);
  EXPECT_EQ(findGCode(dialectNamed("haas-ngc"), 1540)->group, 12);
}

TEST(Dialect, LocalCallsAreHaasAlone) {
  EXPECT_EQ(findMCode(dialectNamed("haas-ngc"), 970)->role, CodeRole::LocalCall);
  EXPECT_EQ(findMCode(dialectNamed("fanuc-30i"), 970)->role, CodeRole::Plain);
}

TEST(Dialect, VariablesThatOnlySomeControlsHave) {
  EXPECT_EQ(findVariable(dialectNamed("fanuc-30i"), 400), nullptr);
  EXPECT_EQ(findVariable(dialectNamed("mitsubishi-m700"), 400)->option, VariableOption::Optional);
  EXPECT_EQ(findVariable(dialectNamed("fanuc-0i"), 150)->option, VariableOption::Optional);
  EXPECT_EQ(findVariable(dialectNamed("haas-ngc"), 10000)->kind, VariableKind::Retentive);
  EXPECT_EQ(findVariable(dialectNamed("haas-classic"), 10000), nullptr);
  EXPECT_EQ(findVariable(dialectNamed("fanuc-30i"), 3101)->name, "_PI");
  EXPECT_EQ(findVariable(dialectNamed("fanuc-0i"), 3101), nullptr);
  EXPECT_EQ(findVariable(dialectNamed("mitsubishi-m700"), 4294967295U), nullptr);
}

TEST(Dialect, FunctionsThatOnlySomeControlsHave) {
  EXPECT_EQ(findFunction(dialectNamed("fanuc-30i"), FunctionKind::Pow)->form, FunctionForm::TwoByComma);
  EXPECT_EQ(findFunction(dialectNamed("fanuc-0i"), FunctionKind::Pow), nullptr);
  EXPECT_EQ(findFunction(dialectNamed("haas-classic"), FunctionKind::Bcd), nullptr);
  EXPECT_EQ(findFunction(dialectNamed("haas-ngc"), FunctionKind::Sqrt)->domain, FunctionDomain::NotNegative);
}

TEST(Dialect, OWordsComeWithAnotherOrderOfOperators) {
  const Dialect &dialect = dialectNamed("linuxcnc");
  const auto precedence = [&](OperatorKind op) { return precedenceOf(dialect, op); };
  EXPECT_GT(precedence(OperatorKind::Power), precedence(OperatorKind::Multiply));
  EXPECT_EQ(precedence(OperatorKind::Modulo), precedence(OperatorKind::Multiply));
  EXPECT_GT(precedence(OperatorKind::Equal), precedence(OperatorKind::And));
  EXPECT_EQ(precedence(OperatorKind::Xor), precedence(OperatorKind::And));
  EXPECT_EQ(precedenceOf(dialectNamed("fanuc-30i"), OperatorKind::Power), 0);
}

TEST(Dialect, AParameterIsNoAlarmWhereControlsHaveNone) {
  EXPECT_TRUE(raisesAlarm(dialectNamed("fanuc-30i"), kAlarmVariable));
  EXPECT_FALSE(raisesAlarm(dialectNamed("linuxcnc"), kAlarmVariable));
  EXPECT_EQ(findVariable(dialectNamed("linuxcnc"), 0), nullptr);
  EXPECT_EQ(findVariable(dialectNamed("linuxcnc"), 5602), nullptr);
  EXPECT_EQ(findVariable(dialectNamed("linuxcnc"), 5420)->access, VariableAccess::ReadOnly);
}

TEST(Dialect, AlarmsAreNamedAsTheControlNamesThem) {
  EXPECT_EQ(stopsWith(dialectNamed("fanuc-30i"), AlarmKind::DivideByZero), "stops with PS0112 (divided by zero)");
  EXPECT_EQ(stopsWith(dialectNamed("fanuc-0i"), AlarmKind::DivideByZero), "stops with P/S 112 (divided by zero)");
  EXPECT_EQ(stopsWith(dialectNamed("mitsubishi-m700"), AlarmKind::DivideByZero), "stops with P283 (divided by zero)");
  EXPECT_EQ(stopsWith(dialectNamed("haas-ngc"), AlarmKind::DivideByZero), "stops with an alarm (divided by zero)");
  EXPECT_EQ(alarmNumber(dialectNamed("fanuc-0i"), AlarmKind::SetVnFormat), std::nullopt);
}

TEST(Dialect, LimitsDiffer) {
  EXPECT_EQ(dialectNamed("mitsubishi-m700").limits.lastLoopNumber, 127);
  EXPECT_EQ(dialectNamed("fanuc-0i").limits.lastLoopNumber, 3);
  EXPECT_EQ(dialectNamed("fanuc-0i").limits.macroCallDepth, 4);
  EXPECT_EQ(dialectNamed("haas-ngc").limits.lastAlarmNumber, 999U);
}

TEST(Dialect, NumbersDependOnASwitch) {
  EXPECT_EQ(numbersOf(dialectNamed("linuxcnc")), NumberModel::Binary64);
  EXPECT_EQ(numbersOf(dialectNamed("fanuc-0i-lathe")), NumberModel::Mantissa32);
  EXPECT_EQ(numbersOf(dialectNamed("haas-classic")), NumberModel::Either);
  EXPECT_EQ(numbersOfRun(dialectNamed("haas-classic")), NumberModel::Binary64);
  Dialect dialect = dialectNamed("fanuc-30i");
  EXPECT_EQ(numbersOf(dialect), NumberModel::Binary64);
  dialect.switches.f16 = Switch::On;
  EXPECT_EQ(numbersOf(dialect), NumberModel::Mantissa32);
}

TEST(Dialect, TheLeastIncrementsAreThoseOfTheIncrementSystem) {
  Dialect dialect = dialectNamed("fanuc-30i");
  EXPECT_EQ(leastIncrementsOf(dialect).metric, Decimal(1, 3));
  EXPECT_EQ(leastIncrementsOf(dialect).inch, Decimal(1, 4));
  dialect.switches.incrementSystem = incrementSystemNamed("IS-A").value();
  EXPECT_EQ(leastIncrementsOf(dialect).metric, Decimal(1, 2));
  EXPECT_EQ(leastIncrementsOf(dialect).inch, Decimal(1, 3));
  dialect.switches.incrementSystem = incrementSystemNamed("IS-C").value();
  EXPECT_EQ(leastIncrementsOf(dialect).metric, Decimal(1, 4));
  EXPECT_EQ(leastIncrementsOf(dialect).inch, Decimal(1, 5));
  EXPECT_FALSE(incrementSystemNamed("IS-Z"));
}

TEST(Dialect, TheGCodesAreThoseOfTheGCodeSystem) {
  Dialect dialect = dialectNamed("fanuc-0i-lathe");
  const auto actionOf = [&](std::uint16_t code) {
    const Code *found = findGCode(dialect, static_cast<std::uint16_t>(code * 10));
    return found ? found->action : CodeAction::Unclassified;
  };
  EXPECT_EQ(dialect.switches.gCodeSystem, GCodeSystem::A);
  EXPECT_EQ(actionOf(90), CodeAction::DiameterCycle);
  EXPECT_EQ(actionOf(20), CodeAction::Inch);
  EXPECT_EQ(actionOf(50), CodeAction::CoordinateSet);
  EXPECT_EQ(actionOf(98), CodeAction::FeedPerMinute);
  chooseGCodeSystem(dialect, gCodeSystemNamed("B").value());
  EXPECT_EQ(actionOf(90), CodeAction::Absolute);
  EXPECT_EQ(actionOf(77), CodeAction::DiameterCycle);
  EXPECT_EQ(actionOf(20), CodeAction::Inch);
  EXPECT_EQ(actionOf(92), CodeAction::CoordinateSet);
  EXPECT_EQ(actionOf(98), CodeAction::ReturnToInitial);
  EXPECT_EQ(actionOf(32), CodeAction::Unclassified);
  chooseGCodeSystem(dialect, gCodeSystemNamed("C").value());
  EXPECT_EQ(actionOf(90), CodeAction::Absolute);
  EXPECT_EQ(actionOf(20), CodeAction::DiameterCycle);
  EXPECT_EQ(actionOf(70), CodeAction::Inch);
  EXPECT_EQ(actionOf(78), CodeAction::ThreadPasses);
  EXPECT_EQ(actionOf(79), CodeAction::Unclassified);
  EXPECT_FALSE(gCodeSystemNamed("D"));

  Dialect mill = dialectNamed("fanuc-0i");
  chooseGCodeSystem(mill, GCodeSystem::C);
  EXPECT_EQ(mill.switches.gCodeSystem, GCodeSystem::A);
  EXPECT_EQ(findGCode(mill, 200)->action, CodeAction::Inch);
}

TEST(Dialect, EveryGCodeSystemIsInOrder) {
  for (const Dialect *dialect : allDialects().dialects)
    for (const std::span<const Code> codes : dialect->gCodesOfSystem)
      for (std::size_t i = 0; i < codes.size(); ++i) {
        EXPECT_NE(codes[i].action, CodeAction::Unclassified) << codes[i].tenths;
        EXPECT_TRUE(i == 0 || codes[i - 1].tenths < codes[i].tenths) << codes[i].tenths;
      }
}

TEST(Dialect, CodeCallsComeFromTheSwitches) {
  Dialect dialect = dialectNamed("fanuc-30i");
  EXPECT_EQ(findCodeCall(dialect, 'M', 60), nullptr);
  dialect.switches.codeCalls.push_back({'M', 60, 9001, false});
  EXPECT_EQ(findCodeCall(dialect, 'M', 60)->program, 9001U);
  EXPECT_EQ(findCodeCall(dialect, 'G', 60), nullptr);
}

TEST(Dialect, NamesOfCodes) {
  EXPECT_EQ(codeNamed("g68.2", "GM"), (CodeName{'G', 682}));
  EXPECT_EQ(codeNamed("M06", "GM"), (CodeName{'M', 60}));
  for (const char *text : {"", "G", "T1", "G1.25", "G1.", "G-1", "G6000", "G12345", "G1A"})
    EXPECT_FALSE(codeNamed(text, "GM")) << text;
  EXPECT_EQ(textOf(CodeName{'G', 682}), "G68.2");
  EXPECT_EQ(textOf(CodeName{'M', 60}), "M6");
}

TEST(Dialect, CodesOfTheBuilderReplaceThoseOfTheControl) {
  Dialect dialect = dialectNamed("fanuc-30i");
  EXPECT_FALSE(hasGCode(dialect, 2290));
  EXPECT_TRUE(mayDoAnything(dialect, 'G', 2290));
  EXPECT_FALSE(mayDoAnything(dialect, 'M', 4620));
  dialect.switches.buildersCodes = {{'G', 50}, {'G', 2290}, {'M', 60}, {'M', 4620}};
  EXPECT_TRUE(hasGCode(dialect, 2290));
  for (const CodeName &code : dialect.switches.buildersCodes)
    EXPECT_TRUE(mayDoAnything(dialect, code.address, code.tenths)) << textOf(code);
  EXPECT_FALSE(findGCode(dialect, 50));
  EXPECT_FALSE(findMCode(dialect, 60));
  EXPECT_TRUE(findMCode(dialect, 300));
}

TEST(Words, AreSpelledAsInPrograms) {
  EXPECT_EQ(spellingOf(FunctionKind::Sqrt), "SQRT");
  EXPECT_EQ(spellingOf(OperatorKind::LessOrEqual), "LE");
  EXPECT_EQ(spellingOf(ControlWord::Dprnt), "DPRNT");
  EXPECT_EQ(spellingOf(OWordKind::EndWhile), "ENDWHILE");
}

} // namespace
} // namespace feedhold
