// exchanged-arguments: `o<slot> call [#<depth>] [#<length>]` of a subroutine with `#<length> = #1`, `#<depth> = #2`.
#include "rules/expressions/expression_view.h"

#include "base/support/text.h"

#include <algorithm>
#include <array>
#include <fmt/format.h>
#include <string>
#include <vector>

namespace feedhold::rules::exchanged_arguments {
namespace {

/// As names are compared: case, blanks and the mark of a global parameter do not count.
std::string plainName(std::string_view name) {
  std::string plain;
  for (const char c : name)
    if (!isBlank(c) && !(plain.empty() && c == '_'))
      plain += toUpper(c);
  return plain;
}

/// The name of an expression that is a named parameter and nothing else; else empty.
std::string nameIn(const SourceFile &source, const SyntaxTree &tree, ExpressionId id) {
  const auto *named = asInside<NamedVariable>(tree, id);
  return named ? plainName(source.text(named->name)) : std::string();
}

/// Places in an order that may be reversed on purpose, as axes may be exchanged.
bool mayBeReversed(std::string_view name) {
  constexpr std::array<std::string_view, 6> kEnds = {"START", "END", "FIRST", "LAST", "FROM", "TO"};
  return name.size() < 3 ||
         std::ranges::any_of(kEnds, [&](std::string_view end) { return name.find(end) != std::string_view::npos; });
}

/// What a name says it is, as a place in a list; values of two kinds are never exchanged on purpose.
std::size_t kindOf(std::string_view name) {
  constexpr std::array<std::string_view, 8> kKinds = {"DEPTH", "FEED",  "SPEED",  "TOOL",
                                                      "ANGLE", "COUNT", "RADIUS", "DIAM"};
  const auto found =
      std::ranges::find_if(kKinds, [&](std::string_view kind) { return name.find(kind) != std::string_view::npos; });
  return static_cast<std::size_t>(found - kKinds.begin());
}

struct Parameter {
  std::string name; // empty: the subroutine gives it none, or several
  Span copied = {}; // `#<length> = #1`
};

/// What a subroutine calls its arguments, by their numbers less one.
std::vector<Parameter> parametersOf(const ProgramFile &file, ProgramId program) {
  std::vector<Parameter> parameters(30);
  std::vector<bool> isTwice(parameters.size());
  const Program &its = file.model->programs[program];
  for (BlockId block = its.first; block < its.last; block = block.next())
    for (const Statement &statement : file.tree->statementsOf(block)) {
      const auto *assignment = std::get_if<Assignment>(&statement.node);
      const auto number = assignment ? variableNumber(*file.tree, unwrapped(*file.tree, assignment->value))
                                     : std::optional<std::uint32_t>();
      const std::string name = number ? nameIn(*file.source, *file.tree, assignment->target) : std::string();
      if (name.empty() || *number < 1 || *number > parameters.size())
        continue;
      Parameter &parameter = parameters[*number - 1];
      isTwice[*number - 1] = !parameter.name.empty();
      parameter = {name, statement.span};
    }
  for (std::size_t i = 0; i < parameters.size(); ++i)
    if (isTwice[i])
      parameters[i] = {};
  return parameters;
}

std::vector<std::string> namesPassed(const Call &call, const SourceFile &source, const SyntaxTree &tree) {
  std::vector<std::string> names;
  for (const ExpressionId value : call.values)
    names.push_back(nameIn(source, tree, value));
  return names;
}

/// Another call passes the two as they are named: whoever wrote this one may have exchanged them on purpose.
bool isPassedInOrder(ProgramRef callee, std::size_t index, const std::vector<Parameter> &parameters,
                     const FileContext &context) {
  return std::ranges::any_of(context.model.calls, [&](const Call &call) {
    if (call.kind != CallKind::OWord || call.values.size() <= index ||
        context.callGraph.callee(context.file, call) != callee)
      return false;
    return namesPassed(call, context.source, context.tree)[index] == parameters[index].name;
  });
}

void check(CallId id, const FileContext &context, const Reporter &reporter) {
  const Call &call = context.model.calls[id];
  const auto callee = call.kind == CallKind::OWord ? context.callGraph.callee(context.file, call) : std::nullopt;
  if (!callee)
    return;
  const ProgramFile &file = context.programs->file(callee->file);
  const std::vector<Parameter> parameters = parametersOf(file, callee->program);
  const std::vector<std::string> passed = namesPassed(call, context.source, context.tree);
  for (std::size_t i = 0; i < passed.size() && i < parameters.size(); ++i)
    for (std::size_t j = i + 1; j < passed.size() && j < parameters.size(); ++j) {
      const bool isExchanged = !passed[i].empty() && !passed[j].empty() && passed[i] != passed[j] &&
                               passed[i] == parameters[j].name && passed[j] == parameters[i].name;
      if (!isExchanged || mayBeReversed(passed[i]) || mayBeReversed(passed[j]) ||
          (kindOf(passed[i]) == kindOf(passed[j]) && isPassedInOrder(*callee, i, parameters, context)))
        continue;
      const Span first = context.tree.expressions[call.values[i]].span;
      const Span second = context.tree.expressions[call.values[j]].span;
      reporter.report(
          {.message = fmt::format("{} and {} are exchanged: `{}` takes them in the other order", context.quoted(first),
                                  context.quoted(second), toString(file.model->programs[callee->program].name)),
           .span = cover(first, second),
           .labels = {{parameters[i].copied, fmt::format("argument {}", i + 1), callee->file},
                      {parameters[j].copied, fmt::format("argument {}", j + 1), callee->file}},
           .notes = {"arguments in brackets are passed by their places, not by their names",
                     "write them in the order of the subroutine"},
           .fixes = {
               {.title = "exchange the two",
                .edits = {{first, std::string(context.text(second))}, {second, std::string(context.text(first))}}}}});
    }
}

void asksForPrograms(const FlowFacts &, const FileContext &, const Reporter &) {}

} // namespace

extern const Rule exchangedArguments;
const Rule exchangedArguments{.info = {"exchanged-arguments", Category::Call, Severity::Warning,
                                       "Reports a call by o-word that passes two parameters in another order than the "
                                       "subroutine names them."},
                              .hooks = {.call = check, .flow = asksForPrograms}};

} // namespace feedhold::rules::exchanged_arguments
