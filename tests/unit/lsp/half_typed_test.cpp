// Every request at every stage of a text that is being written: answered, with places that are in the text.
#include "feature_fixture.h"

namespace feedhold::lsp {
namespace {

struct Written {
  const char *dialect;
  std::string_view text;
};

constexpr std::string_view kShop = "%\r\n"
                                   "O1(\xF0\x9F\x98\x80 PART)\r\n"
                                   "(@PARAM #1 A 0..9 MM)\r\n"
                                   "N10G90G65P2A1.B#1(\xC3\x84)\r\n"
                                   "WHILE[#1LT#[2+#3]]DO1\r\n"
                                   "IF[#1EQ#0]GOTO20\r\n"
                                   "END1\r\n"
                                   "N20M98P2L3\r\n"
                                   "GOTO#1\r\n"
                                   "M30\r\n"
                                   "O2\r\n"
                                   "#100=-[#1+2.]/SIN[30]\r\n"
                                   "#3000=1(NO)\r\n"
                                   "M99P10\r\n"
                                   "%\r\n";
constexpr std::string_view kLathe = "O1\nIF[#1EQ0]THEN\nG71P10Q20U1.\nELSE\nN10G00X#1\nENDIF\nN20M99\n";
constexpr std::string_view kNamed = "o<cut> sub\n#<depth>=#1 ;\xC3\x84\no1 if [#1 GT 0]\nG1 X#<_x> F[2*3]\no1 endif\n"
                                    "o<cut> endsub\no<cut> call [1] [#2]\nM2\n";

class LspHalfTyped : public FeatureTest {
protected:
  /// The units of UTF-16 of each line.
  static std::vector<std::size_t> linesOf(std::string_view text) {
    std::vector<std::size_t> lines{0};
    for (std::size_t i = 0; i < text.size(); ++i) {
      const Json at = positionOf(text, i + 1);
      if (text[i] == '\n')
        lines.push_back(0);
      else if (text[i] != '\r')
        lines.back() = at["character"].get<std::size_t>();
    }
    return lines;
  }
  static bool isIn(const std::vector<std::size_t> &lines, const Json &position) {
    const auto line = position.at("line").get<std::size_t>();
    return line < lines.size() && position.at("character").get<std::size_t>() <= lines[line];
  }
  static void expectPlacesIn(const std::vector<std::size_t> &lines, const Json &answer) {
    if (answer.is_object() && answer.contains("start") && answer.contains("end")) {
      const auto keyOf = [](const Json &p) { return std::pair(p["line"].get<int>(), p["character"].get<int>()); };
      EXPECT_LE(keyOf(answer["start"]), keyOf(answer["end"])) << answer;
      EXPECT_TRUE(isIn(lines, answer["start"]) && isIn(lines, answer["end"])) << answer;
    }
    if (answer.is_object() && answer.contains("selectionRange")) {
      const auto within = [&](const char *end) { return answer["range"][end]["line"].get<int>(); };
      EXPECT_LE(within("start"), answer["selectionRange"]["start"]["line"].get<int>()) << answer;
      EXPECT_GE(within("end"), answer["selectionRange"]["end"]["line"].get<int>()) << answer;
    }
    if (answer.is_structured())
      for (const Json &part : answer)
        expectPlacesIn(lines, part);
  }
  static void askAll(const View &view, std::string_view text, std::size_t at) {
    const std::vector<std::size_t> lines = linesOf(text);
    const Json whole{{"start", positionOf(text, 0)}, {"end", positionOf(text, text.size())}};
    const Json params{{"textDocument", {{"uri", view.uri}}},
                      {"position", positionOf(text, at)},
                      {"range", whole},
                      {"query", ""},
                      {"newName", "77"}};
    for (const Feature &feature : features()) {
      Json item = params;
      if (feature.method.starts_with("callHierarchy/")) {
        const Json items = ask(view, "textDocument/prepareCallHierarchy", params);
        if (items.is_null())
          continue;
        item["item"] = items.at(0);
      }
      SCOPED_TRACE(std::string(feature.method) + " behind:\n" + std::string(text.substr(0, at)));
      try {
        expectPlacesIn(lines, feature.answer(view, item));
      } catch (const Refused &) { // what cannot be renamed
      }
    }
  }
  /// Absent: it is taken for no program, and nothing is asked of it.
  std::optional<View> tryOpen(std::string_view text, const std::string &dialect = "fanuc-30i") const {
    try {
      return openText(text, dialect);
    } catch (const std::runtime_error &) {
      return std::nullopt;
    }
  }
  static bool isBoundary(std::string_view text, std::size_t at) {
    return at >= text.size() || (static_cast<unsigned char>(text[at]) & 0xC0) != 0x80;
  }
};

TEST_F(LspHalfTyped, AtTheEndOfWhatIsWritten) {
  for (const Written &each : {Written{"fanuc-30i", kShop}, {"mitsubishi-m700", kLathe}, {"linuxcnc", kNamed}})
    for (std::size_t length = 0; length <= each.text.size(); ++length)
      if (isBoundary(each.text, length)) {
        const std::string_view text = each.text.substr(0, length);
        const auto view = tryOpen(text, each.dialect);
        EXPECT_TRUE(view || length == 0) << text;
        if (view)
          askAll(*view, text, length);
        if (HasFailure())
          return;
      }
}

TEST_F(LspHalfTyped, EverywhereInWhatIsWritten) {
  for (const Written &each : {Written{"fanuc-30i", kShop}, {"mitsubishi-m700", kLathe}, {"linuxcnc", kNamed}}) {
    const View view = openText(each.text, each.dialect);
    for (std::size_t at = 0; at <= each.text.size(); ++at)
      if (isBoundary(each.text, at))
        askAll(view, each.text, at);
  }
}

TEST_F(LspHalfTyped, TextsWithoutAProgram) {
  for (const std::string_view text :
       {"", "\n", "%", "%\n", "%\n%", "\r\n\r\n", "(", "(@", "\xEF\xBB\xBF", "#", "]", "O", "G65", "END1", "ENDIF\n",
        "\n\n\nO1", "%\nO1\nM30\n%\nO2\nG65P1A#1\n#2=#1\nGOTO1\n"}) {
    const auto view = tryOpen(text);
    for (std::size_t at = 0; view && at <= text.size(); ++at)
      if (isBoundary(text, at))
        askAll(*view, text, at);
  }
}

} // namespace
} // namespace feedhold::lsp
