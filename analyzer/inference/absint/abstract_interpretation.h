// AbstractInterpretation: programs read with all the values that are possible at once.
//
// Values are AbstractValue.  Each carries the symbol that it is a copy of, or at a known distance from: that is how the
// analysis knows that `#10 = #1 + 17` stays true around a loop.  A condition that may hold and may not is Maybe; the
// semantics then joins both sides.
#pragma once

#include "inference/absint/evaluation_memo.h"
#include "inference/absint/operation_memo.h"
#include "inference/domain/code_set.h"
#include "inference/domain/value.h"
#include "meaning/semantics/step.h"

#include <string_view>
#include <variant>

namespace feedhold {

class AbstractInterpretation;
using AbstractState = MachineState<AbstractInterpretation>;

/// Symbols: what was there at the entry of the analysed program, and values that were fixed later.
inline constexpr std::uint32_t kZeroSymbol = 0;                                       // constants are distances from it
constexpr std::uint32_t symbolOfVariable(std::uint32_t variable) { return variable; } // #0 is no variable
inline constexpr std::uint32_t kPositionSymbols = 0x90000000;
constexpr std::uint32_t symbolOfPosition(std::size_t axis) {
  return kPositionSymbols + static_cast<std::uint32_t>(axis);
}
inline constexpr std::uint32_t kModalSymbols = 0x90000100;
inline constexpr std::uint32_t kWordSymbols = 0x90000200;
inline constexpr std::uint32_t kFirstFreshSymbol = 0x90001000;
constexpr bool isEntrySymbol(std::uint32_t symbol) { return symbol < kFirstFreshSymbol; }

/// Told of what happens in the steps of an analysis, when it has come to its end.
class StepObserver {
public:
  virtual ~StepObserver() = default;
  virtual void alarm(Truth, const AlarmReport &) {}
  virtual void userAlarm(const AbstractValue &, Span) {}
  virtual void move(MoveKind) {}
  virtual void unmodelled(std::string_view, Span) {}
  virtual void evaluated(ExpressionId, const AbstractValue &) {}
};

class AbstractInterpretation {
public:
  using Value = AbstractValue;
  using Truth = feedhold::Truth;
  using ModalCode = CodeSet;
  using State = AbstractState;

  explicit AbstractInterpretation(const Dialect &dialect) { useDialect(dialect); }

  // ---- for the engine ----
  void useDialect(const Dialect &dialect) {
    dialect_ = &dialect;
    mayHaveMantissa32_ = numbersOf(dialect) != NumberModel::Binary64;
  }
  /// Results may be rounded to mantissas of 32 bits.
  bool mayHaveMantissa32() const { return mayHaveMantissa32_; }
  /// The mode of polar coordinates is taken to be left as it is by what is not followed.
  void keepPolar(std::optional<std::uint8_t> group) { polarGroup_ = group; }
  void observe(StepObserver *observer) { observer_ = observer; }
  StepObserver *observer() const { return observer_; }
  /// Every run has stopped in the step: nothing goes on from here.
  bool stopped() const { return stopped_; }
  void start() { stopped_ = mayHaveDividedByZero_ = false; }
  /// A divisor of the step may have been zero: in the runs that went on it was not.
  bool mayHaveDividedByZero() const { return mayHaveDividedByZero_; }
  /// A symbol of which nothing is known yet but that it is one value.
  std::uint32_t freshSymbol() { return nextSymbol_++; }
  Value withSymbol(Value value);

  // ---- values ----
  Value literal(Decimal value) const;
  Value number(double value) const;
  Value vacant() const { return AbstractValue::vacant(); }
  Value anything() const { return AbstractValue::any(); }
  Value anyNumber() const { return AbstractValue::anyNumber(); }
  Value asNumber(const Value &value) const;
  Truth isVacant(const Value &value) const { return truthOfOutcomes(value.mayBeVacant(), value.mayBeNumber()); }
  std::optional<double> constantOf(const Value &value) const;
  bool isFixed(const Value &value) const { return constantOf(value).has_value(); }
  Value select(Truth truth, const Value &first, const Value &second) const;
  Value either(const Value &first, const Value &second) const;

  // ---- arithmetic ----
  Value add(const Value &a, const Value &b) const;
  Value subtract(const Value &a, const Value &b) const;
  Value multiply(const Value &a, const Value &b) const;
  Value divide(const Value &a, const Value &b) const;
  Value negate(const Value &a) const;
  Value remainder(const Value &a, const Value &b) const;
  Value fix(const Value &a) const;
  Value fup(const Value &a) const;
  Value floor(const Value &a) const;
  Value ceiling(const Value &a) const;
  Value roundTo(const Value &value, Decimal step) const;
  Value function(FunctionKind kind, const Value &argument) const;
  Value atan2(const Value &y, const Value &x) const;
  Value power(const Value &base, const Value &exponent) const;
  Value bitwise(OperatorKind op, const Value &a, const Value &b) const;

