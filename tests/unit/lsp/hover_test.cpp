#include "feature_fixture.h"

namespace feedhold::lsp {
namespace {

class LspHover : public FeatureTest {
protected:
  static std::string at(const View &view, std::string_view what, std::size_t in = 0) {
    const Json answer = askAt(view, "textDocument/hover", what, in);
    return answer.is_null() ? "" : answer["contents"]["value"].get<std::string>();
  }
  static void expectIn(const std::string &text, std::string_view part) {
    EXPECT_NE(text.find(part), std::string::npos) << "`" << part << "` is missing in:\n" << text;
  }
};

constexpr std::string_view kSlot = "%\n"
                                   "O9100(SLOT)\n"
                                   "(@PARAM #21 DEPTH 0.5..50. MM)\n"
                                   "(W = STEP \xC3\x84)\n"
                                   "#10=0(DONE)\n"
                                   "N30WHILE[#10LT7]DO1\n"
                                   "#10=#10+1\n"
                                   "END1\n"
                                   "G91G01Z-#21F#23\n"
                                   "G00X#10\n"
                                   "GOTO99\n"
                                   "GOTO#10\n"
                                   "M99\n"
                                   "%\n";

TEST_F(LspHover, AVariableHasAMeaningAndARange) {
  const View view = openText(kSlot);
  expectIn(at(view, "#21F"), "**#21** DEPTH (local variable, argument U)");
  expectIn(at(view, "#21F"), "`@PARAM #21 DEPTH 0.5..50. MM`");
  expectIn(at(view, "#23"), "**#23** STEP \xC3\x84 (");
  expectIn(at(view, "#10LT"), "**#10** DONE");
  expectIn(at(view, "#10+1"), "before this line, assuming the contract: 0 to 6, whole");
  expectIn(at(view, "#10\nGOTO99"), "before this line, assuming the contract: 7");
}

TEST_F(LspHover, ValuesOfSeveralCallsAreToldApart) {
  const View view = openText("O1\nG65P2A1.\nG65P2A5.\nM30\nO2\nG00X#1\nM99\n");
  const std::string text = at(view, "#1\n");
  expectIn(text, "1 (called in line 2)");
  expectIn(text, "5 (called in line 3)");
}

TEST_F(LspHover, VacancyAndWhatIsNeverReached) {
  EXPECT_EQ(at(openText("O1\n#100=#0\n#101=#100\nM30\n"), "#100\nM30").find("before this line: vacant") !=
                std::string::npos,
            true);
  expectIn(at(openText("O1\nM30\n#101=#100\n"), "#100"), "this line is unreachable");
}

TEST_F(LspHover, ValuesAreThoseThatTheContractAllows) {
  constexpr std::string_view kText = "O1\n(@PARAM #1 N 1..9 INT)\n(@PARAM #2 D 0..5 OPTIONAL)\n(@MODAL G91)\n"
                                     "#10=#1\n#11=#2\nG90X0\nM98P2\nM30\nO2\n#12=#1+0\nM99\n";
  const View view = openText(kText);
  expectIn(at(view, "#1\n#11"), "before this line, assuming the contract: 1 to 9, whole");
  expectIn(at(view, "#2\nG90"), "vacant or 0 to 5");
  expectIn(at(view, "G90"), "before this line, assuming the contract: G91");
  expectIn(at(view, "#1+0"), "before this line, assuming the contract of O1: 1 to 9, whole");
  expectIn(at(openText("O1\n#10=#1\nM30\n"), "#1\n"), "before this line: as at start");
}

TEST_F(LspHover, AHavockedVariableIsNotAsAtTheStart) {
  expectIn(at(openText("O1\nG65P77\n#1=#500\nM30\n"), "#500"), "before this line: unknown");
}

TEST_F(LspHover, TheFlowIsThatOfTheText) {
  View view = openText("O1\n#1=1\n#2=#1\nM30\n");
  expectIn(at(view, "#1\nM30"), "before this line: 1");
  View changed = openText("O1\n#1=2\n#2=#1\nM30\n");
  changed.flow = view.flow;
  expectIn(at(changed, "#1\nM30"), "before this line: 2");
}

TEST_F(LspHover, WordsOfCommentsAreShownAsTheyAre) {
  const View view = openText("O1(A*B* <C>)\n(#1 = P_Q_)\n(T-SLOT)\n#20=#1\nM30\n");
  expectIn(at(view, "O1"), "**O1** A\\*B\\* \\<C\\>");
  expectIn(at(view, "#1\n"), "**#1** P\\_Q\\_");
  EXPECT_EQ(at(view, "#20").find("SLOT"), std::string::npos) << "a hyphen is no sign between letter and name";
}

TEST_F(LspHover, CallersOfAMacroThatCallsNothingAreSeen) {
  write("feedhold.toml", "[switches]\nsqc = true\n"); // M98 starts at its Q
  write("main.nc", "%\nO7\nG65P1\nG65P1\nM98P1Q30\nM30\n%\n");
  const View view = openText("O1\nN30G00X0\nM99\n");
  expectIn(at(view, "O1"), "called from 3 places in the project");
  expectIn(at(view, "N30"), "target of the jump in main.nc:5");
}

TEST_F(LspHover, ACallWithoutAnythingBehindIt) {
  const View view = openText("o<cut> sub\no<cut> endsub\no<cut> call", "linuxcnc");
  expectIn(at(view, "o<cut> call"), "**o<cut>**");
}

TEST_F(LspHover, ASystemVariableIsOfTheControl) {
  const View view = openText("O1\n#3000=1(BAD \xC3\x84)\n#5221=0\nM30\n");
  expectIn(at(view, "#3000"), "`_ALM` macro alarm, write-only");
  EXPECT_EQ(at(view, "#3000").find("BAD"), std::string::npos);
  expectIn(at(view, "#5221"), "work offset of G54");
  expectIn(at(openText("O1\n#4999=1\nM30\n"), "#4999"), "does not exist on");
}

TEST_F(LspHover, ACodeDependsOnTheControl) {
  expectIn(at(openText("O1\nG91\nG90X0\nM30\n"), "G90"), "modal group 3: distance\n\nbefore this line: G91");
  const std::string_view text = "O1\nG12I5.F100\nM30\n";
  expectIn(at(openText(text, "haas-ngc"), "G12"), "**G12** ");
  EXPECT_NE(at(openText(text, "haas-ngc"), "G12"), at(openText(text, "fanuc-30i"), "G12"));
  expectIn(at(openText("O1\nM77\nM30\n"), "M77"), "defined by the machine builder");
  expectIn(at(openText("O1\nG#1\nM30\n"), "G#1"), "computed");
}

TEST_F(LspHover, JumpsAndCallsSayWhereTheyLead) {
  write("O9100.nc", kSlot);
  const View view = openText("O1\nG65P9100U3.\nG65P#1\nG65P77\nN5GOTO5\nM30\n");
  expectIn(at(view, "P9100"), "**O9100** SLOT\n\nin `O9100.nc`");
  expectIn(at(view, "U3"), "O9100: DEPTH");
  expectIn(at(view, "P#1"), "the program number is computed");
  expectIn(at(view, "P77"), "no file of the project contains O77");
  expectIn(at(view, "GOTO5"), "jumps to **N5** in line 5 of O1");
  expectIn(at(view, "N5"), "target of the jump in line 5");
  const View slot = open("O9100.nc");
  expectIn(at(slot, "GOTO99"), "N99 does not exist");
  expectIn(at(slot, "GOTO#10"), "the jump target is computed");
  expectIn(at(slot, "N30"), "no jump to this block");
  expectIn(at(slot, "@PARAM"), "an argument and its local variable");
  expectIn(at(slot, "END1"), "loop from line 6 to line 8");
}

TEST_F(LspHover, ANumberOfSeveralProgramsIsNotMissing) {
  const View view = openText("O1\nG65P2\nM30\nO2\nM99\nO2\nM99\n");
  expectIn(at(view, "P2"), "the project contains several programs O2");
}

TEST_F(LspHover, NothingIsNull) {
  const View view = openText(kSlot);
  EXPECT_TRUE(askAt(view, "textDocument/hover", "%").is_null());
  EXPECT_TRUE(askAt(view, "textDocument/hover", "(SLOT", 2).is_null());
}

} // namespace
} // namespace feedhold::lsp
