// SymbolicInterpretation: the semantics over solver terms: a value is a term over the state at the start of the run.
//
// A value is a pair: whether it is vacant, and its number, which is 0 wherever it is vacant; so a vacant value counts
// as 0 in arithmetic without a case of its own.  What is not known is a fresh variable.
//
// In the arithmetic of the control, results are rounded: `nearest(t)` is the double that is nearest to the exact result
// t, and `near(t, h)` a number that is at most h away from it (a word that is rounded to the least increment, a sine).
// Where t is a double for certain, it stands for itself.  docs/arithmetic.md
#pragma once

#include "meaning/semantics/parts.h"
#include "meaning/semantics/step.h"
#include "proof/smt/ground_truth.h"
#include "proof/smt/term.h"
#include "proof/symbolic/grids.h"
#include "proof/symbolic/increments.h"
#include "proof/symbolic/region_memory.h"

#include <functional>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace feedhold::prove {

struct Condition {
  smt::TermId term{0};
  friend bool operator==(const Condition &, const Condition &) = default;
};
/// The index of a code in its group, a number of sort Int.
struct SymbolicCode {
  smt::TermId index{0};
  friend bool operator==(const SymbolicCode &, const SymbolicCode &) = default;
};

/// Exact reals, as in mathematics; or doubles, of which each operation gives the nearest to its exact result.
enum class Arithmetic : std::uint8_t { Exact, Doubles };

/// How the names of variables begin that stand for what is not known of a control.
inline constexpr std::string_view kUnknownTruth = "either";
inline constexpr std::string_view kUnknownSetting = "setting ";
/// And of those that stand for a setting of the machine: one for each time that it is asked, since controls may take
/// two things differently that one setting names.
std::string nameOfSetting(SwitchId id);

/// What a contract says of an input; nothing without a clause.
struct WrittenInput {
  bool isWhole = false;
  bool hasLow = false; // a least number
  bool hasHigh = false;
  std::optional<smt::Number> step = {}; // it is a multiple of
};

class SymbolicInterpretation;
using SymbolicState = MachineState<SymbolicInterpretation>;

/// No system variable is vacant, and nothing is typed into one.
bool isSystemVariable(const Dialect &dialect, std::uint32_t variable);

/// One read of an input by the program, which may give any number.
struct InputRead {
  std::optional<Place> place; // of the instruction; absent: of no single one
  std::uint32_t variable;
  smt::TermId number;
};

/// Something that stops the run where the condition holds.
struct PossibleStop {
  Condition when;
  std::optional<AlarmKind> alarm; // absent: `#3000=`
  SymbolicValue number;           // of `#3000=`
  Span place;
};

/// What holds on the present path; the explorer knows it.
class PathKnowledge {
public:
  virtual ~PathKnowledge() = default;
  /// By a look at the conditions of the path.
  virtual bool says(smt::TermId condition) const = 0;
  /// By a proof, which costs more.
  virtual bool proves(smt::TermId condition) = 0;
  /// The index at the place is in the range that is told for it.  Taken for granted while invariants are looked for,
  /// and proved on every recorded path.
  virtual bool mayRelyOn(IndexPlace index, smt::TermId condition) = 0;
};

class SymbolicInterpretation {
public:
  using Value = SymbolicValue;
  using Truth = Condition;
  using ModalCode = SymbolicCode;
  using State = SymbolicState;

  SymbolicInterpretation(smt::TermStore &store, const Dialect &dialect, Arithmetic arithmetic = Arithmetic::Exact)
      : store_(store), dialect_(&dialect), arithmetic_(arithmetic), grids_(store), increments_(store),
        groundTruth_(store) {}

