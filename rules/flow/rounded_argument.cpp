// rounded-argument: `SQRT[#1*#1-#2*#3]`, which is 0 on paper and below 0 on the control.
#include "rules/flow/formula.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace feedhold::rules::rounded_argument {
namespace {

bool accepts(FunctionDomain domain, double value) {
  if (domain == FunctionDomain::NotNegative)
    return value >= 0;
  return domain != FunctionDomain::MinusOneToOne || std::abs(value) <= 1;
}

struct Shown {
  RoundedNumber argument;
  std::string given;
};

/// An argument that has to be accepted: a run with other values has stopped for another reason.
struct Demand {
  FormulaId argument;
  FunctionDomain domain;
};

/// What the functions of a block demand on paper.
std::vector<Demand> demandsOf(Formulas &formulas, BlockId block, NodeId node) {
  const ProgramFile &file = formulas.facts().file;
  std::vector<Demand> demands;
  for (const ExpressionId id : expressionsOf(file, block)) {
    const auto *call = as<FunctionCall>(*file.tree, id);
    const Function *row = call && !call->arguments().empty() ? findFunction(*file.dialect, call->function) : nullptr;
    const auto argument = row ? formulas.of(call->arguments().front(), node) : std::nullopt;
    if (argument)
      demands.push_back({*argument, row->domain});
  }
  return demands;
}

/// Values with which the argument is accepted on paper, and rounding takes it beyond.
std::optional<Shown> findShown(Formulas &formulas, FormulaId argument, FunctionDomain domain, NodeId node) {
  const auto demands = demandsOf(formulas, formulas.facts().node(node).block, node);
  const auto inputs = formulas.inputsOf(argument);
  const auto guards = formulas.guardsOf(node);
  std::optional<RoundedNumber> shown;
  const auto setting = findSetting(formulas, inputs, [&](FormulaSetting &tried) {
    const auto value = formulas.value(argument, tried);
    if (!value || !accepts(domain, value->exact.toDouble()) || accepts(domain, value->computed) ||
        !formulas.pass(guards, tried))
      return false;
    const bool isMet = std::ranges::all_of(demands, [&](const Demand &demand) {
      const auto demanded = formulas.value(demand.argument, tried);
      return !demanded || accepts(demand.domain, demanded->exact.toDouble());
    });
    if (!isMet)
      return false;
    shown = value;
    return true;
  });
  return setting ? std::optional(Shown{*shown, describeSetting(formulas, inputs, *setting)}) : std::nullopt;
}

void checkCall(const FunctionCall &call, NodeId node, const FlowFacts &facts, const FileContext &context,
               const Reporter &reporter) {
  const Function *row = findFunction(context.dialect, call.function);
  if (!row || call.arguments().empty() ||
      (row->domain != FunctionDomain::NotNegative && row->domain != FunctionDomain::MinusOneToOne))
    return;
  const ExpressionId id = call.arguments().front();
  Formulas formulas(facts);
  const auto argument = formulas.of(id, node);
  // out-of-domain reports what is known.
  if (!argument || formulas.inputsOf(*argument).empty())
    return;
  const auto shown = findShown(formulas, *argument, row->domain, node);
  if (!shown)
    return;
  const std::string text = context.quoted(context.tree.expressions[id].span);
  const bool isRoot = row->domain == FunctionDomain::NotNegative;
  reporter.report(
      {.message = fmt::format("{}, rounding takes {} outside the range that {} accepts: {}", shown->given, text,
                              spellingOf(call.function), describeRounding(text, shown->argument)),
       .span = context.tree.expressions[id].span,
       .flow = pathFromEntry(facts, node),
       .notes = {fmt::format("the control {}", stopsWith(context.dialect, AlarmKind::ArgumentOutOfDomain)),
                 isRoot ? "compute the argument in a block of its own, and set it to 0 there if it is below"
                        : "compute the argument in a block of its own, and set it to 1 or -1 there if it is beyond"}});
}

void check(const FlowFacts &facts, const FileContext &context, const Reporter &reporter) {
  std::optional<BlockId> last;
  for (const VariableUse &use : context.model.variablesOf(facts.program)) {
    if (last == use.block)
      continue;
    last = use.block;
    for (const ExpressionId id : expressionsOf(facts.file, use.block)) {
      const auto *call = as<FunctionCall>(context.tree, id);
      const auto node = call ? nodeOf(facts, use.block, id) : std::nullopt;
      if (node)
        checkCall(*call, *node, facts, context, reporter);
    }
  }
}

} // namespace

extern const Rule roundedArgument;
const Rule roundedArgument{
    .info = {"rounded-argument", Category::Flow, Severity::Info,
             "Reports `SQRT`, `ASIN` or `ACOS` of a computed number that only rounding takes outside of their range."},
    .hooks = {.flow = check}};

} // namespace feedhold::rules::rounded_argument
