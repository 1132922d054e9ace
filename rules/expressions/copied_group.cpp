// copied-group: `#511=#510-#18`, `#521=#520+#18`, and of the other axis `#611=#610-#18`, `#621=#610+#18`.
#include "findings/rule/rule.h"

#include "base/support/text.h"
#include "rules/expressions/expression_view.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <vector>

namespace feedhold::rules::copied_group {
namespace {

constexpr std::size_t kFewest = 4;   // assignments of a group
constexpr std::size_t kMost = 1'000; // of a program: each is compared with each

struct Use {
  std::int64_t number;
  Span span;
};

/// An assignment that is all that its block does.
struct Line {
  std::int64_t target = 0;
  std::string shape = {}; // of its value, with `#` for each variable
  std::vector<Use> uses = {};
  std::size_t run = 0; // those of one run follow each other
  Span span = {};
};

/// Absent: it reads what has no plain number.
std::optional<Line> lineOf(const Assignment &assignment, const FileContext &context) {
  const auto target = variableNumber(context.tree, assignment.target);
  if (!target)
    return std::nullopt;
  Line line{.target = *target};
  const Span span = context.tree.expressions[assignment.value].span;
  const std::string_view text = context.text(span);
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (isBlank(text[i]))
      continue;
    line.shape.push_back(toUpper(text[i]));
    if (text[i] != '#')
      continue;
    const std::size_t begin = i;
    std::int64_t number = 0;
    while (i + 1 < text.size() && isDigit(text[i + 1]) && number < 10'000'000)
      number = number * 10 + (text[++i] - '0');
    if (i == begin)
      return std::nullopt;
    line.uses.push_back(
        {number, {span.begin + static_cast<std::uint32_t>(begin), span.begin + static_cast<std::uint32_t>(i) + 1}});
  }
  return line;
}

std::vector<Line> linesOf(ProgramId id, const FileContext &context) {
  const Program &program = context.model.programs[id];
  std::vector<Line> lines;
  std::size_t run = 0;
  for (BlockId block = program.first; block < program.last; block = block.next()) {
    const auto statements = context.tree.statementsOf(block);
    if (statements.empty() && context.tree.wordsOf(block).empty() && !context.tree.blocks[block].has(Block::kBroken))
      continue;
    const bool isAlone = statements.size() == 1 && context.tree.wordsOf(block).empty();
    const auto *assignment = isAlone ? std::get_if<Assignment>(&statements.front().node) : nullptr;
    auto line = assignment ? lineOf(*assignment, context) : std::nullopt;
    if (!line) {
      ++run;
      continue;
    }
    line->run = run;
    line->span = context.tree.blocks[block].span();
    lines.push_back(std::move(*line));
  }
  return lines;
}

using Group = std::span<const Line>;

/// How many lines from both places on are alike, with targets that are the same number apart.
std::size_t lengthOfPair(const std::vector<Line> &lines, std::size_t first, std::size_t second) {
  const std::int64_t apart = lines[second].target - lines[first].target;
  std::size_t length = 0;
  while (apart != 0 && first + length < second && second + length < lines.size()) {
    const Line &one = lines[first + length];
    const Line &other = lines[second + length];
    if (one.run != lines[first].run || other.run != lines[second].run || one.shape != other.shape ||
        other.target - one.target != apart)
      break;
    ++length;
  }
  return length;
}

bool sets(Group group, std::int64_t number) { return std::ranges::find(group, number, &Line::target) != group.end(); }

/// Variables of the group that it reads.
std::set<std::int64_t> readsOfOwn(Group group) {
  std::set<std::int64_t> reads;
  for (const Line &line : group)
    for (const Use &use : line.uses)
      if (sets(group, use.number))
        reads.insert(use.number);
  return reads;
}

struct Slip {
  Use use;
  Use other; // at the same place of the other group
  std::int64_t expected;
};

/// The only place at which the groups do not read variables that correspond; they do at another place.
std::optional<Slip> slipBetween(Group first, Group second) {
  const std::int64_t apart = second.front().target - first.front().target;
  std::optional<Slip> slip;
  std::size_t matching = 0;
  for (std::size_t i = 0; i < first.size(); ++i)
    for (std::size_t k = 0; k < first[i].uses.size(); ++k) {
      const Use &one = first[i].uses[k];
      const Use &other = second[i].uses[k];
      if (!sets(first, one.number) && !sets(second, other.number))
        continue;
      if (other.number - one.number == apart) {
        ++matching;
        continue;
      }
      if (slip || !sets(first, one.number) || !sets(second, other.number))
        return std::nullopt;
      const std::size_t own = readsOfOwn(first).size();
      const std::size_t others = readsOfOwn(second).size();
      if (own == others)
        return std::nullopt;
      slip = own > others ? Slip{other, one, one.number + apart} : Slip{one, other, other.number - apart};
    }
  return matching > 0 ? slip : std::nullopt;
}

bool targetsDiffer(Group group) {
  std::set<std::int64_t> targets;
  for (const Line &line : group)
    targets.insert(line.target);
  return targets.size() == group.size();
}

void check(ProgramId id, const FileContext &context, const Reporter &reporter) {
  const std::vector<Line> lines = linesOf(id, context);
  if (lines.size() > kMost)
    return;
  std::set<std::uint32_t> told;
  for (std::size_t first = 0; first < lines.size(); ++first)
    for (std::size_t second = first + kFewest; second < lines.size(); ++second) {
      const std::size_t length = lengthOfPair(lines, first, second);
      if (length < kFewest)
        continue;
      const Group one = Group(lines).subspan(first, length);
      const Group other = Group(lines).subspan(second, length);
      const auto slip = targetsDiffer(one) && targetsDiffer(other) ? slipBetween(one, other) : std::nullopt;
      if (!slip || !told.insert(slip->use.span.begin).second)
        continue;
      reporter.report(
          {.message = fmt::format("{} is not the variable that corresponds to {}: that is `#{}`",
                                  context.quoted(slip->use.span), context.quoted(slip->other.span), slip->expected),
           .span = slip->use.span,
           .labels = {{slip->other.span, "in the group that is written alike"}},
           .notes = {"the other lines of both groups read variables that correspond: the line was probably copied, and "
                     "this number not changed",
                     "correct it, or say in a comment why it differs"}});
    }
}

} // namespace

extern const Rule copiedGroup;
const Rule copiedGroup{
    .info = {"copied-group", Category::Expression, Severity::Warning,
             "Reports a group of assignments that repeats another one for other variables, and reads "
             "one of its own variables where the other group reads the next one."},
    .hooks = {.program = check}};

} // namespace feedhold::rules::copied_group