  // ---- for the explorer ----
  void useDialect(const Dialect &dialect) { dialect_ = &dialect; }
  const Dialect &dialect() const { return *dialect_; }
  void usePath(PathKnowledge *path) { path_ = path; }
  /// Unmodelled code is assumed to leave the mode of polar coordinates unchanged.
  void keepPolar(std::optional<std::uint8_t> group) { polarGroup_ = group; }
  smt::TermStore &store() { return store_; }
  Arithmetic arithmetic() const { return arithmetic_; }
  /// How results are rounded: not at all, as doubles (geometry, as `run` computes it), or in the number model of the
  /// dialect (expressions of the program).
  enum class Rounds : std::uint8_t { No, AsDoubles, AsDialect };
  /// Exact arithmetic rounds nothing.  Returns what it was.
  Rounds roundResults(Rounds rounds) {
    return std::exchange(rounds_, arithmetic_ == Arithmetic::Exact ? Rounds::No : rounds);
  }
  /// The instruction that is executed, for roundAlways().
  void executeAt(Place place) { place_ = place; }
  /// The numbers of the instruction are not known to be so small that results are exact.
  void roundAlways(Place place) { rounded_.insert(place); }
  /// What was taken as small since the last call.
  std::vector<TakenAsSmall> takeExactResults() { return std::exchange(exact_, {}); }
  void restoreExactResults(std::vector<TakenAsSmall> results) { exact_ = std::move(results); }
  Grids &grids() { return grids_; }
  Increments &increments() { return increments_; }
  /// Whether what contracts say of the numbers of inputs is believed.  Returns what it was.
  bool believeInputs(bool believes) {
    increments_.believeInputs(believes);
    return grids_.believeInputs(believes);
  }
  /// What a program reads of a counter of increments: a number of the control, of which no manual says how it is
  /// computed from the counter.
  Value asRead(const Value &value);
  /// What a counter of increments holds of such a number: its multiple of a step, where it is known to be one.
  smt::TermId asCounted(smt::TermId number);
  /// What no text and no manual says comes out as in a run of the machine, in place of both ways; `settings`: those
  /// that are otherwise.
  void takeUsual(std::vector<std::pair<SwitchId, bool>> settings) {
    takesUsual_ = true;
    settings_ = std::move(settings);
  }
  /// Of the variables of the programs: named ones that every program sees.
  void useGlobalNames(std::function<bool(std::uint32_t)> isGlobalName) { isGlobalName_ = std::move(isGlobalName); }
  /// Equal: of numbers that are not whole, as near as this.  Returns what it was.
  std::optional<smt::TermId> useTolerance(std::optional<smt::TermId> tolerance) {
    return std::exchange(tolerance_, tolerance);
  }
  /// The variables have these values at the start of the run, and the others that programs own are vacant.
  void startFrom(std::map<std::uint32_t, Value> values) { given_ = std::move(values); }
  /// The reads of inputs give these in order, and then the last; those of others 0.  For single paths.
  void readInputs(std::map<std::uint32_t, std::vector<smt::TermId>> readings) { readings_ = std::move(readings); }
  /// The reads of inputs, in the order in which paths were followed.
  const std::vector<InputRead> &inputReads() const { return inputReads_; }
  /// Whether a clause of a contract is read, not the program.  Returns what it was.
  bool readContract(bool isContract) { return std::exchange(isContract_, isContract); }
  /// What is said of inputs.
  void assumeInputs(std::map<std::uint32_t, WrittenInput> written) { written_ = std::move(written); }
  /// What a proof assumes of the number that a variable of the programs holds at the start: that it can be typed.
  /// Whoever calls the program has to show it.  In exact arithmetic nothing is assumed.
  std::vector<smt::TermId> typedInput(std::uint32_t variable, const WrittenInput &written, smt::TermId number);
  /// What the contract has said of the variable: a multiple of it.
  std::optional<smt::Number> stepOf(std::uint32_t variable) const {
    const auto written = written_.find(variable);
    return written == written_.end() ? std::nullopt : written->second.step;
  }
  /// With what has been said of the inputs of the program itself.
  std::vector<smt::TermId> typedInput(std::uint32_t variable, smt::TermId number) {
    return typedInput(variable, written_[variable], number);
  }
  /// The number is that of the control that is nearest to a multiple of the step.
  smt::TermId isMultiple(smt::TermId number, const smt::Number &step);
  /// Where an index is thought to be.
  void suggestIndices(IndexRanges ranges) { indexRanges_ = std::move(ranges); }
  std::set<IndexPlace> suggestedIndices() const;
  /// What variables held at the start of the run that an index chose, by the index.
  const std::map<smt::TermId, Value> &startReads() const { return startReads_; }
  /// The changes that have led from one state to another, the last first.  Absent: they are not known.
  std::optional<std::vector<const RegionChange *>> changesBetween(const State &before, const State &after) const;
  /// The index chooses the variable.
  smt::TermId isCell(smt::TermId index, std::uint32_t variable) { return isAmong(index, {variable, variable}); }
  /// Begins a step.
  void start();
  /// Before the first step: an exploration that was given up in the middle of one has left what belongs to its place.
  void startOver();
  bool stopped() const { return stopped_; }
  /// What may have stopped the run in the step, in order.
  const std::vector<PossibleStop> &possibleStops() const { return possibleStops_; }
  /// Whether an axis may have moved in the step.
  bool moved() const { return moved_; }
  /// The movements of the step, in order.
  const std::vector<Move<Value>> &moves() const { return moves_; }
  std::vector<Move<Value>> takeMoves() { return std::exchange(moves_, {}); }
  /// A variable is written of which the state keeps nothing: it may hold anything at the next read.
  void writesUnkept(std::uint32_t variable) { unkeptWrites_.push_back(variable); }
  const std::vector<std::uint32_t> &unkeptWrites() const { return unkeptWrites_; }
  /// What an unlisted G code is: an alarm or anything; a macro that returns; one that changes nothing, too.
  enum class UnlistedCodes : std::uint8_t { DoAnything, Return, ChangeNothing };
  void treatUnlisted(UnlistedCodes codes) { unlistedCodes_ = codes; }
  /// The names of those that were taken to return, since the last call.
  std::vector<std::string> takeReturning() { return std::exchange(returning_, {}); }
  /// What was not modelled since the last call.
  std::vector<std::pair<std::string_view, Span>> takeNotes() { return std::exchange(notes_, {}); }
  /// Whether a formula was too large to keep since the last call.
  bool takeTooLarge() { return std::exchange(tooLarge_, false); }
  /// Facts about the variables that this interpretation has made.
  const std::vector<smt::TermId> &facts() const { return facts_; }
  /// A new variable; its name starts with `what`.
  smt::TermId fresh(std::string_view what, smt::Sort sort);
  /// A value with variables of its own, named after `name`: a number where `vacant` is false.
  enum class MayBeVacant : std::uint8_t { No, Yes };
  Value named(const std::string &name, MayBeVacant mayBeVacant);
  /// The same, of a number that no control need hold.
  Value numberNamed(const std::string &name, MayBeVacant mayBeVacant);
  /// The value that a variable has at the start of the run.
  Value atEntry(std::uint32_t variable);
  /// The variable of the solver stands for what was there at the start of the run.
  bool isFromEntry(smt::TermId variable) const { return entry_.contains(variable); }
  /// The variables of programs whose first value has been asked for, by number.
  const std::map<std::uint32_t, Value> &entryValues() const { return entryValues_; }

