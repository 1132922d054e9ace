#include "mutation/mutants.h"

#include <cctype>
#include <functional>
#include <optional>
#include <regex>

namespace feedhold::mutation {

using soundness::ProgramLines;

namespace {

struct Change {
  std::string_view slip;
  const char *pattern;
  const char *replacement;
  enum class Where { Blocks, Clauses } where = Where::Blocks;
};

// A pattern that stands more than once in a block gives one mutant for each place.
const Change kChanges[] = {
    {"increment dropped", "^(N[0-9]+)?#([0-9]+)=#\\2[+-].*$", "$1"},
    {"assignment dropped", "^(N[0-9]+)?#[0-9]+=.*$", "$1"},
    {"guard dropped", "^(N[0-9]+)?IF\\[.*$", "$1"},
    {"G90 for G91", "G91", "G90"},
    {"G91 for G90", "G90", "G91"},
    {"relation widened", "GT", "GE"},
    {"relation widened", "LT", "LE"},
    {"relation narrowed", "GE", "GT"},
    {"relation narrowed", "LE", "LT"},
    {"relation turned", "LT", "GT"},
    {"relation turned", "GT", "LT"},
    {"relation negated", "EQ", "NE"},
    {"relation negated", "NE", "EQ"},
    {"sign changed", "\\+#", "-#"},
    {"sign changed", "-#", "+#"},
    {"sign changed", "\\+([0-9.])", "-$1"},
    {"sign changed", "-([0-9.])", "+$1"},
    {"term dropped", "[*/+-]#[0-9]+", ""},
    {"off by one", "(EQ|NE|GT|GE|LT|LE|=)([0-9]+)(?![0-9.])", "$1[$2+1]"},
    {"off by one", "(EQ|NE|GT|GE|LT|LE)(#[0-9]+)", "$1[$2+1]"},
    {"bound widened", "([0-9]+)\\.\\.([0-9.]+)", "-1..[$2*2]", Change::Where::Clauses},
    {"bound dropped", "^\\(@(PARAM|REQUIRE).*$", "", Change::Where::Clauses},
};

std::vector<std::string> changed(const std::string &block, const Change &change) {
  const std::regex pattern(change.pattern);
  std::vector<std::string> all;
  for (std::sregex_iterator match(block.begin(), block.end(), pattern), end; match != end; ++match) {
    const auto at = static_cast<std::size_t>(match->position());
    all.push_back(block.substr(0, at) + match->format(change.replacement) +
                  block.substr(at + static_cast<std::size_t>(match->length())));
  }
  return all;
}

} // namespace

std::vector<Mutant> mutantsOf(const ProgramLines &lines) {
  std::vector<Mutant> mutants;
  for (std::size_t i = 1; i < lines.size() && !lines[i].starts_with('O'); ++i) {
    const bool isClause = lines[i].starts_with("(@");
    const std::size_t comment = isClause ? lines[i].size() : std::min(lines[i].find('('), lines[i].size());
    const std::string block = lines[i].substr(0, comment);
    for (const Change &change : kChanges)
      if ((change.where == Change::Where::Clauses) == isClause && !block.empty())
        for (std::string &text : changed(block, change)) {
          Mutant mutant{change.slip, lines};
          mutant.lines[i] = std::move(text) + lines[i].substr(comment);
          mutants.push_back(std::move(mutant));
        }
  }
  return mutants;
}

} // namespace feedhold::mutation
