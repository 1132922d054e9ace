// feed-left-by-thread: `G76 X46.45 Z-115. .. F2.75`, and then `G01 X60.` without an F.
#include "rules/motion/turning_program.h"

#include <fmt/format.h>

#include <algorithm>

namespace feedhold::rules::feed_left_by_thread {
namespace {

class Reader {
public:
  Reader(ProgramId program, const FileContext &context)
      : context_(context), walk_(program, context), hidden_(program, context) {}

  void read(BlockId block, const Reporter &reporter) {
    const TurningMove move = walk_.read(block);
    const bool isHidden = hidden_.isIn(block);
    if (!isHidden && cutsThread(block))
      lead_ = findWord(context_.tree, block, 'F');
    else if (isHidden || findWord(context_.tree, block, 'F') || findWord(context_.tree, block, 'T'))
      lead_ = nullptr;
    else if (lead_ && move == TurningMove::Feed && !walk_.isInContour(block))
      tell(block, reporter);
  }

private:
  bool cutsThread(BlockId block) const {
    return std::ranges::any_of(context_.tree.wordsOf(block), [&](const Word &word) {
      const Code *code = word.isCode() ? codeOf(word, context_.dialect) : nullptr;
      return code && rules::cutsThread(*code);
    });
  }
  void tell(BlockId block, const Reporter &reporter) {
    const Span span = context_.tree.blocks[block].span();
    reporter.report({.message = fmt::format("{} moves with the lead of the thread as its feed", context_.quoted(span)),
                     .span = span,
                     .labels = {{lead_->span(), "the lead is the last F before it"}},
                     .notes = {"the feed of a threading cycle stays in force: no cut is meant to be fed so fast",
                               "write `G00` for a free move, or F with the feed of the cut"}});
    lead_ = nullptr;
  }

  const FileContext &context_;
  TurningWalk walk_;
  HiddenWork hidden_;
  const Word *lead_ = nullptr; // the F in force, where it is that of a thread
};

} // namespace

extern const Rule feedLeftByThread;
const Rule feedLeftByThread{.info = {"feed-left-by-thread", Category::Motion, Severity::Warning,
                                     "Reports a cut or a feed move of a lathe with the lead of a thread as its feed."},
                            .hooks = {.program = readTurningProgram<Reader>}};

} // namespace feedhold::rules::feed_left_by_thread
