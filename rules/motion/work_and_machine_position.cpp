// work-and-machine-position: `IF[ABS[#5063-#5023]LT.01]`.
#include "rules/flow/definitions.h"
#include "rules/flow/system_variables.h"
#include "rules/motion/motion_view.h"

#include <fmt/format.h>

#include <algorithm>

namespace feedhold::rules::work_and_machine_position {
namespace {

enum class Coordinates : std::uint8_t { Work, Machine };

struct Position {
  Coordinates coordinates;
  Span origin; // where it is read, or named as a machine coordinate
};

class Positions {
public:
  Positions(const FlowFacts &facts, const FileContext &context)
      : facts_(facts), context_(context), view_(facts.program, context) {}

  std::optional<Position> of(ExpressionId id, NodeId at) const {
    const auto number = variableOf(facts_, id);
    if (!number)
      return std::nullopt;
    const VariableRole role = roleOf(context_, *number);
    const Span span = context_.tree.expressions[id].span;
    if (role == VariableRole::MachinePosition)
      return Position{Coordinates::Machine, span};
    if (isPosition(role))
      return Position{Coordinates::Work, span};
    if (const auto word = machineWord(*number))
      return Position{Coordinates::Machine, *word};
    const auto known = definitionsOf(facts_, *number, at);
    if (!known || known->fromEntry || known->nodes.size() != 1)
      return std::nullopt;
    const auto assignment = assignmentTo(facts_, known->nodes.front(), *number);
    const auto source =
        assignment ? variableNumber(context_.tree, unwrapped(context_.tree, assignment->value)) : std::nullopt;
    return source && isPosition(roleOf(context_, *source)) ? of(assignment->value, at) : std::nullopt;
  }

private:
  /// The word of a G53 block whose whole value is the variable.
  std::optional<Span> machineWord(std::uint32_t variable) const {
    for (NodeId node = facts_.entry(); node < facts_.end(); node = node.next()) {
      if (!view_.mayDo(node, {CodeAction::MachineMove}))
        continue;
      for (const Word *word : view_.axisWords(node))
        if (word->form() == WordForm::Expression && variableOf(facts_, word->expression()) == variable)
          return word->span();
    }
    return std::nullopt;
  }

  const FlowFacts &facts_;
  const FileContext &context_;
  MotionView view_;
};

/// `ABS[#5001-#5021]`: what is inside of ABS.  A difference with its sign may be an offset that is to be set.
std::vector<ExpressionId> distancesIn(const SyntaxTree &tree, ExpressionId value) {
  std::vector<ExpressionId> found;
  for (const ExpressionId part : subexpressions(tree, value))
    if (const auto *call = as<FunctionCall>(tree, part); call && call->function == FunctionKind::Abs)
      for (const ExpressionId argument : call->arguments())
        found.push_back(unwrapped(tree, argument));
  return found;
}

/// One finding for X, Y and Z.
void checkDistances(const Positions &positions, const FlowFacts &facts, const FileContext &context,
                    const Reporter &reporter) {
  std::optional<Diagnostic> told;
  for (NodeId node = facts.entry(); node < facts.end(); node = node.next())
    for (const Assignment &assignment : facts.isReached(node) ? assignmentsOf(facts, node) : std::vector<Assignment>{})
      for (const ExpressionId part : distancesIn(context.tree, assignment.value)) {
        const auto *difference = as<BinaryOperation>(context.tree, part);
        if (!difference || difference->op != OperatorKind::Subtract)
          continue;
        const auto left = positions.of(difference->left, node);
        const auto right = positions.of(difference->right, node);
        if (!left || !right || left->coordinates == right->coordinates)
          continue;
        const Position &machine = left->coordinates == Coordinates::Machine ? *left : *right;
        const Span span = context.tree.expressions[part].span;
        if (told) {
          told->labels.push_back({span, "nor is this"});
          continue;
        }
        told = {.message = fmt::format("{} is no distance: one is a work coordinate, the other a machine coordinate",
                                       context.quoted(span)),
                .span = span,
                .notes = {"they differ by the work offset and the tool length offset, wherever the axis stands",
                          "subtract positions of one coordinate system: `#5021` and on are machine, `#5001`, `#5041` "
                          "and `#5061` and on are work coordinates"}};
        if (!span.contains(machine.origin))
          told->labels.push_back({machine.origin, "a machine coordinate"});
      }
  if (told)
    reporter.report(std::move(*told));
}

void check(const FlowFacts &facts, const FileContext &context, const Reporter &reporter) {
  const auto reads = context.model.variablesOf(facts.program);
  if (isTooLarge(facts) || std::ranges::none_of(reads, [&](const VariableUse &use) {
        return !use.write && use.number && isPosition(roleOf(context, *use.number));
      }))
    return;
  const Positions positions(facts, context);
  checkDistances(positions, facts, context, reporter);
  for (NodeId node = facts.entry(); node < facts.end(); node = node.next()) {
    const auto *test = std::get_if<Test>(&facts.node(node).instruction);
    if (!test || !test->condition || !facts.isReached(node))
      continue;
    for (const ExpressionId part : subexpressions(context.tree, *test->condition)) {
      const auto *operation = as<BinaryOperation>(context.tree, part);
      if (!operation || (!isRelation(operation->op) && operation->op != OperatorKind::Subtract))
        continue;
      const auto left = positions.of(operation->left, node);
      const auto right = positions.of(operation->right, node);
      if (!left || !right || left->coordinates == right->coordinates)
        continue;
      const Position &machine = left->coordinates == Coordinates::Machine ? *left : *right;
      const Span span = context.tree.expressions[part].span;
      Diagnostic diagnostic{
          .message = fmt::format("{} compares a work coordinate with a machine coordinate", context.quoted(span)),
          .span = span,
          .notes = {"they differ by the work offset and the tool length offset, so the comparison does not tell what "
                    "it is meant to",
                    "compare positions of one coordinate system: `#5021` and on are machine, `#5041` and `#5061` and "
                    "on are work coordinates"}};
      if (!span.contains(machine.origin))
        diagnostic.labels.push_back({machine.origin, "a machine coordinate"});
      reporter.report(std::move(diagnostic));
      break;
    }
  }
}

} // namespace

extern const Rule workAndMachinePosition;
const Rule workAndMachinePosition{
    .info = {"work-and-machine-position", Category::Motion, Severity::Warning,
             "Reports a condition that compares a work coordinate with a machine coordinate, and a distance "
             "between two such."},
    .hooks = {.flow = check}};

} // namespace feedhold::rules::work_and_machine_position
