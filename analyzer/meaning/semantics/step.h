// Step: what one instruction does to the state.  Where control goes next is the engine's to decide; it asks the
// functions below for the conditions.
#pragma once

#include "meaning/semantics/calls.h"
#include "meaning/semantics/interpreter_errors.h"
#include "meaning/semantics/motion.h"
#include "meaning/semantics/saved_modes.h"

namespace feedhold {

/// Instructions that have one successor.  `words` is scratch memory that a run keeps.  The others (tests, jumps, calls,
/// returns, ends) change nothing here.
template <ValueAlgebra R> void step(StepContext<R> &context, const Instruction &instruction, ExecutedWords<R> &words);

/// Whether a corner waits (corners.h), and the instruction is no block that may have the line behind it.
template <ValueAlgebra R> bool endsCorner(StepContext<R> &context, const Instruction &instruction) {
  return !std::holds_alternative<ExecuteWords>(instruction) && !std::holds_alternative<BlockSkip>(instruction) &&
         context.interpretation.mayBe(waitsForLine(context));
}

/// Whether the block that has just been executed moved an axis: a modal macro is called then.
template <ValueAlgebra R> typename R::Truth movesAxis(StepContext<R> &context, const ExecutedWords<R> &words);

/// The truth of a Test; either where the condition did not parse.
template <ValueAlgebra R> typename R::Truth conditionOf(StepContext<R> &context, const Test &test);

/// The truth of a CountDown; the counter has been counted down in the cases where it holds.
template <ValueAlgebra R> typename R::Truth countDown(StepContext<R> &context, const CountDown &count);

/// The number that a computed GOTO looks for, rounded; alarms for numbers that no block has are the engine's.
template <ValueAlgebra R> typename R::Value jumpTarget(StepContext<R> &context, const JumpTo &jump);

/// P of an M99; absent without one.  The value of `return [..]` has been stored, and the modes are those that the level
/// restores, when this returns.
template <ValueAlgebra R>
std::optional<typename R::Value> returnTarget(StepContext<R> &context, const ReturnFromProgram &from);

// ---- implementation -----------------------------------------------------------------------------------------------

namespace detail {

template <ValueAlgebra R> void store(StepContext<R> &context, ExpressionId target, typename R::Value value) {
  R &interpretation = context.interpretation;
  const Expression &expression = context.tree().expressions[target];
  if (const auto *numbered = std::get_if<NumberedVariable>(&expression.node)) {
    const auto number = numbered->number.asInteger();
    if (number && *number >= 0 && *number < kFirstPredefinedName)
      return writeVariable(context, static_cast<std::uint32_t>(*number), std::move(value), expression.span);
  } else if (const auto *indirect = std::get_if<IndirectVariable>(&expression.node)) {
    const auto index = evaluate(context, indirect->index);
    if (const auto number = variableAt(context, index, expression.span))
      return writeVariable(context, *number, std::move(value), expression.span);
    if (interpretation.writeAnyOf(context.state, interpretation.asNumber(index), value, expression.span))
      loseOrigins(context, expression.span);
    forgetLength(context);
    return;
  } else if (const auto *named = std::get_if<NamedVariable>(&expression.node)) {
    if (const auto number = context.programs.variableOf(context.file.file, named->name))
      return writeVariable(context, *number, std::move(value), expression.span);
  }
  interpretation.havoc(context.state, "an assignment to an unknown variable", expression.span);
}

/// A name on the left of `=` is there, and 0, while the right side is read: `#<new>=[#<new>+1]`.
template <ValueAlgebra R> void introduceName(StepContext<R> &context, ExpressionId target) {
  const auto *named = std::get_if<NamedVariable>(&context.tree().expressions[target].node);
  const auto number = named ? context.programs.variableOf(context.file.file, named->name) : std::nullopt;
  if (number && *number >= kFirstNamedVariable)
    context.state.variables.set(*number, context.interpretation.asNumber(storedValue(context, *number)));
}

/// An interpretation that goes through a program several times may know the value from the last time.
template <ValueAlgebra R> typename R::Value assignedValue(StepContext<R> &context, ExpressionId expression) {
  if constexpr (requires { context.interpretation.recalled(context.file, context.state, expression); }) {
    if (auto known = context.interpretation.recalled(context.file, context.state, expression))
      return *std::move(known);
    auto value = evaluate(context, expression);
    context.interpretation.remember(context.file, expression, value);
    return value;
  } else {
    return evaluate(context, expression);
  }
}

/// All right sides are read before the first assignment takes place.
template <ValueAlgebra R> void assign(StepContext<R> &context, const Assign &assign) {
  const SyntaxTree &tree = context.tree();
  const auto assignmentAt = [&](std::uint32_t i) {
    return std::get_if<Assignment>(&tree.statements[StatementId(assign.first.index() + i)].node);
  };
  const auto read = [&](const Assignment &assignment) {
    if (context.behaviour().assignsAfterReading)
      introduceName(context, assignment.target);
    return assignedValue(context, assignment.value);
  };
  if (const Assignment *only = assign.count == 1 ? assignmentAt(0) : nullptr) { // nearly always: no list is needed
    auto value = read(*only);
    if (!context.interpretation.stopped())
      store(context, only->target, std::move(value));
    return;
  }
  std::vector<typename R::Value> values;
  for (std::uint32_t i = 0; i < assign.count; ++i)
    if (const Assignment *assignment = assignmentAt(i))
      values.push_back(read(*assignment));
  if (context.interpretation.stopped())
    return; // with an alarm, and nothing has been assigned
  auto value = values.begin();
  for (std::uint32_t i = 0; i < assign.count; ++i)
    if (const Assignment *assignment = assignmentAt(i))
      store(context, assignment->target, std::move(*value++));
}

template <ValueAlgebra R>
void setNamed(StepContext<R> &context, std::string_view name, const typename R::Value &value) {
  if (const auto number = context.programs.usesName(name) ? context.programs.variableNamed(name) : std::nullopt)
    context.state.variables.set(*number, value);
}

template <ValueAlgebra R> void keepReturned(StepContext<R> &context, std::optional<ExpressionId> expression) {
  R &interpretation = context.interpretation;
  const auto value = expression ? interpretation.asNumber(evaluate(context, *expression)) : context.zero();
  setNamed(context, kReturnedValue, value);
  setNamed(context, kIsValueReturned, interpretation.number(expression ? 1 : 0));
}

template <ValueAlgebra R>
void executeWords(StepContext<R> &context, const ExecuteWords &execute, ExecutedWords<R> &words) {
  readWords(context, execute, words);
  for (const auto &[code, span] : words.unlisted)
    context.interpretation.unlistedCode(context.state, code, span);
  if (!words.unlisted.empty())
    return;
  const bool keeps = keepsWords(context);
  const auto before = keeps ? context.state.position : std::array<typename R::Value, kAxisCount>{};
  applyModes(context, words);
  if (keeps)
    forgetKeptIfMoved(context, before); // lengths in other units, a tool length
  if (const std::string_view why = whyInterpreterStops(context, words); !why.empty())
    context.interpretation.havoc(context.state, why, context.place());
  applyMotion(context, words);
  if (words.mayTakeAxes) {
    havocPosition(context);
    for (const VariableRange &range : context.dialect().variables)
      if (range.role == VariableRole::SkipPosition)
        context.interpretation.havocVariables(context.state, range.first, range.last);
  }
  for (const CodeWord &word : words.codes)
    if (word.code->action == CodeAction::Anything)
      context.interpretation.havoc(context.state, word.code->meaning, word.span);
    else if (word.code->action == CodeAction::InterruptOn)
      context.interpretation.abandon("a macro interrupt is armed, and its program may run between any two blocks",
                                     word.span);
    else if (const CodeAction action = word.code->action;
             action == CodeAction::ModesSave || action == CodeAction::ModesDrop || action == CodeAction::ModesRestore ||
             action == CodeAction::ModesSaveForReturn)
      savedModes(context, words, word);
  if (words.unmodelled)
    context.interpretation.havoc(context.state, "an unknown code", context.place());
}

template <ValueAlgebra R> void startCount(StepContext<R> &context, const StartCount &start) {
  auto &counters = context.state.counters;
  if (counters.size() <= start.counter.index())
    counters.resize(start.counter.index() + 1, context.zero());
  R &interpretation = context.interpretation;
  const auto times = evaluate(context, start.times);
  const auto rounded = interpretation.roundTo(interpretation.asNumber(times), Decimal(1, 0));
  counters[start.counter.index()] = interpretation.select(interpretation.isVacant(times), interpretation.number(1),
                                                          rounded); // a word that is dropped
}

template <ValueAlgebra R> void havocVariables(StepContext<R> &context, const HavocVariables &unread) {
  if constexpr (requires { R::kGoesOnBehindMistakes; }) {
    context.interpretation.unmodelled(unread.reason, context.place());
    context.interpretation.havocVariables(context.state, 0, 0xffffffff);
    for (std::size_t local = 1; local <= kLocalVariables; ++local)
      context.state.locals[local] = context.interpretation.anything();
  } else {
    context.interpretation.havoc(context.state, unread.reason, context.place());
  }
}

} // namespace detail

/// A program that is not followed has returned nothing, or a number that is read from outside.
template <ValueAlgebra R> void keepReturnedByOther(StepContext<R> &context) {
  R &interpretation = context.interpretation;
  const auto variable = context.programs.returnedValue();
  if (!variable)
    return;
  const auto isReturned = interpretation.isReadFromOutside(*variable);
  const auto read = interpretation.volatileRead(*variable);
  detail::setNamed(context, kReturnedValue, interpretation.select(isReturned, read, context.zero()));
  detail::setNamed(context, kIsValueReturned,
                   interpretation.select(isReturned, interpretation.number(1), context.zero()));
}

template <ValueAlgebra R> void step(StepContext<R> &context, const Instruction &instruction, ExecutedWords<R> &words) {
  R &interpretation = context.interpretation;
  if (const auto *execute = std::get_if<ExecuteWords>(&instruction))
    return detail::executeWords(context, *execute, words);
  if (const auto *assign = std::get_if<Assign>(&instruction))
    return detail::assign(context, *assign);
  if (const auto *enter = std::get_if<EnterLoop>(&instruction))
    enteredLoop(context.state, enter->number, interpretation.truth(true)) = interpretation.truth(true);
  else if (const auto *into = std::get_if<JumpIntoLoop>(&instruction))
    enteredLoop(context.state, into->number, interpretation.truth(false)) = interpretation.truth(false);
  else if (const auto *require = std::get_if<RequireLoop>(&instruction))
    interpretation.alarm(
        interpretation.negation(enteredLoop(context.state, require->number, interpretation.truth(true))),
        {AlarmKind::MissingDo, context.place()});
  else if (const auto *start = std::get_if<StartCount>(&instruction))
    detail::startCount(context, *start);
  else if (const auto *stop = std::get_if<StopWithAlarm>(&instruction))
    interpretation.alarm(interpretation.truth(true), {stop->alarm, context.place()});
  else if (const auto *passed = std::get_if<PassedReturn>(&instruction)) {
    context.passesDefinition = true;
    detail::keepReturned(context, passed->value);
    context.passesDefinition = false;
  } else if (const auto *havoc = std::get_if<Havoc>(&instruction))
    interpretation.havoc(context.state, havoc->reason, context.place());
  else if (const auto *unread = std::get_if<HavocVariables>(&instruction))
    detail::havocVariables(context, *unread);
}

template <ValueAlgebra R> typename R::Truth movesAxis(StepContext<R> &context, const ExecutedWords<R> &words) {
  auto moves = context.interpretation.truth(false);
  for (const CodeWord &word : words.codes)
    if (word.code->action == CodeAction::Dwell || word.code->action == CodeAction::LocalShift ||
        word.code->action == CodeAction::CoordinateSet || word.code->role == CodeRole::DataSetting)
      return moves;
  for (const Axis axis : kAllAxes)
    if (const auto *entry = words.find(letterOf(axis)))
      moves = context.either(moves, entry->present);
  return moves;
}

template <ValueAlgebra R> typename R::Truth conditionOf(StepContext<R> &context, const Test &test) {
  if constexpr (!requires { R::kGoesOnBehindMistakes; })
    if (test.passesContour)
      return context.interpretation.truth(true);
  return test.condition ? evaluateCondition(context, *test.condition) : context.interpretation.unknownTruth();
}

template <ValueAlgebra R> typename R::Truth countDown(StepContext<R> &context, const CountDown &count) {
  R &interpretation = context.interpretation;
  auto &counters = context.state.counters;
  if (counters.size() <= count.counter.index())
    counters.resize(count.counter.index() + 1, context.zero());
  auto &left = counters[count.counter.index()];
  const auto goesOn = interpretation.compare(Relation::Greater, left, context.zero());
  left = interpretation.select(goesOn, interpretation.subtract(left, interpretation.number(1)), left);
  return goesOn;
}

template <ValueAlgebra R> typename R::Value jumpTarget(StepContext<R> &context, const JumpTo &jump) {
  return context.interpretation.roundTo(context.interpretation.asNumber(evaluate(context, jump.target)), Decimal(1, 0));
}

template <ValueAlgebra R>
std::optional<typename R::Value> returnTarget(StepContext<R> &context, const ReturnFromProgram &from) {
  R &interpretation = context.interpretation;
  restoreModesAtReturn(context);
  if (context.dialect().grammar.namedParameters && !from.target)
    detail::keepReturned(context, from.value);
  if (!from.target)
    return std::nullopt;
  const Word &word = context.tree().words[*from.target];
  if (word.form() == WordForm::Expression)
    return interpretation.roundTo(interpretation.asNumber(evaluate(context, word.expression())), Decimal(1, 0));
  return word.isNumber() ? interpretation.literal(word.number()) : interpretation.anyNumber();
}

} // namespace feedhold
