#include "proof/symbolic/contract_terms.h"

#include "base/support/match.h"
#include "meaning/semantics/tool_length.h"
#include "proof/smt/steps.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <set>

namespace feedhold::prove {

using smt::TermId;

namespace {

constexpr std::uint64_t kStepsOfTerm = 1'000; // of setting up the state over which a clause is read
constexpr std::uint32_t kMostComputed = 40;   // numbers of H
constexpr int kMostOffset = 10'000;           // in a register of tool offsets (FANUC: 9999.999 mm at most)

/// The expressions of a contract are read as those of the program, in a tree of their own.
template <typename Evaluate>
auto inContract(SymbolicInterpretation &interpretation, const ProgramSet &programs, FileId file,
                const FileContracts &contracts, SymbolicState &state, Evaluate &&evaluate) {
  const ProgramFile &program = programs.file(file);
  const ProgramFile within{.file = file,
                           .source = program.source,
                           .tree = &contracts.tree,
                           .model = program.model,
                           .dialect = program.dialect};
  const ModalTable modes(*program.dialect);
  interpretation.useDialect(*program.dialect);
  const ContractArithmetic arithmetic(interpretation);
  StepContext<SymbolicInterpretation> context{interpretation, state, programs, within, modes, BlockId(0)};
  auto result = evaluate(context);
  interpretation.start(); // what a condition of a contract would stop at is no alarm of the program
  return result;
}

smt::Number stepOf(const EntryValue &input) { return smt::Number::parse(input.step->toString()).value(); }

} // namespace

std::set<std::uint32_t> oldVariablesIn(const FileContracts &contracts) {
  std::set<std::uint32_t> found;
  for (const Expression &expression : contracts.tree.expressions) {
    const auto *variable = std::get_if<NumberedVariable>(&expression.node);
    const auto number = variable ? variable->number.asInteger() : std::nullopt;
    if (!number || *number >= 0)
      continue;
    const auto old = reservedVariable(static_cast<std::uint32_t>(-*number));
    if (const auto *of = old ? std::get_if<OldValueOf>(&*old) : nullptr)
      found.insert(of->variable);
  }
  return found;
}

ContractTerms::ContractTerms(SymbolicInterpretation &interpretation, const ProgramSet &programs, FileId file,
                             const FileContracts &contracts)
    : interpretation_(interpretation), programs_(programs), file_(file), contracts_(contracts),
      oldVariables_(oldVariablesIn(contracts)) {
  std::erase_if(oldVariables_, [](std::uint32_t variable) { return variable <= kLocalVariables; });
}

std::map<std::uint32_t, WrittenInput> writtenInputs(const FileContracts &file, const Contract &contract) {
  const auto isWhole = [&](ExpressionId id) {
    const auto *literal = std::get_if<NumberLiteral>(&file.tree.expressions[id].node);
    return literal && std::floor(literal->value.toDouble()) == literal->value.toDouble();
  };
  std::map<std::uint32_t, WrittenInput> inputs;
  for (const auto *clauses : {&contract.params, &contract.globals})
    for (const EntryValue &each : *clauses) {
      WrittenInput &input = inputs[each.variable];
      input.isWhole |= each.unit == Unit::Integer;
      const auto *range = std::get_if<Range>(&each.values);
      input.hasLow |= range && range->low;
      input.hasHigh |= range && range->high;
      const auto *list = std::get_if<ValueList>(&each.values);
      input.hasLow |= list != nullptr;
      input.hasHigh |= list != nullptr;
      input.isWhole |= list && std::ranges::all_of(list->values, isWhole);
      if (each.step)
        input.step = stepOf(each);
    }
  return inputs;
}

SymbolicValue heldBy(SymbolicInterpretation &interpretation, const Dialect &dialect, std::uint32_t variable,
                     const SymbolicState &state) {
  if (variable <= kLocalVariables)
    return state.locals[variable];
  const std::uint32_t cell = cellOf(dialect, variable);
  const SymbolicValue *written = state.variables.find(cell);
  return written ? *written : interpretation.unwritten(state, cell);
}

SymbolicValue ContractTerms::value(ExpressionId expression, const SymbolicState &state) {
  SymbolicState copy = state;
  return inContract(interpretation_, programs_, file_, contracts_, copy,
                    [&](auto &context) { return evaluate(context, expression); });
}

SymbolicState ContractTerms::withReserved(const SymbolicState &entry, const SymbolicState &now) const {
  SymbolicState state = now;
  for (const Axis axis : kAllAxes) {
    state.variables.set(positionVariable(letterOf(axis)), now.at(axis));
    state.variables.set(entryVariable(letterOf(axis)), entry.at(axis));
  }
  for (std::uint32_t local = 1; local <= kLocalVariables; ++local)
    state.variables.set(oldVariable(local), entry.locals[local]);
  for (const std::uint32_t variable : oldVariables_)
    state.variables.set(oldVariable(variable), valueOf(variable, entry));
  smt::spend(kStepsOfTerm);
  return state;
}

std::set<std::uint32_t> variablesIn(const FileContracts &contracts) {
  std::set<std::uint32_t> found = oldVariablesIn(contracts);
  for (const Expression &expression : contracts.tree.expressions)
    if (const auto *variable = std::get_if<NumberedVariable>(&expression.node))
      if (const auto number = variable->number.asInteger(); number && *number >= 0)
        found.insert(static_cast<std::uint32_t>(*number));
  return found;
}

TermId ContractTerms::condition(ExpressionId expression, const SymbolicState &entry, const SymbolicState &now) {
  SymbolicState state = withReserved(entry, now);
  return inContract(interpretation_, programs_, file_, contracts_, state,
                    [&](auto &context) { return evaluateCondition(context, expression); })
      .term;
}

/// In exact numbers a promise is exact, unless the contract says otherwise.
TermId ContractTerms::promise(const Contract &contract, ExpressionId expression, const SymbolicState &entry,
                              const SymbolicState &now) {
  const bool isExact = interpretation_.arithmetic() == Arithmetic::Exact && !contract.tolerance;
  const TermId tolerance = interpretation_.literal(toleranceOf(contract, *programs_.file(file_).dialect)).number;
  const auto before = interpretation_.useTolerance(isExact ? std::nullopt : std::optional(tolerance));
  const TermId result = condition(expression, entry, now);
  interpretation_.useTolerance(before);
  return result;
}

TermId ContractTerms::conditionAt(ExpressionId expression, const SymbolicState &entry,
                                  const std::array<TermId, 3> &point) {
  SymbolicState state = withReserved(entry, entry);
  for (const Axis axis : {Axis::X, Axis::Y, Axis::Z})
    state.variables.set(pointVariable(letterOf(axis)), {interpretation_.store().no(), point[indexOf(axis)]});
  return inContract(interpretation_, programs_, file_, contracts_, state,
                    [&](auto &context) { return evaluateCondition(context, expression); })
      .term;
}

TermId ContractTerms::number(ExpressionId expression, const SymbolicState &entry, const SymbolicState &now) {
  return value(expression, withReserved(entry, now)).number;
}

SymbolicValue ContractTerms::valueOf(std::uint32_t variable, const SymbolicState &state) const {
  return heldBy(interpretation_, *programs_.file(file_).dialect, variable, state);
}

TermId ContractTerms::demandOf(const EntryValue &given, const SymbolicState &entry) {
  smt::TermStore &store = interpretation_.store();
  const SymbolicValue held = valueOf(given.variable, entry);
  std::vector<TermId> demands;
  match(
      given.values, [](const AnyNumber &) {},
      [&](const Range &range) {
        const auto isAtMost = [&](const SymbolicValue &low, const SymbolicValue &high) {
          demands.push_back(interpretation_.compare(Relation::LessOrEqual, low, high).term);
        };
        if (range.low)
          isAtMost(value(*range.low, entry), held);
        if (range.high)
          isAtMost(held, value(*range.high, entry));
      },
      [&](const ValueList &list) {
        std::vector<TermId> cases;
        for (const ExpressionId each : list.values)
          cases.push_back(store.equal(held.number, value(each, entry).number));
        demands.push_back(store.logicalOr(cases));
      });
  if (given.unit == Unit::Integer)
    demands.push_back(store.equal(store.floor(held.number), held.number));
  if (given.step)
    demands.push_back(interpretation_.isMultiple(held.number, stepOf(given)));
  const TermId within = store.logicalAnd(demands);
  if (given.vacancy == Vacancy::Possible)
    return store.logicalOr(held.vacant, within);
  return store.logicalAnd(store.logicalNot(held.vacant), within);
}

/// The numbers of H that blocks of these programs name, and the first ones where some block computes its own.
std::set<std::uint32_t> ContractTerms::numbersOfLengths() const {
  std::set<std::uint32_t> numbers;
  const Dialect &dialect = *programs_.file(file_).dialect;
  for (std::size_t i = 0; i < programs_.size(); ++i)
    for (const Word &word : programs_.file(FileId(i)).tree->words)
      if (word.address() == 'H' && !word.isNumber()) {
        for (std::uint32_t number = 1; number <= kMostComputed && number <= dialect.behaviour.lengthOffsets.count;
             ++number)
          numbers.insert(number);
      } else if (word.address() == 'H')
        if (const auto number = lengthOffsetNumber(dialect, word.number().toDouble()))
          numbers.insert(*number);
  return numbers;
}

void ContractTerms::demandRegisters(const SymbolicState &entry, std::vector<TermId> &demands) {
  smt::TermStore &store = interpretation_.store();
  const TermId most = store.number(smt::Number(kMostOffset));
  for (const std::uint32_t number : numbersOfLengths())
    for (const std::uint32_t variable : lengthVariables(*programs_.file(file_).dialect, number)) {
      const TermId held = valueOf(variable, entry).number;
      demands.push_back(store.lessOrEqual(store.negate(most), held));
      demands.push_back(store.lessOrEqual(held, most));
    }
}

/// A clause of every H speaks of those that the programs name and no other clause does.
void ContractTerms::demandLength(const LengthRange &length, const Contract &contract, const SymbolicState &entry,
                                 std::vector<TermId> &demands) {
  smt::TermStore &store = interpretation_.store();
  std::set<std::uint32_t> numbers = length.number ? std::set{*length.number} : numbersOfLengths();
  if (!length.number)
    for (const LengthRange &other : contract.lengths)
      if (other.number)
        numbers.erase(*other.number);
  for (const std::uint32_t number : numbers) {
    const auto [geometry, wear] = lengthVariables(*programs_.file(file_).dialect, number);
    const TermId sum = store.add(valueOf(geometry, entry).number, valueOf(wear, entry).number);
    if (length.length.low)
      demands.push_back(store.lessOrEqual(value(*length.length.low, entry).number, sum));
    if (length.length.high)
      demands.push_back(store.lessOrEqual(sum, value(*length.length.high, entry).number));
  }
}

TermId ContractTerms::lengthInSpindle(const Contract &contract, const SymbolicState &entry) {
  std::optional<SymbolicValue> length;
  for (const LengthRange &each : contract.lengths) {
    const auto &[low, high] = each.length;
    const SymbolicValue one =
        low && high ? interpretation_.between(value(*low, entry), value(*high, entry)) : interpretation_.anyNumber();
    length = length ? interpretation_.either(*length, one) : one;
  }
  return length ? length->number : interpretation_.anyNumber().number;
}

std::optional<TermId> ContractTerms::longestBelow(const Contract &contract, const SymbolicState &entry) {
  smt::TermStore &store = interpretation_.store();
  const Dialect &dialect = *programs_.file(file_).dialect;
  const ModalTable modes(dialect);
  const auto group = modes.groupOf(ModalKind::Length);
  const auto code = group ? interpretation_.onlyCode(entry.codes[*group]) : std::nullopt;
  if (!code || modes.group(*group).codes[*code]->action != CodeAction::LengthOff)
    return store.number(smt::Number(0));
  std::optional<TermId> longest;
  for (const LengthRange &each : contract.lengths) {
    if (!each.length.high)
      return std::nullopt;
    const TermId high = value(*each.length.high, entry).number;
    longest = longest ? store.ite(store.less(*longest, high), high, *longest) : high;
  }
  return longest ? longest : store.number(smt::Number(0));
}

/// How far the tip may be above the coordinates while no length is in force: lengths below zero.
TermId ContractTerms::mostAbove(const Contract &contract, const SymbolicState &entry) {
  smt::TermStore &store = interpretation_.store();
  TermId most = store.number(smt::Number(0));
  for (const LengthRange &each : contract.lengths) {
    if (!each.length.low)
      return interpretation_.anyNumber().number;
    const TermId above = store.negate(value(*each.length.low, entry).number);
    most = store.ite(store.less(most, above), above, most);
  }
  return most;
}

/// At the start the axes stand in the range of the machine; where its zero point is not known, nothing follows.
void ContractTerms::demandMachine(const MachineRange &machine, const SymbolicState &entry,
                                  std::vector<TermId> &demands) {
  smt::TermStore &store = interpretation_.store();
  const std::array<TermId, 3> zero = machineZero(entry);
  for (const AxisRange &side : machine.box.sides) {
    const std::size_t axis = indexOf(*axisOf(side.axis));
    const TermId at = store.add(entry.position[axis].number, zero[axis]);
    if (side.range.low)
      demands.push_back(store.lessOrEqual(value(*side.range.low, entry).number, at));
    if (side.range.high)
      demands.push_back(store.lessOrEqual(at, value(*side.range.high, entry).number));
  }
}

std::array<TermId, 3> ContractTerms::machineZero(const SymbolicState &entry) {
  SymbolicState copy = entry;
  return inContract(interpretation_, programs_, file_, contracts_, copy, [](auto &context) {
    return std::array{originOf(context, Axis::X).number, originOf(context, Axis::Y).number,
                      originOf(context, Axis::Z).number};
  });
}

std::vector<TermId> ContractTerms::demands(const Contract &contract, const SymbolicState &entry) {
  std::vector<TermId> demands;
  for (const EntryValue &param : contract.params)
    demands.push_back(demandOf(param, entry));
  for (const EntryValue &global : contract.globals)
    demands.push_back(demandOf(global, entry));
  for (const ContractCondition &requirement : contract.requirements)
    demands.push_back(condition(requirement.condition, entry, entry));
  if (contract.machine || !contract.lengths.empty())
    demandRegisters(entry, demands);
  for (const LengthRange &length : contract.lengths)
    demandLength(length, contract, entry, demands);
  if (contract.machine)
    demandMachine(*contract.machine, entry, demands);
  return demands;
}

std::vector<InputEnds> ContractTerms::inputEnds(const Contract &contract, const SymbolicState &entry) {
  const auto number = [&](std::optional<ExpressionId> end) {
    return end ? std::optional(value(*end, entry).number) : std::nullopt;
  };
  std::vector<InputEnds> ends;
  for (const auto *inputs : {&contract.params, &contract.globals})
    for (const EntryValue &input : *inputs)
      if (const auto *range = std::get_if<Range>(&input.values))
        ends.push_back({input.variable, number(range->low), number(range->high)});
  const Dialect &dialect = *programs_.file(file_).dialect;
  for (const LengthRange &length : contract.lengths)
    for (const std::uint32_t each : length.number ? std::set{*length.number} : numbersOfLengths())
      ends.push_back({lengthVariables(dialect, each).front(), number(length.length.low), number(length.length.high)});
  return ends;
}

std::vector<OffsetEnd> ContractTerms::offsetEnds(const Contract &contract, const SymbolicState &entry) {
  std::vector<OffsetEnd> ends;
  for (const RadiusOffset &offset : contract.offsets)
    if (offset.radius.high && offset.radius.low != offset.radius.high)
      ends.push_back({offset.number ? std::optional(value(*offset.number, entry).number) : std::nullopt,
                      value(*offset.radius.high, entry).number});
  return ends;
}

std::vector<TermId> ContractTerms::modesOfStart(const Contract &contract, const SymbolicState &started) {
  SymbolicState prepared = started;
  prepare(contract, prepared);
  std::vector<TermId> all;
  for (std::size_t group = 0; group < kModalGroups; ++group)
    all.push_back(interpretation_.store().equal(started.codes[group].index, prepared.codes[group].index));
  return all;
}

std::vector<TermId> ContractTerms::placeOfStart(const Contract &contract, const SymbolicState &started) {
  SymbolicState prepared = started;
  prepare(contract, prepared);
  std::vector<TermId> all;
  for (const Axis axis : kAllAxes)
    for (const auto part : {&SymbolicState::position, &SymbolicState::shift, &SymbolicState::local})
      all.push_back(
          interpretation_.store().equal((started.*part)[indexOf(axis)].number, (prepared.*part)[indexOf(axis)].number));
  all.push_back(interpretation_.store().equal(started.lengthOffset.number, prepared.lengthOffset.number));
  return all;
}

std::vector<TermId> ContractTerms::assumptions(const Contract &contract, const SymbolicState &started) {
  std::vector<TermId> all = demands(contract, started);
  for (const auto &more : {modesOfStart(contract, started), placeOfStart(contract, started)})
    all.insert(all.end(), more.begin(), more.end());
  return all;
}

/// Then no shift of G52 or G92 lies between them and those of the program.
bool ContractTerms::namesMachineCoordinates(const Contract &contract) const {
  return contract.machine || std::ranges::any_of(contract.globals, [&](const EntryValue &value) {
           return contracts_.clauses[value.clause].kind == ClauseKind::Offset;
         });
}

void ContractTerms::prepare(const Contract &contract, SymbolicState &entry) {
  const Dialect &dialect = *programs_.file(file_).dialect;
  const ModalTable modes(dialect);
  for (const ModalCode &code : contract.modal) {
    const Code *row = code.address == 'G' ? findGCode(dialect, code.tenths) : nullptr;
    const auto index = row ? modes.indexOf(*row) : std::nullopt;
    if (index)
      entry.codes[row->group] = interpretation_.code(*index);
    if (row && row->action == CodeAction::LengthOff)
      entry.lengthOffset = interpretation_.number(0);
  }
  if (namesMachineCoordinates(contract)) {
    entry.shift.fill(interpretation_.number(0));
    entry.local.fill(interpretation_.number(0));
  }
  if (contract.start)
    for (const AxisValue &axis : contract.start->axes)
      if (const auto known = axisOf(axis.axis))
        entry.at(*known) = {interpretation_.store().no(), interpretation_.asCounted(value(axis.value, entry).number)};
}

} // namespace feedhold::prove
