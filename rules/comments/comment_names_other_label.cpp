// comment-names-other-label: `IF[#1EQ#0]GOTO801(GO TO N802)`.
#include "findings/rule/rule.h"

#include "base/support/text.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <vector>

namespace feedhold::rules::comment_names_other_label {
namespace {

constexpr std::size_t kNone = std::string_view::npos;

std::size_t skip(std::string_view text, std::size_t at, std::string_view what) {
  while (at < text.size() && what.find(text[at]) != kNone)
    ++at;
  return at;
}

/// `TO N802`, `GOTO 802`, `go to, N802`: the number behind a TO.
std::optional<Decimal> labelBehind(std::string_view text, std::size_t to) {
  const bool isGoto = to >= 2 && toUpper(text[to - 1]) == 'O' && toUpper(text[to - 2]) == 'G';
  if (to > 0 && isLetter(text[to - 1]) && !isGoto)
    return std::nullopt;
  std::size_t at = skip(text, to + 2, " ,");
  const bool isNumbered = at < text.size() && toUpper(text[at]) == 'N';
  if (isNumbered)
    ++at;
  else if (!isGoto)
    return std::nullopt;
  std::int64_t number = 0;
  const std::size_t first = at;
  for (; at < text.size() && isDigit(text[at]) && at - first < 9; ++at)
    number = number * 10 + (text[at] - '0');
  const bool goesOn = at < text.size() && (text[at] == '.' || isDigit(text[at]) || isLetter(text[at]));
  return at == first || goesOn ? std::nullopt : std::optional(Decimal::fromInteger(number));
}

struct Named {
  Decimal number;
  Span comment;
};

/// All labels that the comments of a block name as the aim of a jump.
std::vector<Named> labelsIn(const FileContext &context, BlockId block) {
  std::vector<Named> found;
  for (const Comment &comment : context.tree.commentsOf(block)) {
    const std::string_view text = context.text(comment.span);
    for (std::size_t at = 0; at + 1 < text.size(); ++at)
      if (toUpper(text[at]) == 'T' && toUpper(text[at + 1]) == 'O')
        if (const auto label = labelBehind(text, at))
          found.push_back({*label, comment.span});
  }
  return found;
}

const Jump *onlyGoto(const FileContext &context, BlockId block) {
  const auto jumps = context.model.jumpsIn(block, block.next());
  return jumps.size() == 1 && jumps.front().kind == JumpKind::Goto && jumps.front().number && jumps.front().target
             ? &jumps.front()
             : nullptr;
}

bool isCommentAlone(const FileContext &context, BlockId block) {
  return isEmpty(context.tree, block) && !context.tree.commentsOf(block).empty();
}

/// What the comments say that belong to a jump: those of its block, and those of the next lines where the block before
/// is not a jump as well, which may be meant.
std::vector<Named> labelsAt(const FileContext &context, const Jump &jump, BlockId last) {
  std::vector<Named> found = labelsIn(context, jump.block);
  const bool isLone =
      jump.block.index() == 0 || context.model.jumpsIn(BlockId(jump.block.index() - 1), jump.block).empty();
  if (!found.empty() || !isLone)
    return found;
  for (BlockId block = jump.block.next(); block < last && isCommentAlone(context, block); block = block.next())
    for (const Named &named : labelsIn(context, block))
      if (context.text(named.comment).find('[') == std::string_view::npos) // a block that was taken out
        found.push_back(named);
  return found;
}

bool hasLabel(const FileContext &context, ProgramId program, const Decimal &number) {
  return std::ranges::any_of(context.model.sequenceNumbersOf(program),
                             [&](const SequenceNumber &label) { return label.number == number.toDouble(); });
}

void check(ProgramId program, const FileContext &context, const Reporter &reporter) {
  const BlockId last = context.model.programs[program].last;
  for (const Jump &each : context.model.jumpsOf(program)) {
    const Jump *jump = onlyGoto(context, each.block);
    const std::vector<Named> named = jump ? labelsAt(context, *jump, last) : std::vector<Named>{};
    if (named.size() != 1 || named.front().number == *jump->number)
      continue;
    const bool exists = hasLabel(context, program, named.front().number);
    Diagnostic diagnostic{.message = fmt::format("{}, but its comment names {}", context.quoted(jump->span),
                                                 exists ? "another block" : "a block that the program does not have"),
                          .span = jump->span,
                          .labels = {{named.front().comment, "the comment"}},
                          .notes = {"one of the two was changed without the other",
                                    "find out which block is meant, and correct the jump or the comment"}};
    reporter.report(std::move(diagnostic), exists ? Severity::Warning : Severity::Info);
  }
}

} // namespace

extern const Rule commentNamesOtherLabel;
const Rule commentNamesOtherLabel{
    .info = {"comment-names-other-label", Category::Comment, Severity::Warning,
             "Reports a `GOTO` to one sequence number beside a comment that says it goes to another."},
    .hooks = {.program = check}};

} // namespace feedhold::rules::comment_names_other_label
