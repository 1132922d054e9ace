#include "mutation/mutants.h"

#include <algorithm>
#include <regex>
#include <span>

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

// Of programs that move; the contract stays.  No letter stands before the address of a word: `FIX[` is none.
const Change kMotionChanges[] = {
    {"motion dropped", "^(N[0-9]+)?[GXYZ].*$", "$1"},
    {"word dropped", "([^A-Z])[XYZIJ](-?(#[0-9]+|[0-9.]+|\\[[^A-Z]*\\]))(?=[A-Z]|$)", "$1"},
    {"axes swapped", "(^|[^A-Z])X(?=[-#0-9.\\[])", "$1Y"},
    {"axes swapped", "(^|[^A-Z])Y(?=[-#0-9.\\[])", "$1X"},
    {"axes swapped", "(^|[^A-Z])Z(?=[-#0-9.\\[])", "$1X"},
    {"sign of word", "(^|[^A-Z])([XYZIJR])(?=[#0-9.\\[])", "$1$2-"},
    {"sign of word", "(^|[^A-Z])([XYZIJR])-", "$1$2"},
    {"plane changed", "G17", "G18"},
    {"plane changed", "G17", "G19"},
    {"plane changed", "G1[89]", "G17"},
    {"arc turned", "G0?2(?![0-9.])", "G03"},
    {"arc turned", "G0?3(?![0-9.])", "G02"},
    {"rapid for feed", "G0?1(?![0-9.])", "G00"},
    {"mirror dropped", "G51\\.1.*$", ""},
    {"step changed", "([+-])(#[0-9]+)", "$1[2*$2]"},
    {"step changed", "([+-])(#[0-9]+)", "$1[$2/2]"},
    {"factor changed", "([*/])2(?![0-9.])", "$1[3]"},
    {"factor changed", "([^#A-Z0-9.])2\\*", "$1"},
    {"constant changed", "([+-])([0-9]+)(?=[\\]A-Z]|$)", "$1[$2+1]"},
    {"clamp dropped", "^(N[0-9]+)?IF.*THEN.*$", "$1"},
    {"call or jump dropped", "^(N[0-9]+)?(G65|GOTO).*$", "$1"},
};

using Slips = std::vector<std::pair<const Change *, std::regex>>;

Slips slipsOf(std::span<const Change> changes) {
  Slips slips;
  for (const Change &change : changes)
    slips.emplace_back(&change, change.pattern);
  return slips;
}

std::vector<std::string> changed(const std::string &block, const Change &change, const std::regex &pattern) {
  std::vector<std::string> all;
  for (std::sregex_iterator match(block.begin(), block.end(), pattern), end; match != end; ++match) {
    const auto at = static_cast<std::size_t>(match->position());
    all.push_back(block.substr(0, at) + match->format(change.replacement) +
                  block.substr(at + static_cast<std::size_t>(match->length())));
  }
  return all;
}

/// Of one block, its comments left as they are.
void addMutants(std::vector<Mutant> &mutants, const ProgramLines &lines, std::size_t line, const Slips &slips) {
  const bool isClause = lines[line].starts_with("(@");
  const std::size_t comment = isClause ? lines[line].size() : std::min(lines[line].find('('), lines[line].size());
  const std::string block = lines[line].substr(0, comment);
  if (block.empty())
    return;
  for (const auto &[change, pattern] : slips)
    if ((change->where == Change::Where::Clauses) == isClause)
      for (const std::string &text : changed(block, *change, pattern)) {
        Mutant mutant{change->slip, line, lines};
        mutant.lines[line] = text + lines[line].substr(comment);
        mutants.push_back(std::move(mutant));
      }
}

} // namespace

std::vector<Mutant> mutantsOf(const ProgramLines &lines) {
  const Slips slips = slipsOf(kChanges);
  std::vector<Mutant> mutants;
  for (std::size_t i = 1; i < lines.size() && !lines[i].starts_with('O'); ++i)
    addMutants(mutants, lines, i, slips);
  return mutants;
}

std::vector<Mutant> movingMutantsOf(const ProgramLines &lines) {
  Slips slips = slipsOf(kChanges);
  std::ranges::move(slipsOf(kMotionChanges), std::back_inserter(slips));
  std::vector<Mutant> mutants;
  for (std::size_t i = 1; i < lines.size(); ++i)
    if (!lines[i].starts_with('O') && !lines[i].starts_with("(@"))
      addMutants(mutants, lines, i, slips);
  return mutants;
}

} // namespace feedhold::mutation