  // ---- values ----
  Value literal(Decimal value);
  Value number(double value);
  Value vacant();
  Value anything() { return freshValue(MayBeVacant::Yes); }
  Value anyNumber() { return freshValue(MayBeVacant::No); }
  Value notFollowed(std::uint32_t variable) {
    return isPredefinedName(variable) ? volatileRead(variable) : anyNumber();
  }
  Value asNumber(const Value &value) const { return {store_.no(), value.number}; }
  Truth isVacant(const Value &value) const { return {value.vacant}; }
  std::optional<double> constantOf(const Value &value) const;
  bool isFixed(const Value &value) const;
  Value select(Truth truth, const Value &first, const Value &second);
  Value either(const Value &first, const Value &second) {
    return takesUsual_ ? first : select(unknownTruth(), first, second);
  }
  Value between(const Value &start, const Value &end);
  void beginSkip();
  Value endOfSkip(const Value &start, const Value &end);

  // ---- arithmetic ----
  Value add(const Value &a, const Value &b);
  Value subtract(const Value &a, const Value &b);
  Value multiply(const Value &a, const Value &b);
  Value divide(const Value &a, const Value &b);
  Value negate(const Value &a);
  Value remainder(const Value &a, const Value &b);
  Value fix(const Value &a);
  Value fup(const Value &a);
  Value floor(const Value &a) { return of(store_.floor(a.number)); }
  Value ceiling(const Value &a) { return of(store_.ceiling(a.number)); }
  Value roundTo(const Value &value, Decimal step);
  Value function(FunctionKind kind, const Value &argument);
  Value atan2(const Value &y, const Value &x);
  Value power(const Value &base, const Value &exponent);
  Value bitwise(OperatorKind op, const Value &a, const Value &b);

