// offset-from-work-position: `#5221=#5041`, where the machine coordinate #5021 is meant.
#include "rules/expressions/expression_view.h"
#include "rules/flow/system_variables.h"

#include <fmt/format.h>

#include <algorithm>

namespace feedhold::rules::offset_from_work_position {
namespace {

bool isWorkOffset(VariableRole role) {
  return role == VariableRole::WorkOffset || role == VariableRole::AdditionalWorkOffset;
}

struct Parts {
  std::optional<SumTerm> work;    // a position in work coordinates
  std::optional<SumTerm> machine; // in machine coordinates
  std::optional<SumTerm> offset;  // a work offset
  bool isReadable = true;         // nothing else may hold a coordinate
};

Parts partsOf(const FileContext &context, ExpressionId value) {
  Parts parts;
  for (const SumTerm &term : termsOf(context.tree, value)) {
    const auto number = tableNumber(context, term.value);
    const VariableRole role = number ? roleOf(context, *number) : VariableRole::Plain;
    if (role == VariableRole::WorkPosition || role == VariableRole::SkipPosition)
      parts.work = term;
    else if (role == VariableRole::MachinePosition)
      parts.machine = term;
    else if (isWorkOffset(role))
      parts.offset = term;
    else if (!isConstant(context.tree, term.value))
      parts.isReadable = parts.isReadable && !readsLiveValue(context, term.value);
  }
  return parts;
}

/// Where the offset holds 0 the coordinates are those of the machine: some block before clears one.
bool clearsOffset(const FileContext &context, ProgramId program, BlockId before) {
  for (BlockId block = context.model.programs[program].first; block < before; block = block.next()) {
    if (const Word *code = findCode(context.tree, block, context.dialect, CodeRole::OwnWords);
        code && code->integer() == 10)
      return true;
    for (const Statement &statement : context.tree.statementsOf(block)) {
      const auto *assignment = std::get_if<Assignment>(&statement.node);
      const auto number = assignment ? tableNumber(context, assignment->target) : std::nullopt;
      if (number && isWorkOffset(roleOf(context, *number)))
        if (const auto value = literalValue(context.tree, assignment->value); value && value->isZero())
          return true;
    }
  }
  return false;
}

void check(const Statement &statement, BlockId block, const FileContext &context, const Reporter &reporter) {
  const auto *assignment = std::get_if<Assignment>(&statement.node);
  const auto target = assignment ? tableNumber(context, assignment->target) : std::nullopt;
  if (!target || !isWorkOffset(roleOf(context, *target)))
    return;
  const Parts parts = partsOf(context, assignment->value);
  const auto spanOf = [&](const SumTerm &term) { return context.tree.expressions[term.value].span; };
  if (!parts.isReadable)
    return;
  if (parts.work && !parts.work->isMinus && !parts.machine && !parts.offset) {
    if (clearsOffset(context, context.model.programOf(block), block))
      return;
    reporter.report(
        {.message = fmt::format("{} makes a work coordinate a work offset", context.quoted(statement.span)),
         .span = spanOf(*parts.work),
         .labels = {{context.tree.expressions[assignment->target].span, "counts from the machine zero"}},
         .notes = {"a work coordinate counts from the offset in force: unless that is 0, the new zero lies elsewhere",
                   "take the machine coordinate, `#5021` and on, or add the offset in force"}});
  } else if (parts.machine && !parts.machine->isMinus && parts.offset && !parts.offset->isMinus && !parts.work) {
    reporter.report(
        {.message = fmt::format("{} adds a machine coordinate to a work offset", context.quoted(statement.span)),
         .span = spanOf(*parts.machine),
         .labels = {{spanOf(*parts.offset), "is contained in the machine coordinate"}},
         .notes = {"the machine coordinate counts from the machine zero already: the offset enters twice",
                   "add the work coordinate, `#5041` and on, or leave out the offset"}});
  }
}

} // namespace

extern const Rule offsetFromWorkPosition;
const Rule offsetFromWorkPosition{
    .info = {"offset-from-work-position", Category::Motion, Severity::Warning,
             "Reports a work offset that is set to a work coordinate, or to the sum of an offset and a machine "
             "coordinate."},
    .hooks = {.statement = check}};

} // namespace feedhold::rules::offset_from_work_position
