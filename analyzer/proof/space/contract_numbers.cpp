#include "proof/space/contract_numbers.h"

#include "base/support/match.h"
#include "meaning/semantics/evaluate.h"
#include "proof/symbolic/contract_terms.h"

#include <algorithm>
#include <cmath>

namespace feedhold::prove {

namespace {

constexpr double kRounding = 1e-6; // of sums of the shortest numbers that controls have, by their size

/// A promise in the state behind a run.
class NearPromise {
public:
  NearPromise(StepContext<ConcreteInterpretation> &context, double tolerance)
      : context_(context), tolerance_(tolerance) {}

  bool mayHold(ExpressionId id) {
    const ExpressionId inner = unwrapped(context_.tree(), id);
    const auto *operation = std::get_if<BinaryOperation>(&context_.tree().expressions[inner].node);
    if (!operation)
      return true;
    if (operation->op == OperatorKind::And)
      return mayHold(operation->left) && mayHold(operation->right);
    if (operation->op == OperatorKind::Or)
      return mayHold(operation->left) || mayHold(operation->right);
    return !isRelation(operation->op) || operation->op == OperatorKind::NotEqual ||
           evaluateCondition(context_, inner) || isNear(*operation);
  }

private:
  bool isNear(const BinaryOperation &relation) {
    const ConcreteValue left = evaluate(context_, relation.left);
    const ConcreteValue right = evaluate(context_, relation.right);
    const double rounding = kRounding * std::max(std::fabs(left.number), std::fabs(right.number));
    return left.vacant == right.vacant && !(std::fabs(left.number - right.number) > tolerance_ + rounding);
  }

  StepContext<ConcreteInterpretation> &context_;
  double tolerance_;
};

} // namespace

ContractNumbers::ContractNumbers(const ProgramSet &programs, Callee program, const FileContracts &contracts,
                                 const RunOptions &run)
    : programs_(programs), file_(programs.file(program.file)), contracts_(contracts), modes_(*file_.dialect),
      interpretation_(*file_.dialect, run.variables), state_(startState(interpretation_, modes_, run.start)) {
  for (const auto &[group, code] : run.codes)
    state_.codes[group] = code;
  putInForce(run.variables.start, state_);
  for (const Axis axis : kAllAxes) {
    state_.variables.set(positionVariable(letterOf(axis)), state_.at(axis));
    state_.variables.set(entryVariable(letterOf(axis)), state_.at(axis));
  }
}

template <typename Result, typename Evaluate> Result ContractNumbers::within(State &state, Evaluate &&evaluateIt) {
  const ProgramFile contract{.file = file_.file,
                             .source = file_.source,
                             .tree = &contracts_.tree,
                             .model = file_.model,
                             .dialect = file_.dialect};
  StepContext<ConcreteInterpretation> context{interpretation_, state, programs_, contract, modes_, BlockId(0)};
  return evaluateIt(context);
}

double ContractNumbers::number(ExpressionId expression) {
  return within<double>(state_, [&](auto &context) { return evaluate(context, expression).number; });
}

bool ContractNumbers::holds(ExpressionId condition, const geometry::Point<double> &point) {
  for (const Axis axis : {Axis::X, Axis::Y, Axis::Z})
    state_.variables.set(pointVariable(letterOf(axis)), ConcreteValue::of(point[indexOf(axis)]));
  return within<bool>(state_, [&](auto &context) { return evaluateCondition(context, condition); });
}

ConcreteValue ContractNumbers::atStart(std::uint32_t variable) const {
  if (variable <= kLocalVariables)
    return state_.locals[variable];
  const std::uint32_t cell = cellOf(*file_.dialect, variable);
  const ConcreteValue *held = state_.variables.find(cell);
  return held ? *held : interpretation_.unwritten(state_, cell);
}

/// With what POS, ENTRY and OLD stand for.
ContractNumbers::State ContractNumbers::behind(const State &end) const {
  State state = end;
  for (const Axis axis : kAllAxes) {
    state.variables.set(positionVariable(letterOf(axis)), end.at(axis));
    state.variables.set(entryVariable(letterOf(axis)), state_.at(axis));
  }
  for (const std::uint32_t variable : oldVariablesIn(contracts_))
    state.variables.set(oldVariable(variable), atStart(variable));
  return state;
}

bool ContractNumbers::isClearlyBroken(const Ensure &ensure, const RunResult &end, double tolerance) {
  return match(
      ensure.promise, [](const ModalPreserved &) { return false; },
      [&](const std::vector<ModalCode> &codes) {
        return std::ranges::any_of(codes, [&](const ModalCode &code) {
          const Code *row = code.address == 'G' ? findGCode(*file_.dialect, code.tenths) : nullptr;
          const auto inForce = row ? end.state.codes[row->group] : ConcreteInterpretation::kNoCode;
          return inForce != ConcreteInterpretation::kNoCode && modes_.indexOf(*row) != inForce;
        });
      },
      [&](ExpressionId promise) {
        State state = behind(end.state);
        const bool mayHold =
            within<bool>(state, [&](auto &context) { return NearPromise(context, tolerance).mayHold(promise); });
        return !mayHold && !interpretation_.stopped();
      });
}

} // namespace feedhold::prove