  // ---- truths ----
  Truth truth(bool value) const { return {value ? store_.yes() : store_.no()}; }
  Truth compare(Relation relation, const Value &a, const Value &b);
  Truth both(Truth a, Truth b) { return {store_.logicalAnd(a.term, b.term)}; }
  Truth negation(Truth a) { return {store_.logicalNot(a.term)}; }
  bool mayBe(Truth a);
  bool proves(Truth a) { return path_ && path_->proves(a.term); }
  Truth unknownTruth() { return {fresh(kUnknownTruth, smt::Sort::Bool)}; }
  Truth answer(ControlQuestion question);
  Truth setting(SwitchId id);
  const std::vector<std::pair<SwitchId, smt::TermId>> &askedSettings() const { return askedSettings_; }

  // ---- modal codes ----
  ModalCode code(std::uint8_t index) { return {store_.number(smt::Number(static_cast<int>(index)))}; }
  ModalCode unknownCode() { return {fresh("code", smt::Sort::Int)}; }
  Truth isOneOf(ModalCode code, CodeMask mask);
  std::optional<std::uint8_t> onlyCode(ModalCode code);
  ModalCode selectCode(Truth truth, ModalCode first, ModalCode second);
  bool isSameCode(ModalCode a, ModalCode b) const { return a == b; }
  Value numberOfCode(ModalCode code, const ModalTable &modes, std::uint8_t group);
  std::optional<std::pair<std::uint8_t, ModalCode>> codeFrom(const Value &value, const ModalTable &modes) const;

  // ---- variables ----
  Value unwritten(const State &state, std::uint32_t variable);
  Value volatileRead(std::uint32_t variable);
  Value signalRead(std::uint32_t variable, double least, double most);
  Truth isReadFromOutside(std::uint32_t variable) {
    return readings_ ? truth(readings_->contains(variable)) : unknownTruth();
  }
  Value readAnyOf(State &state, const Value &index, Span place);
  bool writeAnyOf(State &state, const Value &index, const Value &value, Span place);
  void havocVariables(State &state, std::uint32_t first, std::uint32_t last);
  void join(State &state, Truth truth, const State &second);

  // ---- what happens ----
  void alarm(Truth truth, const AlarmReport &report);
  void userAlarm(const Value &number, Span place);
  bool wantsMoves() const { return true; }
  void move(const Move<Value> &move);
  void unmodelled(std::string_view reason, Span place) { notes_.emplace_back(reason, place); }
  void abandon(std::string_view reason, Span) { abandoned_ = reason; }
  /// Why no claim on the program is made.
  std::optional<std::string_view> abandoned() const { return abandoned_; }
  void havoc(State &state, std::string_view reason, Span place);
  void unlistedCode(State &state, const CodeName &code, Span place);
  /// Results are rounded so while it lives.
  class Rounding {
  public:
    Rounding(SymbolicInterpretation &interpretation, Rounds rounds)
        : interpretation_(interpretation), before_(interpretation.roundResults(rounds)) {}
    Rounding(const Rounding &) = delete;
    Rounding &operator=(const Rounding &) = delete;
    ~Rounding() { interpretation_.roundResults(before_); }

