// program-not-found: `M98 P1234`, and O1234 is in none of the files.
#include "findings/rule/rule.h"

#include "rules/calls/call_view.h"

#include <fmt/format.h>

#include <set>

namespace feedhold::rules::program_not_found {
namespace {

/// One finding for each missing program of a file: the first call of it.
void check(const FileContext &context, const Reporter &reporter) {
  // A file alone is a fragment of what is on the machine.
  if (context.callGraph.programCount() < 2)
    return;
  std::set<std::string> seen;
  for (const Call &call : context.model.calls) {
    const bool names = (namesProgram(call.kind) && call.kind != CallKind::External) || call.kind == CallKind::OWord;
    if (!names || call.callee.empty() || !context.callGraph.candidates(context.file, call).empty())
      continue;
    const std::string name = toString(call.callee);
    if (!seen.insert(name).second)
      continue;
    reporter.report({.message = fmt::format("`{}` is in none of the checked files", name),
                     .span = call.programWord ? wordOf(context, *call.programWord).span() : call.span,
                     .notes = {fmt::format("if it is not on the machine either, the control {}",
                                           stopsWith(context.dialect, AlarmKind::ProgramNotFound))}});
  }
}

} // namespace

extern const Rule programNotFound;
const Rule programNotFound{.info = {"program-not-found",
                                    Category::Call,
                                    Severity::Info,
                                    "Reports a call to a program that is in none of the checked files.",
                                    {},
                                    CauseScope::OneFolder},
                           .hooks = {.file = check}};

} // namespace feedhold::rules::program_not_found
