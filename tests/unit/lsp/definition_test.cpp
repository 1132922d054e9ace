#include "feature_fixture.h"

namespace feedhold::lsp {
namespace {

constexpr std::string_view kTwo = "%\n"
                                  "O1000(Ä \xF0\x9F\x98\x80)\n" // two units of UTF-16
                                  "N10 #1=5. (\xC3\x84)\n"
                                  "(\xF0\x9F\x98\x80\xC3\xA4)IF[#1GT3]GOTO10\n"
                                  "GOTO#1\n"
                                  "M98P2000\n"
                                  "M30\n"
                                  "O2000\n"
                                  "N10 G01X#1\n"
                                  "WHILE[#1LT3]DO1\n"
                                  "#1=#1+1\n"
                                  "END1\n"
                                  "GOTO10\n"
                                  "GOTO99\n"
                                  "M99\n"
                                  "%\n";

class LspDefinition : public FeatureTest {
protected:
  Strings from(const View &view, std::string_view what, std::size_t in = 0) const {
    return shown(view, askAt(view, "textDocument/definition", what, in));
  }
  Strings references(const View &view, std::string_view what, std::size_t in = 0) const {
    return shown(view, askAt(view, "textDocument/references", what, in));
  }
};

TEST_F(LspDefinition, AJumpLeadsToTheNumberOfItsOwnProgram) {
  const View view = openText(kTwo);
  EXPECT_EQ(from(view, "GOTO10\nGOTO#"), (Strings{"3:N10 #1=5. (Ä)"})); // behind four units in six bytes
  EXPECT_EQ(from(view, "GOTO10\nGOTO99", 4), (Strings{"9:N10 G01X#1"}));
  EXPECT_TRUE(askAt(view, "textDocument/definition", "GOTO99").is_null());
  EXPECT_TRUE(askAt(view, "textDocument/definition", "M30").is_null());
  EXPECT_TRUE(askAt(view, "textDocument/definition", "%").is_null());
}

TEST_F(LspDefinition, ACallLeadsToItsProgram) {
  const View view = openText(kTwo);
  EXPECT_EQ(from(view, "P2000", 2), (Strings{"8:O2000"}));
  EXPECT_EQ(from(view, "M98"), (Strings{"8:O2000"}));
  EXPECT_EQ(references(view, "O2000"), (Strings{"6:P2000", "8:O2000"}));
}

TEST_F(LspDefinition, ACallLeadsIntoAnotherFile) {
  write("O9100.nc", "%\nO9100(SLOT)\n(@PARAM #21 DEPTH 0.5..50. MM)\nG01Z-#21\nM99\n%\n");
  const View view = openText("%\nO1\nG65P9100U3.\nG65P9200\nG65P#1\nM30\n%\n");
  EXPECT_EQ(from(view, "P9100"), (Strings{"O9100.nc:2:O9100"}));
  EXPECT_EQ(from(view, "U3"), (Strings{"3:U3.", "O9100.nc:3:#21"}));
  EXPECT_TRUE(askAt(view, "textDocument/definition", "P9200").is_null());
  EXPECT_TRUE(askAt(view, "textDocument/definition", "G65P#1").is_null());
}

TEST_F(LspDefinition, AVariableLeadsToItsAssignmentsInItsScope) {
  const View view = openText(kTwo);
  EXPECT_EQ(from(view, "#1GT3"), (Strings{"3:#1"}));
  EXPECT_EQ(from(view, "#1LT3"), (Strings{"11:#1"}));
  EXPECT_EQ(references(view, "#1LT3"), (Strings{"9:#1", "10:#1", "11:#1", "11:#1"}));
}

TEST_F(LspDefinition, CallersGiveArgumentsTheirValues) {
  write("main.nc", "%\nO7\nG65P9100A5.\nM30\n%\n");
  EXPECT_EQ(from(openText("%\nO9100\nG01X#1\nM99\n%\n"), "#1"), (Strings{"main.nc:3:A5."}));
}

TEST_F(LspDefinition, AFileInAnotherEncodingIsCountedAsItIsDecoded) {
  write("O9100.nc", "%\nO9100\n(M\xD6GLICHE H\xD6HE)#510=1.\nM99\n%\n"); // Latin-1
  const View view = openText("%\nO1\nG65P9100\n#1=#510\nM30\n%\n");
  const Json found = askAt(view, "textDocument/definition", "#510");
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0]["range"]["start"], (Json{{"line", 2}, {"character", 15}}));
}

TEST_F(LspDefinition, TheEndsOfALoopLeadToEachOther) {
  const View view = openText(kTwo);
  EXPECT_EQ(from(view, "END1"), (Strings{"10:WHILE[#1LT3]DO1"}));
  EXPECT_EQ(from(view, "DO1"), (Strings{"12:END1"}));
}

} // namespace
} // namespace feedhold::lsp
