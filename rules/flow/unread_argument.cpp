// unread-argument: the call passes R, and nothing in the macro reads `#18`.
#include "base/source/path_text.h"
#include "base/support/text.h"
#include "rules/flow/flow_view.h"

#include <algorithm>
#include <array>
#include <filesystem>
#include <fmt/format.h>
#include <string>

namespace feedhold::rules::unread_argument {
namespace {

/// The text of the program says what it reads of its local variables.
bool isTransparent(const ProgramFile &file, ProgramId program) {
  for (const Call &call : file.model->callsOf(program))
    if (call.kind != CallKind::Macro && call.kind != CallKind::Modal && call.kind != CallKind::ModalCancel &&
        call.kind != CallKind::OWord) // which has local variables of its own
      return false;
  for (const BlockId block : blocksOf(file, program))
    if (file.tree->blocks[block].has(Block::kBroken))
      return false;
  return std::ranges::none_of(file.model->variablesOf(program),
                              [&](const VariableUse &use) { return mayReadLocal(file, use); });
}

bool reads(const ProgramFile &file, ProgramId program, std::uint32_t variable) {
  return std::ranges::any_of(file.model->variablesOf(program),
                             [&](const VariableUse &use) { return !use.write && use.number == variable; });
}

/// Some call before this one in the file passes as many values to the same subroutine.
bool isTold(CallId id, std::size_t index, ProgramRef callee, const FileContext &context) {
  for (CallId each(0); each < id; each = each.next()) {
    const Call &call = context.model.calls[each];
    if (call.kind == CallKind::OWord && call.values.size() > index &&
        context.callGraph.callee(context.file, call) == callee)
      return true;
  }
  return false;
}

/// `(DEBUG, depth #3)`: the interpreter puts the value into the message.
bool isShown(const ProgramFile &file, ProgramId program, std::uint32_t variable) {
  constexpr std::array<std::string_view, 4> kMessages = {"DEBUG,", "PRINT,", "LOG,", "ABORT,"};
  const std::string name = fmt::format("#{}", variable);
  for (const BlockId block : blocksOf(file, program))
    for (const Comment &comment : file.tree->commentsOf(block)) {
      const std::string text = toUpper(trimmed(file.source->text(comment.span).substr(1)));
      if (std::ranges::none_of(kMessages, [&](std::string_view begin) { return text.starts_with(begin); }))
        continue;
      for (std::size_t at = text.find(name); at != std::string::npos; at = text.find(name, at + 1))
        if (at + name.size() == text.size() || !isDigit(text[at + name.size()]))
          return true;
    }
  return false;
}

/// One of the two lies in a folder around that of the other: not the subroutine of another machine.
bool isNear(const ProgramFile &file, const FileContext &context) {
  const auto folderOf = [](const SourceFile &source) {
    return pathText(std::filesystem::path(source.path()).parent_path());
  };
  const std::string own = folderOf(context.source);
  const std::string other = folderOf(*file.source);
  return own.starts_with(other) || other.starts_with(own);
}

/// `o<pocket> call [#1] [#2] [5]` of a subroutine that reads #1 and #2 only.
void checkOWord(CallId id, ProgramRef callee, const FileContext &context, const Reporter &reporter) {
  const Call &call = context.model.calls[id];
  const ProgramFile &file = context.programs->file(callee.file);
  if (call.values.empty() || !isTransparent(file, callee.program) || !isNear(file, context))
    return;
  const Program &program = file.model->programs[callee.program];
  const Contract *contract = context.contractOf(callee);
  for (std::size_t i = 0; i < call.values.size(); ++i) {
    const auto variable = static_cast<std::uint32_t>(i + 1);
    if (reads(file, callee.program, variable) || isShown(file, callee.program, variable) ||
        isTold(id, i, callee, context) || (contract && contract->param(variable)))
      continue;
    const Span value = context.tree.expressions[call.values[i]].span;
    reporter.report({.message = fmt::format("`{}` never reads `#{}`: {} has no effect", toString(program.name),
                                            variable, context.quoted(value)),
                     .span = value,
                     .labels = {{program.header, "the called subroutine", callee.file}},
                     .notes = {"the subroutine may take it from another variable, or no longer need it"}});
  }
}

void check(CallId id, const FileContext &context, const Reporter &reporter) {
  const Call &call = context.model.calls[id];
  if (const auto sub = context.callGraph.callee(context.file, call); sub && call.kind == CallKind::OWord)
    return checkOWord(id, *sub, context, reporter);
  const auto callee = context.callGraph.callee(context.file, call);
  if ((call.kind != CallKind::Macro && call.kind != CallKind::Modal) || !callee)
    return;
  const ProgramFile &file = context.programs->file(callee->file);
  if (!isTransparent(file, callee->program))
    return;
  const Program &program = file.model->programs[callee->program];
  const Contract *contract = context.contractOf(*callee);
  for (const Argument &argument : call.arguments) {
    const Word &word = context.tree.words[argument.word];
    const bool passesNothing = word.form() == WordForm::Expression && isVacant(context, word.expression());
    // A letter of I, J, K out of order is reported as such.
    if (argument.role != ArgumentRole::Passed || argument.variable == 0 || argument.fromSet || passesNothing ||
        reads(file, callee->program, argument.variable))
      continue;
    // A parameter of the contract belongs to the interface, as the radius of the tool does, which no block needs.
    const bool isPromised = contract && contract->param(argument.variable);
    reporter.report({.message = fmt::format("{} never reads `#{}`: {} has no effect", toString(program.name),
                                            argument.variable, context.quoted(word.span())),
                     .span = word.span(),
                     .labels = {{program.header, "the called program", callee->file}},
                     .notes = {"probably another letter was meant, or the macro no longer needs it"}},
                    isPromised ? Severity::Info : Severity::Warning);
  }
}

void asksForPrograms(const FlowFacts &, const FileContext &, const Reporter &) {}

} // namespace

extern const Rule unreadArgument;
const Rule unreadArgument{
    .info = {"unread-argument", Category::Flow, Severity::Warning,
             "Reports an argument of a macro call, or of a call by o-word, that the called program "
             "never reads."},
    .hooks = {.call = check, .flow = asksForPrograms}};

} // namespace feedhold::rules::unread_argument