  private:
    SymbolicInterpretation &interpretation_;
    Rounds before_;
  };
  /// Not of a contract, whose expressions are evaluated in doubles.
  Rounding inExpression() {
    const bool isOfProgram = rounds_ == Rounds::AsDoubles && !isContract_;
    return {*this, isOfProgram ? Rounds::AsDialect : rounds_};
  }
  Value asHeld(const Value &value);
  void hold(Value &value, const Expression &expression);
  void holdSum(Value &, OperatorKind, const Value &, const Value &) const {}
  void evaluated(ExpressionId, const Value &) const {}

private:
  Value of(smt::TermId number);
  Value readOf(std::uint32_t variable, smt::Sort sort);
  /// The operation on two numbers in the cases of one condition; absent where they are not in such cases.
  template <typename Compute> std::optional<Value> inEachCase(const Value &a, const Value &b, const Compute &compute);
  void tieToCode(smt::TermId number, ModalCode code, const ModalTable &modes, std::uint8_t group);
  enum class Operation : std::uint8_t { Sum, Product, Quotient };
  Value result(Operation operation, smt::TermId exact, const Value &a, const Value &b);
  Value inShortMantissa(Operation operation, smt::TermId exact, const Value &a, const Value &b);
  Value functionInShortMantissa(FunctionKind kind, smt::TermId exact, const Value &argument);
  Value tangentInShortMantissa(const Value &argument);
  bool hasShortMantissas() const;
  smt::TermId sizeOf(smt::TermId number);
  Value resultOf(FunctionKind kind, smt::TermId exact, const Value &argument);
  Value near(smt::TermId exact, smt::TermId distance);
  smt::TermId inShortMantissa(smt::TermId number);
  smt::TermId asTyped(smt::TermId decimal);
  Value constantNear(FunctionKind kind, smt::TermId exact, smt::TermId distance, const Value &argument);
  Value roundedWord(const Value &value, Decimal step);
  std::optional<double> onlyWord(smt::TermId number, Decimal step);
  smt::TermId distanceOfWord(smt::TermId exact, const smt::Number &half);
  Truth equal(const Value &a, const Value &b);
  bool isRoundedHere() const { return place_ && rounded_.contains(*place_); }
  bool isMultipleByPowerOfTwo(const Value &factor) const;
  Value freshValue(MayBeVacant mayBeVacant);
  bool isNeverNegative(smt::TermId term);
  bool hasFormNeverNegative(smt::TermId term);
  enum class Use : std::uint8_t { Read, Write };
  void alarmsOfAnyOf(const Value &index, Use use, const Value &value, Span place);
  // ---- indices of which a range is known (indirect_variables.cpp) ----
  using Cells = std::vector<std::pair<std::uint32_t, Value>>;
  std::optional<VariableSpan> spanOf(const Value &index, Span place);
  smt::TermId isAmong(smt::TermId index, VariableSpan span);
  bool isStored(VariableSpan span) const;
  MayBeVacant vacancyIn(VariableSpan span) const;
  Value heldIn(const State &state, std::uint32_t variable);
  Value chosen(smt::TermId index, const Cells &cells, Value otherwise);
  Value readAmong(const State &state, smt::TermId index, VariableSpan span);
  Value regionAt(smt::TermId token, smt::TermId index, VariableSpan span, int depth);
  Value startAt(smt::TermId index);
  Value regionCell(smt::TermId token, std::uint32_t variable, int depth);
  Value anyCell(smt::TermId token, std::uint32_t variable);
  bool staysDefined(std::uint32_t variable) const;
  bool writeAmong(State &state, smt::TermId index, const Value &value, VariableSpan span);
  bool writeRow(State &state, const VariableRange &row, const RegionWrite &write);
  bool writeAnywhere(State &state, const Value &index);
  void changeRegion(State &state, RegionChange change);

