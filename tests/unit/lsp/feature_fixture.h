// Documents in a folder of their own, asked as the dispatcher asks.
#pragma once

#include "base/source/file_uri.h"
#include "dialects/registry.h"
#include "rules/registry.h"
#include "surface/lsp/feature.h"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <stdexcept>

namespace feedhold::lsp {

class FeatureTest : public testing::Test {
protected:
  void SetUp() override {
    folder_ = std::filesystem::temp_directory_path() /
              ("feedhold-lsp-" + std::to_string(testing::UnitTest::GetInstance()->random_seed()) +
               testing::UnitTest::GetInstance()->current_test_info()->test_suite_name() +
               testing::UnitTest::GetInstance()->current_test_info()->name());
    std::filesystem::remove_all(folder_);
    std::filesystem::create_directories(folder_);
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  void write(const std::string &name, std::string_view text) const {
    std::ofstream(folder_ / name, std::ios::binary) << text;
  }
  std::string uri(const std::string &name) const { return uriOfPath(folder_ / name); }
  View open(const std::string &name, const std::string &dialect = "fanuc-30i") const {
    ProgramOptions options;
    options.path = (folder_ / name).string();
    options.control.dialect = dialect;
    auto programs = loadProject(options, kKnown);
    if (!programs)
      throw std::runtime_error(programs.error().message);
    return {uri(name), programs.take(), nullptr, kKnown, PositionEncoding::Utf16, {folder_}};
  }
  View openText(std::string_view text, const std::string &dialect = "fanuc-30i") const {
    write("part.nc", text);
    return open("part.nc", dialect);
  }

  static Json ask(const View &view, std::string_view method, const Json &params) {
    const auto all = features();
    const auto found = std::find_if(all.begin(), all.end(), [&](const Feature &each) { return each.method == method; });
    if (found == all.end())
      throw std::runtime_error("no such method");
    return found->answer(view, params);
  }
  /// At the first sign of `what`, or `in` bytes behind it.
  static Json askAt(const View &view, std::string_view method, std::string_view what, std::size_t in = 0,
                    Json more = Json::object()) {
    const std::size_t at = view.file().source.text().find(what);
    if (at == std::string_view::npos)
      throw std::runtime_error("not in the text");
    more["textDocument"] = {{"uri", view.uri}};
    more["position"] = positionOf(view.file().source.text(), at + in);
    return ask(view, method, more);
  }
  /// Counted here, not by Places: in units of UTF-16.
  static Json positionOf(std::string_view text, std::size_t at) {
    std::size_t line = 0, units = 0;
    for (std::size_t i = 0; i < at; ++i) {
      const auto byte = static_cast<unsigned char>(text[i]);
      if (byte == '\n') {
        ++line;
        units = 0;
      } else if (byte < 0x80 || byte >= 0xC0) {
        units += byte >= 0xF0 ? 2 : 1;
      }
    }
    return {{"line", line}, {"character", units}};
  }
  /// The text of a range in a text without signs beyond ASCII in its line.
  static std::string textAt(std::string_view text, const Json &range) {
    const auto offset = [&](const Json &position) {
      for (std::size_t at = 0; at <= text.size(); ++at)
        if ((at == text.size() || (static_cast<unsigned char>(text[at]) & 0xC0) != 0x80) &&
            positionOf(text, at) == position)
          return at;
      throw std::runtime_error("no such position");
    };
    const std::size_t begin = offset(range.at("start"));
    return std::string(text.substr(begin, offset(range.at("end")) - begin));
  }
  /// `line:text` of each location, of the document itself, or `file:line:text`; in the order of the answer.
  std::vector<std::string> shown(const View &view, Json locations) const {
    if (locations.is_object())
      locations = Json::array({locations});
    std::vector<std::string> found;
    for (const Json &each : locations) {
      const std::filesystem::path path = pathOfUri(each.value("uri", view.uri));
      std::ifstream file(path, std::ios::binary);
      const std::string text{std::istreambuf_iterator<char>(file), {}};
      const std::string line = std::to_string(each["range"]["start"]["line"].get<int>() + 1);
      found.push_back((path == pathOfUri(view.uri) ? "" : path.filename().string() + ":") + line + ":" +
                      textAt(text, each["range"]));
    }
    return found;
  }

  inline static const KnownNames kKnown{allDialects(), allRules()};
  std::filesystem::path folder_;
};

using Strings = std::vector<std::string>;

} // namespace feedhold::lsp
