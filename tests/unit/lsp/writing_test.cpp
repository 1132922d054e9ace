// What helps while a program is written: hints, completion, signatures, lenses.
#include "feature_fixture.h"

namespace feedhold::lsp {
namespace {

constexpr std::string_view kWritingSlot = "%\n"
                                          "O9100(SLOT)\n"
                                          "(@PARAM #21 DEPTH 0.5..50. MM)\n"
                                          "(@PARAM #22 STEP 0.1..#21 MM)\n"
                                          "#10=0\n"
                                          "WHILE[#10LT#21]DO1\n"
                                          "#10=#10+#22\n"
                                          "END1\n"
                                          "G91\n"
                                          "M99\n"
                                          "%\n";

class LspWriting : public FeatureTest {
protected:
  static Strings hints(const View &view) {
    Strings found;
    const Json all{{"start", {{"line", 0}, {"character", 0}}}, {"end", {{"line", 9999}, {"character", 0}}}};
    for (const Json &each : ask(view, "textDocument/inlayHint", {{"range", all}}))
      found.push_back(std::to_string(each["position"]["line"].get<int>() + 1) + ":" +
                      each["position"]["character"].dump() + " " + each["label"].get<std::string>());
    return found;
  }
  static Strings labels(const View &view, std::string_view what, std::size_t in) {
    Strings found;
    for (const Json &each : askAt(view, "textDocument/completion", what, in))
      found.push_back(each["label"].get<std::string>());
    return found;
  }
  static bool has(const Strings &all, const std::string &one) {
    return std::find(all.begin(), all.end(), one) != all.end();
  }
  /// With its proofs, as the server makes them.
  View proved(View view) const {
    prove::ProveOptions options;
    options.contractsOf = {&view.file().contracts};
    std::vector<DocumentProof> proofs;
    for (std::size_t i = 0; i < view.file().model.programs.size(); ++i) {
      const ProgramId id(i);
      const Callee callee{FileId(0), view.programs->set->file(FileId(0)).cfg.entryOf(id), id};
      proofs.push_back({id, prove::prove(*view.programs->set, callee, &view.file().contracts, options)});
    }
    view.proofs = std::make_shared<const std::vector<DocumentProof>>(std::move(proofs));
    return view;
  }
};

TEST_F(LspWriting, ArgumentsHaveNames) {
  write("O9100.nc", kWritingSlot);
  const View view = openText("%\nO1\n(\xF0\x9F\x98\x80)G65P9100U3.V1.\nG65P#1U3.\nM30\n%\n");
  EXPECT_EQ(hints(view), (Strings{"3:12 DEPTH:", "3:15 STEP:"}));
}

TEST_F(LspWriting, ALoopThatIsProvedToEndHasABound) {
  const View view = openText(kWritingSlot);
  EXPECT_EQ(hints(view), (Strings{}));
  const Strings found = hints(proved(view));
  ASSERT_EQ(found.size(), 1U);
  EXPECT_TRUE(found[0].starts_with("6:18 at most ") && found[0].ends_with(" iterations")) << found[0];
}

TEST_F(LspWriting, ADistanceModeThatACallLeavesIsShown) {
  write("O9100.nc", kWritingSlot);
  const View view = openText("%\nO1\nG90\nG65P9100U3.V1.\nG01X5.\nG90\nG01X6.\nM30\n%\n");
  EXPECT_EQ(hints(view), (Strings{"4:8 DEPTH:", "4:11 STEP:", "5:6 G91 active here"}));
  const View lathe = openText("%\nO1\nM98P2\nM30\nO2\nM99\n%\n");
  EXPECT_EQ(hints(lathe), (Strings{}));
}

TEST_F(LspWriting, ADistanceModeIsNotComparedAcrossPrograms) {
  EXPECT_EQ(hints(openText("O1\nG90\nM98P2\nG01X0\nM30\nO2\nG01X1.\nG91\nM99\nO3\nM99\n")),
            (Strings{"4:5 G91 active here"}));
}

TEST_F(LspWriting, DistanceModesOfALongProgram) {
  std::string text = "O1\nG90\n";
  for (int i = 0; i < 1200; ++i)
    text += "N" + std::to_string(i + 1) + "G01X#1F100.\nIF[#1GT" + std::to_string(i) + "]GOTO" + std::to_string(i + 1) +
            "\n";
  text += "M98P2\nG01X5.\nM30\nO2\nG91\nM99\n";
  const View view = openText(text);
  EXPECT_EQ(hints(view), (Strings{"2404:6 G91 active here"}));
  const auto between = [](int first, int last) {
    return Json{
        {"range", {{"start", {{"line", first}, {"character", 0}}}, {"end", {{"line", last}, {"character", 0}}}}}};
  };
  EXPECT_EQ(ask(view, "textDocument/inlayHint", between(2403, 2405)).size(), 1U); // the block above is not in it
  EXPECT_TRUE(ask(view, "textDocument/inlayHint", between(0, 2402)).empty());
}

TEST_F(LspWriting, CompletionReplacesTheWholeNumber) {
  const View view = openText("O1\nN10#1=0\nGOTO123\nGOTO 1 2\nM30\n");
  const auto range = [&](std::string_view what, std::size_t in) {
    return textAt(view.file().source.text(),
                  askAt(view, "textDocument/completion", what, in).at(0)["textEdit"]["range"]);
  };
  EXPECT_EQ(range("GOTO123", 5), "123");
  EXPECT_EQ(range("GOTO123", 4), "123");
  EXPECT_EQ(range("1 2", 3), "1 2");
  EXPECT_TRUE(askAt(openText("o1 sub ;#\no1 endsub\nM2\n", "linuxcnc"), "textDocument/completion", "#", 1).is_null());
}

TEST_F(LspWriting, CompletionOfProgramsArgumentsLabels) {
  write("O9100.nc", kWritingSlot);
  const View view = openText("%\nO1\n(\xC3\x84)G65 P91 \nG65P9100U3. \nGOTO 1\nN10#1=#5\nN15M30\n(@PA\n(NOTE @P)\n%\n");
  const Json programs = askAt(view, "textDocument/completion", "P91", 3);
  ASSERT_EQ(programs.size(), 1U);
  EXPECT_EQ(programs[0]["label"], "9100");
  EXPECT_EQ(programs[0]["detail"], "SLOT (O9100.nc)");
  EXPECT_EQ(programs[0]["textEdit"]["range"],
            (Json{{"start", {{"line", 2}, {"character", 8}}}, {"end", {{"line", 2}, {"character", 10}}}}));
  EXPECT_EQ(labels(view, "U3. ", 4), (Strings{"V"}));
  EXPECT_EQ(labels(view, "GOTO 1", 6), (Strings{"10", "15"}));
  EXPECT_TRUE(has(labels(view, "(@PA", 4), "@PARAM"));
  const Strings variables = labels(view, "#5", 2);
  EXPECT_TRUE(has(variables, "#5221") && has(variables, "#1")) << variables.size();
  EXPECT_TRUE(askAt(view, "textDocument/completion", "M30", 3).is_null());
  EXPECT_TRUE(askAt(view, "textDocument/completion", "(NOTE @P", 8).is_null());
}

TEST_F(LspWriting, VariablesOfTheControlDependOnTheControl) {
  const Strings one = labels(openText("O1\n#1=#\nM30\n", "fanuc-30i"), "=#", 2);
  const Strings other = labels(openText("o1 sub\n#1=#5\no1 endsub\nM2\n", "linuxcnc"), "=#5", 3);
  EXPECT_TRUE(has(one, "#3000"));
  EXPECT_FALSE(has(other, "#3000"));
}

TEST_F(LspWriting, SignatureOfTheCalledMacro) {
  write("O9100.nc", kWritingSlot);
  const View view = openText("%\nO1\n(\xF0\x9F\x98\x80)G65 P9100 U3. \nG65 P77 U1.\nM30\n%\n");
  const Json help = askAt(view, "textDocument/signatureHelp", "U3. ", 4);
  EXPECT_EQ(help["signatures"][0]["label"], "G65 P9100 U<DEPTH> V<STEP>");
  EXPECT_EQ(help["signatures"][0]["parameters"][1]["label"], "V<STEP>");
  EXPECT_EQ(help["activeParameter"], 1);
  EXPECT_EQ(askAt(view, "textDocument/signatureHelp", "U3. ", 2)["activeParameter"], 0);
  EXPECT_TRUE(askAt(view, "textDocument/signatureHelp", "U1.", 3).is_null());
  EXPECT_TRUE(askAt(view, "textDocument/signatureHelp", "M30", 3).is_null());
}

TEST_F(LspWriting, ALensSaysWhatIsProved) {
  const View fresh = openText(kWritingSlot);
  const Json unproved = ask(fresh, "textDocument/codeLens", {});
  ASSERT_EQ(unproved.size(), 1U);
  EXPECT_EQ(unproved[0]["command"]["title"], "prove");
  EXPECT_EQ(unproved[0]["command"]["command"], "feedhold.prove");
  EXPECT_EQ(unproved[0]["command"]["arguments"][0]["program"], "O9100");
  EXPECT_EQ(unproved[0]["range"]["start"]["line"], 1);
  const std::string title = ask(proved(fresh), "textDocument/codeLens", {})[0]["command"]["title"];
  EXPECT_NE(title.find(" proved"), std::string::npos) << title;

  const View wrong = openText("O1\n(@PARAM #1 N 0..9)\n#2=1/#1\nM99\n");
  const Json refuted = ask(proved(wrong), "textDocument/codeLens", {});
  ASSERT_EQ(refuted.size(), 1U);
  const std::string broken = refuted[0]["command"]["title"];
  EXPECT_TRUE(broken.ends_with("1 refuted: run witness")) << broken;
  EXPECT_EQ(refuted[0]["command"]["command"], "feedhold.runWitness");
  EXPECT_TRUE(refuted[0]["command"]["arguments"][0]["obligation"].get<std::string>().starts_with("O1."));
  EXPECT_TRUE(ask(openText("O1\nM30\n"), "textDocument/codeLens", {}).empty());
}

} // namespace
} // namespace feedhold::lsp
