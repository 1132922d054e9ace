// call-without-program: `M98` and no P.
#include "findings/rule/rule.h"

#include "rules/calls/call_view.h"

#include <fmt/format.h>

#include <algorithm>

namespace feedhold::rules::call_without_program {
namespace {

/// `M98 (FOLDER/PART.NC)`: some controls take the path of a file in parentheses.
bool namesFile(const FileContext &context, BlockId block) {
  return std::ranges::any_of(context.tree.commentsOf(block), [&](const Comment &comment) {
    return context.text(comment.span).find_first_of("/.") != std::string_view::npos;
  });
}

/// `M98 P0`
bool namesNone(const Call &call, const FileContext &context) {
  return namesProgram(call.kind) && call.programWord && !context.dialect.grammar.oWords &&
         wordOf(context, *call.programWord).integer() == 0;
}

void check(CallId id, const FileContext &context, const Reporter &reporter) {
  const Call &call = context.model.calls[id];
  if (namesNone(call, context)) {
    const Span zero = wordOf(context, *call.programWord).span();
    reporter.report({.message = fmt::format("{} names no program: numbers begin at 1", context.quoted(zero)),
                     .span = zero,
                     .notes = {fmt::format("the control {}", stopsWith(context.dialect, AlarmKind::ProgramNotFound))}});
    return;
  }
  const bool needsOne = namesProgram(call.kind) || call.kind == CallKind::Local;
  if (!needsOne || call.programWord || context.tree.blocks[call.block].has(Block::kBroken) ||
      namesFile(context, call.block))
    return;
  const Span code = wordOf(context, call.code).span();
  const bool local = call.kind == CallKind::Local;
  reporter.report(
      {.message =
           fmt::format("{} does not say which {} to call", context.quoted(code), local ? "sequence number" : "program"),
       .span = code,
       .notes = {fmt::format("the control {}", stopsWith(context.dialect, local ? AlarmKind::SequenceNotFound
                                                                                : AlarmKind::ProgramNotFound)),
                 "write the number with P in the same block"}});
}

} // namespace

extern const Rule callWithoutProgram;
const Rule callWithoutProgram{
    .info = {"call-without-program", Category::Call, Severity::Error,
             "Reports a call without the number of the program that it calls, or with the number 0."},
    .hooks = {.call = check}};

} // namespace feedhold::rules::call_without_program
