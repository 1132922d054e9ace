// thread-depth-with-point: `G76 X38.05 Z-40. P0.974 Q0.3 F1.5`; `P875 Q875`: the whole thread in one pass.
#include "findings/rule/rule.h"

#include <fmt/format.h>

#include <algorithm>

namespace feedhold::rules::thread_depth_with_point {
namespace {

bool hasPoint(const Word *word) { return word && word->isNumber() && word->has(Word::kPoint); }

void tellPoint(const Word &word, const FileContext &context, const Reporter &reporter) {
  reporter.report({.message = fmt::format("{} of `G76` takes no decimal point", context.quoted(word.span())),
                   .span = word.span(),
                   .notes = {"P and Q of the threading cycle are whole numbers of the least increment, such as "
                             "`P974` for 0.974 mm: the control stops, or reads another depth"}});
}

const Word *cycleIn(BlockId block, const FileContext &context) {
  for (const Word &word : context.tree.wordsOf(block)) {
    const Code *code = word.address() == 'G' ? codeOf(word, context.dialect) : nullptr;
    if (code && code->action == CodeAction::ThreadPasses)
      return &word;
  }
  return nullptr;
}

/// A block above cuts the same thread in several passes: this one finishes it.
bool finishes(BlockId cycle, const FileContext &context) {
  const auto textOf = [&](BlockId block, char letter) {
    const Word *word = findWord(context.tree, block, letter);
    return word ? context.text(word->span()) : std::string_view();
  };
  const BlockId first = context.model.programs[context.model.programOf(cycle)].first;
  for (BlockId block = first; block < cycle; block = block.next()) {
    const Word *depth = findWord(context.tree, block, 'Q');
    const Word *height = findWord(context.tree, block, 'P');
    if (depth && height && cycleIn(block, context) && depth->integer() < height->integer() &&
        std::ranges::all_of(std::string_view("XZUWP"),
                            [&](char letter) { return textOf(block, letter) == textOf(cycle, letter); }))
      return true;
  }
  return false;
}

/// The first pass is as deep as the whole thread.
void checkDepths(BlockId block, const Word &height, const Word &first, const FileContext &context,
                 const Reporter &reporter) {
  const auto whole = height.integer();
  const auto pass = first.integer();
  if (!whole || !pass || *whole == 0 || *pass < *whole || finishes(block, context))
    return;
  reporter.report({.message = fmt::format("{} cuts the thread in one pass: {} is its whole height",
                                          context.quoted(first.span()), context.quoted(height.span())),
                   .span = first.span(),
                   .labels = {{height.span(), "the height of the thread"}},
                   .notes = {"Q is the depth of the first pass"}},
                  Severity::Warning);
}

void check(BlockId block, const FileContext &context, const Reporter &reporter) {
  if (context.dialect.machine != MachineKind::Turning || !context.dialect.hasFanucParameters ||
      context.tree.blocks[block].has(Block::kBroken))
    return;
  if (!cycleIn(block, context))
    return;
  const Word *height = findWord(context.tree, block, 'P');
  const Word *first = findWord(context.tree, block, 'Q');
  if (hasPoint(height))
    tellPoint(*height, context, reporter);
  if (hasPoint(first))
    tellPoint(*first, context, reporter);
  const bool isCut = findWord(context.tree, block, 'Z') || findWord(context.tree, block, 'W');
  if (height && first && isCut && !hasPoint(height) && !hasPoint(first))
    checkDepths(block, *height, *first, context, reporter);
}

} // namespace

extern const Rule threadDepthWithPoint;
const Rule threadDepthWithPoint{
    .info = {"thread-depth-with-point", Category::Word, Severity::Warning,
             "Reports a threading cycle whose P or Q has a decimal point, or that cuts the whole height in one pass."},
    .hooks = {.block = check}};

} // namespace feedhold::rules::thread_depth_with_point
