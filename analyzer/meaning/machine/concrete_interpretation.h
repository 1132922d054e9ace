// ConcreteInterpretation: programs read with the numbers of one run.
//
// Coordinates are doubles.  Expressions are computed in doubles, and each result is rounded to the numbers of the
// control where these are others.  Comparisons take the sign of a rounded difference (16i operator's manual), which is
// the sign of the exact one: rounding to the nearest number makes no difference 0.
#pragma once

#include "meaning/semantics/step.h"

#include <compare>
#include <functional>
#include <span>
#include <string>
#include <variant>
#include <vector>

namespace feedhold {

struct ConcreteValue {
  bool vacant = true;
  double number = 0;
  static ConcreteValue of(double number) { return {false, number}; }
  friend bool operator==(const ConcreteValue &, const ConcreteValue &) = default;
};

/// What the reads of an input give, in order; the last number stays.  None is empty.
using InputReadings = VariableMap<std::vector<double>>;

/// The words in force that a run can be given at its start.
inline constexpr std::string_view kGivenWords = "FSTDH";

/// What a run finds in force in place of what power-on or a contract says; nothing else is listed.
struct GivenStart {
  std::vector<std::pair<std::uint8_t, std::uint8_t>> codes = {}; // group, and index in it; sorted
  std::vector<std::pair<char, double>> words = {};               // of kGivenWords
  std::vector<std::pair<Axis, double>> place = {};               // in their order
  std::vector<std::pair<SwitchId, bool>> settings = {};          // of the machine, where they are not known; sorted
  bool isEmpty() const { return codes.empty() && words.empty() && place.empty() && settings.empty(); }
  friend std::partial_ordering operator<=>(const GivenStart &, const GivenStart &) = default;
};

/// What a run starts from and what it reads from outside: by number; others are vacant, or 0 for cells of the control.
struct GivenVariables : VariableMap<ConcreteValue> {
  InputReadings readings = {};
  GivenStart start = {};
  friend bool operator==(const GivenVariables &, const GivenVariables &) = default;
};

/// What one read of an input gives; asked at each.
using InputSource = std::function<double(std::uint32_t variable)>;

/// Something that was not followed, and where.
struct MachineNote {
  std::string_view reason;
  BlockId block;
};

/// Words are rounded to the least increment, as a control does; or taken as they are written.
enum class WordRounding : std::uint8_t { Increment, None };

class ConcreteInterpretation {
public:
  using Value = ConcreteValue;
  using Truth = bool;
  /// Index in the group; kNoCode: none is known to be in force.
  using ModalCode = std::uint8_t;
  static constexpr ModalCode kNoCode = 0xff;
  using State = MachineState<ConcreteInterpretation>;

  ConcreteInterpretation(const Dialect &dialect, const GivenVariables &given,
                         WordRounding rounding = WordRounding::Increment, NumberModel numbers = NumberModel::Binary64)
      : dialect_(&dialect), given_(byCell(dialect, given, numbers)), rounding_(rounding), numbers_(numbers) {}

  /// Codes that the control's manual does not have are macros that return and change nothing; else they stop the run.
  void takeCodesToReturn(bool doThey) { takesCodesToReturn_ = doThey; }
  /// Their names, since the last call.
  std::vector<std::string> takeSkipped() { return std::exchange(skipped_, {}); }
  /// In place of the readings that are given.
  void readInputsFrom(InputSource source) { source_ = std::move(source); }

  // ---- what happened, for the machine ----
  enum class Stop : std::uint8_t { None, ControlAlarm, UserAlarm };
  struct Stopped {
    Stop kind = Stop::None;
    AlarmKind alarm{};
    double number = 0; // of `#3000=`
    Span place;
    explicit operator bool() const { return kind != Stop::None; }
  };
  const Stopped &stopped() const { return stopped_; }
  std::vector<Move<Value>> takeMoves() { return std::exchange(moves_, {}); }
  std::vector<std::string_view> takeNotes() { return std::exchange(notes_, {}); }
  /// What may change anything has been taken to change nothing.
  bool passedUnmodelled() const { return passedUnmodelled_; }
  /// An input or a clock has been read since the last call.
  bool takeVolatileReads() { return std::exchange(sawVolatile_, false); }

