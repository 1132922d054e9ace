// offset-value-as-number: `G43 H#11001`, the length of tool 1 in the place of its number.
#include "rules/flow/system_variables.h"

#include <fmt/format.h>

namespace feedhold::rules::offset_value_as_number {
namespace {

void check(const Word &word, BlockId block, const FileContext &context, const Reporter &reporter) {
  if (word.form() != WordForm::Expression || word.has(Word::kArgument) ||
      !context.model.callsIn(block, block.next()).empty())
    return;
  const auto number = tableNumber(context, word.expression());
  if (!number || !isToolOffset(context, *number))
    return;
  const Span value = context.tree.expressions[word.expression()].span;
  reporter.report(
      {.message = fmt::format("{} takes the value of an offset for the number of one", context.quoted(word.span())),
       .span = word.span(),
       .labels = {{value, "the offset of a tool, in millimetres or inches"}},
       .notes = {fmt::format("`{}` names an offset by its number, which the control rounds to a whole one or "
                             "refuses",
                             word.address()),
                 fmt::format("write the number of the offset, such as `{}1`", word.address())}});
}

} // namespace

extern const Rule offsetValueAsNumber;
const Rule offsetValueAsNumber{.info = {"offset-value-as-number", Category::Motion, Severity::Warning,
                                        "Reports an H or D that takes the value of a tool offset for its number."},
                               .hooks = {.word = check, .wordAddresses = "HD"}};

} // namespace feedhold::rules::offset_value_as_number
