// golden_tests [--update] PATHS...: runs the cases of Markdown pages (docs/testing.md tells their format).
#include "base/diag/edits.h"
#include "base/support/text.h"
#include "dialects/registry.h"
#include "golden/page.h"
#include "golden/stages.h"
#include "rules/registry.h"

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <fmt/format.h>
#include <fstream>
#include <iterator>
#include <sstream>

namespace feedhold::golden {
namespace {

namespace fs = std::filesystem;

struct Tally {
  std::size_t cases = 0;
  std::size_t failures = 0;
  std::size_t rewritten = 0;
};

enum class Mode { Compare, Update };

std::vector<std::string> wordsOf(std::string_view text) {
  std::istringstream stream{std::string(text)};
  return {std::istream_iterator<std::string>(stream), {}};
}

/// Text of an `escaped` fence: `\r \n \t \\ \xHH`, and a backslash at the end of a line joins it to the next.
std::string unescaped(std::string_view text) {
  std::string bytes;
  for (std::size_t at = 0; at < text.size(); ++at) {
    if (text[at] != '\\' || at + 1 == text.size()) {
      bytes += text[at];
      continue;
    }
    switch (text[++at]) {
    case 'r': bytes += '\r'; break;
    case 'n': bytes += '\n'; break;
    case 't': bytes += '\t'; break;
    case '\n': break;
    case 'x':
      bytes += static_cast<char>(std::stoi(std::string(text.substr(at + 1, 2)), nullptr, 16));
      at += 2;
      break;
    default: bytes += text[at]; break;
    }
  }
  return bytes;
}

/// `O1000.nc` by the first O word, else `program.nc`.
std::string defaultName(std::string_view text) {
  for (std::size_t at = 0; at + 1 < text.size(); ++at) {
    const bool wordBegins = at == 0 || !isLetter(text[at - 1]);
    if (text[at] != 'O' || !wordBegins || !isDigit(text[at + 1]))
      continue;
    const std::size_t end = text.find_first_not_of("0123456789", at + 1);
    return std::string(text.substr(at, end == std::string_view::npos ? end : end - at)) + ".nc";
  }
  return "program.nc";
}

/// Adds what a "```nc DIALECT [NAME] [escaped]" fence gives; the reason when it cannot be used.
std::optional<std::string> addFile(const Fence &fence, Input &input) {
  std::vector<std::string> words = wordsOf(fence.info);
  const bool escaped = std::erase(words, "escaped") > 0;
  input.guess = words.size() > 1 && words[1] == "guess";
  const Dialect *dialect = words.size() < 2 ? nullptr
                           : input.guess    ? allDialects().dialects.front()
                                            : findDialect(allDialects(), words[1]);
  if (!dialect)
    return fmt::format("`{}` names no dialect", fence.info);
  if (input.dialect && input.dialect != dialect)
    return "the files of a case have one dialect";
  input.dialect = dialect;
  std::string text = escaped ? unescaped(fence.text) : fence.text;
  std::string name = words.size() > 2 ? words[2] : defaultName(text);
  input.files.push_back({std::move(name), std::move(text)});
  return std::nullopt;
}

/// All rules (an empty list); on the page of a rule only that one, and for rules about suppressions also those that
/// the programs name.
std::vector<std::string> rulesFor(const Page &page, const Section &section) {
  const RegisteredRule *own = findRule(allRules(), page.title);
  if (!own)
    return {};
  std::vector<std::string> rules{page.title};
  if (own->rule->info.category != Category::Suppression)
    return rules;
  for (const RegisteredRule &registered : allRules().rules) {
    const std::string name(registered.rule->info.name);
    const auto names = [&](const Fence &fence) {
      return fence.info.starts_with("nc") && fence.text.find(name) != std::string::npos;
    };
    if (name != page.title && std::any_of(section.fences.begin(), section.fences.end(), names))
      rules.push_back(name);
  }
  return rules;
}

void fail(Tally &tally, const Page &page, const Section &section, std::string_view reason) {
  ++tally.failures;
  fmt::print("{}:{}: {}: {}\n", page.path, section.line, section.title, reason);
}

void runExpectation(const Fence &fence, const Input &input, const Page &page, const Section &section,
                    std::vector<NewBody> &bodies, Tally &tally) {
  const std::optional<std::string> actual = runStage(fence.info, input);
  if (!actual)
    return fail(tally, page, section, fmt::format("no stage is named `{}`", fence.info));
  ++tally.cases;
  if (*actual == fence.text)
    return;
  bodies.push_back({fence.firstLine, fence.lineCount, *actual});
  const std::string diff = unifiedDiff(fence.info, fence.text, *actual);
  fail(tally, page, section, fmt::format("`{}` is not as expected\n{}", fence.info, diff));
}

void runSection(const Page &page, const Section &section, std::vector<NewBody> &bodies, Tally &tally) {
  Input input;
  input.rules = rulesFor(page, section);
  std::vector<const Fence *> expectations;
  for (const Fence &fence : section.fences) {
    if (fence.info == "toml")
      input.config = fence.text;
    else if (!fence.info.starts_with("nc") && !fence.info.empty() && fence.info != "text")
      expectations.push_back(&fence);
    else if (const auto problem = fence.info.starts_with("nc") ? addFile(fence, input) : std::nullopt)
      return fail(tally, page, section, *problem);
  }
  if (input.files.empty())
    return;
  if (expectations.empty())
    return fail(tally, page, section, "a program without an expectation");
  for (const Fence *fence : expectations)
    runExpectation(*fence, input, page, section, bodies, tally);
}

std::string readFile(const fs::path &path) {
  std::ifstream stream(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

void runPage(const fs::path &path, Mode mode, Tally &tally) {
  const Page page = parsePage(path.lexically_normal().string(), readFile(path));
  std::vector<NewBody> bodies;
  Tally own;
  for (const Section &section : page.sections)
    runSection(page, section, bodies, own);
  tally.cases += own.cases;
  if (mode == Mode::Compare || bodies.empty()) {
    tally.failures += own.failures;
    if (own.failures > 0)
      fmt::print("to accept what came out: ./dev update-goldens {}\n\n", page.path);
    return;
  }
  std::ofstream(path, std::ios::binary) << withBodies(page, bodies);
  tally.failures += own.failures - bodies.size();
  tally.rewritten += bodies.size();
}

std::vector<fs::path> pagesBelow(const fs::path &root) {
  if (fs::is_regular_file(root))
    return {root};
  std::vector<fs::path> pages;
  for (const fs::directory_entry &entry : fs::recursive_directory_iterator(root))
    if (entry.path().extension() == ".md")
      pages.push_back(entry.path());
  std::sort(pages.begin(), pages.end());
  return pages;
}

} // namespace
} // namespace feedhold::golden

int main(int argc, char **argv) {
  using namespace feedhold::golden;
  std::vector<std::string> paths(argv + 1, argv + argc);
  const Mode mode = std::erase(paths, "--update") > 0 ? Mode::Update : Mode::Compare;
  Tally tally;
  for (const std::string &path : paths)
    for (const fs::path &page : pagesBelow(path))
      runPage(page, mode, tally);
  fmt::print("{} expectations, {} failed, {} rewritten\n", tally.cases, tally.failures, tally.rewritten);
  return tally.failures == 0 && tally.cases > 0 ? 0 : 1;
}
