// tailstock-back-while-turning: `M22` in front of `M05`.
#include "rules/motion/turning_program.h"

#include <fmt/format.h>

#include <algorithm>

namespace feedhold::rules::tailstock_back_while_turning {
namespace {

/// The word of the block with a code of this meaning: in the tables, that on a lathe stands behind that on a mill.
const Word *findMeaning(BlockId block, std::string_view meaning, const FileContext &context) {
  for (const Word &word : context.tree.wordsOf(block))
    if (const Code *code = codeOf(word, context.dialect); code && code->meaning.ends_with(meaning))
      return &word;
  return nullptr;
}

class Reader {
public:
  Reader(ProgramId program, const FileContext &context) : context_(context), hidden_(program, context) {}

  void read(BlockId block, const Reporter &reporter) {
    const auto find = [&](std::initializer_list<CodeAction> actions) {
      return findAction(context_.tree, block, context_.dialect, actions);
    };
    // A stop of the program stops the spindle, too.
    if (hidden_.isIn(block) || find({CodeAction::SpindleStop}) ||
        findCode(context_.tree, block, context_.dialect, CodeRole::ProgramStop))
      turning_ = nullptr;
    else if (const Word *start = find({CodeAction::SpindleClockwise, CodeAction::SpindleCounterclockwise}))
      turning_ = start;
    if (const Word *forward = findMeaning(block, "tailstock forward", context_))
      forward_ = forward;
    const Word *back = findMeaning(block, "tailstock back", context_);
    if (back && forward_ && turning_)
      tell(*back, reporter);
    if (back)
      forward_ = nullptr;
  }

private:
  void tell(const Word &back, const Reporter &reporter) const {
    reporter.report(
        {.message = fmt::format("{} takes the tailstock back while the spindle turns", context_.quoted(back.span())),
         .span = back.span(),
         .labels = {{forward_->span(), "the tailstock holds the part from here"},
                    {turning_->span(), "the spindle turns from here"}},
         .notes = {"the part turns at full speed without its support: it may whip, or leave the chuck",
                   fmt::format("stop the spindle first: `M05` before {}", context_.quoted(back.span()))}});
  }

  const FileContext &context_;
  HiddenWork hidden_;
  const Word *turning_ = nullptr; // M03 or M04, in force
  const Word *forward_ = nullptr; // the tailstock is at the part
};

} // namespace

extern const Rule tailstockBackWhileTurning;
const Rule tailstockBackWhileTurning{.info = {"tailstock-back-while-turning", Category::Motion, Severity::Warning,
                                              "Reports a lathe that takes the tailstock back from the part while the "
                                              "spindle turns."},
                                     .hooks = {.program = readTurningProgram<Reader>}};

} // namespace feedhold::rules::tailstock_back_while_turning
