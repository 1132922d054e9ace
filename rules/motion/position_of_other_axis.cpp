// position-of-other-axis: `X#5041 Y#5041`.
#include "rules/flow/definitions.h"
#include "rules/flow/system_variables.h"
#include "rules/motion/motion_view.h"

#include <fmt/format.h>

#include <optional>
#include <string_view>

namespace feedhold::rules::position_of_other_axis {
namespace {

/// Of one axis each: U, V, W may be the increments of X, Y, Z.
constexpr std::string_view kAxes = "XYZABC";

struct Source {
  std::uint32_t position; // #5041
  Span origin;            // where it is read
};

/// The position that is the whole value of a word, or that its variable is a copy of.
std::optional<Source> sourceOf(const FlowFacts &facts, const FileContext &context, ExpressionId value, NodeId at) {
  const auto number = variableOf(facts, value);
  if (!number)
    return std::nullopt;
  if (isPosition(roleOf(context, *number)))
    return Source{*number, context.tree.expressions[value].span};
  const auto known = definitionsOf(facts, *number, at);
  if (!known || known->fromEntry || known->nodes.size() != 1)
    return std::nullopt;
  const auto copy = assignmentTo(facts, known->nodes.front(), *number);
  const auto position = copy ? variableOf(facts, copy->value) : std::nullopt;
  return position && isPosition(roleOf(context, *position))
             ? std::optional(Source{*position, context.tree.expressions[copy->value].span})
             : std::nullopt;
}

void checkBlock(const MotionView &view, NodeId node, const FlowFacts &facts, const FileContext &context,
                const Reporter &reporter) {
  std::vector<std::pair<const Word *, Source>> known;
  for (const Word *word : view.wordsOf(node)) {
    if (kAxes.find(word->address()) == std::string_view::npos || word->form() != WordForm::Expression)
      continue;
    const auto source = sourceOf(facts, context, word->expression(), node);
    if (!source)
      continue;
    for (const auto &[other, its] : known) {
      if (its.position != source->position || other->address() == word->address())
        continue;
      Diagnostic diagnostic{
          .message = fmt::format("`#{}` is the position of one axis, and both {} and {} take it", source->position,
                                 context.quoted(other->span()), context.quoted(word->span())),
          .span = word->span(),
          .labels = {{other->span(), "the same position"}},
          .notes = {"the numbers of a table of positions follow the axes: the first one belongs to the first axis, "
                    "the next one to the second",
                    "correct the number of the variable for one of them"}};
      if (!word->span().contains(source->origin))
        diagnostic.labels.push_back({source->origin, "read here"});
      reporter.report(std::move(diagnostic));
      return;
    }
    known.emplace_back(word, *source);
  }
}

void check(const FlowFacts &facts, const FileContext &context, const Reporter &reporter) {
  const auto uses = context.model.variablesOf(facts.program);
  if (isTooLarge(facts) || std::ranges::none_of(uses, [&](const VariableUse &use) {
        return !use.write && use.number && isPosition(roleOf(context, *use.number));
      }))
    return;
  const MotionView view(facts.program, context);
  for (NodeId node = facts.entry(); node < facts.end(); node = node.next())
    if (facts.isReached(node))
      checkBlock(view, node, facts, context, reporter);
}

} // namespace

extern const Rule positionOfOtherAxis;
const Rule positionOfOtherAxis{.info = {"position-of-other-axis", Category::Motion, Severity::Warning,
                                        "Reports words of two axes in one block that take the position of the same "
                                        "axis."},
                               .hooks = {.flow = check}};

} // namespace feedhold::rules::position_of_other_axis