  smt::TermStore &store_;
  const Dialect *dialect_;
  std::function<bool(std::uint32_t)> isGlobalName_;
  Arithmetic arithmetic_;
  Rounds rounds_ = Rounds::No;
  bool takesUsual_ = false;
  std::vector<std::pair<SwitchId, bool>> settings_;
  std::vector<std::pair<SwitchId, smt::TermId>> askedSettings_;
  std::optional<smt::TermId> tolerance_;
  Grids grids_;
  Increments increments_;
  smt::GroundTruth groundTruth_;
  std::optional<Place> place_;
  std::set<Place> rounded_; // by roundAlways()
  std::vector<TakenAsSmall> exact_;
  PathKnowledge *path_ = nullptr;
  std::optional<std::uint8_t> polarGroup_;
  std::vector<PossibleStop> possibleStops_;
  std::optional<std::string_view> abandoned_;
  std::vector<std::pair<std::string_view, Span>> notes_;
  UnlistedCodes unlistedCodes_ = UnlistedCodes::DoAnything;
  std::vector<std::string> returning_;
  std::vector<std::uint32_t> unkeptWrites_;
  std::vector<Move<Value>> moves_;
  std::vector<smt::TermId> facts_;
  std::map<smt::TermId, std::pair<std::uint8_t, ModalCode>> codeNumbers_; // what #4003 read, by its term
  std::map<smt::TermId, bool> neverNegative_;
  std::map<ControlQuestion, smt::TermId> answers_;
  IndexRanges indexRanges_;
  std::map<smt::TermId, Value> startReads_;
  std::map<smt::TermId, RegionChange> regionChanges_; // by token
  std::map<std::string, Value> named_;
  std::map<std::uint32_t, Value> entryValues_;
  std::set<std::uint32_t> typed_; // of entryValues_: taken to be numbers that can be typed
  std::map<std::uint32_t, WrittenInput> written_;
  std::set<smt::TermId> entry_;
  std::optional<std::map<std::uint32_t, Value>> given_; // present: what the run starts from
  std::optional<std::map<std::uint32_t, std::vector<smt::TermId>>> readings_;
  std::map<std::uint32_t, std::size_t> taken_; // readings
  std::vector<InputRead> inputReads_;
  bool isContract_ = false;
  std::uint32_t nextFresh_ = 0;
  bool stopped_ = false;
  bool assumesTyped_ = true; // what is read at the start is taken as typed
  bool tooLarge_ = false;
  bool moved_ = false;
  std::optional<Value> skipShare_ = {}; // of the skip move that is made, in a run on given readings
};

/// An expression of a contract is evaluated in doubles.  Its whole numbers are exact, however large.
class ContractArithmetic {
public:
  explicit ContractArithmetic(SymbolicInterpretation &interpretation)
      : interpretation_(interpretation), rounding_(interpretation, SymbolicInterpretation::Rounds::AsDoubles),
        exact_(interpretation.takeExactResults()), wasContract_(interpretation.readContract(true)) {}
  ContractArithmetic(const ContractArithmetic &) = delete;
  ContractArithmetic &operator=(const ContractArithmetic &) = delete;
  ~ContractArithmetic() {
    interpretation_.restoreExactResults(std::move(exact_));
    interpretation_.readContract(wasContract_);
  }

private:
  SymbolicInterpretation &interpretation_;
  SymbolicInterpretation::Rounding rounding_;
  std::vector<TakenAsSmall> exact_;
  bool wasContract_;
};

/// Results are rounded while it lives: those of the instruction at the place.
class ProgramArithmetic {
public:
  ProgramArithmetic(SymbolicInterpretation &interpretation, Place place)
      : rounding_(interpretation, SymbolicInterpretation::Rounds::AsDoubles) {
    interpretation.executeAt(place);
  }

private:
  SymbolicInterpretation::Rounding rounding_;
};

/// An arbitrary state at the start: each part is a variable of its own.
SymbolicState symbolicEntry(SymbolicInterpretation &interpretation);

/// Calls visit(smt::TermId &) for each term of the state, in the order of forEachPart.
template <typename State, typename Visit> void forEachTerm(State &state, Visit &&visit) {
  forEachPart(Overloaded{[&visit](PartId, auto &code) requires requires { code.index;
}
{ visit(code.index); }
, [&visit](PartId, auto &truth) requires requires { truth.term; }
{ visit(truth.term); }
, [&visit](PartId, auto &value) requires requires { value.vacant; }
{
  visit(value.vacant);
  visit(value.number);
}
} // namespace feedhold::prove
,
              state);
}

/// Gives both states the same parts and the same havocked variables.  False when they hold different
/// modal calls.
bool alignAll(SymbolicInterpretation &interpretation, SymbolicState &a, SymbolicState &b);

} // namespace feedhold::prove
