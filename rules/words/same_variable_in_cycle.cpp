// same-variable-in-cycle: `G83 Z#9 R#3 Q#9`: the peck is the depth of the hole.
#include "findings/rule/rule.h"

#include <fmt/format.h>

#include <array>
#include <utility>

namespace feedhold::rules::same_variable_in_cycle {
namespace {

/// The word is one variable, and nothing else.
std::optional<std::uint32_t> variableIn(BlockId block, char address, const FileContext &context) {
  const Word *word = findWord(context.tree, block, address);
  if (!word || word->form() != WordForm::Expression || word->has(Word::kArgument))
    return std::nullopt;
  return variableNumber(context.tree, unwrapped(context.tree, word->expression()));
}

bool isCycle(BlockId block, const FileContext &context) {
  return context.dialect.machine == MachineKind::Milling &&
         findCode(context.tree, block, context.dialect, CodeRole::CannedCycle) != nullptr &&
         context.model.callsIn(block, block.next()).empty();
}

void check(BlockId block, const FileContext &context, const Reporter &reporter) {
  if (!isCycle(block, context))
    return;
  constexpr std::array kPairs = {std::pair{'Z', 'R'}, std::pair{'Z', 'Q'}, std::pair{'R', 'Q'}};
  for (const auto &[first, second] : kPairs) {
    const auto one = variableIn(block, first, context);
    if (!one || one != variableIn(block, second, context))
      continue;
    reporter.report({.message = fmt::format("{} and {} of this cycle are the same variable", first, second),
                     .span = findWord(context.tree, block, second)->span(),
                     .labels = {{findWord(context.tree, block, first)->span(), "also here"}},
                     .notes = {"the depth, the R level and the peck of a hole are three different numbers: one of the "
                               "two variables is wrong"}});
    return;
  }
}

} // namespace

extern const Rule sameVariableInCycle;
const Rule sameVariableInCycle{.info = {"same-variable-in-cycle", Category::Word, Severity::Warning,
                                        "Reports a canned cycle that takes two of its depth, R level and peck from one "
                                        "variable."},
                               .hooks = {.block = check}};

} // namespace feedhold::rules::same_variable_in_cycle
