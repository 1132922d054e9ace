// What is shown of a whole document: outline, folds, tokens, call hierarchy, symbols of the folder.
#include "feature_fixture.h"

namespace feedhold::lsp {
namespace {

constexpr std::string_view kTwoOutlines = "%\n"
                                          "(ONE)\n"
                                          "(TWO)\n"
                                          "O1(\xF0\x9F\x98\x80 PART)\n"
                                          "N10#1=0\n"
                                          "WHILE[#1LT3]DO1\n"
                                          "N20#1=#1+1\n"
                                          "END1\n"
                                          "M98P2\n"
                                          "M30\n"
                                          "O2\n"
                                          "M99\n"
                                          "%\n";

class LspOutline : public FeatureTest {
protected:
  static std::string outline(const Json &symbols, const std::string &indent = "") {
    std::string text;
    for (const Json &each : symbols)
      text += indent + each["name"].get<std::string>() + "\n" +
              outline(each.value("children", Json::array()), indent + "  ");
    return text;
  }
  static Strings folds(const View &view) {
    Strings found;
    for (const Json &each : ask(view, "textDocument/foldingRange", {}))
      found.push_back(std::to_string(each["startLine"].get<int>() + 1) + "-" +
                      std::to_string(each["endLine"].get<int>() + 1) + " " + each["kind"].get<std::string>());
    return found;
  }
};

TEST_F(LspOutline, ProgramsHoldTheirNumbersAndLoops) {
  const View view = openText(kTwoOutlines);
  const Json symbols = ask(view, "textDocument/documentSymbol", {});
  EXPECT_EQ(outline(symbols), "O1\n  N10\n  WHILE[#1LT3]DO1\n    N20\nO2\n");
  EXPECT_EQ(symbols[0]["detail"], "\xF0\x9F\x98\x80 PART");
  EXPECT_TRUE(ask(openText("%\n%\n"), "textDocument/documentSymbol", {}).is_array());
  EXPECT_EQ(outline(ask(openText("o<cut> sub\no1 if [#1 GT 0]\no1 endif\no<cut> endsub\nM2\n", "linuxcnc"),
                        "textDocument/documentSymbol", {})),
            "unnamed program\n  o<cut>\n    o1 if [#1 GT 0]\n");
}

TEST_F(LspOutline, FoldsOfProgramsLoopsBranchesAndComments) {
  EXPECT_EQ(folds(openText(kTwoOutlines)), (Strings{"4-10 region", "11-13 region", "6-8 region", "2-3 comment"}));
  EXPECT_EQ(folds(openText("O1\nIF[#1EQ0]THEN\n#1=1\nELSE\n#1=2\nENDIF\nM30\n", "mitsubishi-m700")),
            (Strings{"1-7 region", "2-6 region"}));
  EXPECT_EQ(folds(openText("O1\n")), (Strings{}));
  EXPECT_EQ(folds(openText("O1\nIF[#1EQ0]THEN\nM30\nO2\nENDIF\nM30\n", "mitsubishi-m700")), // one is not closed
            (Strings{"1-3 region", "4-6 region"}));
}

TEST_F(LspOutline, ProgramsOfTheFolderAreFoundByNumberAndTitle) {
  write("O9100.nc", "%\nO9100(SLOT)\nM99\n%\n");
  const View view = openText("%\nO1(PART)\nG65P9100\nM30\n%\n");
  const auto names = [&](const char *query) {
    Strings found;
    for (const Json &each : ask(view, "workspace/symbol", {{"query", query}}))
      found.push_back(each["name"].get<std::string>());
    return found;
  };
  EXPECT_EQ(names("slo"), (Strings{"O9100 (SLOT)"}));
  EXPECT_EQ(names(""), (Strings{"O1 (PART)", "O9100 (SLOT)"}));
  EXPECT_EQ(names("zzz"), (Strings{}));
}

TEST_F(LspOutline, ProgramsOfTheFolderAreFoundFromOneThatCallsNothing) {
  write("O9100.nc", "%\nO9100(SLOT)\nM99\n%\n");
  EXPECT_EQ(ask(openText("%\nO1\nM30\n%\n"), "workspace/symbol", {{"query", "slot"}}).size(), 1U);
}

TEST_F(LspOutline, CallsBothWays) {
  write("O9100.nc", "%\nO9100(SLOT)\nM98P2\nM99\n%\n");
  const View view = openText("%\nO1\nG65P9100\nM98P2\nM98P2\nM30\nO2\nM99\n%\n");
  const Json item = askAt(view, "textDocument/prepareCallHierarchy", "P9100").at(0);
  EXPECT_EQ(item["name"], "O9100");
  EXPECT_EQ(item["uri"], uri("O9100.nc"));
  const Json outgoing = ask(view, "callHierarchy/outgoingCalls", {{"item", item}});
  ASSERT_EQ(outgoing.size(), 1U);
  EXPECT_EQ(outgoing[0]["to"]["name"], "O2");
  const Json incoming = ask(view, "callHierarchy/incomingCalls", {{"item", outgoing[0]["to"]}});
  ASSERT_EQ(incoming.size(), 2U);
  EXPECT_EQ(incoming[0]["from"]["name"], "O1");
  EXPECT_EQ(incoming[0]["fromRanges"].size(), 2U);
  EXPECT_EQ(incoming[1]["from"]["name"], "O9100");
  EXPECT_TRUE(askAt(view, "textDocument/prepareCallHierarchy", "M30").is_null());
}

TEST_F(LspOutline, CallersAreFoundFromAMacroThatCallsNothing) {
  write("main.nc", "%\nO1\nG65P9100A1.\nM30\n%\n");
  const View view = openText("%\nO9100\nG00X#1\nM99\n%\n");
  const Json item = askAt(view, "textDocument/prepareCallHierarchy", "O9100").at(0);
  const Json incoming = ask(view, "callHierarchy/incomingCalls", {{"item", item}});
  ASSERT_EQ(incoming.size(), 1U);
  EXPECT_EQ(incoming[0]["from"]["uri"], uri("main.nc"));
  EXPECT_EQ(shown(view, askAt(view, "textDocument/references", "#1")), (Strings{"3:#1", "main.nc:3:A1."}));
}

TEST_F(LspOutline, TokensAreCountedInUnitsOfTheClient) {
  const View view = openText("(\xF0\x9F\x98\x80)G01X#1\nGOTO10\n#3000=1(@X)\n");
  const Json data = ask(view, "textDocument/semanticTokens/full", {})["data"];
  const auto types = featureCapabilities()["semanticTokensProvider"]["legend"]["tokenTypes"];
  ASSERT_EQ(data.size() % 5, 0U);
  std::string text;
  for (std::size_t i = 0; i < data.size(); i += 5)
    text += data[i].dump() + "+" + data[i + 1].dump() + ":" + data[i + 2].dump() + " " +
            types[data[i + 3].get<std::size_t>()].get<std::string>() + " " + data[i + 4].dump() + "\n";
  EXPECT_EQ(text, "0+0:4 comment 0\n0+4:3 method 0\n0+3:1 property 0\n0+1:2 parameter 0\n"
                  "1+0:4 keyword 0\n0+4:2 label 0\n"
                  "1+0:5 variable 2\n0+6:1 number 0\n");
}

} // namespace
} // namespace feedhold::lsp
