// tolerance-on-one-side: `#3=ABS[#3]`, and `IF[#142GT#3]GOTO914` is all that is asked of the deviation.
#include "rules/flow/case_ladder.h"
#include "rules/flow/flow_view.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <vector>

namespace feedhold::rules::tolerance_on_one_side {
namespace {

bool isOrder(OperatorKind op) {
  return op == OperatorKind::GreaterThan || op == OperatorKind::GreaterOrEqual || op == OperatorKind::LessThan ||
         op == OperatorKind::LessOrEqual;
}

std::optional<std::uint32_t> numberIn(const FileContext &context, ExpressionId id) {
  return variableNumber(context.tree, unwrapped(context.tree, id));
}

/// `#3=ABS[#3]`: a number to which a sign says nothing.
struct Tolerance {
  std::uint32_t variable;
  Span span;
};

class Text {
public:
  Text(ProgramId program, const FileContext &context) : context_(context), program_(program) {
    const Program &whole = context.model.programs[program];
    for (BlockId block = whole.first; block < whole.last; block = block.next())
      for (const Statement &statement : context.tree.statementsOf(block))
        read(statement);
  }

  bool hasTolerance() const { return !tolerances_.empty(); }
  std::optional<Tolerance> tolerance(std::uint32_t variable) const {
    const auto found = std::ranges::find(tolerances_, variable, &Tolerance::variable);
    return found == tolerances_.end() ? std::nullopt : std::optional(*found);
  }

  /// It is asked for only as in `#142GT#3`: no comparison with the other limit, no sign or ABS taken of it.
  bool isAskedOnOneSide(std::uint32_t deviation) const { return !otherUses_.contains(deviation); }

  /// A common variable that another program sets: the result of a measurement.
  bool isResult(std::uint32_t variable) const {
    const VariableRange *range = variable < kFirstNamedVariable ? findVariable(context_.dialect, variable) : nullptr;
    const auto uses = context_.model.variablesOf(program_);
    return range && range->kind == VariableKind::Common && std::ranges::none_of(uses, [&](const VariableUse &use) {
             return use.write && (!use.number || use.number == variable);
           });
  }

  /// The operator is told: an alarm, or a stop with a remark.
  bool tellsOperator(const Jump &jump) const {
    if (!jump.target)
      return false;
    BlockId block = *jump.target;
    if (context_.tree.statementsOf(block).empty() && context_.tree.wordsOf(block).size() == 1)
      block = nextContent(context_, block);
    if (block >= context_.model.programs[program_].last)
      return false; // a label at the end of a text that is cut off
    const bool isStop = findCode(context_.tree, block, context_.dialect, CodeRole::ProgramStop) &&
                        !context_.tree.commentsOf(block).empty();
    const auto uses = context_.model.variablesIn(block, block.next());
    return isStop || std::ranges::any_of(uses, [&](const VariableUse &use) {
             return use.write && use.number && raisesAlarm(context_.dialect, *use.number);
           });
  }

  /// The last call before the block is one of the probing cycles O9811 to O9899 that most makers deliver: #140 to #143
  /// are their errors in X, Y, Z and size, with a sign; #145, the error of the true position, is a distance.  Source:
  /// output table of Renishaw's Inspection Plus, as given for the same cycles on Okuma (VS80 to VS83, VS85).
  bool isBehindProbing(BlockId block) const {
    const Call *last = nullptr;
    for (const Call &call : context_.model.callsOf(program_))
      if (call.block < block)
        last = &call;
    const auto number = last ? last->callee.number : std::nullopt;
    return number && *number > 9810 && *number < 9900;
  }

private:
  void read(const Statement &statement) {
    if (const auto *assignment = std::get_if<Assignment>(&statement.node)) {
      const auto *call = asInside<FunctionCall>(context_.tree, assignment->value);
      const auto target = numberIn(context_, assignment->target);
      if (call && call->function == FunctionKind::Abs && target)
        tolerances_.push_back({*target, statement.span});
      return readAll(assignment->value);
    }
    if (const auto condition = conditionOf(statement)) {
      const auto *relation = asInside<BinaryOperation>(context_.tree, *condition);
      const bool isUpperLimit =
          relation && (relation->op == OperatorKind::GreaterThan || relation->op == OperatorKind::GreaterOrEqual) &&
          numberIn(context_, relation->left) && numberIn(context_, relation->right);
      if (!isUpperLimit)
        readAll(*condition);
    }
  }
  void readAll(ExpressionId root) {
    for (const ExpressionId part : subexpressions(context_.tree, root))
      if (const auto number = variableNumber(context_.tree, part))
        otherUses_.insert(*number);
  }

  const FileContext &context_;
  ProgramId program_;
  std::vector<Tolerance> tolerances_;
  std::set<std::uint32_t> otherUses_;
};

/// How sure it is that the deviation may be negative; absent: it never is.
std::optional<Severity> severityOf(const Text &text, const Jump &jump, std::uint32_t deviation) {
  constexpr std::uint32_t kFirstError = 140;
  constexpr std::uint32_t kLastError = 143;
  if (!text.isBehindProbing(jump.block))
    return Severity::Info;
  return kFirstError <= deviation && deviation <= kLastError ? std::optional(Severity::Warning) : std::nullopt;
}

void checkJump(const Jump &jump, const Text &text, const FileContext &context, const Reporter &reporter) {
  const Statement *statement = firstStatement(context.tree, jump.block);
  const auto condition = statement ? conditionOf(*statement) : std::nullopt;
  const auto *relation = condition ? asInside<BinaryOperation>(context.tree, *condition) : nullptr;
  if (!relation || !isOrder(relation->op) || jump.kind != JumpKind::Goto)
    return;
  const auto deviation = numberIn(context, relation->left);
  const auto limit = numberIn(context, relation->right);
  const auto tolerance = deviation && limit ? text.tolerance(*limit) : std::nullopt;
  if (!tolerance || !text.isResult(*deviation) || !text.isAskedOnOneSide(*deviation) || !text.tellsOperator(jump))
    return;
  const auto severity = severityOf(text, jump, *deviation);
  if (!severity)
    return;
  reporter.report({.message = fmt::format("{} asks for deviations to one side only", context.quoted(statement->span)),
                   .span = context.tree.expressions[*condition].span,
                   .labels = {{tolerance->span, "the tolerance is made positive here, for both sides"}},
                   .notes = {fmt::format("a deviation of any size below -`#{}` passes", *limit),
                             fmt::format("compare `ABS[#{}]` with `#{}`", *deviation, *limit)}},
                  *severity);
}

void check(ProgramId program, const FileContext &context, const Reporter &reporter) {
  const Text text(program, context);
  if (!text.hasTolerance())
    return;
  for (const Jump &jump : context.model.jumpsOf(program))
    checkJump(jump, text, context, reporter);
}

} // namespace

extern const Rule toleranceOnOneSide;
const Rule toleranceOnOneSide{
    .info = {"tolerance-on-one-side", Category::Flow, Severity::Warning,
             "Reports a measured deviation that is compared with a tolerance on one side only."},
    .hooks = {.program = check}};

} // namespace feedhold::rules::tolerance_on_one_side