  // ---- values ----
  Value literal(Decimal value) const { return Value::of(value.toDouble()); }
  Value number(double value) const { return Value::of(value); }
  Value vacant() const { return {}; }
  Value anything() const { return Value::of(0); }
  Value anyNumber() const { return Value::of(0); }
  Value asNumber(const Value &value) const { return Value::of(value.vacant ? 0 : value.number); }
  bool isVacant(const Value &value) const { return value.vacant; }
  std::optional<double> constantOf(const Value &value) const;
  bool isFixed(const Value &) const { return true; }
  Value select(bool truth, const Value &first, const Value &second) const { return truth ? first : second; }
  Value either(const Value &first, const Value &) const { return first; }

  // ---- arithmetic ----
  Value add(const Value &a, const Value &b) const { return Value::of(a.number + b.number); }
  Value subtract(const Value &a, const Value &b) const { return Value::of(a.number - b.number); }
  Value multiply(const Value &a, const Value &b) const { return Value::of(a.number * b.number); }
  Value divide(const Value &a, const Value &b) const { return Value::of(b.number == 0 ? 0 : a.number / b.number); }
  Value negate(const Value &a) const { return Value::of(-a.number); }
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
  bool truth(bool value) const { return value; }
  bool compare(Relation relation, const Value &a, const Value &b) const;
  bool both(bool a, bool b) const { return a && b; }
  bool negation(bool a) const { return !a; }
  bool mayBe(bool a) const { return a; }
  bool unknownTruth() const { return true; }
  bool answer(ControlQuestion) const { return true; }
  bool setting(SwitchId id) const;

  // ---- modal codes ----
  ModalCode code(std::uint8_t index) const { return index; }
  ModalCode unknownCode() const { return kNoCode; }
  bool isOneOf(ModalCode code, CodeMask mask) const { return code < 64 && ((mask >> code) & 1U) != 0; }
  std::optional<std::uint8_t> onlyCode(ModalCode code) const {
    return code == kNoCode ? std::nullopt : std::optional(code);
  }
  ModalCode selectCode(bool truth, ModalCode first, ModalCode second) const { return truth ? first : second; }
  bool isSameCode(ModalCode a, ModalCode b) const { return a == b; }
  Value numberOfCode(ModalCode code, const ModalTable &modes, std::uint8_t group);
  std::optional<std::pair<std::uint8_t, ModalCode>> codeFrom(const Value &, const ModalTable &) const {
    return std::nullopt; // a number is one number here
  }

  // ---- variables ----
  Value unwritten(const State &, std::uint32_t variable) const { return given(variable); }
  Value given(std::uint32_t variable) const;
  std::span<const GivenVariables::Entry> allGiven() const { return given_.entries(); }
  bool isLocal(std::uint32_t variable) const;
  Value volatileRead(std::uint32_t variable);
  /// What is given beyond the ends is the nearer one.
  Value signalRead(std::uint32_t variable, double least, double most) {
    return Value::of(std::clamp(std::round(volatileRead(variable).number), least, most));
  }
  bool isReadFromOutside(std::uint32_t variable) const { return source_ || given_.readings.find(variable); }
  /// What is given, or 0: one of many things that may be there.
  Value notFollowed(std::uint32_t variable);
  Value readAnyOf(State &, const Value &, Span) const { return {}; }                   // the index is always one number
  bool writeAnyOf(State &, const Value &, const Value &, Span) const { return false; } // likewise
  void havocVariables(State &, std::uint32_t, std::uint32_t) const {} // they keep what they hold: a note says so
  Value between(const Value &, const Value &end) const { return end; }
  void beginSkip();
  Value endOfSkip(const Value &start, const Value &end) const {
    return skipShare_ == 1 ? end : Value::of(start.number + skipShare_ * (end.number - start.number));
  }
  /// Of the run.
  std::uint64_t skips() const { return skips_; }
  void join(State &state, bool truth, const State &second) const {
    if (truth)
      state = second;
  }

