// Slips are few or alike; a text in another language has many blocks of many kinds that cannot be read, or one habit
// that nobody has who writes for the control.
#include "findings/rule/other_control.h"

#include "base/support/text.h"
#include "findings/rule/dead_blocks.h"
#include "language/dialect/line_signals.h"

#include <algorithm>
#include <array>
#include <set>

namespace feedhold {
namespace {

// Measured on programs that run on real machines: beyond tests of a few lines, none has a tenth of its blocks unread.
// The programs in some forty other languages, read as this one, have a third or more of them so.
constexpr std::size_t kFewestUnread = 3;
constexpr std::size_t kShareOfBlocks = 5;        // one block of so many
constexpr std::size_t kShareWithOtherMarks = 10; // where variables or codes are of another control, too
constexpr std::size_t kFewestShapes = 3;         // of one or two, the author may believe that they are right
constexpr std::size_t kFewestBroken = 5;         // of all kinds
constexpr std::size_t kShareOfBroken = 7;        // one block of so many
constexpr std::size_t kFewestKinds = 4;          // of mistakes in them
constexpr std::size_t kFewestHabits = 2;         // one remark behind `//` may be a slip
constexpr std::size_t kFewestCommas = 3;         // a comma lies beside the point on some keyboards
constexpr std::size_t kFewestNamed = 3;          // a name or two may come from an example for another control

char charAt(std::string_view text, std::size_t at) { return at < text.size() ? text[at] : '\0'; }

std::string_view restOfBlock(const SyntaxIssue &issue, const FileContext &context) {
  return context.text({issue.span.end, context.tree.blocks[context.tree.blockAt(issue.span.begin)].end});
}

/// `// size tolerance`: something that no program is made of stands behind the slashes.
bool isSlashRemark(const SyntaxIssue &issue, const FileContext &context) {
  if (!context.text(issue.span).ends_with("//"))
    return false;
  TextScan scan;
  scanLine(restOfBlock(issue, context), scan);
  return scan.otherLines + scan.signalLines > 0;
}

/// `M00 /clamp again`
bool isBehindSlash(const SyntaxIssue &issue, const FileContext &context) {
  const BlockId block = context.tree.blockAt(issue.span.begin);
  const std::string_view before = trimmed(context.text({context.tree.blocks[block].begin, issue.span.begin}));
  return before.size() > 1 && before.ends_with('/') && isLetter(charAt(context.text(issue.span), 0));
}

bool isDecimalComma(const SyntaxIssue &issue, const FileContext &context) {
  const std::string_view text = context.source.text();
  return text[issue.span.begin] == ',' && issue.span.begin > 0 && isDigit(text[issue.span.begin - 1]) &&
         isDigit(charAt(text, issue.span.begin + 1));
}

/// `Y20 *45`: nobody writes a product of two numbers.
bool isChecksum(const SyntaxIssue &issue, const FileContext &context) {
  const std::string_view rest = trimmed(context.text(issue.span));
  const std::string_view number = rest.substr(0, 1) == "*" ? trimmed(rest.substr(1)) : std::string_view();
  const std::string_view word = context.text(issue.other);
  return !context.dialect.grammar.wordMayBeUnbracketed && !number.empty() && std::ranges::all_of(number, isDigit) &&
         word.find_first_of("#[") == std::string_view::npos && trimmed(restOfBlock(issue, context)).empty();
}

/// The first parenthesis closes, the last one opens.
bool closesFirst(std::string_view block) {
  const std::size_t at = block.find_first_of("()");
  return at != std::string_view::npos && block[at] == ')';
}
bool opensLast(std::string_view block) {
  const std::size_t at = block.find_last_of("()");
  return at != std::string_view::npos && block[at] == '(';
}

std::string_view textOf(std::size_t block, const FileContext &context) {
  return block < context.tree.blockCount() ? context.text(context.tree.blocks[BlockId(block)].span())
                                           : std::string_view();
}

/// A remark that is open at the end of its line, and closed there or in the next block.
bool isLongRemark(const SyntaxIssue &issue, const FileContext &context) {
  return issue.kind == SyntaxIssueKind::UnclosedComment &&
         (context.text(issue.span).ends_with(')') ||
          closesFirst(textOf(context.tree.blockAt(issue.span.begin).index() + 1, context)));
}

/// In the block that closes it.
bool isRestOfRemark(const SyntaxIssue &issue, const FileContext &context) {
  const std::size_t block = context.tree.blockAt(issue.span.begin).index();
  return block > 0 && closesFirst(textOf(block, context)) && opensLast(textOf(block - 1, context));
}

/// `GO1`, `X1O.`: the letter that looks like a digit is written so all over by those who do it at all.  `X?`, `X__`:
/// a number to be filled in.
bool isSlip(const SyntaxIssue &issue, const FileContext &context) {
  constexpr std::string_view kSlips = "OoIl?_";
  const std::uint32_t at = issue.kind == SyntaxIssueKind::MissingValue ? issue.span.end : issue.span.begin;
  const char next = charAt(context.source.text(), at);
  return next != '\0' && kSlips.find(next) != std::string_view::npos;
}

/// What mistakes in macro statements leave, a bracket or a THEN too few, shows that the author writes macros.
bool isOutsideLanguage(const SyntaxIssue &issue, const FileContext &context) {
  const bool isText = issue.kind == SyntaxIssueKind::UnexpectedText || issue.kind == SyntaxIssueKind::MissingValue;
  return habitAt(issue, context) || (isText && !isSlip(issue, context) && !isRestOfRemark(issue, context));
}

/// The beginning of what cannot be read, with any letter and any digit for its own.
std::string shapeOf(const SyntaxIssue &issue, const FileContext &context) {
  constexpr std::size_t kLength = 3;
  std::string shape(context.source.text().substr(issue.span.begin, kLength));
  for (char &c : shape)
    c = isDigit(c) ? '0' : toUpper(c);
  return shape;
}

struct Tally {
  std::size_t unread = 0;
  Span first;
  std::array<std::size_t, 5> habits{}; // by ForeignHabit, those that an issue shows
  std::set<std::string> shapes;
};

/// Each block counts once, by what cannot be read in it first.
Tally tallyOf(const FileContext &context) {
  Tally tally;
  std::optional<BlockId> last;
  for (const SyntaxIssue &issue : context.tree.issues) {
    const BlockId block = context.tree.blockAt(issue.span.begin);
    if (block == last || !isRead(context.tree.blocks[block]) || !isOutsideLanguage(issue, context))
      continue;
    last = block;
    tally.first = tally.unread++ == 0 ? issue.span : tally.first;
    if (const auto habit = habitAt(issue, context))
      ++tally.habits[static_cast<std::size_t>(*habit)];
    tally.shapes.insert(shapeOf(issue, context));
  }
  return tally;
}

/// Mistakes in macro statements that leave nothing of them; others, `IF [#1=2]`, some controls accept.
bool isOfStatement(const SyntaxIssue &issue) {
  constexpr std::array kKinds = {SyntaxIssueKind::BrokenExpression,   SyntaxIssueKind::ExpressionInParentheses,
                                 SyntaxIssueKind::MissingOpenBracket, SyntaxIssueKind::IfWithoutCondition,
                                 SyntaxIssueKind::DoWithoutNumber,    SyntaxIssueKind::WhileWithoutCondition};
  return std::ranges::find(kKinds, issue.kind) != kKinds.end();
}

/// Blocks that cannot be read, for whatever reason.
struct BrokenBlocks {
  std::size_t count = 0;
  std::set<SyntaxIssueKind> kinds;
};

BrokenBlocks brokenBlocksOf(const FileContext &context) {
  BrokenBlocks broken;
  std::optional<BlockId> last;
  for (const SyntaxIssue &issue : context.tree.issues) {
    const BlockId id = context.tree.blockAt(issue.span.begin);
    const Block &block = context.tree.blocks[id];
    if (!isRead(block) || !(block.has(Block::kBroken) || isOfStatement(issue)))
      continue;
    broken.count += id == last ? 0U : 1U;
    broken.kinds.insert(issue.kind);
    last = id;
  }
  return broken;
}

/// Blocks that hold something else than remarks.
std::size_t countBlocks(const FileContext &context) {
  std::size_t count = 0;
  for (BlockId id(0); id.index() < context.tree.blockCount(); id = id.next()) {
    const Block &block = context.tree.blocks[id];
    const bool isEmpty = context.tree.wordsOf(id).empty() && context.tree.statementsOf(id).empty();
    count += isRead(block) && (!isEmpty || block.has(Block::kBroken)) ? 1U : 0U;
  }
  return count;
}

/// The habit of nearly all blocks that cannot be read.
std::optional<ForeignHabit> commonHabit(const Tally &tally, std::size_t broken) {
  const auto most = std::ranges::max_element(tally.habits);
  const auto habit = static_cast<ForeignHabit>(most - tally.habits.begin());
  const std::size_t fewest = habit == ForeignHabit::DecimalComma ? kFewestCommas : kFewestHabits;
  const bool isCommon = *most >= fewest && *most * 4 >= tally.unread * 3 && *most * 2 >= broken;
  return isCommon ? std::optional(habit) : std::nullopt;
}

bool isTooMuch(const Tally &tally, std::size_t blocks, const FileContext &context) {
  if (tally.unread < kFewestUnread)
    return false;
  if (tally.unread * 2 >= blocks)
    return true;
  return tally.shapes.size() >= kFewestShapes &&
         (tally.unread * kShareOfBlocks >= blocks ||
          (tally.unread * kShareWithOtherMarks >= blocks && seemsForOtherControl(context)));
}

/// Macros of another language look like macros that are wrong all over, in many ways.
bool isBrokenAllOver(const BrokenBlocks &broken, std::size_t blocks) {
  return broken.count >= kFewestBroken && broken.count * kShareOfBroken >= blocks &&
         broken.kinds.size() >= kFewestKinds;
}

/// `#<depth>` is LinuxCNC's and its kin's, whose jumps have o-numbers; `IF [..] GOTO` and `DO1` are of controls without
/// such names.  Who writes both has a control that is neither, and its other rules are not known.
std::optional<UnreadText> namedMacroB(const FileContext &context) {
  if (context.source.text().find("#<") == std::string_view::npos)
    return std::nullopt;
  std::array<std::size_t, 2> counts{}; // blocks with names, blocks with jumps or loops
  std::array<Span, 2> first{};
  for (BlockId id(0); id.index() < context.tree.blockCount(); id = id.next()) {
    TextScan scan;
    scanLine(textOf(id.index(), context), scan);
    const std::array<bool, 2> isOfKind{scan.count(TextSignal::AngleName) > 0,
                                       scan.count(TextSignal::MacroBranch) + scan.count(TextSignal::NumberedLoop) > 0};
    for (std::size_t kind = 0; kind < counts.size(); ++kind)
      if (isOfKind[kind] && isRead(context.tree.blocks[id]) && counts[kind]++ == 0)
        first[kind] = context.tree.blocks[id].span();
  }
  if (counts[0] < kFewestNamed || counts[1] < kFewestHabits)
    return std::nullopt;
  const std::size_t foreign = context.dialect.grammar.namedParameters ? 1 : 0;
  return UnreadText{counts[foreign], std::max(countBlocks(context), counts[foreign]), first[foreign],
                    ForeignHabit::NamedMacroB};
}

} // namespace

std::optional<ForeignHabit> habitAt(const SyntaxIssue &issue, const FileContext &context) {
  if (issue.kind == SyntaxIssueKind::BlockSkipLevel && isSlashRemark(issue, context))
    return ForeignHabit::SlashRemark;
  if (issue.kind == SyntaxIssueKind::UnbracketedExpression && isChecksum(issue, context))
    return ForeignHabit::Checksum;
  if (isLongRemark(issue, context))
    return ForeignHabit::LongRemark;
  if (issue.kind != SyntaxIssueKind::UnexpectedText)
    return std::nullopt;
  if (isBehindSlash(issue, context))
    return ForeignHabit::SlashRemark;
  if (context.text(issue.span).starts_with('\''))
    return ForeignHabit::QuoteRemark;
  return isDecimalComma(issue, context) ? std::optional(ForeignHabit::DecimalComma) : std::nullopt;
}

std::optional<UnreadText> unreadTextOf(const FileContext &context) {
  if (const std::optional<UnreadText> mixed = namedMacroB(context))
    return mixed;
  if (context.tree.issues.size() < kFewestHabits)
    return std::nullopt;
  const Tally tally = tallyOf(context);
  const BrokenBlocks broken = brokenBlocksOf(context);
  if (tally.unread < kFewestHabits && broken.count < kFewestBroken)
    return std::nullopt;
  const std::size_t blocks = std::max(countBlocks(context), tally.unread);
  if (const std::optional<ForeignHabit> habit = commonHabit(tally, broken.count))
    return UnreadText{tally.unread, blocks, tally.first, habit};
  if (isTooMuch(tally, blocks, context))
    return UnreadText{tally.unread, blocks, tally.first};
  if (isBrokenAllOver(broken, blocks))
    return UnreadText{broken.count, blocks, context.tree.issues.front().span};
  return std::nullopt;
}

} // namespace feedhold
