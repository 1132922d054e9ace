// self-assignment: `#1=#1`; `G10 L2 P1 X#5221`.
#include "findings/rule/rule.h"

#include "rules/expressions/expression_view.h"

#include <fmt/format.h>

#include <string_view>

namespace feedhold::rules::self_assignment {
namespace {

void check(const Statement &statement, BlockId block, const FileContext &context, const Reporter &reporter) {
  const auto *assignment = std::get_if<Assignment>(&statement.node);
  if (!assignment)
    return;
  const Span target = context.tree.expressions[assignment->target].span;
  const Span value = context.tree.expressions[unwrapped(context.tree, assignment->value)].span;
  if (!sameText(context, target, value))
    return;
  // `#1=#1 (START Y)` is how some writers note what an argument is.
  const bool saysWhy = !context.tree.commentsOf(block).empty();
  reporter.report({.message = fmt::format("{} is assigned to itself", context.quoted(target)),
                   .span = statement.span,
                   .notes = {"nothing changes; probably another variable was meant"}},
                  saysWhy ? Severity::Info : Severity::Warning);
}

/// The variable of a work offset: of G54 in X #5221, of G55 #5241.
std::uint32_t variableOf(std::uint32_t offset, std::size_t axis) {
  constexpr std::uint32_t kFirst = 5201; // the external offset, P0
  constexpr std::uint32_t kStep = 20;
  return kFirst + kStep * offset + static_cast<std::uint32_t>(axis);
}

/// `G10 L2 P1 X#5221 Y#5222`: each axis gets what it has.
void checkOffset(BlockId block, const FileContext &context, const Reporter &reporter) {
  constexpr std::string_view kAxes = "XYZ";
  constexpr std::uint32_t kLast = 6; // G59
  const Word *table = findWord(context.tree, block, 'L');
  if (!table || context.dialect.grammar.oWords || context.dialect.machine != MachineKind::Milling ||
      !findCode(context.tree, block, context.dialect, CodeRole::DataSetting) ||
      findAction(context.tree, block, context.dialect, {CodeAction::Incremental}))
    return;
  const Word *offset = findWord(context.tree, block, 'P');
  const auto number = table->integer() == 2U && offset ? offset->integer() : std::nullopt;
  if (!number || *number > kLast)
    return;
  const Word *first = nullptr;
  for (const Word &word : context.tree.wordsOf(block)) {
    const std::size_t axis = kAxes.find(word.address());
    if (axis == std::string_view::npos)
      continue;
    const auto variable = word.form() == WordForm::Expression
                              ? variableNumber(context.tree, unwrapped(context.tree, word.expression()))
                              : std::nullopt;
    if (variable != variableOf(*number, axis))
      return;
    first = first ? first : &word;
  }
  if (first)
    reporter.report({.message = fmt::format("{} sets the offset to what it is", context.quoted(first->span())),
                     .span = first->span(),
                     .notes = {"nothing changes; probably the difference was to be added, or another offset meant"}});
}

} // namespace

extern const Rule selfAssignment;
const Rule selfAssignment{.info = {"self-assignment", Category::Expression, Severity::Warning,
                                   "Reports a variable or a work offset that is assigned to itself."},
                          .hooks = {.block = checkOffset, .statement = check}};

} // namespace feedhold::rules::self_assignment
