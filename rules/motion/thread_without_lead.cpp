// thread-without-lead: `G01 X30. F0.2`, and then `G92 X29.4 Z-20.`: the lead is 0.2.
#include "rules/motion/tool_sections.h"
#include "rules/motion/turning_walk.h"

#include <fmt/format.h>

namespace feedhold::rules::thread_without_lead {
namespace {

class Reader {
public:
  Reader(ProgramId program, const FileContext &context) : context_(context), hidden_(program, context) {}

  void read(BlockId block, const Reporter &reporter) {
    if (hidden_.isIn(block) || meansOwnWords(context_.tree, block, context_.dialect))
      return lose();
    const Word *thread = threadIn(block);
    if (thread && !findWord(context_.tree, block, 'F') && isSetting(*thread))
      thread = nullptr;
    hasStarted_ = hasStarted_ || starts(block);
    const Word *feed = findWord(context_.tree, block, 'F');
    noteMotion(block, thread);
    if (feed) {
      feed_ = feed;
      isLead_ = isThreading_;
      isKnown_ = true;
    } else if (thread && isKnown_ && !isLead_ && namesEnd(block) && !findWord(context_.tree, block, 'E')) {
      tell(*thread, reporter);
      isLead_ = true; // told once for one thread
    }
  }

private:
  /// `G92 X200. Z220.` at the head, before the first move and before the spindle starts: where the tool is.
  bool isSetting(const Word &thread) const { return !hasStarted_ && thread.integer() == 92; }
  bool starts(BlockId block) const {
    return findWord(context_.tree, block, 'S') || findWord(context_.tree, block, 'T') ||
           findWord(context_.tree, block, 'F') || findCode(context_.tree, block, context_.dialect, CodeRole::Motion) ||
           findAction(context_.tree, block, context_.dialect,
                      {CodeAction::SpindleClockwise, CodeAction::SpindleCounterclockwise});
  }
  void lose() {
    isKnown_ = false;
    hasStarted_ = true;
    feed_ = nullptr;
  }
  const Word *threadIn(BlockId block) const {
    for (const Word &word : context_.tree.wordsOf(block))
      if (const Code *code = codeOf(word, context_.dialect); code && cutsThread(*code))
        return &word;
    return nullptr;
  }
  /// Blocks behind G32 or G92 without a code of motion go on with the thread.
  void noteMotion(BlockId block, const Word *thread) {
    if (thread)
      isThreading_ = true;
    else if (findCode(context_.tree, block, context_.dialect, CodeRole::Motion) ||
             findCode(context_.tree, block, context_.dialect, CodeRole::Arc) ||
             findCode(context_.tree, block, context_.dialect, CodeRole::CannedCycle) ||
             findCode(context_.tree, block, context_.dialect, CodeRole::Contour))
      isThreading_ = false;
  }
  bool namesEnd(BlockId block) const {
    return findWord(context_.tree, block, 'Z') || findWord(context_.tree, block, 'W');
  }
  void tell(const Word &thread, const Reporter &reporter) const {
    Diagnostic diagnostic{.message =
                              fmt::format("{} cuts a thread without an F of its own", context_.quoted(thread.span())),
                          .span = thread.span(),
                          .notes = {feed_ ? "the control takes the feed in force as the lead of the thread"
                                          : "no F stands above it: the control stops, or cuts with an old feed as lead",
                                    "write the lead as F in this block"}};
    if (feed_)
      diagnostic.labels = {{feed_->span(), "the feed in force"}};
    reporter.report(std::move(diagnostic));
  }

  const FileContext &context_;
  HiddenWork hidden_;
  const Word *feed_ = nullptr; // the last one
  bool hasStarted_ = false;    // a tool, the spindle or a move stands above
  bool isKnown_ = true;        // which F is the last one, or that there is none
  bool isLead_ = false;        // it was written for a thread
  bool isThreading_ = false;   // the code of motion in force cuts a thread
};

void check(ProgramId program, const FileContext &context, const Reporter &reporter) {
  const Program &its = context.model.programs[program];
  if (context.dialect.machine != MachineKind::Turning || its.returns || its.name.isSubroutine)
    return;
  Reader reader(program, context);
  for (BlockId block = its.first; block < its.last; block = block.next())
    reader.read(block, reporter);
}

} // namespace

extern const Rule threadWithoutLead;
const Rule threadWithoutLead{.info = {"thread-without-lead", Category::Motion, Severity::Warning,
                                      "Reports a thread of a lathe whose first block has no `F`, so that the feed of "
                                      "the cut before becomes its lead."},
                             .hooks = {.program = check}};

} // namespace feedhold::rules::thread_without_lead
