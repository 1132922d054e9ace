#include "proof/contract_run.h"

#include "base/support/match.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace feedhold::proof_tests {

using prove::Obligation;
using prove::ObligationKind;
using soundness::EntryValues;

namespace {

bool hasEnded(RunEnd end) {
  return end == RunEnd::M02 || end == RunEnd::M30 || end == RunEnd::Returned || end == RunEnd::EndOfFile;
}

ConcreteValue valueOf(const GivenVariables &given, const MachineState<ConcreteInterpretation> &state,
                      std::uint32_t variable) {
  if (variable <= kLocalVariables)
    return state.locals[variable];
  if (const ConcreteValue *written = state.variables.find(variable))
    return *written;
  const ConcreteValue *held = given.find(variable);
  return held ? *held : ConcreteValue{};
}

/// Reads an expression of the contract in a state; absent where that would stop the control.
template <typename Evaluate>
auto inContract(const soundness::LoadedSample &machine, const FileContracts &contracts, const EntryValues &entry,
                MachineState<ConcreteInterpretation> state, Evaluate &&evaluate)
    -> std::optional<decltype(evaluate(std::declval<StepContext<ConcreteInterpretation> &>()))> {
  const ProgramFile &program = machine.set.file(FileId(0));
  const ProgramFile within{.file = program.file,
                           .source = program.source,
                           .tree = &contracts.tree,
                           .model = program.model,
                           .dialect = program.dialect};
  const ModalTable modes(machine.dialect());
  ConcreteInterpretation interpretation(machine.dialect(), entry.given);
  StepContext<ConcreteInterpretation> context{interpretation, state, machine.set, within, modes, BlockId(0)};
  const auto result = evaluate(context);
  return interpretation.stopped() ? std::nullopt : std::optional(result);
}

} // namespace

std::optional<double> ContractOnRun::number(ExpressionId expression, const EntryValues &entry) const {
  const auto value = inContract(machine_, contracts_, entry, entry.state,
                                [&](auto &context) { return evaluate(context, expression); });
  return value ? std::optional(value->number) : std::nullopt;
}

std::optional<bool> ContractOnRun::condition(ExpressionId expression, const EntryValues &entry,
                                             const State &now) const {
  State state = now;
  for (const Axis axis : kAllAxes) {
    state.variables.set(positionVariable(letterOf(axis)), now.at(axis));
    state.variables.set(entryVariable(letterOf(axis)), entry.state.at(axis));
  }
  for (const auto &[variable, given] : entry.given.entries())
    state.variables.set(oldVariable(variable), valueOf(entry.given, entry.state, variable));
  return inContract(machine_, contracts_, entry, state,
                    [&](auto &context) { return evaluateCondition(context, expression); });
}

void ContractOnRun::prepare(EntryValues &entry) const {
  if (!contract_)
    return;
  const ModalTable modes(machine_.dialect());
  for (const ModalCode &code : contract_->modal)
    if (const Code *row = code.address == 'G' ? findGCode(machine_.dialect(), code.tenths) : nullptr)
      entry.state.codes[row->group] = modes.indexOf(*row).value_or(entry.state.codes[row->group]);
  if (contract_->start)
    for (const AxisValue &axis : contract_->start->axes)
      if (const auto known = axisOf(axis.axis))
        entry.state.at(*known) = ConcreteValue::of(number(axis.value, entry).value_or(0));
}

void ContractOnRun::draw(EntryValues &entry, soundness::Random &random) const {
  if (!contract_)
    return;
  for (const auto *demands : {&contract_->params, &contract_->globals})
    for (const EntryValue &demand : *demands) {
      const ConcreteValue value = drawn(demand, entry, random);
      entry.given.set(demand.variable, value);
      if (demand.variable <= kLocalVariables)
        entry.state.locals[demand.variable] = value;
      else if (entry.state.variables.find(demand.variable))
        entry.state.variables.set(demand.variable, value);
    }
}

ConcreteValue ContractOnRun::drawn(const EntryValue &demand, const EntryValues &entry,
                                   soundness::Random &random) const {
  if (demand.vacancy == Vacancy::Possible && random.oneIn(4))
    return {};
  double value = static_cast<double>(random.below(20)) - 5;
  if (const auto *list = std::get_if<ValueList>(&demand.values))
    value = number(list->values[random.below(static_cast<std::uint32_t>(list->values.size()))], entry).value_or(0);
  if (const auto *range = std::get_if<Range>(&demand.values)) {
    const auto low = range->low ? number(*range->low, entry) : std::nullopt;
    const auto high = range->high ? number(*range->high, entry) : std::nullopt;
    const double least = low.value_or(high.value_or(0) - (high ? 20 : 5));
    const double most = high.value_or(least + 20);
    value = std::clamp(least + std::floor((most - least) * random.below(9)) / 8, least, std::max(least, most));
  }
  return ConcreteValue::of(demand.unit == Unit::Integer ? std::round(value) : value);
}

