// What a block leaves out of the two axes of the plane, under G16 and under G68: a run comes to the place that the
// manuals say, ranges contain it, and a proof shows it; where the manuals differ or say nothing, no proof does.
#include "semantics/language_sample.h"

#include <fmt/format.h>

namespace feedhold {
namespace {

struct Case {
  std::string_view name;
  std::string_view blocks;
  std::array<double, 2> end = {}; // X and Y
};

const std::vector<Case> kFollowed = {
    // FANUC operator's manual, polar coordinate command: the bolt hole circle and its form by increments.
    {"Angle", "G16\nG81X100.Y30.Z-20.R-5.F200.\nY150.\nY270.", {0, -100}},
    {"AngleByIncrement", "G16\nG81X100.Y30.Z-20.R-5.F200.\nG91Y120.\nY120.", {0, -100}},
    {"Repeated", "G16\nG81X100.Y0Z-20.R-5.F200.\nG91Y45.K2", {0, 100}},
    {"Radius", "G16\nG0X100.Y90.\nX50.", {0, 50}},
    {"OtherAxis", "G16\nG0X100.Y90.\nZ5.\nG91Z1.\nG90Y180.", {-100, 0}},
    {"VacantWord", "G16\n#9=#0\nG0X100.Y90.\nX#9Y180.", {-100, 0}},
    {"Radius0", "G16\nG0X0Y90.\nX10.Y0", {10, 0}},
    {"ShiftBeside", "G16\nG0X10.Y90.\nG52Z5.\nY0", {10, 0}},
    {"InSubprogram", "G16\nG0X10.Y90.\nM98P2", {-10, 0}},
    {"InLoop", "G16\n#1=0\nG0X10.Y0\nWHILE[#1LT4]DO1\n#1=#1+1\nY[#1*45]\nEND1", {-10, 0}},
    {"RotatedX", "G68X0Y0R#9\nG0X10.Y0\nX20.", {0, 20}},
    {"RotatedY", "G68X5.Y0R#9\nG0X15.Y0\nY10.", {-5, 10}},
    {"RotatedThere", "G68X0Y0R#9\nG0X10.Y3.\nZ1.\nX20.\nG91Y2.\nG90X30.", {-5, 30}},
    {"RotatedByZero", "G68X0Y0R[#9-#9]\nG0X10.Y3.\nX20.", {20, 3}},
};
const std::vector<Case> kNotFollowed = {
    {"AtFirst", "G0X10.Y0\nG16\nY90."},
    {"MachineMove", "G16\nG0X10.Y90.\nG53X10.\nY0"},
    {"ReferenceReturn", "G16\nG0X10.Y90.\nG28X10.Y90.\nY0"},
    {"PointOnTheWay", "G16\nG0X10.Y90.\nG91G28Y0"},
    {"Skip", "G16\nG0X10.Y90.\nG31X20.Y90.\nY0"},
    {"LocalZero", "G16\nG0X10.Y90.\nG52X5.\nY0"},
    {"ZeroOfSystem", "G16\nG0X10.Y90.\n#5221=#5221+3\nY0"},
    {"OtherSystem", "#5241=#5221+5\nG16\nG0X10.Y90.\nG55\nY0"},
    {"SetCoordinate", "G16\nG0X10.Y90.\nG92X1.\nY0"},
    {"OffAndOn", "G16\nG0X10.Y90.\nG15\nG16\nY0"},
    {"OtherPlane", "G16\nG0X10.Y90.\nG18\nG17\nY0"},
    {"OtherUnits", "G16\nG0X10.Y90.\nG20\nY0"},
    {"BelowZero", "G16\nG0X-10.Y90.\nY0"},
    {"RadiusByIncrement", "G16\nG0X10.Y90.\nG91X10.Y0"},
    {"BehindThat", "G16\nG0X10.Y90.\nG91X10.Y0\nG90Y90."},
    {"UnderRotation", "G68X0Y0R90.\nG16\nG0X10.Y90.\nY0"},
    {"BehindRotation", "G16\nG0X10.Y90.\nG68X0Y0R90.\nY0"},
};

std::string textOf(const Case &each, double x, double y) {
  return fmt::format("O1\nG15G17G21G40G49G50G50.1G54G69G80G90G94\n#9=90\nG0X1.Y1.Z1.\n{}\n#101=#5001\n#102=#5002\n"
                     "IF[ABS[#101-[{}]]GT.01]GOTO8\nIF[ABS[#102-[{}]]LE.01]GOTO9\nN8#3000=1\nN9M30\n",
                     each.blocks, x, y);
}
constexpr const char *kSubprogram = "O2\nY180.\nM99\n";

const Dialect &dialect() { return *findDialect(allDialects(), "fanuc-30i"); }
class WordsThatAreKept : public ::testing::TestWithParam<Case> {};
class WordsThatAreNot : public ::testing::TestWithParam<Case> {};

TEST_P(WordsThatAreKept, LeadWhereTheManualsSay) {
  const auto &end = GetParam().end;
  const LanguageSample sample(dialect(), {textOf(GetParam(), end[0], end[1]), kSubprogram});
  const RunResult result = sample.run();
  EXPECT_EQ(result.end, RunEnd::M30);
  EXPECT_FALSE(result.isLost);
  for (std::size_t i = 0; i < 2; ++i) {
    const auto variable = static_cast<std::uint32_t>(101 + i);
    EXPECT_NEAR(result.state.variables.find(variable)->number, end[i], 1e-6);
    const auto range = sample.valueBefore("N9", variable);
    ASSERT_TRUE(range);
    EXPECT_TRUE(range->number().contains(result.state.variables.find(variable)->number));
  }
  const auto verdict = sample.userAlarm();
  EXPECT_TRUE(!verdict || holds(*verdict));
}

/// Neither shown nor refuted: the run that would break it has lost its position.
TEST_P(WordsThatAreNot, ProveNothing) {
  for (const auto &[x, y] : {std::pair{10, 0}, std::pair{0, 10}, std::pair{-10, 0}, std::pair{500, 500}}) {
    const LanguageSample sample(dialect(), {textOf(GetParam(), x, y), kSubprogram});
    EXPECT_FALSE(sample.run().notes.empty());
    const auto verdict = sample.userAlarm();
    ASSERT_TRUE(verdict);
    EXPECT_FALSE(holds(*verdict));
    EXPECT_FALSE(verdict->kind() == prove::Verdict::Refuted);
    for (const std::uint32_t variable : {101U, 102U}) {
      const auto range = sample.valueBefore("N9", variable); // behind a test that holds near the place
      EXPECT_TRUE(!range || range->number().contains(variable == 101 ? x : y));
    }
  }
}

std::string nameOf(const ::testing::TestParamInfo<Case> &each) { return std::string(each.param.name); }
INSTANTIATE_TEST_SUITE_P(All, WordsThatAreKept, ::testing::ValuesIn(kFollowed), nameOf);
INSTANTIATE_TEST_SUITE_P(All, WordsThatAreNot, ::testing::ValuesIn(kNotFollowed), nameOf);

} // namespace
} // namespace feedhold
