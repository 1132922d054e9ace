// position-in-other-coordinates: `#1=#5021`, and `G90 G00 X#1`.
#include "rules/flow/definitions.h"
#include "rules/flow/system_variables.h"
#include "rules/motion/motion_view.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <string_view>
#include <vector>

namespace feedhold::rules::position_in_other_coordinates {
namespace {

class PositionInOtherCoordinates final : public FlowRule {
public:
  PositionInOtherCoordinates(ProgramId program, const FileContext &context)
      : view_(program, context), context_(context), asked_(readsPositions(program)) {}

  void after(NodeId node, const AbstractState &state) override {
    if (!view_.surely(state, ModalKind::Distance, {CodeAction::Absolute}))
      return;
    if (!asked_ && !view_.mayDo(node, {CodeAction::MachineMove, CodeAction::Skip}))
      return;
    const bool isMachineMove =
        view_.mayDo(node, {CodeAction::MachineMove}) && view_.findAction(node, {CodeAction::MachineMove}) != nullptr;
    if (!isMachineMove && view_.findAction(node, {CodeAction::WorkOffset, CodeAction::ExtendedWorkOffset}))
      return;
    if (isMachineMove || view_.findAction(node, {CodeAction::Skip}))
      for (const Word *word : view_.wordsOf(node))
        if (std::string_view("XYZ").find(word->address()) != std::string_view::npos &&
            word->form() == WordForm::Expression)
          (isMachineMove ? machine_ : skips_).push_back({node, word});
    for (const Word *word : isMachineMove ? view_.wordsOf(node) : view_.modalMotionWords(node))
      if (std::string_view("XYZABC").find(word->address()) != std::string_view::npos &&
          word->form() == WordForm::Expression)
        uses_.emplace(std::pair{node, word}, isMachineMove);
  }

  void report(const FlowFacts &facts, const FileContext &context, const Reporter &reporter) override {
    checkSkips(facts, context, reporter);
    std::optional<NodeId> told; // one finding for a block
    for (const auto &[place, isMachineMove] : uses_) {
      const auto &[node, word] = place;
      const auto origin = told == node ? std::nullopt : originOf(facts, word->expression(), node);
      if (!origin || isMachine(*origin) == isMachineMove)
        continue;
      told = node;
      const Span span = context.tree.expressions[*origin].span;
      Diagnostic diagnostic{
          .message = isMachineMove ? fmt::format("{} moves to a work coordinate as if it were a machine coordinate",
                                                 context.quoted(word->span()))
                                   : fmt::format("{} moves to a machine coordinate as if it were a work coordinate",
                                                 context.quoted(word->span())),
          .span = word->span(),
          .notes = {"the two differ by the work offset and the tool length offset: the axis moves to another place",
                    isMachineMove ? "read `#5021` and on, or move without `G53`"
                                  : "move with `G53`, or read `#5041` and on"}};
      if (!word->span().contains(span))
        diagnostic.labels.push_back({span, "read here"});
      reporter.report(std::move(diagnostic));
    }
  }

private:
  struct Use {
    NodeId node;
    const Word *word;
  };

  /// Of `Z[#512-10]`: #512.
  std::optional<std::uint32_t> baseOf(const FlowFacts &facts, const Word &word) const {
    std::optional<std::uint32_t> found;
    for (const SumTerm &term : termsOf(context_.tree, word.expression())) {
      if (isConstant(context_.tree, term.value))
        continue;
      const auto variable = variableOf(facts, term.value);
      if (found || term.isMinus || !variable)
        return std::nullopt;
      found = variable;
    }
    return found;
  }
  /// `G53 G00 Z[#512+25]`, and `G31 Z[#512-10]`: the value cannot be both.
  void checkSkips(const FlowFacts &facts, const FileContext &context, const Reporter &reporter) const {
    for (const Use &skip : skips_)
      for (const Use &machine : machine_) {
        const auto base = skip.word->address() == machine.word->address() ? baseOf(facts, *skip.word) : std::nullopt;
        if (!base || base != baseOf(facts, *machine.word))
          continue;
        const auto here = definitionsOf(facts, *base, skip.node);
        if (!here || here != definitionsOf(facts, *base, machine.node))
          continue;
        reporter.report(
            {.message = fmt::format("{} moves to a machine coordinate as if it were a work coordinate",
                                    context.quoted(skip.word->span())),
             .span = skip.word->span(),
             .labels = {{machine.word->span(), "with `G53`, a machine coordinate"}},
             .notes = {"`G53` is active in its own block only: the skip move goes to this place in the work offset "
                       "that is active",
                       "probe by a distance under `G91`, or subtract the work offset"}});
        return;
      }
  }

  bool readsPositions(ProgramId program) const {
    const auto uses = context_.model.variablesOf(program);
    return std::ranges::any_of(uses, [&](const VariableUse &use) {
      return !use.write && use.number && isPosition(roleOf(context_, *use.number));
    });
  }
  bool isMachine(ExpressionId position) const {
    const auto number = variableNumber(context_.tree, position);
    return number && roleOf(context_, *number) == VariableRole::MachinePosition;
  }
  /// The position of which the value is a copy, or from which it differs by a constant.
  std::optional<ExpressionId> originOf(const FlowFacts &facts, ExpressionId value, NodeId at) const {
    std::optional<ExpressionId> found;
    for (const SumTerm &term : termsOf(context_.tree, value)) {
      if (isConstant(context_.tree, term.value))
        continue;
      if (found || term.isMinus)
        return std::nullopt;
      found = term.value;
    }
    const auto number = found ? variableOf(facts, *found) : std::nullopt;
    if (!number)
      return std::nullopt;
    if (isPosition(roleOf(context_, *number)))
      return found;
    const auto known = definitionsOf(facts, *number, at);
    if (!known || known->fromEntry || known->nodes.size() != 1)
      return std::nullopt;
    const auto copy = assignmentTo(facts, known->nodes.front(), *number);
    const auto position = copy ? variableOf(facts, copy->value) : std::nullopt;
    return position && isPosition(roleOf(context_, *position)) ? std::optional(unwrapped(context_.tree, copy->value))
                                                               : std::nullopt;
  }

  MotionView view_;
  const FileContext &context_;
  bool asked_;
  std::map<std::pair<NodeId, const Word *>, bool> uses_;
  std::vector<Use> machine_, skips_; // words with expressions under G53, and of skip moves
};

std::unique_ptr<FlowRule> watch(ProgramId program, const FileContext &context) {
  return std::make_unique<PositionInOtherCoordinates>(program, context);
}

} // namespace

extern const Rule positionInOtherCoordinates;
const Rule positionInOtherCoordinates{
    .info = {"position-in-other-coordinates", Category::Motion, Severity::Warning,
             "Reports an absolute move to a machine coordinate without `G53`, or to a work coordinate with it."},
    .hooks = {.watch = watch}};

} // namespace feedhold::rules::position_in_other_coordinates
