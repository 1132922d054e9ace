// program-not-found: `M98 P1234`, and O1234 is in none of the files.
#include "findings/rule/rule.h"

#include "rules/calls/call_view.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>

namespace feedhold::rules::program_not_found {
namespace {

/// `N1000`, behind the end of the calling program and with an M99 behind it: what `M97 P1000` calls.
const Word *localSubprogram(const Call &call, const FileContext &context) {
  const auto number = call.programWord ? wordOf(context, *call.programWord).integer() : std::nullopt;
  if (!number || context.dialect.grammar.oWords)
    return nullptr;
  const Program &caller = context.model.programs[call.caller];
  const auto has = [&](BlockId block, CodeRole role) {
    return findCode(context.tree, block, context.dialect, role) != nullptr;
  };
  bool hasEnded = false;
  const Word *label = nullptr;
  for (BlockId block = caller.first; block < caller.last; block = block.next()) {
    const Word *own = findWord(context.tree, block, 'N');
    if (hasEnded && own && own->integer() == number)
      label = own;
    if (label && has(block, CodeRole::Return))
      return label;
    hasEnded = hasEnded || has(block, CodeRole::ProgramEnd) || has(block, CodeRole::Return);
  }
  return nullptr;
}

/// `M97` passes no arguments.
bool canBeLocal(const Call &call, const FileContext &context) {
  const bool isMacro = call.kind == CallKind::Macro && !call.arguments.empty();
  return !isMacro &&
         std::ranges::any_of(context.dialect.mCodes, [](const Code &code) { return code.role == CodeRole::LocalCall; });
}

void tellLocal(const Call &call, const Word &label, const FileContext &context, const Reporter &reporter) {
  const Word &code = wordOf(context, call.code);
  Diagnostic diagnostic{.message = fmt::format("{} calls another program, but {} is a subprogram in this one",
                                               context.quoted(call.span), context.quoted(label.span())),
                        .span = call.span,
                        .labels = {{label.span(), "this subprogram"}},
                        .notes = {fmt::format("no checked file holds a program of that number; if there is none on "
                                              "the machine, the control {}",
                                              stopsWith(context.dialect, AlarmKind::ProgramNotFound))}};
  if (canBeLocal(call, context)) {
    diagnostic.notes.emplace_back("`M97` calls a subprogram by its sequence number");
    diagnostic.fixes.push_back({.title = "write `M97`", .edits = {{code.span(), "M97"}}});
  } else {
    diagnostic.notes.push_back(
        fmt::format("a call goes to a program: write `{}` in place of the sequence number", toString(call.callee)));
  }
  reporter.report(std::move(diagnostic), Severity::Warning);
}

/// One finding for each missing program of a file: the first call of it.
void check(const FileContext &context, const Reporter &reporter) {
  std::set<std::string> seen;
  for (const Call &call : context.model.calls) {
    const bool names = (namesProgram(call.kind) && call.kind != CallKind::External) || call.kind == CallKind::OWord;
    if (!names || call.callee.empty() || !context.callGraph.candidates(context.file, call).empty())
      continue;
    const std::string name = toString(call.callee);
    if (!seen.insert(name).second)
      continue;
    if (const Word *label = localSubprogram(call, context)) {
      tellLocal(call, *label, context, reporter);
      continue;
    }
    // A file alone is a fragment of what is on the machine.
    if (context.callGraph.programCount() < 2)
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
