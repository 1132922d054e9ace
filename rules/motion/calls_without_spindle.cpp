// calls-without-spindle: `M98P9998` cuts, and neither program has M03 or S.
#include "rules/motion/motion_view.h"

#include <algorithm>
#include <array>
#include <fmt/format.h>
#include <set>

namespace feedhold::rules::calls_without_spindle {
namespace {

/// What the text of a program, and of those that it calls, does.
struct Work {
  bool cuts = false;      // a block with G01, G02, G03 or a drilling cycle, and an end point
  bool hasTool = false;   // M06 or G43: a machine that changes tools, no plotter
  bool isUnknown = false; // it may start the spindle, or measure, or cut with something else
};

class Reader {
public:
  explicit Reader(const FileContext &context) : context_(context) {}

  Work read(ProgramRef program) {
    seen_.clear();
    Work work;
    readProgram(program, work);
    return work;
  }
  /// Of the program alone.
  void readBlocks(ProgramRef ref, Work &work) const {
    const ProgramFile &file = context_.programs->file(ref.file);
    const Program &program = file.model->programs[ref.program];
    for (BlockId block = program.first; block < program.last; block = block.next())
      readBlock(file, block, work);
  }

private:
  void readProgram(ProgramRef ref, Work &work) {
    if (!seen_.insert(ref).second)
      return;
    readBlocks(ref, work);
    for (const Call &call : context_.programs->file(ref.file).model->callsOf(ref.program)) {
      const auto callee = context_.callGraph.callee(ref.file, call);
      if (callee)
        readProgram(*callee, work);
      else
        work.isUnknown = work.isUnknown || call.kind != CallKind::ModalCancel;
    }
  }
  void readBlock(const ProgramFile &file, BlockId block, Work &work) const {
    if (file.tree->blocks[block].has(Block::kData))
      return;
    bool isCut = false;
    bool hasEnd = false;
    for (const Word &word : file.tree->wordsOf(block)) {
      hasEnd = hasEnd || word.address() == 'X' || word.address() == 'Y' || word.address() == 'Z';
      work.isUnknown = work.isUnknown || (word.address() == 'S' && !word.has(Word::kArgument));
      if (!word.isCode())
        continue;
      const Code *code = codeOf(word, *file.dialect);
      work.isUnknown = work.isUnknown || !code || mayTurnSpindle(*code);
      isCut = isCut || (code && isCutting(*code));
      work.hasTool =
          work.hasTool || (code && (code->action == CodeAction::LengthPlus || code->action == CodeAction::ToolChange));
    }
    work.cuts = work.cuts || (isCut && hasEnd);
  }
  static bool mayTurnSpindle(const Code &code) {
    constexpr std::array kTurning = {CodeAction::SpindleClockwise,
                                     CodeAction::SpindleCounterclockwise,
                                     CodeAction::CycleTap,
                                     CodeAction::CycleTapLeft,
                                     CodeAction::Unmodelled,
                                     CodeAction::Anything,
                                     CodeAction::Device};
    return isSkip(code.role) || std::ranges::find(kTurning, code.action) != kTurning.end();
  }
  static bool isCutting(const Code &code) {
    constexpr std::array kCutting = {CodeAction::Linear,     CodeAction::ArcClockwise, CodeAction::ArcCounterclockwise,
                                     CodeAction::CycleDrill, CodeAction::CyclePeck,    CodeAction::CycleChipBreak};
    return std::ranges::find(kCutting, code.action) != kCutting.end();
  }

  const FileContext &context_;
  std::set<ProgramRef> seen_;
};

void check(const FlowFacts &facts, const FileContext &context, const Reporter &reporter) {
  if (context.dialect.machine != MachineKind::Milling || context.dialect.behaviour.endRestoresModes ||
      startedBy(context, facts.program) != StartedBy::Operator || !comesToItsEnd(facts))
    return;
  const ProgramRef program{context.file, facts.program};
  const auto calls = context.model.callsOf(facts.program);
  Reader reader(context);
  Work own;
  reader.readBlocks(program, own);
  if (calls.empty() || own.cuts) // its own moves are another rule's
    return;
  const Work all = reader.read(program);
  if (!all.cuts || !all.hasTool || all.isUnknown)
    return;
  const Call &first = calls.front();
  reporter.report(
      {.message = fmt::format("{} cuts, but neither program starts the spindle", context.quoted(first.span)),
       .span = first.span,
       .notes = {"no S, `M03` or `M04` stands in this program or in those that it calls",
                 "start the spindle with S and M03 before the call"}});
}

} // namespace

extern const Rule callsWithoutSpindle;
const Rule callsWithoutSpindle{.info = {"calls-without-spindle", Category::Motion, Severity::Warning,
                                        "Reports a main program whose called programs cut, when nothing in any of them "
                                        "starts the spindle."},
                               .hooks = {.flow = check}};

} // namespace feedhold::rules::calls_without_spindle
