// difference-as-position: `#12=#9-#5043`, and `G90 Z#12`.
#include "rules/flow/system_variables.h"
#include "rules/motion/motion_view.h"

#include <algorithm>
#include <fmt/format.h>
#include <string_view>

namespace feedhold::rules::difference_as_position {
namespace {

constexpr std::string_view kAxes = "XYZ";
/// Protected positioning of the probing cycles that most makers deliver: X, Y, Z are absolute positions.
constexpr std::uint32_t kProtectedPositioning = 9810;

/// Where the tool is now, on the axis of the word.
bool isPositionNow(const FileContext &context, std::uint32_t variable, char axis) {
  const VariableRange *range = variable < kFirstNamedVariable ? findVariable(context.dialect, variable) : nullptr;
  const bool isNow =
      range && (range->role == VariableRole::WorkPosition || range->role == VariableRole::BlockEndPosition ||
                range->role == VariableRole::MachinePosition);
  return isNow && variable - range->first == kAxes.find(axis);
}

class Differences {
public:
  Differences(const FlowFacts &facts, const FileContext &context) : facts_(facts), context_(context) {}

  /// `#9-#5043` behind the value of the word, itself or of the variable that is assigned once.
  std::optional<ExpressionId> behind(const Word &word) const {
    if (word.form() != WordForm::Expression || kAxes.find(word.address()) == std::string_view::npos)
      return std::nullopt;
    const ExpressionId value = unwrapped(context_.tree, word.expression());
    if (isDifference(value, word.address()))
      return value;
    const auto variable = variableNumber(context_.tree, value);
    const Assignment *source = variable ? onlyAssignment(*variable, word.span()) : nullptr;
    if (!source || !isDifference(source->value, word.address()))
      return std::nullopt;
    return unwrapped(context_.tree, source->value);
  }

private:
  /// A variable or a number, less the position, and nothing else: what is computed of several positions is not
  /// followed.
  bool isDifference(ExpressionId value, char axis) const {
    int targets = 0;
    int positions = 0;
    for (const SumTerm &term : termsOf(context_.tree, value)) {
      const auto variable = variableNumber(context_.tree, unwrapped(context_.tree, term.value));
      if (variable && term.isMinus && isPositionNow(context_, *variable, axis))
        ++positions;
      else if (variable && !term.isMinus && isPlainTarget(*variable))
        ++targets;
      else if (const auto number = literalValue(context_.tree, term.value); !number || number->isZero())
        return false;
    }
    return targets == 1 && positions == 1;
  }
  /// A local or common variable that is no copy of a position.
  bool isPlainTarget(std::uint32_t variable) const {
    const VariableRange *range = variable < kFirstNamedVariable ? findVariable(context_.dialect, variable) : nullptr;
    if (!range || (range->kind != VariableKind::Local && range->kind != VariableKind::Common &&
                   range->kind != VariableKind::Retentive))
      return false;
    return std::ranges::none_of(context_.model.variablesOf(facts_.program), [&](const VariableUse &use) {
      return use.write && use.number == variable && readsSystem(use.block);
    });
  }
  bool readsSystem(BlockId block) const {
    return std::ranges::any_of(readsOf(facts_.file, block), [&](const Read &read) {
      return !read.number || roleOf(context_, *read.number) != VariableRole::Plain;
    });
  }
  /// In the text of the program, and before the word.
  const Assignment *onlyAssignment(std::uint32_t variable, Span word) const {
    const Assignment *found = nullptr;
    const Program &program = context_.model.programs[facts_.program];
    for (BlockId block = program.first; block < program.last; block = block.next())
      for (const Statement &statement : context_.tree.statementsOf(block)) {
        const auto *assignment = std::get_if<Assignment>(&statement.node);
        if (!assignment || variableNumber(context_.tree, unwrapped(context_.tree, assignment->target)) != variable)
          continue;
        if (found || statement.nested || statement.span.begin > word.begin)
          return nullptr;
        found = assignment;
      }
    return found;
  }

  const FlowFacts &facts_;
  const FileContext &context_;
};

/// G90 in the program, and neither G91 nor a code that puts the zero point where the tool is.
bool staysAbsolute(const FileContext &context, const Program &program) {
  bool isSet = false;
  for (BlockId block = program.first; block < program.last; block = block.next())
    for (const Word &word : context.tree.wordsOf(block)) {
      const Code *code = codeOf(word, context.dialect);
      if (!code)
        continue;
      if (code->action == CodeAction::Incremental || code->action == CodeAction::LocalShift ||
          code->role == CodeRole::CoordinateShift || code->role == CodeRole::DataSetting)
        return false;
      isSet = isSet || code->action == CodeAction::Absolute;
    }
  return isSet;
}

bool setsOffset(const FlowFacts &facts, const FileContext &context) {
  return std::ranges::any_of(context.model.variablesOf(facts.program), [&](const VariableUse &use) {
    return use.write && use.number && isOffset(context, *use.number);
  });
}

void tell(const Word &word, ExpressionId difference, const FileContext &context, const Reporter &reporter) {
  const Span span = context.tree.expressions[difference].span;
  Diagnostic diagnostic{
      .message = fmt::format("{} moves to a distance as if it were a position", context.quoted(word.span())),
      .span = word.span(),
      .notes = {
          "the difference to where the tool is now is the way there; under `G90` a coordinate is a place, counted "
          "from the zero point",
          "write the position itself, or move under `G91`"}};
  if (!word.span().contains(span))
    diagnostic.labels = {{span, "the way from here"}};
  reporter.report(std::move(diagnostic));
}

void check(const FlowFacts &facts, const FileContext &context, const Reporter &reporter) {
  const auto uses = context.model.variablesOf(facts.program);
  const bool reads = std::ranges::any_of(uses, [&](const VariableUse &use) {
    return !use.write && use.number && isPosition(roleOf(context, *use.number));
  });
  if (!reads || isTooLarge(facts) || !staysAbsolute(context, context.model.programs[facts.program]) ||
      setsOffset(facts, context))
    return;
  const MotionView view(facts.program, context);
  const Differences differences(facts, context);
  for (NodeId node = facts.entry(); node < facts.end(); node = node.next())
    if (facts.isReached(node))
      for (const Word *word : view.modalMotionWords(node))
        if (const auto difference = differences.behind(*word))
          tell(*word, *difference, context, reporter);
  for (const Call &call : context.model.callsOf(facts.program)) {
    if (call.kind != CallKind::Macro || call.callee.number != kProtectedPositioning)
      continue;
    for (const Word &word : context.tree.wordsOf(call.block))
      if (const auto difference = differences.behind(word))
        tell(word, *difference, context, reporter);
  }
}

} // namespace

extern const Rule differenceAsPosition;
const Rule differenceAsPosition{.info = {"difference-as-position", Category::Motion, Severity::Warning,
                                         "Reports an absolute move to a value from which the position of the tool has "
                                         "been subtracted."},
                                .hooks = {.flow = check}};

} // namespace feedhold::rules::difference_as_position
