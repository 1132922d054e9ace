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

void check(CallId id, const FileContext &context, const Reporter &reporter) {
  const Call &call = context.model.calls[id];
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
const Rule callWithoutProgram{.info = {"call-without-program", Category::Call, Severity::Error,
                                       "Reports a call without the number of the program that it calls."},
                              .hooks = {.call = check}};

} // namespace feedhold::rules::call_without_program
