#include "inference/absint/contract_entry.h"

#include "base/support/match.h"
#include "inference/absint/refine.h"
#include "meaning/semantics/evaluate.h"
#include "meaning/semantics/mappings.h"

#include <algorithm>
#include <cmath>

namespace feedhold {

namespace {

/// Bounds may speak of other arguments, and requirements of any: a second round knows what the first has found.
constexpr int kRounds = 2;

class EntryCut {
public:
  EntryCut(AbstractInterpretation &interpretation, const ProgramSet &programs, FileId file,
           const FileContracts &contracts, AbstractState &state)
      : interpretation_(interpretation), programs_(programs), modes_(*programs.file(file).dialect),
        within_{.file = file,
                .source = programs.file(file).source,
                .tree = &contracts.tree, // expressions of a contract are read as those of the program
                .model = programs.file(file).model,
                .dialect = programs.file(file).dialect},
        state_(state) {}

  void values(const std::vector<EntryValue> &given) {
    for (const EntryValue &value : given)
      cut(value);
  }

  void requirement(ExpressionId condition) {
    AbstractState trial = state_;
    AbstractContext context{interpretation_, trial, programs_, within_, modes_, BlockId(0)};
    if (assume(context, condition, Holds::Yes))
      state_ = std::move(trial);
    interpretation_.start();
  }

  void modal(const ModalCode &given) {
    const Code *code =
        given.address == 'G' ? findGCode(*within_.dialect, given.tenths) : findMCode(*within_.dialect, given.tenths);
    if (!code || beginsMapping(code->action)) // whose code is certain, is taken to be the program's own
      return;
    if (const auto index = modes_.indexOf(*code); index && given.address == 'G')
      state_.codes[code->group] = CodeSet::of(*index);
    const auto spindle = std::find(kSpindleActions.begin(), kSpindleActions.end(), code->action);
    if (spindle != kSpindleActions.end())
      state_.spindle = CodeSet::of(static_cast<std::size_t>(spindle - kSpindleActions.begin()));
  }

  void start(const AxisValue &given) {
    if (const auto axis = axisOf(given.axis))
      meetCell(state_.at(*axis), AbstractValue::number(numberOf(given.value)));
  }

private:
  /// Of exact numbers and of rounded ones: either is an end for both.
  AbstractNumber numberOf(ExpressionId expression) {
    AbstractContext context{interpretation_, state_, programs_, within_, modes_, BlockId(0)};
    const AbstractValue value = interpretation_.asNumber(evaluate(context, expression));
    interpretation_.start(); // what an expression of a contract would stop at is no alarm of the program
    return value.number();
  }

  /// The numbers that the clause allows; absent: none.
  std::optional<AbstractNumber> allowed(const EntryValue &given) {
    std::optional<AbstractNumber> number = AbstractNumber::any();
    match(
        given.values, [](const AnyNumber &) {},
        [&](const Range &range) {
          if (range.low)
            number = meetAtLeast(*number, numberOf(*range.low).interval().lo);
          if (range.high && number)
            number = meetAtMost(*number, numberOf(*range.high).interval().hi);
        },
        [&](const ValueList &list) {
          number.reset();
          for (const ExpressionId each : list.values)
            number = number ? join(*number, numberOf(each)) : numberOf(each);
        });
    if (number && given.unit == Unit::Integer)
      number = meet(*number, AbstractNumber::integersIn({-INFINITY, INFINITY}));
    return number;
  }
  void cut(const EntryValue &given) {
    const auto number = allowed(given);
    if (!number)
      return;
    const AbstractValue wanted =
        given.vacancy == Vacancy::Possible ? AbstractValue::vacantOr(*number) : AbstractValue::number(*number);
    if (given.variable <= kLocalVariables)
      return meetCell(state_.locals[given.variable], wanted);
    const std::uint32_t place = cellOf(*within_.dialect, given.variable);
    const AbstractValue *known = state_.variables.find(place);
    AbstractValue cell = known ? *known : interpretation_.unwritten(state_, place);
    meetCell(cell, wanted);
    state_.variables.set(place, std::move(cell));
  }
  static void meetCell(AbstractValue &cell, const AbstractValue &wanted) {
    if (const auto met = meet(cell, wanted))
      cell = met->withOrigin(cell.origin());
  }

  AbstractInterpretation &interpretation_;
  const ProgramSet &programs_;
  const ModalTable modes_;
  const ProgramFile within_;
  AbstractState &state_;
};

} // namespace

bool speaksOfEntry(const Contract &contract) {
  return !contract.params.empty() || !contract.globals.empty() || !contract.requirements.empty() ||
         !contract.modal.empty() || contract.start.has_value();
}

void assumeContract(AbstractInterpretation &interpretation, const ProgramSet &programs, FileId file,
                    const FileContracts &contracts, const Contract &contract, AbstractState &entry) {
  interpretation.useDialect(*programs.file(file).dialect);
  EntryCut entryCut(interpretation, programs, file, contracts, entry);
  for (int round = 0; round < kRounds; ++round) {
    entryCut.values(contract.params);
    entryCut.values(contract.globals);
    for (const ContractCondition &requirement : contract.requirements)
      entryCut.requirement(requirement.condition);
  }
  for (const ModalCode &code : contract.modal)
    entryCut.modal(code);
  if (contract.start)
    for (const AxisValue &axis : contract.start->axes)
      entryCut.start(axis);
}

} // namespace feedhold
