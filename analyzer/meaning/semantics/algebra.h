// ValueAlgebra: what an interpretation must offer, so that the meaning of an instruction is written once.
//
// An interpretation says what a value is (a number of a run; all possible numbers; a term of a solver) and receives
// what happens (alarms, moves).  The semantics never asks a value for its bits: it branches through the interpretation,
// which may take one side, or both and join them.
#pragma once

#include "language/dialect/dialect.h"
#include "language/dialect/switch_names.h"
#include "meaning/cfg/cfg.h"
#include "meaning/semantics/modal_table.h"
#include "meaning/semantics/moves.h"
#include "meaning/semantics/state.h"

#include <concepts>
#include <cstdint>
#include <optional>
#include <string_view>

namespace feedhold {

/// Relations of conditions; the vacancy rules are the semantics' own (evaluate.h).
enum class Relation : std::uint8_t { Equal, NotEqual, Greater, GreaterOrEqual, Less, LessOrEqual };

/// Why a run stops by itself at a place.
struct AlarmReport {
  AlarmKind kind;
  Span place;
};

/// Values: vacant, or a number.
template <typename R>
concept HasValues = requires(R interpretation, const typename R::Value value, const typename R::Truth truth,
                             Decimal decimal, double number) {
  { interpretation.literal(decimal) } -> std::same_as<typename R::Value>;
  { interpretation.number(number) } -> std::same_as<typename R::Value>;
  { interpretation.vacant() } -> std::same_as<typename R::Value>;
  /// Any value at all, vacant included; any number.
  { interpretation.anything() } -> std::same_as<typename R::Value>;
  { interpretation.anyNumber() } -> std::same_as<typename R::Value>;
  /// A vacant value as 0.
  { interpretation.asNumber(value) } -> std::same_as<typename R::Value>;
  { interpretation.isVacant(value) } -> std::same_as<typename R::Truth>;
  /// The number that it must be; absent when it may be several, or vacant.
  { interpretation.constantOf(value) } -> std::same_as<std::optional<double>>;
  /// Settings of the machine and modes choose it among literals.
  { interpretation.isFixed(value) } -> std::same_as<bool>;
  { interpretation.select(truth, value, value) } -> std::same_as<typename R::Value>;
  /// The control's settings are not known: one of the two.
  { interpretation.either(value, value) } -> std::same_as<typename R::Value>;
  /// The place between two values where a signal stops a movement.
  { interpretation.between(value, value) } -> std::same_as<typename R::Value>;
  /// A skip move begins, which ends there along each of its axes.
  interpretation.beginSkip();
  { interpretation.endOfSkip(value, value) } -> std::same_as<typename R::Value>;
};

/// Of numbers; divisors are not zero, arguments lie in the domain: the semantics has seen to it.
template <typename R>
concept HasArithmetic = requires(R interpretation, const typename R::Value value, Decimal decimal) {
  { interpretation.add(value, value) } -> std::same_as<typename R::Value>;
  { interpretation.subtract(value, value) } -> std::same_as<typename R::Value>;
  { interpretation.multiply(value, value) } -> std::same_as<typename R::Value>;
  { interpretation.divide(value, value) } -> std::same_as<typename R::Value>;
  { interpretation.negate(value) } -> std::same_as<typename R::Value>;
  { interpretation.remainder(value, value) } -> std::same_as<typename R::Value>; // sign of the dividend
  { interpretation.fix(value) } -> std::same_as<typename R::Value>;              // towards zero
  { interpretation.fup(value) } -> std::same_as<typename R::Value>;              // away from zero
  { interpretation.floor(value) } -> std::same_as<typename R::Value>;
  { interpretation.ceiling(value) } -> std::same_as<typename R::Value>;
  /// To the nearest multiple of a step above zero, halves away from zero.
  { interpretation.roundTo(value, decimal) } -> std::same_as<typename R::Value>;
  /// One argument: SIN .. EXP, ABS, SQRT, BIN, BCD.
  { interpretation.function(FunctionKind::Sin, value) } -> std::same_as<typename R::Value>;
  /// ATAN[y]/[x] in degrees, above -180 up to 180; POW.
  { interpretation.atan2(value, value) } -> std::same_as<typename R::Value>;
  { interpretation.power(value, value) } -> std::same_as<typename R::Value>;
  { interpretation.bitwise(OperatorKind::And, value, value) } -> std::same_as<typename R::Value>;
};

/// What a control does where no manual says so: always the same.
enum class ControlQuestion : std::uint8_t {
  DropsNegatedVacantWord, // whether `X-#1` counts as not written while #1 is vacant, as `X#1` does
};

template <typename R>
concept HasTruths = requires(R interpretation, const typename R::Value value, const typename R::Truth truth) {
  { interpretation.truth(true) } -> std::same_as<typename R::Truth>;
  { interpretation.compare(Relation::Equal, value, value) } -> std::same_as<typename R::Truth>;
  { interpretation.both(truth, truth) } -> std::same_as<typename R::Truth>;
  { interpretation.negation(truth) } -> std::same_as<typename R::Truth>;
  { interpretation.mayBe(truth) } -> std::same_as<bool>;
  /// Either of the two, undetermined.
  { interpretation.unknownTruth() } -> std::same_as<typename R::Truth>;
  { interpretation.answer(ControlQuestion{}) } -> std::same_as<typename R::Truth>;
  /// A setting of the machine that is not known.
  { interpretation.setting(SwitchId{}) } -> std::same_as<typename R::Truth>;
};

/// Modal codes of one group.
template <typename R>
concept HasModalCodes = requires(R interpretation, const typename R::Value value, const typename R::Truth truth,
                                 const typename R::ModalCode code, const ModalTable &modes) {
  { interpretation.code(std::uint8_t{}) } -> std::same_as<typename R::ModalCode>;
  { interpretation.unknownCode() } -> std::same_as<typename R::ModalCode>;
  { interpretation.isOneOf(code, CodeMask{}) } -> std::same_as<typename R::Truth>;
  /// The index of the code when it can be only one.
  { interpretation.onlyCode(code) } -> std::same_as<std::optional<std::uint8_t>>;
  { interpretation.selectCode(truth, code, code) } -> std::same_as<typename R::ModalCode>;
  /// One code for certain, whichever it is: two equal sets of codes need not be.
  { interpretation.isSameCode(code, code) } -> std::same_as<bool>;
  /// The number of the code as #4001 reads it (54.1); of group `std::uint8_t`.
  { interpretation.numberOfCode(code, modes, std::uint8_t{}) } -> std::same_as<typename R::Value>;
  /// The group and the code that a number names, when it may be several numbers; absent when they are of no one group.
  {
    interpretation.codeFrom(value, modes)
    } -> std::same_as<std::optional<std::pair<std::uint8_t, typename R::ModalCode>>>;
};

template <typename R>
concept HasVariables = requires(R interpretation, const typename R::Value value, const typename R::Truth truth,
                                MachineState<R> &state, std::uint32_t variable, Span place) {
  /// What a variable holds that no write of this run has reached.
  { interpretation.unwritten(state, variable) } -> std::same_as<typename R::Value>;
  /// A cell that may change between two reads: an input, a clock.
  { interpretation.volatileRead(variable) } -> std::same_as<typename R::Value>;
  /// Of inputs of the machine, as bits: a whole number from `least` to `most`.
  { interpretation.signalRead(variable, double(), double()) } -> std::same_as<typename R::Value>;
  /// Whether reads of the variable are given from outside, where nobody else says what it holds.
  { interpretation.isReadFromOutside(variable) } -> std::same_as<typename R::Truth>;
  /// A cell of the control that nothing here keeps up with: any number.
  { interpretation.notFollowed(variable) } -> std::same_as<typename R::Value>;
  /// A variable whose number is not one constant.
  { interpretation.readAnyOf(state, value, place) } -> std::same_as<typename R::Value>;
  /// Whether a zero point may have been written: then it has moved by a distance that is not known.
  { interpretation.writeAnyOf(state, value, value, place) } -> std::same_as<bool>;
  /// Nothing is known any more of the variables of a range of numbers.
  interpretation.havocVariables(state, variable, variable);
  /// Two states into the first: `second` where the truth holds, else the first.
  interpretation.join(state, truth, state);
};

/// A block with a G code that the control's manual does not have.
inline constexpr std::string_view kUnlistedCode = "a G code that the control does not have";

/// What happens in a step, reported to the interpretation.
template <typename R>
concept HearsEffects = requires(R interpretation, const typename R::Value value, const typename R::Truth truth,
                                typename R::Value &result, MachineState<R> &state, ExpressionId expression,
                                const Expression &expressionNode, Span place, const Move<typename R::Value> &move) {
  /// The control stops when `truth` holds; the run goes on in the other cases.
  interpretation.alarm(truth, AlarmReport{});
  /// `#3000=`: stops always.
  interpretation.userAlarm(value, place);
  /// Whether moves are reported at all; an interpretation that ignores them saves the work.
  { interpretation.wantsMoves() } -> std::same_as<bool>;
  interpretation.move(move);
  /// A construct is unmodelled; what it may have changed has been havocked.
  interpretation.unmodelled(std::string_view(), place);
  /// Anything may have happened to the whole state.
  interpretation.havoc(state, std::string_view(), place);
  /// A G code that the control does not have by its manual: the control stops, or it is a macro that the control has.
  interpretation.unlistedCode(state, CodeName{}, place);
  /// From here on nothing that the text says need hold, nor did it perhaps before: no claim on the program is made.
  interpretation.abandon(std::string_view(), place);
  /// While what it returns lives, operations are those of an expression of the program; elsewhere they are the geometry
  /// of its blocks, for which controls do not use the numbers of their variables.
  interpretation.inExpression();
  /// A number of the geometry, such as a position, as an expression finds it.
  { interpretation.asHeld(value) } -> std::same_as<typename R::Value>;
  /// What the control keeps of the result of an expression: the number that its arithmetic has for it.
  interpretation.hold(result, expressionNode);
  /// Likewise of a sum or difference: how far it is rounded depends on the operands.
  interpretation.holdSum(result, OperatorKind::Add, value, value);
  /// An expression has been evaluated.
  interpretation.evaluated(expression, value);
};

template <typename R>
concept ValueAlgebra =
    HasValues<R> && HasArithmetic<R> && HasTruths<R> && HasModalCodes<R> && HasVariables<R> && HearsEffects<R>;

} // namespace feedhold
