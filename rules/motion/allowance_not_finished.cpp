// allowance-not-finished: `G71 P90 Q160 U1.0 W0.1`, and nothing cuts along the contour behind it.
#include "rules/comments/remarks_of_block.h"
#include "rules/motion/turning_walk.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <string>

namespace feedhold::rules::allowance_not_finished {
namespace {

/// U or W of the block with P and Q, other than 0.
const Word *allowanceIn(BlockId block, const FileContext &context) {
  for (const char address : {'U', 'W'})
    if (const Word *word = findWord(context.tree, block, address);
        word && word->isNumber() && !word->number().isZero() && !word->has(Word::kArgument))
      return word;
  return nullptr;
}

bool isRoughing(BlockId block, const FileContext &context) {
  const Word *word = findCode(context.tree, block, context.dialect, CodeRole::Contour);
  const Code *code = word ? codeOf(*word, context.dialect) : nullptr;
  return code && (code->action == CodeAction::TurnContour || code->action == CodeAction::FaceContour ||
                  code->action == CodeAction::RepeatContour);
}

/// What finishes a contour: a cycle that names one, or a cut along Z.  Drilling in the centre cuts none of it.
class Work {
public:
  Work(ProgramId program, const FileContext &context) : context_(context), walk_(program, context) {}

  /// Nothing is known of what a block does that is a call, or that moves in a way that is not known.
  void read(BlockId block) {
    const TurningPoint before = walk_.at();
    const TurningMove move = walk_.read(block);
    const bool isInCentre = before.x && walk_.at().x && *before.x == 0 && *walk_.at().x == 0;
    const bool goesAlong = findWord(context_.tree, block, 'Z') || findWord(context_.tree, block, 'W');
    const bool isContourCycle = findCode(context_.tree, block, context_.dialect, CodeRole::Contour) != nullptr;
    if (isContourCycle || (move == TurningMove::Feed && goesAlong && !isInCentre && !isThread(block)) ||
        (move == TurningMove::Unknown) || !context_.model.callsIn(block, block.next()).empty())
      last_ = block;
  }
  const std::vector<Contour> &contours() const { return walk_.contours(); }
  /// The last block that may finish a contour.
  const std::optional<BlockId> &last() const { return last_; }

private:
  bool isThread(BlockId block) const {
    return std::ranges::any_of(context_.tree.wordsOf(block), [&](const Word &word) {
      const Code *code = codeOf(word, context_.dialect);
      return code && cutsThread(*code);
    });
  }

  const FileContext &context_;
  TurningWalk walk_;
  std::optional<BlockId> last_;
};

/// `O1003 (ROUGHING)`, or `T0909 (OD ROUGH)` where it is the only tool: another program finishes the part, as the
/// remarks say in one of the languages of the shops.
bool isForRoughing(const Program &program, const FileContext &context) {
  std::string head;
  std::string tools;
  std::size_t calls = 0;
  for (BlockId block = program.first; block < program.last; block = block.next()) {
    const bool hasTool = findWord(context.tree, block, 'T') != nullptr;
    calls += hasTool ? 1 : 0;
    if (hasTool)
      tools += remarksOf(context, block);
    else if (calls == 0)
      head += remarksOf(context, block);
  }
  if (calls == 1)
    head += tools;
  return saysAny(head, {"ROUGH", "DESBAST", "EBAUCHE", "SCHRUPP", "SGROSS", "DEGROSS"}) &&
         !saysAny(head, {"FINISH", "ACABAM", "FINITION", "SCHLICHT", "FINITURA"});
}

void check(ProgramId program, const FileContext &context, const Reporter &reporter) {
  const Program &its = context.model.programs[program];
  if (context.dialect.machine != MachineKind::Turning || its.returns || !context.model.callsOf(program).empty() ||
      isForRoughing(its, context))
    return;
  Work work(program, context);
  bool ends = false;
  for (BlockId block = its.first; block < its.last; block = block.next()) {
    work.read(block);
    ends = ends || findCode(context.tree, block, context.dialect, CodeRole::ProgramEnd);
  }
  for (const Contour &contour : work.contours()) {
    const BlockId cycle = contour.cycle->block;
    const Word *allowance = allowanceIn(cycle, context);
    if (!ends || !allowance || !isRoughing(cycle, context) || !contour.standsBehindCycle() ||
        (work.last() && cycle < *work.last()))
      continue;
    const Word *code = findCode(context.tree, cycle, context.dialect, CodeRole::Contour);
    reporter.report({.message = fmt::format("nothing takes off the finishing allowance {} that {} leaves",
                                            context.quoted(allowance->span()), context.quoted(code->span())),
                     .span = allowance->span(),
                     .notes = {"no finishing cycle, and no other cut along the contour, comes behind it: the part "
                               "stays too large, a bore too small",
                               "write `G70` with the same P and Q behind the contour, or rough without an allowance"}});
  }
}

} // namespace

extern const Rule allowanceNotFinished;
const Rule allowanceNotFinished{
    .info = {"allowance-not-finished", Category::Motion, Severity::Warning,
             "Reports a roughing cycle of a lathe with a finishing allowance that nothing takes off behind it."},
    .hooks = {.program = check}};

} // namespace feedhold::rules::allowance_not_finished
