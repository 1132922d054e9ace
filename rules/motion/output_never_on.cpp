// output-never-on: `M65 P2` and a wait for what it does, and no `M62 P2` or `M64 P2` in the folder.
#include "rules/motion/folder_programs.h"
#include "rules/motion/queued_output.h"

#include <algorithm>
#include <fmt/format.h>
#include <set>

namespace feedhold::rules::output_never_on {
namespace {

/// The output of that number, or one with a computed number, is switched on in the file.
bool switchesOn(std::uint32_t pin, const FileContext &context) {
  for (BlockId block(0); block.index() < context.tree.blockCount(); block = block.next()) {
    const auto output = outputIn(block, context);
    if (output && output->isOn && output->pin->integer().value_or(pin) == pin)
      return true;
  }
  return false;
}

bool isSwitchedOn(std::uint32_t pin, const FileContext &context) {
  return switchesOn(pin, context) || std::ranges::any_of(filesOfFolder(context), [&](FileId file) {
           return switchesOn(pin, contextOf(context.programs->file(file), context));
         });
}

BlockId nextWithContent(BlockId block, const FileContext &context) {
  do
    block = block.next();
  while (block.index() < context.tree.blockCount() && isEmpty(context.tree, block));
  return block;
}

void check(const FlowFacts &facts, const FileContext &context, const Reporter &reporter) {
  if (!context.dialect.grammar.oWords)
    return;
  std::set<std::uint32_t> told;
  const Program &program = context.model.programs[facts.program];
  for (BlockId block = program.first; block < program.last; block = block.next()) {
    const auto output = outputIn(block, context);
    const auto pin = output && !output->isOn ? output->pin->integer() : std::nullopt;
    const BlockId next = pin ? nextWithContent(block, context) : block;
    if (!pin || next >= program.last || !waitIn(next, context) || told.contains(*pin) || isSwitchedOn(*pin, context))
      continue;
    told.insert(*pin);
    const Span span{output->code->span().begin, std::max(output->code->span().end, output->pin->span().end)};
    reporter.report({.message = fmt::format("{} switches an output off that nothing switches on", context.quoted(span)),
                     .span = span,
                     .labels = {{context.tree.blocks[next].span(), "waits for what it does"}},
                     .notes = {"`M62` and `M64` switch on, `M63` and `M65` off: the output is off all the time",
                               "write `M64` where it is to be switched on"}});
  }
}

} // namespace

extern const Rule outputNeverOn;
const Rule outputNeverOn{.info = {"output-never-on",
                                  Category::Motion,
                                  Severity::Warning,
                                  "Reports an output that is switched off, and nowhere on, where the program waits for "
                                  "its effect.",
                                  {},
                                  CauseScope::OneFolder},
                         .hooks = {.flow = check}};

} // namespace feedhold::rules::output_never_on
