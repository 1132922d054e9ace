// ValueAlgebra: what a reading of programs must offer, so that the meaning of an instruction is written once.
//
// A reading says what a value is (a number of a run; all numbers that are possible; a term of a solver) and receives
// what happens (alarms, moves).  The semantics never asks a value for its bits: it branches through the reading, which
// may take one side, or both and join them.
#pragma once

#include "language/dialect/dialect.h"
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
concept HasValues = requires(R reading, const typename R::Value value, const typename R::Truth truth, Decimal decimal,
                             double number) {
  { reading.literal(decimal) } -> std::same_as<typename R::Value>;
  { reading.number(number) } -> std::same_as<typename R::Value>;
  { reading.vacant() } -> std::same_as<typename R::Value>;
  /// Any value at all, vacant included; any number.
  { reading.anything() } -> std::same_as<typename R::Value>;
  { reading.anyNumber() } -> std::same_as<typename R::Value>;
  /// A vacant value as 0.
  { reading.asNumber(value) } -> std::same_as<typename R::Value>;
  { reading.isVacant(value) } -> std::same_as<typename R::Truth>;
  /// The number that it must be; absent when it may be several, or vacant.
  { reading.constantOf(value) } -> std::same_as<std::optional<double>>;
  { reading.select(truth, value, value) } -> std::same_as<typename R::Value>;
  /// The control's settings are not known: one of the two.
  { reading.either(value, value) } -> std::same_as<typename R::Value>;
  /// The place between two values where a signal stops a movement.
  { reading.between(value, value) } -> std::same_as<typename R::Value>;
};

/// Of numbers; divisors are not zero, arguments lie in the domain: the semantics has seen to it.
template <typename R>
concept HasArithmetic = requires(R reading, const typename R::Value value, Decimal decimal) {
  { reading.add(value, value) } -> std::same_as<typename R::Value>;
  { reading.subtract(value, value) } -> std::same_as<typename R::Value>;
  { reading.multiply(value, value) } -> std::same_as<typename R::Value>;
  { reading.divide(value, value) } -> std::same_as<typename R::Value>;
  { reading.negate(value) } -> std::same_as<typename R::Value>;
  { reading.remainder(value, value) } -> std::same_as<typename R::Value>; // sign of the dividend
  { reading.fix(value) } -> std::same_as<typename R::Value>;              // towards zero
  { reading.fup(value) } -> std::same_as<typename R::Value>;              // away from zero
  { reading.floor(value) } -> std::same_as<typename R::Value>;
  { reading.ceiling(value) } -> std::same_as<typename R::Value>;
  /// To the nearest multiple of a step above zero, halves away from zero.
  { reading.roundTo(value, decimal) } -> std::same_as<typename R::Value>;
  /// One argument: SIN .. EXP, ABS, SQRT, BIN, BCD.
  { reading.function(FunctionKind::Sin, value) } -> std::same_as<typename R::Value>;
  /// ATAN[y]/[x] in degrees, above -180 up to 180; POW.
  { reading.atan2(value, value) } -> std::same_as<typename R::Value>;
  { reading.power(value, value) } -> std::same_as<typename R::Value>;
  { reading.bitwise(OperatorKind::And, value, value) } -> std::same_as<typename R::Value>;
};

template <typename R>
concept HasTruths = requires(R reading, const typename R::Value value, const typename R::Truth truth) {
  { reading.truth(true) } -> std::same_as<typename R::Truth>;
  { reading.compare(Relation::Equal, value, value) } -> std::same_as<typename R::Truth>;
  { reading.both(truth, truth) } -> std::same_as<typename R::Truth>;
  { reading.negation(truth) } -> std::same_as<typename R::Truth>;
  { reading.mayBe(truth) } -> std::same_as<bool>;
  /// Either of the two, undetermined.
  { reading.unknownTruth() } -> std::same_as<typename R::Truth>;
};

/// Modal codes of one group.
template <typename R>
concept HasModalCodes = requires(R reading, const typename R::Value value, const typename R::Truth truth,
                                 const typename R::ModalCode code, const ModalTable &modes) {
  { reading.code(std::uint8_t{}) } -> std::same_as<typename R::ModalCode>;
  { reading.unknownCode() } -> std::same_as<typename R::ModalCode>;
  { reading.isOneOf(code, CodeMask{}) } -> std::same_as<typename R::Truth>;
  /// The index of the code when it can be only one.
  { reading.onlyCode(code) } -> std::same_as<std::optional<std::uint8_t>>;
  { reading.selectCode(truth, code, code) } -> std::same_as<typename R::ModalCode>;
  /// The number of the code as #4001 reads it (54.1); of group `std::uint8_t`.
  { reading.numberOfCode(code, modes, std::uint8_t{}) } -> std::same_as<typename R::Value>;
  /// The group and the code that a number names, when it may be several numbers; absent when they are of no one group.
  { reading.codeFrom(value, modes) } -> std::same_as<std::optional<std::pair<std::uint8_t, typename R::ModalCode>>>;
};

template <typename R>
concept HasVariables = requires(R reading, const typename R::Value value, const typename R::Truth truth,
                                MachineState<R> &state, std::uint32_t variable, Span place) {
  /// What a variable holds that no write of this run has reached.
  { reading.unwritten(state, variable) } -> std::same_as<typename R::Value>;
  /// A cell that may change between two reads: an input, a clock.
  { reading.volatileRead(variable) } -> std::same_as<typename R::Value>;
  /// The tool length of an offset number, with its sign left out of account where it is not known.
  { reading.toolLength(state, value) } -> std::same_as<typename R::Value>;
  /// A variable whose number is not one constant.
  { reading.readAnyOf(state, value, place) } -> std::same_as<typename R::Value>;
  /// Whether a zero point may have been written: then it has moved by a distance that is not known.
  { reading.writeAnyOf(state, value, value, place) } -> std::same_as<bool>;
  /// Nothing is known any more of the variables of a range of numbers.
  reading.forgetVariables(state, variable, variable);
  /// Two states into the first: `second` where the truth holds, else the first.
  reading.join(state, truth, state);
};

/// What happens in a step, told to the reading.
template <typename R>
concept HearsEffects = requires(R reading, const typename R::Value value, const typename R::Truth truth,
                                MachineState<R> &state, ExpressionId expression, Span place,
                                const Move<typename R::Value> &move) {
  /// The control stops when `truth` holds; the run goes on in the other cases.
  reading.alarm(truth, AlarmReport{});
  /// `#3000=`: stops always.
  reading.userAlarm(value, place);
  /// Whether moves are to be told at all; a reading that does not listen saves the work.
  { reading.wantsMoves() } -> std::same_as<bool>;
  reading.move(move);
  /// Something is not modelled; what it may have changed has been made unknown.
  reading.notModelled(std::string_view(), place);
  /// Anything may have happened to the whole state.
  reading.havoc(state, std::string_view(), place);
  /// From here on nothing that the text says need hold, nor did it perhaps before: no claim on the program is made.
  reading.abandon(std::string_view(), place);
  /// An expression has been evaluated.
  reading.evaluated(expression, value);
};

template <typename R>
concept ValueAlgebra =
    HasValues<R> && HasArithmetic<R> && HasTruths<R> && HasModalCodes<R> && HasVariables<R> && HearsEffects<R>;

} // namespace feedhold
