// two-block-cycle: `G71 U1.5 R.5` and `G71 P100 Q110 ..` on a control that takes the cycle in one block.
#include "rules/motion/tool_sections.h"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>

namespace feedhold::rules::two_block_cycle {
namespace {

/// The words of a first block, and those of the second one that it must not have.
struct Form {
  CodeAction action;
  std::string_view first;
  std::string_view second;
};

/// As the manuals of FANUC have them (B-64604EN-1, multiple repetitive cycles).
constexpr Form kForms[] = {{CodeAction::TurnContour, "UR", "PQ"},   {CodeAction::FaceContour, "WR", "PQ"},
                           {CodeAction::RepeatContour, "UR", "PQ"}, {CodeAction::ThreadPasses, "PQ", "XZ"},
                           {CodeAction::FaceGroove, "R", "ZF"},     {CodeAction::DiameterGroove, "R", "XF"}};

class Reader {
public:
  Reader(ProgramId program, const FileContext &context) : context_(context), its_(context.model.programs[program]) {}

  void read(BlockId block, const Reporter &reporter) const {
    for (const Form &form : kForms)
      if (const Word *code = codeIn(block, form); code && isFirst(block, form))
        if (const auto next = nextWith(block))
          if (const Word *other = codeIn(*next, form); other && has(*next, form.second))
            report(*code, *other, reporter);
  }

private:
  const Word *codeIn(BlockId block, const Form &form) const {
    return findAction(context_.tree, block, context_.dialect, {form.action});
  }
  bool has(BlockId block, std::string_view addresses) const {
    return std::ranges::all_of(addresses,
                               [&](char address) { return findWord(context_.tree, block, address) != nullptr; });
  }
  bool isFirst(BlockId block, const Form &form) const {
    const bool hasOther = std::ranges::any_of(
        form.second, [&](char address) { return findWord(context_.tree, block, address) != nullptr; });
    return has(block, form.first) && !hasOther;
  }
  /// The next block with words.
  std::optional<BlockId> nextWith(BlockId block) const {
    for (BlockId next = block.next(); next < its_.last; next = next.next())
      if (!context_.tree.wordsOf(next).empty())
        return next;
    return std::nullopt;
  }
  void report(const Word &code, const Word &other, const Reporter &reporter) const {
    reporter.report({.message = fmt::format("{} is written in two blocks, and {} takes it in one",
                                            context_.quoted(code.span()), context_.dialect.id),
                     .span = code.span(),
                     .labels = {{other.span(), "the second block"}},
                     .notes = {"two blocks are the form of other controls; this one stops at the first of them, or "
                               "cuts the second with a depth of cut of its own",
                               "write one block with all words, or name the control if it is another one"}});
  }

  const FileContext &context_;
  const Program &its_;
};

void check(ProgramId program, const FileContext &context, const Reporter &reporter) {
  if (!context.dialect.behaviour.oneBlockCycles || context.dialect.machine != MachineKind::Turning)
    return;
  const Reader reader(program, context);
  const Program &its = context.model.programs[program];
  for (BlockId block = its.first; block < its.last; block = block.next())
    reader.read(block, reporter);
}

} // namespace

extern const Rule twoBlockCycle;
const Rule twoBlockCycle{.info = {"two-block-cycle", Category::Motion, Severity::Warning,
                                  "Reports a turning cycle in two blocks on a control that takes it in one."},
                         .hooks = {.program = check}};

} // namespace feedhold::rules::two_block_cycle
