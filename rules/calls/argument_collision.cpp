// argument-collision: `G65 P1 I1. I2. D5.`: the second I and D are both #7.
#include "findings/rule/rule.h"

#include "rules/calls/call_view.h"

#include <fmt/format.h>

#include <algorithm>

namespace feedhold::rules::argument_collision {
namespace {

/// The word that wins: the last one of the variable.
const Argument &winner(const Call &call, const Argument &loser) {
  const auto last = std::find_if(call.arguments.rbegin(), call.arguments.rend(),
                                 [&](const Argument &other) { return other.variable == loser.variable; });
  return *last;
}

std::vector<std::string> notesFor(const Argument &lost, const Argument &later) {
  std::vector<std::string> notes;
  if (lost.fromSet || later.fromSet)
    notes.emplace_back("a second I, J or K in a call sets the variables of other letters");
  notes.emplace_back("delete one of the two words, or pass the value with another letter");
  return notes;
}

/// I, J or K counted as a second set only because the letters are out of order.  Controls differ there, and
/// argument-order says so; the collision is sure when the letter is written twice.
bool isSureOfSet(const Argument &argument, const Call &call, const FileContext &context) {
  const char letter = wordOf(context, argument.word).address();
  return !argument.fromSet || std::ranges::count_if(call.arguments, [&](const Argument &other) {
                                return wordOf(context, other.word).address() == letter;
                              }) > 1;
}

void check(CallId id, const FileContext &context, const Reporter &reporter) {
  const Call &call = context.model.calls[id];
  for (const Argument &argument : call.arguments) {
    if (argument.role != ArgumentRole::Overridden)
      continue;
    const Argument &later = winner(call, argument);
    if (!isSureOfSet(argument, call, context) || !isSureOfSet(later, call, context))
      continue;
    const Span lost = wordOf(context, argument.word).span();
    const Span wins = wordOf(context, later.word).span();
    reporter.report({.message = fmt::format("{} has no effect: {} also sets `#{}`", context.quoted(lost),
                                            context.quoted(wins), argument.variable),
                     .span = lost,
                     .labels = {{wins, "overwrites it"}},
                     .notes = notesFor(argument, later)});
  }
}

} // namespace

extern const Rule argumentCollision;
const Rule argumentCollision{.info = {"argument-collision", Category::Call, Severity::Warning,
                                      "Reports two words of a macro call that set the same local variable."},
                             .hooks = {.call = check}};

} // namespace feedhold::rules::argument_collision
