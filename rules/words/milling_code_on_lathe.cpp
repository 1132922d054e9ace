// milling-code-on-lathe: `T0303`, and then `G43 H1` of a program for a mill.
#include "findings/rule/rule.h"

#include <fmt/format.h>

#include <algorithm>

namespace feedhold::rules::milling_code_on_lathe {
namespace {

/// `T0303`: the turret, and the offset with it.
bool callsTurret(const Word &word) {
  const auto number = word.address() == 'T' && !word.has(Word::kArgument) ? word.integer() : std::nullopt;
  return number && *number >= 100 && *number / 100 == *number % 100;
}

/// Axes and planes of machines that turn and mill, on which a tool may have a length offset.
bool mills(BlockId block, const FileContext &context) {
  return std::ranges::any_of(context.tree.wordsOf(block),
                             [](const Word &word) { return word.address() == 'B' || word.address() == 'C'; }) ||
         findAction(context.tree, block, context.dialect, {CodeAction::PlaneXY, CodeAction::PlaneYZ});
}

struct Signs {
  const Word *turret = nullptr;
  const Word *length = nullptr; // G43 or G44
  const Word *change = nullptr; // M06 beside a tool without an offset
  const Word *y = nullptr;      // beside a return to the reference position
  bool movesY = false;          // elsewhere
  bool mills = false;
};

Signs signsOf(ProgramId program, const FileContext &context) {
  Signs signs;
  const Program &its = context.model.programs[program];
  for (BlockId block = its.first; block < its.last; block = block.next()) {
    signs.mills = signs.mills || mills(block, context);
    const bool isReturn = findCode(context.tree, block, context.dialect, CodeRole::ReferenceReturn);
    for (const Word &word : context.tree.wordsOf(block)) {
      const Code *code = word.isCode() ? codeOf(word, context.dialect) : nullptr;
      if (callsTurret(word))
        signs.turret = signs.turret ? signs.turret : &word;
      if (code && (code->action == CodeAction::LengthPlus || code->action == CodeAction::LengthMinus) &&
          findWord(context.tree, block, 'H'))
        signs.length = signs.length ? signs.length : &word;
      const Word *tool = code && code->action == CodeAction::ToolChange ? findWord(context.tree, block, 'T') : nullptr;
      if (tool && tool->integer().value_or(0) > 0 && *tool->integer() < 100)
        signs.change = signs.change ? signs.change : &word;
      if (word.address() == 'Y' && isReturn)
        signs.y = &word;
      else if (word.address() == 'Y')
        signs.movesY = true;
    }
  }
  return signs;
}

void check(ProgramId program, const FileContext &context, const Reporter &reporter) {
  if (context.dialect.machine != MachineKind::Turning || context.dialect.grammar.oWords)
    return;
  const Signs signs = signsOf(program, context);
  if (!signs.turret || signs.mills || signs.movesY)
    return;
  if (signs.length)
    reporter.report(
        {.message = fmt::format("{} is a length offset of a mill, in a program of a lathe",
                                context.quoted(signs.length->span())),
         .span = signs.length->span(),
         .labels = {{signs.turret->span(), "the turret, with its offset"}},
         .notes = {"a lathe takes the offset by the T word: the control stops, or shifts the tool once more",
                   "take it out together with its H"}});
  if (signs.change)
    reporter.report({.message = fmt::format("{} changes the tool of a mill, in a program of a lathe",
                                            context.quoted(signs.change->span())),
                     .span = signs.change->span(),
                     .labels = {{signs.turret->span(), "the turret, with its offset"}},
                     .notes = {"a lathe calls a tool by T alone; a T of one or two digits takes no geometry offset, or "
                               "only the offset",
                               "take the block out, or write tool and offset, such as `T0101`"}});
  if (signs.y)
    reporter.report(
        {.message = fmt::format("{} names an axis in which no other block of this lathe moves",
                                context.quoted(signs.y->span())),
         .span = signs.y->span(),
         .labels = {{signs.turret->span(), "the turret"}},
         .notes = {"a lathe with the axes X and Z stops with an alarm", "write X and Z, or U and W, to return"}});
}

} // namespace

extern const Rule millingCodeOnLathe;
const Rule millingCodeOnLathe{
    .info = {"milling-code-on-lathe", Category::Word, Severity::Warning,
             "Reports a length offset, the tool change of a mill, and a Y only in the return to the reference "
             "position, in a program that calls the tools of a turret."},
    .hooks = {.program = check}};

} // namespace feedhold::rules::milling_code_on_lathe
