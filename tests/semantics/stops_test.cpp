// Each reason for which the semantics stops a run is seen by all three interpretations: the machine stops, the analysis
// of ranges foresees it, and there is an obligation that it does not come.
#include "dialects/registry.h"
#include "inference/absint/flow_facts.h"
#include "language/contract/contract.h"
#include "language/parse/parse.h"
#include "meaning/machine/machine.h"
#include "proof/prove/prove.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <set>
#include <sstream>

namespace feedhold::prove {
namespace {

struct Stop {
  AlarmKind kind;
  std::string_view name;
  const char *dialect;
  const char *text;
  Switch Switches::*setting = nullptr; // both outcomes, until the machine says so
  Switch value = Switch::On;
};
#define STOP(kind, ...)                                                                                                \
  { AlarmKind::kind, #kind, __VA_ARGS__ }

const std::vector<Stop> kStops = {
    STOP(ArcTooShort, "fanuc-30i", "O1\nG0G90G17X0Y0\nG2X10.R1.F5.\nM30\n"),
    STOP(ArcTooShort, "haas-ngc", "O1\nG0G90G17X0Y0\nG3X10.R-4.F5.\nM30\n"),
    STOP(ArcTooShort, "fanuc-30i", "O1\nG0G90G17G21X0Y0\nG2X10.R4.98F5.\nM30\n", &Switches::shortArcStops),
    STOP(ArcWithoutLength, "linuxcnc", "g21 g90 g17 g0 x0 y0\ng2 x0 y0 r5 f10\nm2\n"),
    STOP(ArcWithoutLength, "mitsubishi-m700", "O1\nG0G90G17X0Y0\nG2X0R5.F5.\nM30\n", &Switches::pointArcStops),
    STOP(ArcWithoutCentre, "fanuc-30i", "O1\nG0G90G17X0Y0\nG2X10.F5.\nM30\n"),
    STOP(ArcRadius, "fanuc-30i", "O1\nG0G90G17X0Y0\nG2X10.I3.F5.\nM30\n"),
    STOP(ArcRadius, "linuxcnc", "g21 g90 g17 g0 x0 y0\ng2 x10 i3 f10\nm2\n"),
    STOP(CornerTooLarge, "fanuc-30i", "O1\nG0G90G17X0Y0\nG1X4.,R5.F5.\nY40.\nM30\n"),
    STOP(LineBehindCornerTooShort, "fanuc-30i", "O1\nG0G90G17X0Y0\nG1X10.,R5.F5.\nY4.\nM30\n"),
    STOP(CornerTooLarge, "haas-ngc", "O1\nG0G90G17X0Y0\nG1X10.,C11.F5.\nY40.\nM30\n"),
    STOP(MachineIncrement, "linuxcnc", "g21 g91\ng53 g0 z1\nm2\n"),
    STOP(CycleWithoutLevel, "linuxcnc", "g21 g90 g17\ng81 x1 y1 r1 f10\nm2\n"),
    STOP(CycleWithoutLevel, "fanuc-30i", "O1\nG90G17G80\nG81X1.Z-1.F10\nM30\n", &Switches::bareCycleStops),
    STOP(ProgramAborted, "linuxcnc", "g21 g90\n(abort, no probe)\nm2\n"),
    STOP(RepeatedLabel, "linuxcnc", "g21 g90\no1 if [0]\no1 endif\no1 while [0]\no1 endwhile\nm2\n"),
    STOP(NoModalCall, "fanuc-30i", "O1\nG67\nM30\n", &Switches::g67, Switch::Off),
    STOP(Overflow, "fanuc-30i", "O1\n#1=EXP[800]\nM30\n"),
    STOP(Overflow, "fanuc-30i", "O1\n#1=EXP[-70]\nM30\n", &Switches::f16),
    STOP(DivideByZero, "fanuc-30i", "O1\n#1=1/0\nM30\n"),
    STOP(ArgumentOutOfDomain, "fanuc-30i", "O1\n#1=SQRT[-1]\nM30\n"),
    STOP(NoDataAfterAddress, "fanuc-30i", "O1\nG0X\nM30\n"),
    STOP(MissingDo, "fanuc-30i", "O1\nEND1\nM30\n"),
    STOP(MissingEnd, "fanuc-30i", "O1\nWHILE[1EQ1]DO1\nM30\n"),
    STOP(SequenceNotFound, "fanuc-30i", "O1\nGOTO77\nM30\n"),
    STOP(WriteProtected, "fanuc-30i", "O1\n#5001=1\nM30\n"),
    STOP(VariableNotAvailable, "fanuc-30i", "O1\n#1=#400\nM30\n"),
};

class Stops : public ::testing::TestWithParam<Stop> {
protected:
  /// The machine has the setting of the row; the analysis knows that of the dialect, and the proof finds it.
  void load(const Dialect &dialect) {
    source_.emplace(SourceFile::fromText("t.nc", GetParam().text));
    tree_.emplace(parse(*source_, dialect));
    model_.emplace(resolve(*source_, *tree_, dialect));
    set_.emplace(std::vector<ProgramFile>{{FileId(0), &*source_, &*tree_, &*model_, &dialect}},
                 CallGraph({{FileId(0), "", "", &*model_}}));
  }
  Callee main() const { return {FileId(0), set_->file(FileId(0)).cfg.entryOf(ProgramId(0)), ProgramId(0)}; }

  std::optional<SourceFile> source_;
  std::optional<SyntaxTree> tree_;
  std::optional<ProgramModel> model_;
  std::optional<ProgramSet> set_;
};

TEST_P(Stops, TheMachineStops) {
  Dialect machine = *findDialect(allDialects(), GetParam().dialect);
  if (GetParam().setting)
    machine.switches.*GetParam().setting = GetParam().value;
  load(machine);
  const RunResult result = run(*set_, main(), {});
  EXPECT_EQ(result.end, RunEnd::Alarm);
  EXPECT_EQ(result.alarm, GetParam().kind);
}

TEST_P(Stops, RangesForeseeIt) {
  load(*findDialect(allDialects(), GetParam().dialect));
  const FlowFacts facts = collectFacts(*set_, FileId(0), ProgramId(0), {}, nullptr);
  const auto &alarms = facts.alarms();
  const auto found =
      std::find_if(alarms.begin(), alarms.end(), [](const AlarmFact &alarm) { return alarm.kind == GetParam().kind; });
  ASSERT_NE(found, alarms.end());
  EXPECT_TRUE(!GetParam().setting || !found->always); // the control may as well go on
}

TEST_P(Stops, AnObligationAsksForIt) {
  load(*findDialect(allDialects(), GetParam().dialect));
  const auto rows = prove(*set_, main(), nullptr, {.guards = InferGuards::No}).obligations;
  const auto found =
      std::find_if(rows.begin(), rows.end(), [](const Obligation &row) { return row.alarm == GetParam().kind; });
  ASSERT_NE(found, rows.end());
  ASSERT_EQ(found->verdict, Verdict::Refuted);
  std::vector<std::pair<SwitchId, bool>> settings;
  const bool isOn = GetParam().value == Switch::On; // a witness names only what is not as usual
  if (const auto setting = GetParam().setting; setting && switchNames()[idOf(setting)].usual != isOn)
    settings.emplace_back(idOf(setting), isOn);
  EXPECT_EQ(found->verdict.witness()->variables.start.settings, settings);
}

INSTANTIATE_TEST_SUITE_P(All, Stops, ::testing::ValuesIn(kStops), [](const auto &instance) {
  return std::string(instance.param.name) + std::to_string(instance.index);
});

/// What is not in the list above: it needs several programs, or text that does not parse.
/// Those of cutter compensation come at a later block (tests/golden/run/cutter_alarms.md, verdicts/compensation.md).
constexpr std::array kElsewhere = {
    "CutterCompensation", "CutterPlane",       "CutterArc",       "CutterEntryTooShort", "CutterArcCentre",
    "CutterInterference", "CutterNoCrossing",  "ArgumentAddress", "GCodeNotUsable",      "IfFormat",
    "LoopNumber",         "MacroFormat",       "MacroNesting",    "ProgramNotFound",     "ReadProtected",
    "SequenceOutOfRange", "SubprogramNesting", "TooManyIjkSets"};

TEST(StopsOfTheSemantics, EachHasAProgram) {
  std::set<std::string, std::less<>> known(kElsewhere.begin(), kElsewhere.end());
  for (const Stop &stop : kStops)
    known.emplace(stop.name);
  for (const auto &entry : std::filesystem::directory_iterator(FEEDHOLD_ROOT "/analyzer/meaning/semantics")) {
    std::stringstream text;
    text << std::ifstream(entry.path()).rdbuf();
    const std::string all = text.str();
    constexpr std::string_view kPrefix = "AlarmKind::";
    for (std::size_t at = all.find(kPrefix); at != std::string::npos; at = all.find(kPrefix, at + 1)) {
      const std::size_t begin = at + kPrefix.size();
      const std::size_t end = std::find_if_not(all.begin() + static_cast<std::ptrdiff_t>(begin), all.end(),
                                               [](unsigned char c) { return std::isalnum(c) != 0; }) -
                              all.begin();
      const std::string name = all.substr(begin, end - begin);
      EXPECT_TRUE(known.contains(name)) << name << " in " << entry.path();
    }
  }
}

} // namespace
} // namespace feedhold::prove
