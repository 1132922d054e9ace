// Names are changed by applying the edits to the texts, which are then read anew and compared.
#include "feature_fixture.h"

#include "language/parse/parse.h"

#include <sstream>

namespace feedhold::lsp {
namespace {

class LspRename : public FeatureTest {
protected:
  /// The texts of all files behind the edits, by name.
  std::map<std::string, std::string> applied(const Json &workspaceEdit) const {
    std::map<std::string, std::string> texts;
    for (const auto &[uri, edits] : workspaceEdit.at("changes").items()) {
      const std::filesystem::path path = pathOfUri(uri);
      std::ostringstream text;
      text << std::ifstream(path, std::ios::binary).rdbuf();
      const SourceFile source = SourceFile::fromText("x", text.str());
      const Places places(source, PositionEncoding::Utf16);
      std::vector<std::pair<Span, std::string>> sorted;
      for (const Json &edit : edits)
        sorted.emplace_back(places.span(edit.at("range")), edit.at("newText").get<std::string>());
      std::sort(sorted.rbegin(), sorted.rend());
      std::string changed = text.str();
      for (const auto &[span, with] : sorted)
        changed.replace(span.begin, span.size(), with);
      texts[path.filename().string()] = changed;
    }
    return texts;
  }
  Json rename(const View &view, std::string_view what, const std::string &to, std::size_t in = 0) const {
    return askAt(view, "textDocument/rename", what, in, {{"newName", to}});
  }
  std::string renamed(const View &view, std::string_view what, const std::string &to, std::size_t in = 0) const {
    return applied(rename(view, what, to, in)).at("part.nc");
  }
  template <typename Act> static std::string refusal(Act act) {
    try {
      act();
    } catch (const Refused &refused) {
      return refused.what();
    }
    return "";
  }
  std::string refused(const View &view, std::string_view what, const std::string &to, std::size_t in = 0) const {
    return refusal([&] { rename(view, what, to, in); });
  }
  /// Which block each jump reaches.
  static std::vector<std::pair<std::uint32_t, std::optional<std::uint32_t>>> jumps(const std::string &text,
                                                                                   const Dialect &dialect) {
    const SourceFile source = SourceFile::fromText("part.nc", text);
    const SyntaxTree tree = parse(source, dialect);
    const ProgramModel model = resolve(source, tree, dialect);
    std::vector<std::pair<std::uint32_t, std::optional<std::uint32_t>>> found;
    for (const Jump &jump : model.jumps)
      found.emplace_back(jump.block.index(), jump.target ? std::optional(jump.target->index()) : std::nullopt);
    return found;
  }
};

constexpr std::string_view kJumps = "%\n"
                                    "O1(\xF0\x9F\x98\x80)\n"
                                    "#1=0\n"
                                    "(\xF0\x9F\x98\x80\xC3\xA4)N10#1=#1+1\n"
                                    "IF[#1LT5]GOTO10\n"
                                    "IF[#1LT9]GOTO 7\n"
                                    "M99P10\n"
                                    "N7M30\n"
                                    "O2\n"
                                    "N10G04X1.\n"
                                    "GOTO10\n"
                                    "M99\n"
                                    "%\n";

TEST_F(LspRename, ASequenceNumberTakesItsJumpsAlong) {
  const View view = openText(kJumps);
  const std::string text = renamed(view, "GOTO10", "N120");
  EXPECT_NE(text.find("N120#1=#1+1\nIF[#1LT5]GOTO120\n"), std::string::npos) << text;
  EXPECT_NE(text.find("M99P120\nN7M30"), std::string::npos) << text;
  EXPECT_NE(text.find("N10G04X1.\nGOTO10\n"), std::string::npos) << "the other program keeps its number";
  EXPECT_EQ(jumps(text, view.programs->dialect()), jumps(std::string(kJumps), view.programs->dialect()));
  EXPECT_EQ(renamed(view, "N10#1", "120"), text);
}

TEST_F(LspRename, PrepareNamesThePlace) {
  const View view = openText(kJumps);
  const Json at = askAt(view, "textDocument/prepareRename", "N10#1");
  EXPECT_EQ(at["placeholder"], "N10");
  EXPECT_EQ(at["range"]["start"], (Json{{"line", 3}, {"character", 5}})); // ( 2+1 )
  EXPECT_NE(refusal([&] { askAt(view, "textDocument/prepareRename", "M30"); }).find("only sequence numbers"),
            std::string::npos);
}

TEST_F(LspRename, ATakenOrUnknownNumberIsRefused) {
  const View view = openText(kJumps);
  EXPECT_NE(refused(view, "N10#1", "7").find("N7 is already in use: line"), std::string::npos);
  EXPECT_NE(refused(view, "N10#1", "seven").find("is not a sequence number"), std::string::npos);
  EXPECT_NE(refused(view, "N10#1", "100000000").find("range from 1 to"), std::string::npos);
  EXPECT_NE(refused(view, "N10#1", "0").find("range from 1 to"), std::string::npos);
  EXPECT_NE(refused(openText("O1\nGOTO5\nN6M30\n"), "N6", "5").find("N5 is already in use: line 2"), std::string::npos);
  EXPECT_NE(refused(openText("O1\nGOTO5\nN6M30\n"), "GOTO5", "8").find("O1 has no N5"), std::string::npos);
}

TEST_F(LspRename, AComputedJumpMayMeanAnyNumber) {
  EXPECT_NE(refused(openText("O1\nN5G00X#1\nGOTO#1\nM30\n"), "N5", "6").find("jump in line 3 computes"),
            std::string::npos);
  EXPECT_NE(refused(openText("O1\nN5G00X0\nG65H80P5\nM30\n"), "N5", "6").find("G65 H.. in line 3"), std::string::npos);
  EXPECT_EQ(refused(openText("O1\nN5G00X0\nM30\nO2\nGOTO#1\nM30\n"), "N5", "6"), "") << "in another program";
}

TEST_F(LspRename, AReturnToANumberFollowsIntoTheCalledFile) {
  write("O9100.nc", "%\nO9100\nM99P40\n%\n");
  const View view = openText("%\nO1\nM98P9100\nM00\nN40M30\n%\n");
  const auto texts = applied(rename(view, "N40", "50"));
  EXPECT_EQ(texts.at("part.nc"), "%\nO1\nM98P9100\nM00\nN50M30\n%\n");
  EXPECT_EQ(texts.at("O9100.nc"), "%\nO9100\nM99P50\n%\n");
  write("O2.nc", "%\nO2\nM98P9100\nN40M30\n%\n");
  EXPECT_NE(refused(open("part.nc"), "N40", "50").find("returns to N40 in several programs"), std::string::npos);
}

TEST_F(LspRename, AContractBesideNamesTheNumberToo) {
  write("part.contract", "@PARAM #1 WIDTH 1..9\n@AT N30 INVARIANT #10 GE 0\n");
  const View view = openText("%\nO1\n#10=0\nN30WHILE[#10LT#1]DO1\n#10=#10+1\nEND1\nM99\n%\n");
  EXPECT_EQ(applied(rename(view, "N30", "35")).at("part.contract"),
            "@PARAM #1 WIDTH 1..9\n@AT N35 INVARIANT #10 GE 0\n");
  EXPECT_EQ(applied(rename(view, "#10=0", "#12")).at("part.contract"),
            "@PARAM #1 WIDTH 1..9\n@AT N30 INVARIANT #12 GE 0\n");
}

TEST_F(LspRename, LocalVariablesStayInTheirProgram) {
  const std::string one = "O1\n#30=1\n(@INVARIANT #30 GE 0)\nWHILE[#30LT5]DO1\n#030=#30+1\nEND1\nM30\n";
  const View view = openText(one + "O2\n#30=2\nM30\n");
  EXPECT_EQ(renamed(view, "#30LT", "31"),
            "O1\n#31=1\n(@INVARIANT #31 GE 0)\nWHILE[#31LT5]DO1\n#31=#31+1\nEND1\nM30\nO2\n#30=2\nM30\n");
  EXPECT_NE(refused(view, "#30LT", "#100").find("is common variable"), std::string::npos);
  EXPECT_NE(refused(openText("O1\n#2=1\n#3=#2\nM30\n"), "#2", "3").find("`#3` is already in use in line 3"),
            std::string::npos);
}

TEST_F(LspRename, WhatACallerPassesIsRefused) {
  EXPECT_NE(refused(openText("O1\nG00X#1\nM99\n"), "#1", "2").find("(argument A) may hold an argument of the call"),
            std::string::npos);
  EXPECT_NE(refused(openText("O1\nIF[#2EQ0]GOTO5\n#1=2\nN5G00X#1\nM99\n"), "#1", "3")
                .find("may hold an argument of the call"),
            std::string::npos)
      << "the jump passes by its assignment";
  EXPECT_EQ(refused(openText("O1\n#1=2\nG00X#1\nM99\n"), "#1", "3"), "");
  EXPECT_NE(refused(openText("O1\n#1=2\nM98P2\nM30\nO2\nG00X#1\nM99\n"), "#1", "3").find("the same local variables"),
            std::string::npos);
  EXPECT_NE(refused(openText("O1\n#1=2\n#[#1]=3\nM30\n"), "#1", "3").find("computes a variable number"),
            std::string::npos);
}

TEST_F(LspRename, CommonVariablesChangeInAllFiles) {
  write("O9100.nc", "%\nO9100\n(@GLOBAL #510 ZOFF -100..0)\n#510=#510-1.\nM99\n%\n");
  const View view = openText("%\nO1\n#510=0\nG65P9100\nM30\n%\n");
  const auto texts = applied(rename(view, "#510", "520"));
  EXPECT_EQ(texts.at("part.nc"), "%\nO1\n#520=0\nG65P9100\nM30\n%\n");
  EXPECT_EQ(texts.at("O9100.nc"), "%\nO9100\n(@GLOBAL #520 ZOFF -100..0)\n#520=#520-1.\nM99\n%\n");
  EXPECT_NE(refused(openText("O1\n#3000=1\nM30\n"), "#3000", "100").find("is not a variable of the program"),
            std::string::npos);
  EXPECT_NE(refused(openText("O1\n(@ASSIGNS #500..#520)\n#510=1\nM30\n"), "#510", "515").find("as part of a range"),
            std::string::npos);
}

TEST_F(LspRename, AMacroThatCallsNothingIsSeenWithItsCallers) {
  write("main.nc", "%\nO1\n#510=1\n#30=4\nM98P9100\nG00X#30\nM30\n%\n");
  const View view = openText("%\nO9100\n#30=3\nG04X#510\nM99\n%\n");
  const auto texts = applied(rename(view, "#510", "520"));
  EXPECT_EQ(texts.at("main.nc"), "%\nO1\n#520=1\n#30=4\nM98P9100\nG00X#30\nM30\n%\n");
  EXPECT_NE(refused(view, "#30", "31").find("which then uses the local variables of its caller"), std::string::npos);
}

TEST_F(LspRename, NamedVariablesOfControlsThatHaveThem) {
  const View view = openText("o<cut> sub\n#<depth>=2\nG0 X#<Depth>\no<cut> endsub\n#<depth>=1\nM2\n", "linuxcnc");
  EXPECT_EQ(renamed(view, "#<depth>=2", "#<low>"), "o<cut> sub\n#<low>=2\nG0 X#<low>\no<cut> endsub\n#<depth>=1\nM2\n");
  EXPECT_NE(refused(view, "#<depth>=2", "z low").find("names contain no spaces"), std::string::npos);
  EXPECT_NE(refused(view, "#<depth>=2", "_low").find("only global names begin with `_`"), std::string::npos);
  EXPECT_NE(refused(view, "#<depth>=2", "Depth").find("is already in use"), std::string::npos);
}

TEST_F(LspRename, NewNumbersKeepAllJumps) {
  const View view = openText(kJumps);
  const Json edit = ask(view, "feedhold/renumber", {{"textDocument", {{"uri", view.uri}}}});
  const std::string text = applied(edit).at("part.nc");
  EXPECT_NE(text.find("IF[#1LT9]GOTO 20\nM99P10\nN20M30"), std::string::npos) << text;
  EXPECT_EQ(jumps(text, view.programs->dialect()), jumps(std::string(kJumps), view.programs->dialect()));
  const View twice = openText("O1\nN5G04X1.\nGOTO5\nN5G04X2.\nGOTO5\nM30\n");
  EXPECT_EQ(applied(ask(twice, "feedhold/renumber", {{"step", 100}})).at("part.nc"),
            "O1\nN100G04X1.\nGOTO200\nN200G04X2.\nGOTO100\nM30\n");
}

TEST_F(LspRename, NewNumbersKeepAllJumpsOfProgramsFromShops) {
  constexpr std::uintmax_t kLargest = 20000;
  std::size_t changed = 0;
  for (const auto &entry :
       std::filesystem::recursive_directory_iterator(std::filesystem::path(FEEDHOLD_SOURCE_DIR) / "corpus")) {
    const bool isProgram = entry.is_regular_file() && entry.path().extension() == ".nc";
    if (!isProgram || entry.file_size() > kLargest)
      continue;
    std::ostringstream text;
    text << std::ifstream(entry.path(), std::ios::binary).rdbuf();
    write("part.nc", text.str());
    const View view = open("part.nc");
    refusal([&] {
      const auto texts = applied(ask(view, "feedhold/renumber", {{"step", 10}}));
      if (texts.empty())
        return;
      ++changed;
      EXPECT_EQ(jumps(texts.at("part.nc"), view.programs->dialect()), jumps(text.str(), view.programs->dialect()))
          << entry.path();
    });
  }
  EXPECT_GT(changed, 10U);
}

TEST_F(LspRename, NewNumbersAreRefusedWhereAJumpWouldBeLost) {
  const auto renumber = [&](std::string_view text) {
    const View view = openText(text);
    return refusal([&] { ask(view, "feedhold/renumber", {{"step", 10}}); });
  };
  EXPECT_NE(renumber("O1\nGOTO20\nN1M30\n").find("jumps to N20, which does not exist"), std::string::npos);
  EXPECT_NE(renumber("O1\nGOTO#1\nN1M30\n").find("computes"), std::string::npos);
  EXPECT_NE(renumber("O1\nM98P2\nN3M30\nO2\nM99P3\n").find("returns to N3 of O1"), std::string::npos);
  EXPECT_EQ(renumber("O1\nGOTO1\nN1M30\n"), "");
}

} // namespace
} // namespace feedhold::lsp