  // ---- what happens ----
  void alarm(bool truth, AlarmReport report);
  void userAlarm(const Value &number, Span place);
  bool wantsMoves() const { return true; }
  void move(const Move<Value> &move);
  void unmodelled(std::string_view reason, Span) { notes_.push_back(reason); }
  /// The axes may be anywhere: what the state says of them is one of many places.
  void losePosition() { lostAxes_ = stopped_.kind == Stop::None ? kAllAxesLost : lostAxes_; }
  /// A coordinate brings the axis to a place that is known.
  void placeAxis(Axis axis) { lostAxes_ &= static_cast<std::uint16_t>(~(1U << indexOf(axis))); }
  bool isLost() const { return (lostAxes_ & 7U) != 0; } // X, Y or Z
  /// A position is taken for a number: what follows from it is one of many things.
  void readPosition(Axis axis) {
    if ((lostAxes_ & (1U << indexOf(axis))) == 0)
      return;
    notes_.push_back("a position that is not known");
    passedUnmodelled_ = passedUnmodelled_ || stopped_.kind == Stop::None;
  }
  void havoc(State &, std::string_view reason, Span) {
    notes_.push_back(reason);
    passedUnmodelled_ = passedUnmodelled_ || !stopped_;
  }
  /// Controls read the block differently: the run goes on with one reading, and shows nothing of the others.
  void passOpenReading(std::string_view reason) {
    notes_.push_back(reason);
    passedUnmodelled_ = passedUnmodelled_ || stopped_.kind == Stop::None;
  }
  void unlistedCode(State &, const CodeName &code, Span place) {
    if (takesCodesToReturn_)
      skipped_.push_back(textOf(code));
    else
      alarm(true, {AlarmKind::GCodeNotUsable, place});
  }
  void abandon(std::string_view reason, Span) { notes_.push_back(reason); }
  std::monostate inExpression() const { return {}; }       // geometry has the same operations
  Value asHeld(const Value &value) const { return value; } // hold() comes next
  void hold(Value &result, const Expression &expression) {
    if (numbers_ == NumberModel::Mantissa32)
      holdInMantissa32(result, expression.span);
  }
  void holdSum(Value &, OperatorKind, const Value &, const Value &) const {}
  void evaluated(ExpressionId, const Value &) const {}

private:
  /// Under the one number of each cell.
  static GivenVariables byCell(const Dialect &dialect, const GivenVariables &given, NumberModel numbers);
  void holdInMantissa32(Value &result, Span place);

  const Dialect *dialect_;
  GivenVariables given_;
  InputSource source_;             // empty: the readings that are given
  VariableMap<std::size_t> reads_; // so many of each input
  WordRounding rounding_;
  NumberModel numbers_;
  Stopped stopped_;
  std::vector<Move<Value>> moves_;
  std::vector<std::string_view> notes_;
  bool sawVolatile_ = false;
  double skipShare_ = 1; // of the skip move that is made
  std::uint64_t skips_ = 0;
  bool passedUnmodelled_ = false;
  static constexpr std::uint16_t kAllAxesLost = (1U << kAxisCount) - 1;
  std::uint16_t lostAxes_ = 0;
  bool takesCodesToReturn_ = false;
  std::vector<std::string> skipped_;
};

/// The state in which a run starts: power-on codes, all variables as given, the tool at `start`.
MachineState<ConcreteInterpretation> startState(const ConcreteInterpretation &interpretation, const ModalTable &modes,
                                                const std::array<double, kAxisCount> &start);
void putInForce(const GivenStart &start, MachineState<ConcreteInterpretation> &state);

} // namespace feedhold