  // ---- truths ----
  Truth truth(bool value) const { return truthOf(value); }
  Truth compare(Relation relation, const Value &a, const Value &b) const;
  Truth both(Truth a, Truth b) const { return conjunction(a, b); }
  Truth negation(Truth a) const { return feedhold::negate(a); }
  bool mayBe(Truth a) const { return mayBeTrue(a); }
  Truth unknownTruth() const { return Truth::Maybe; }
  Truth setting(SwitchId) const { return Truth::Maybe; }
  Truth answer(ControlQuestion) const { return Truth::Maybe; }

  // ---- modal codes ----
  ModalCode code(std::uint8_t index) const { return CodeSet::of(index); }
  ModalCode unknownCode() const;
  Truth isOneOf(ModalCode code, CodeMask mask) const;
  std::optional<std::uint8_t> onlyCode(ModalCode code) const;
  ModalCode selectCode(Truth truth, ModalCode first, ModalCode second) const;
  bool isSameCode(ModalCode a, ModalCode b) const { return onlyCode(a) && onlyCode(a) == onlyCode(b); }
  Value numberOfCode(ModalCode code, const ModalTable &modes, std::uint8_t group) const;
  std::optional<std::pair<std::uint8_t, ModalCode>> codeFrom(const Value &value, const ModalTable &modes) const;

  // ---- variables ----
  Value unwritten(const State &state, std::uint32_t variable) const;
  Value volatileRead(std::uint32_t) { return AbstractValue::anyNumber(); }
  Value signalRead(std::uint32_t, double least, double most) {
    return AbstractValue::number(AbstractNumber::integersIn({least, most}));
  }
  Truth isReadFromOutside(std::uint32_t) const { return Truth::Maybe; }
  Value notFollowed(std::uint32_t) const { return AbstractValue::anyNumber(); }
  Value readAnyOf(State &state, const Value &index, Span place);
  bool writeAnyOf(State &state, const Value &index, const Value &value, Span place);
  void havocVariables(State &state, std::uint32_t first, std::uint32_t last);
  Value between(const Value &start, const Value &end) const;
  void beginSkip() const {}
  Value endOfSkip(const Value &start, const Value &end) const { return between(start, end); }
  void join(State &state, Truth truth, const State &second);

  // ---- what happens ----
  /// A word that always stops the control is a finding of its own; rules judge the rest of the program as if it were
  /// corrected.  Sound: more is reached than in any run.
  static constexpr bool kGoesOnBehindMistakes = true;
  void alarm(Truth truth, const AlarmReport &report);
  void userAlarm(const Value &number, Span place);
  bool wantsMoves() const { return observer_ != nullptr; }
  /// Observers ask how a block moves; where it starts and ends is in the states.
  static constexpr bool kAsksForKindsAlone = true;
  void move(const Move<Value> &move);
  void unmodelled(std::string_view reason, Span place);
  void unlistedCode(State &state, const CodeName &code, Span place);
  void havoc(State &state, std::string_view reason, Span place);
  void abandon(std::string_view reason, Span) { abandoned_ = reason; }
  /// Why nothing is told of the program.
  std::optional<std::string_view> abandoned() const { return abandoned_; }
  std::monostate inExpression() const { return {}; }       // geometry has the same operations
  Value asHeld(const Value &value) const { return value; } // hold() comes next
  void hold(Value &result, const Expression &expression) const {
    if (mayHaveMantissa32_)
      holdInMantissa32(result, expression);
  }
  void holdSum(Value &sum, OperatorKind op, const Value &left, const Value &right) const {
    if (mayHaveMantissa32_)
      holdSumInMantissa32(sum, op, left, right);
  }
  void evaluated(ExpressionId expression, const Value &value) {
    if (observer_)
      observer_->evaluated(expression, value);
  }

  /// The value of an assignment when it was carried out before, and its variables held the same; else absent.
  std::optional<Value> recalled(const ProgramFile &file, const State &state, ExpressionId expression);
  /// Of the one that recalled() has not known just now.
  void remember(const ProgramFile &file, ExpressionId expression, const Value &value);

private:
  enum class Use : std::uint8_t { Read, Write };
  Value ofOne(NumberOperation operation, const Value &a, AbstractNumber (*compute)(const AbstractNumber &)) const;
  void holdInMantissa32(Value &result, const Expression &expression) const;
  void holdSumInMantissa32(Value &sum, OperatorKind op, const Value &left, const Value &right) const;
  void alarmsOfAnyOf(const Value &index, Use use, const Value &value, Span place);

  const Dialect *dialect_ = nullptr;
  bool mayHaveMantissa32_ = false;
  StepObserver *observer_ = nullptr;
  std::optional<std::uint8_t> polarGroup_;
  std::uint32_t nextSymbol_ = kFirstFreshSymbol;
  std::optional<std::string_view> abandoned_;
  bool stopped_ = false;
  bool mayHaveDividedByZero_ = false;
  mutable OperationMemo memo_;
  EvaluationMemo evaluations_;
};

} // namespace feedhold