bool ContractOnRun::isAllowed(const EntryValue &demand, const EntryValues &entry) const {
  const ConcreteValue held = valueOf(entry.given, entry.state, demand.variable);
  if (held.vacant)
    return demand.vacancy == Vacancy::Possible;
  if (demand.unit == Unit::Integer && std::floor(held.number) != held.number)
    return false;
  const auto compares = [&](ExpressionId expression, auto &&relation) {
    const auto value = number(expression, entry);
    return value && relation(held.number, *value);
  };
  return match(
      demand.values, [](const AnyNumber &) { return true; },
      [&](const Range &range) {
        return (!range.low || compares(*range.low, std::greater_equal<>())) &&
               (!range.high || compares(*range.high, std::less_equal<>()));
      },
      [&](const ValueList &list) {
        return std::any_of(list.values.begin(), list.values.end(),
                           [&](ExpressionId each) { return compares(each, std::equal_to<>()); });
      });
}

bool ContractOnRun::foresees(double alarm) const {
  return contract_ && std::any_of(contract_->alarms.begin(), contract_->alarms.end(), [&](const AlarmPromise &promise) {
           return static_cast<double>(promise.number) == alarm;
         });
}

bool ContractOnRun::allows(const EntryValues &entry) const {
  if (!contract_)
    return true;
  const auto each = [&](const EntryValue &demand) { return isAllowed(demand, entry); };
  return std::all_of(contract_->params.begin(), contract_->params.end(), each) &&
         std::all_of(contract_->globals.begin(), contract_->globals.end(), each) &&
         std::all_of(contract_->requirements.begin(), contract_->requirements.end(),
                     [&](const ContractCondition &requirement) {
                       return condition(requirement.condition, entry, entry.state).value_or(false);
                     });
}

// ---- promises ----

bool ContractOnRun::keepsModes(const State &before, const State &now) const {
  const ModalTable modes(machine_.dialect());
  for (std::size_t group = 1; group < kModalGroups; ++group)
    if (!modes.group(group).codes.empty() && before.codes[group] != now.codes[group])
      return false;
  return before.words == now.words && before.shift == now.shift && before.local == now.local &&
         before.spindle == now.spindle && before.modalCalls == now.modalCalls;
}

std::optional<bool> ContractOnRun::keeps(const Ensure &ensure, const EntryValues &entry, const State &now) const {
  return match(
      ensure.promise, [&](ExpressionId expression) { return condition(expression, entry, now); },
      [&](const ModalPreserved &) { return std::optional(keepsModes(entry.state, now)); },
      [&](const std::vector<ModalCode> &codes) {
        const ModalTable modes(machine_.dialect());
        return std::optional(std::all_of(codes.begin(), codes.end(), [&](const ModalCode &code) {
          const Code *row = code.address == 'G' ? findGCode(machine_.dialect(), code.tenths) : nullptr;
          return !row || modes.indexOf(*row) == now.codes[row->group];
        }));
      });
}

std::optional<std::uint32_t> ContractOnRun::written(const EntryValues &entry, const State &now) const {
  for (const auto &[variable, value] : now.variables.entries()) {
    const VariableRange *row = findVariable(machine_.dialect(), variable);
    const bool allowed =
        !row || row->kind == VariableKind::System || row->kind == VariableKind::Local ||
        std::any_of(contract_->assigns.begin(), contract_->assigns.end(), [number = variable](const Assigns &clause) {
          return std::any_of(clause.variables.begin(), clause.variables.end(),
                             [number](const auto &range) { return range.first <= number && number <= range.last; });
        });
    if (!allowed && !(value == valueOf(entry.given, entry.state, variable)))
      return variable;
  }
  return std::nullopt;
}

bool ContractOnRun::keepsAlarm(const AlarmPromise &promise, const EntryValues &entry, const RunResult &run) const {
  const auto demanded = condition(promise.condition, entry, entry.state);
  if (!demanded || run.end == RunEnd::Fuel || run.end == RunEnd::Unmodelled)
    return true;
  const bool raised = run.end == RunEnd::UserAlarm && run.alarmNumber == static_cast<double>(promise.number);
  return raised == *demanded || (raised && promise.claim == AlarmClaim::If);
}

std::optional<std::string> ContractOnRun::broken(const Obligation &promise, const EntryValues &entry,
                                                 const RunResult &run) const {
  if (!contract_)
    return std::nullopt;
  const auto textOf = [&](ClauseId clause) { return contracts_.clauses[clause].text; };
  if (promise.kind == ObligationKind::Ensures || promise.kind == ObligationKind::ModalPreserved)
    for (const Ensure &ensure : contract_->ensures)
      if (hasEnded(run.end) && textOf(ensure.clause) == promise.claim &&
          !keeps(ensure, entry, run.state).value_or(true))
        return "the run ends and it does not hold";
  if (promise.kind == ObligationKind::Assigns && hasEnded(run.end))
    if (const auto variable = written(entry, run.state))
      return fmt::format("#{} is written", *variable);
  if (promise.kind == ObligationKind::AlarmIff)
    for (const AlarmPromise &alarm : contract_->alarms)
      if (textOf(alarm.clause) == promise.claim && !keepsAlarm(alarm, entry, run))
        return fmt::format("the run ends with {} {}", nameOf(run.end), run.alarmNumber);
  return std::nullopt;
}

} // namespace feedhold::proof_tests
