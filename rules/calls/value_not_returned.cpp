// value-not-returned: `#1=#<_value>` behind the call of a subroutine that returns no value.
#include "findings/rule/rule.h"

#include "rules/expressions/expression_view.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <vector>

namespace feedhold::rules::value_not_returned {
namespace {

/// Some `endsub` or `return` of the subroutine has a value behind it.
bool returnsValue(const SyntaxTree &tree, const ProgramModel &model, ProgramId program) {
  const Program &its = model.programs[program];
  return std::ranges::any_of(model.oWordsIn(its.first, its.last), [&](const OWordUse &use) {
    const auto *oWord = std::get_if<OWord>(&tree.statements[use.statement].node);
    return oWord && (use.kind == OWordKind::EndSub || use.kind == OWordKind::Return) && oWord->argumentCount > 0;
  });
}

/// An end without a value that the subroutine comes to.
std::optional<Span> endWithoutValue(const ProgramFile &file, ProgramId program) {
  const NodeId entry = file.cfg.entryOf(program);
  std::set<NodeId> seen{entry};
  std::vector<NodeId> open{entry};
  while (!open.empty()) {
    const NodeId node = open.back();
    open.pop_back();
    const auto *end = std::get_if<ReturnFromProgram>(&file.cfg.nodes[node].instruction);
    if (end && !end->value)
      return file.tree->blocks[file.cfg.nodes[node].block].span();
    forEachSuccessor(file.cfg, *file.model, node, ProgramUse::Called, [&](NodeId next) {
      if (seen.insert(next).second)
        open.push_back(next);
    });
  }
  return std::nullopt;
}

/// Something else may set the value: a call, or a code that a program stands behind.
bool maySetValue(const FileContext &context, BlockId block) {
  return !context.model.oWordsIn(block, block.next()).empty() || !context.model.callsIn(block, block.next()).empty() ||
         std::ranges::any_of(context.tree.wordsOf(block),
                             [&](const Word &word) { return word.isCode() && !codeOf(word, context.dialect); });
}

/// `#<_value>`, whatever the case and the blanks.
bool isNamed(const FileContext &context, const NamedVariable &named, std::string_view wanted) {
  std::string name = comparedName(context.text(named.name));
  std::erase_if(name, [](char c) { return c == '#' || c == '<' || c == '>'; });
  return name == wanted;
}

std::optional<ExpressionId> reads(const FileContext &context, BlockId block, std::string_view name) {
  for (const VariableUse &use : context.model.variablesIn(block, block.next())) {
    const auto *named = as<NamedVariable>(context.tree, use.expression);
    if (named && !use.write && isNamed(context, *named, name))
      return use.expression;
  }
  return std::nullopt;
}

/// The program knows that there may be no value: it reads `#<_value_returned>`.
bool asksWhetherReturned(const FileContext &context, ProgramId program) {
  const Program &its = context.model.programs[program];
  for (BlockId block = its.first; block < its.last; block = block.next())
    if (reads(context, block, "_value_returned"))
      return true;
  return false;
}

/// `o1 if [#<_value> ..]`: what it holds is looked at.
bool isTested(const FileContext &context, BlockId block) {
  return std::ranges::any_of(context.model.oWordsIn(block, block.next()), [](const OWordUse &use) {
    return use.kind == OWordKind::If || use.kind == OWordKind::ElseIf || use.kind == OWordKind::While;
  });
}

std::vector<Label> labelsFor(const Call &call, const ProgramRef &callee, const std::optional<Span> &end) {
  std::vector<Label> labels{{call.span, "called here"}};
  if (end)
    labels.push_back({*end, "without a value", callee.file});
  return labels;
}

void check(CallId id, const FileContext &context, const Reporter &reporter) {
  const Call &call = context.model.calls[id];
  const auto callee = call.kind == CallKind::OWord ? context.callGraph.callee(context.file, call) : std::nullopt;
  if (!callee || !context.programs)
    return;
  const ProgramFile &file = context.programs->file(callee->file);
  const bool returns = returnsValue(*file.tree, *file.model, callee->program);
  const auto end = returns ? endWithoutValue(file, callee->program) : std::nullopt;
  if ((returns && !end) || (end && asksWhetherReturned(context, context.model.calls[id].caller)))
    return;
  const Program &caller = context.model.programs[call.caller];
  for (BlockId block = call.block.next(); block < caller.last; block = block.next()) {
    if (const auto read = reads(context, block, "_value")) {
      if (end && isTested(context, block))
        return;
      reporter.report({.message = fmt::format("{} is read, but `{}` returns no value{}",
                                              context.quoted(context.tree.expressions[*read].span),
                                              toString(call.callee), end ? " at one of its ends" : ""),
                       .span = context.tree.expressions[*read].span,
                       .labels = labelsFor(call, *callee, end),
                       .notes = {"without a value behind `endsub` or `return` it is 0",
                                 "write the value in brackets behind the `endsub` and each `return`"}});
      return;
    }
    if (maySetValue(context, block))
      return;
  }
}

void asksForPrograms(const FlowFacts &, const FileContext &, const Reporter &) {}

} // namespace

extern const Rule valueNotReturned;
const Rule valueNotReturned{
    .info = {"value-not-returned", Category::Call, Severity::Warning,
             "Reports `#<_value>` behind the call of a subroutine that returns no value, or not at each "
             "of its ends."},
    .hooks = {.call = check, .flow = asksForPrograms}};

} // namespace feedhold::rules::value_not_returned
