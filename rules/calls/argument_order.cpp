// argument-order: `G65 P9010 J2. I1.`.
#include "findings/rule/rule.h"

#include "rules/calls/call_view.h"

#include <fmt/format.h>

#include <algorithm>

namespace feedhold::rules::argument_order {
namespace {

char letterOf(const Argument &argument, const FileContext &context) { return wordOf(context, argument.word).address(); }

/// A letter twice means sets; each letter once, in the wrong order, hardly does.
bool repeatsLetter(const Call &call, const FileContext &context) {
  return std::ranges::any_of(std::string_view("IJK"), [&](char letter) {
    return std::ranges::count_if(call.arguments,
                                 [&](const Argument &argument) { return letterOf(argument, context) == letter; }) > 1;
  });
}

const Argument *setBefore(const Call &call, const Argument &argument, const FileContext &context) {
  const Argument *before = nullptr;
  for (const Argument &other : call.arguments) {
    const char letter = letterOf(other, context);
    if (&other == &argument)
      return before;
    if (letter == 'I' || letter == 'J' || letter == 'K')
      before = &other;
  }
  return before;
}

void check(CallId id, const FileContext &context, const Reporter &reporter) {
  const Call &call = context.model.calls[id];
  const auto shifted = std::ranges::find_if(call.arguments, [](const Argument &argument) { return argument.fromSet; });
  if (shifted == call.arguments.end() || repeatsLetter(call, context))
    return;
  const Argument *before = setBefore(call, *shifted, context);
  const char letter = letterOf(*shifted, context);
  const unsigned usual = context.dialect.argumentVariables[static_cast<std::size_t>(letter - 'A')];
  const Span span = wordOf(context, shifted->word).span();
  Diagnostic diagnostic{
      .message = fmt::format("{} sets `#{}`, not `#{}`: I, J and K are out of order", context.quoted(span),
                             shifted->variable, usual),
      .span = span,
      .notes = {"the control reads a letter that comes too late as the start of a second set of I, J, K",
                "write I before J before K"}};
  if (before)
    diagnostic.labels.push_back(
        {wordOf(context, before->word).span(), fmt::format("`{}` must come before it", letter)});
  reporter.report(std::move(diagnostic));
}

} // namespace

extern const Rule argumentOrder;
const Rule argumentOrder{.info = {"argument-order", Category::Call, Severity::Warning,
                                  "Reports I, J, K of a macro call in an order that moves them to other variables."},
                         .hooks = {.call = check}};

} // namespace feedhold::rules::argument_order
