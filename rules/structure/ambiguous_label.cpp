// ambiguous-label: `N10` twice, and a GOTO, or a contour cycle, that can only ever find one of them.
#include "findings/rule/rule.h"

#include "rules/structure/structure_view.h"

#include <fmt/format.h>

#include <algorithm>
#include <unordered_map>
#include <unordered_set>

namespace feedhold::rules::ambiguous_label {
namespace {

constexpr std::string_view kSearchOrder =
    "the control searches from the GOTO to the end of the program, then from the top; parameters can change this";

using Copies = std::span<const SequenceNumber>;

/// The GOTOs, and the P and Q of contour cycles, of a program that find a block, by the number that they name.
struct Seekers {
  std::vector<const Jump *> gotos;
  std::vector<const Jump *> contours;
  std::vector<const Jump *> ends; // the Q of contour cycles
};
using SeekersByNumber = std::unordered_map<std::uint32_t, Seekers>;

/// `N100` twice and no N200: the second one is the end with a wrong number, and what is missing is reported as such.
bool isPartMissing(const Jump &jump, const FileContext &context) {
  const auto parts = context.model.jumpsIn(jump.block, jump.block.next());
  return std::ranges::any_of(parts, [](const Jump &part) {
    return (part.kind == JumpKind::ContourFrom || part.kind == JumpKind::ContourTo) && !part.target;
  });
}

SeekersByNumber seekersOf(ProgramId program, const FileContext &context) {
  SeekersByNumber seekers;
  for (const Jump &jump : context.model.jumpsOf(program)) {
    const auto number = targetNumber(jump);
    if (!number || !jump.target || isPartMissing(jump, context))
      continue;
    if (jump.kind == JumpKind::Goto)
      seekers[*number].gotos.push_back(&jump);
    else if (jump.kind == JumpKind::ContourFrom)
      seekers[*number].contours.push_back(&jump);
    else if (jump.kind == JumpKind::ContourTo)
      seekers[*number].ends.push_back(&jump);
  }
  return seekers;
}

Span spanOf(const SequenceNumber &copy, const FileContext &context) { return context.tree.words[copy.word].span(); }

const SequenceNumber &copyAt(Copies copies, BlockId block) {
  return *std::ranges::find(copies, block, &SequenceNumber::block);
}

/// Some copy is found by no jump: it is a second use of the number, or a mistyped one.
void reportNeverFound(const SequenceNumber &lost, Copies copies, const Jump &jump, const FileContext &context,
                      const Reporter &reporter) {
  const Span found = spanOf(copyAt(copies, *jump.target), context);
  reporter.report({.message = fmt::format("{} goes to the `N{}` in line {}, never to this one",
                                          context.quoted(jump.span), lost.number, context.source.lineOf(found.begin)),
                   .span = spanOf(lost, context),
                   .labels = {{jump.span, "this jump"}, {found, "found first"}},
                   .notes = {std::string(kSearchOrder), "give each jump target its own sequence number"}});
}

/// A jump backward to a number of several blocks finds the first in the program, not the nearest before it.
void reportBackward(const Jump &jump, Copies copies, const FileContext &context, const Reporter &reporter) {
  const SequenceNumber &found = copyAt(copies, *jump.target);
  const auto behind = std::ranges::find_if(copies, [&](const SequenceNumber &c) { return c.block > jump.block; });
  const SequenceNumber &nearest = *std::prev(behind);
  if (nearest.block == found.block)
    return;
  const auto lineOf = [&](const SequenceNumber &copy) { return context.source.lineOf(spanOf(copy, context).begin); };
  reporter.report(
      {.message = fmt::format("{} goes back to the `N{}` in line {}, not to the nearer one in line {}",
                              context.quoted(jump.span), found.number, lineOf(found), lineOf(nearest)),
       .span = jump.span,
       .labels = {{spanOf(found, context), "found first"}, {spanOf(nearest, context), "nearer, but not found"}},
       .notes = {std::string(kSearchOrder), "give each jump target its own sequence number"}});
}

void checkNumber(Copies copies, std::span<const Jump *const> jumps, const FileContext &context,
                 const Reporter &reporter) {
  std::unordered_set<std::uint32_t> found;
  for (const Jump *jump : jumps)
    found.insert(jump->target->index());
  for (const SequenceNumber &copy : copies) {
    if (!found.contains(copy.block.index())) {
      reportNeverFound(copy, copies, *jumps.front(), context, reporter);
      return;
    }
  }
  for (const Jump *jump : jumps)
    if (*jump->target <= jump->block)
      reportBackward(*jump, copies, context, reporter);
}

/// The contour stands before the cycle (G70), and the search finds one of another cycle.
bool checkContour(std::span<const Jump *const> cycles, Copies copies, const FileContext &context,
                  const Reporter &reporter) {
  for (const Jump *cycle : cycles) {
    const auto behind = std::ranges::find_if(copies, [&](const SequenceNumber &c) { return c.block > cycle->block; });
    if (behind == copies.begin())
      continue;
    const SequenceNumber &nearest = *std::prev(behind);
    const bool isOfOther = std::ranges::any_of(
        cycles, [&](const Jump *other) { return other->block > cycle->block && other->block < *cycle->target; });
    if (nearest.block == *cycle->target || (*cycle->target > cycle->block && !isOfOther))
      continue;
    const Span found = spanOf(copyAt(copies, *cycle->target), context);
    reporter.report(
        {.message = fmt::format("{} may find the `N{}` in line {} instead of the contour before this cycle",
                                context.quoted(cycle->span), nearest.number, context.source.lineOf(found.begin)),
         .span = cycle->span,
         .labels = {{spanOf(nearest, context), "the contour before it"}, {found, "has the same number"}},
         .notes = {"the numbers of a contour must not occur twice in a program: the cycle may cut another "
                   "contour",
                   "give each contour its own sequence numbers"}});
    return true;
  }
  return false;
}

/// A block has the number of a contour, and no cycle finds it.  Contours of one number each, one for each tool, are cut
/// by many in this way, and the search finds them.
bool checkSecondUse(std::span<const Jump *const> cycles, Copies copies, const FileContext &context,
                    const Reporter &reporter) {
  const auto isFound = [&](const SequenceNumber &copy) {
    return std::ranges::any_of(cycles, [&](const Jump *cycle) { return *cycle->target == copy.block; });
  };
  const auto lost = std::ranges::find_if_not(copies, isFound);
  if (cycles.empty() || lost == copies.end())
    return false;
  const Jump &cycle = *cycles.front();
  const Span found = spanOf(copyAt(copies, *cycle.target), context);
  reporter.report({.message = fmt::format("{} of a contour is in this program more than once",
                                          context.quoted(spanOf(*lost, context))),
                   .span = cycle.span,
                   .labels = {{found, "the contour of this cycle"}, {spanOf(*lost, context), "the same number"}},
                   .notes = {"the numbers of a contour must not occur twice in a program: the cycle may cut another "
                             "contour",
                             "give the block in the other place another number, or none"}});
  return true;
}

/// One finding for both numbers of a contour.
class ContourNumbers {
public:
  void check(const Seekers &seekers, Copies copies, const FileContext &context, const Reporter &reporter) {
    if (isTold_)
      return;
    isTold_ = checkContour(seekers.contours, copies, context, reporter) ||
              checkSecondUse(seekers.contours, copies, context, reporter) ||
              checkSecondUse(seekers.ends, copies, context, reporter);
  }

private:
  bool isTold_ = false;
};

void check(ProgramId program, const FileContext &context, const Reporter &reporter) {
  const SeekersByNumber seekers = seekersOf(program, context);
  if (seekers.empty())
    return;
  const auto labels = sortedSequenceNumbers(context.model, program);
  ContourNumbers contours;
  for (std::size_t first = 0; first < labels.size();) {
    std::size_t last = first + 1;
    while (last < labels.size() && labels[last].number == labels[first].number)
      ++last;
    const Copies copies = Copies(labels).subspan(first, last - first);
    const auto found = seekers.find(labels[first].number);
    if (copies.size() > 1 && found != seekers.end()) {
      if (!found->second.gotos.empty())
        checkNumber(copies, found->second.gotos, context, reporter);
      contours.check(found->second, copies, context, reporter);
    }
    first = last;
  }
}

} // namespace

extern const Rule ambiguousLabel;
const Rule ambiguousLabel{.info = {"ambiguous-label", Category::Structure, Severity::Warning,
                                   "Reports a `GOTO`, or a contour cycle, with a sequence number that several blocks "
                                   "of the program have, when it may find the wrong one."},
                          .hooks = {.program = check}};

} // namespace feedhold::rules::ambiguous_label
