#include "proof/symbolic/symbolic_interpretation.h"

#include "proof/symbolic/literal_cases.h"

#include <cmath>
#include <fmt/format.h>

namespace feedhold::prove {

using smt::Function;
using smt::Number;
using smt::Sort;
using smt::Term;
using smt::TermId;
using smt::TermKind;

namespace {

constexpr std::size_t kMostArguments = 64;
// Behind these, no certificate can speak of the value (check/problem.cpp), and each further operation makes it larger.
constexpr smt::TermShape kLargest{.monomials = 2'000, .degree = 16, .depth = 64, .words = 64, .size = 0}; // 4096 bits

std::optional<Function> functionOf(FunctionKind kind) {
  if (kind == FunctionKind::Sin)
    return Function::Sin;
  if (kind == FunctionKind::Cos)
    return Function::Cos;
  if (kind == FunctionKind::Tan)
    return Function::Tan;
  if (kind == FunctionKind::Asin)
    return Function::Asin;
  if (kind == FunctionKind::Acos)
    return Function::Acos;
  if (kind == FunctionKind::Sqrt)
    return Function::Sqrt;
  if (kind == FunctionKind::Ln)
    return Function::Ln;
  if (kind == FunctionKind::Exp)
    return Function::Exp;
  return std::nullopt;
}

} // namespace

bool isSystemVariable(const Dialect &dialect, std::uint32_t variable) {
  const VariableRange *range = variable >= kFirstNamedVariable ? nullptr : findVariable(dialect, variable);
  return range && range->kind == VariableKind::System;
}

void SymbolicInterpretation::start() {
  possibleStops_.clear();
  moves_.clear();
  unkeptWrites_.clear();
  stopped_ = moved_ = false;
}

void SymbolicInterpretation::startOver() {
  start();
  notes_.clear();
  returning_.clear();
  tooLarge_ = false;
}

TermId SymbolicInterpretation::fresh(std::string_view what, Sort sort) {
  return store_.variable(fmt::format("{} {}", what, nextFresh_++), sort);
}

Condition SymbolicInterpretation::answer(ControlQuestion question) {
  if (takesUsual_)
    return truth(true);
  const auto known = answers_.find(question);
  return {known != answers_.end() ? known->second : answers_.emplace(question, unknownTruth().term).first->second};
}

std::string nameOfSetting(SwitchId id) { return fmt::format("{}{}:", kUnknownSetting, switchNames()[id].name); }

Condition SymbolicInterpretation::setting(SwitchId id) {
  if (!takesUsual_) {
    const auto known = std::ranges::find(askedSettings_, id, [](const auto &each) { return each.first; });
    if (known != askedSettings_.end() && switchNames()[id].isOneParameter)
      return {known->second};
    return {askedSettings_.emplace_back(id, fresh(nameOfSetting(id), Sort::Bool)).second};
  }
  const auto said = std::ranges::find(settings_, id, [](const auto &each) { return each.first; });
  return truth(said == settings_.end() ? switchNames()[id].usual : said->second);
}

SymbolicValue SymbolicInterpretation::named(const std::string &name, MayBeVacant mayBeVacant) {
  const auto known = named_.find(name);
  if (known != named_.end())
    return known->second;
  const Value value = numberNamed(name, mayBeVacant);
  store_.markAsDouble(value.number);
  return value;
}

SymbolicValue SymbolicInterpretation::numberNamed(const std::string &name, MayBeVacant mayBeVacant) {
  const auto known = named_.find(name);
  if (known != named_.end())
    return known->second;
  Value value{store_.no(), store_.variable(name, Sort::Real)};
  if (mayBeVacant == MayBeVacant::Yes) {
    value.vacant = store_.variable(name + " vacant", Sort::Bool);
    facts_.push_back(store_.implies(value.vacant, store_.equal(value.number, store_.number(Number(0)))));
  }
  named_.emplace(name, value);
  return value;
}

SymbolicValue SymbolicInterpretation::freshValue(MayBeVacant mayBeVacant) {
  return named(fmt::format("any {}", nextFresh_++), mayBeVacant);
}

SymbolicValue SymbolicInterpretation::atEntry(std::uint32_t variable) {
  const bool isNumber = isSystemVariable(*dialect_, variable);
  if (given_) {
    if (const auto value = given_->find(variable); value != given_->end())
      return value->second;
    if (!isNumber)
      return vacant();
  }
  const WrittenInput &written = written_[variable];
  const auto vacancy = isNumber ? MayBeVacant::No : MayBeVacant::Yes;
  const std::string name = fmt::format("#{}", variable);
  const auto step = isNumber ? std::nullopt : written.step; // nothing says that a cell of the control has few digits
  const Value value = step ? numberNamed(name, vacancy) : named(name, vacancy);
  if (entryValues_.emplace(variable, value).second && step)
    increments_.setStep(value.number, *step);
  if (assumesTyped_ && typed_.insert(variable).second) {
    const std::vector<TermId> typed = typedInput(variable, written, value.number);
    facts_.insert(facts_.end(), typed.begin(), typed.end());
    if (written.isWhole && !typed.empty())
      grids_.setOfInput(value.number, 0);
  }
  entry_.insert(value.number);
  entry_.insert(value.vacant);
  return {value.vacant, step ? asTyped(value.number) : value.number};
}

/// As a literal is held: the nearest double, or what a control with shorter mantissas makes of that.
TermId SymbolicInterpretation::asTyped(TermId decimal) {
  if (arithmetic_ == Arithmetic::Exact)
    return decimal;
  const bool isShort = numbersOf(*dialect_) != NumberModel::Binary64;
  return isShort ? inShortMantissa(decimal) : store_.apply(Function::Nearest, decimal);
}

SymbolicValue SymbolicInterpretation::asRead(const Value &value) {
  if (arithmetic_ == Arithmetic::Exact || !increments_.isCounted(value.number))
    return value;
  if (isContract_)
    return {value.vacant, asTyped(value.number)};
  const TermId distance = store_.scale(Number(1) / Number(std::int64_t{1} << 31), sizeOf(value.number));
  return {value.vacant, near(value.number, distance).number};
}

TermId SymbolicInterpretation::asCounted(TermId number) {
  const auto multiple = increments_.isUsed() ? increments_.of(number) : std::nullopt;
  return multiple && increments_.isCounted(multiple->exact) ? multiple->exact : number;
}

/// Controls take 8 digits (docs/arithmetic.md).  Ends that the contract states replace the larger ones.
std::vector<TermId> SymbolicInterpretation::typedInput(std::uint32_t variable, const WrittenInput &written,
                                                       TermId number) {
  if (arithmetic_ == Arithmetic::Exact || isSystemVariable(*dialect_, variable))
    return {};
  number = increments_.typedInput(number);
  std::vector<TermId> typed;
  const TermId most = store_.number(Number(kMostTypedSteps) * written.step.value_or(Number(1)));
  if (!written.hasLow || written.step)
    typed.push_back(store_.lessOrEqual(store_.negate(most), number));
  if (!written.hasHigh || written.step)
    typed.push_back(store_.lessOrEqual(number, most));
  const TermId zero = store_.number(Number(0)), least = store_.number(Number(1) / Number(100'000'000));
  typed.push_back(store_.logicalOr(store_.lessOrEqual(number, zero), store_.lessOrEqual(least, number)));
  typed.push_back(store_.logicalOr(store_.lessOrEqual(zero, number), store_.lessOrEqual(number, store_.negate(least))));
  return typed;
}

// ---- values ----

/// A number that grows without end (`#1=#1*#1` in a loop) is taken as any number at some size.
SymbolicValue SymbolicInterpretation::of(TermId number) {
  const smt::Term &term = store_[number];
  const smt::TermShape &shape = store_.shape(number);
  const bool isHuge = term.arguments.size() > kMostArguments || shape.monomials > kLargest.monomials ||
                      shape.degree > kLargest.degree || shape.depth > kLargest.depth || shape.words > kLargest.words;
  if (!isHuge)
    return {store_.no(), number};
  tooLarge_ = true;
  return anyNumber();
}

SymbolicValue SymbolicInterpretation::number(double value) { return of(store_.number(Number::fromDouble(value))); }
SymbolicValue SymbolicInterpretation::vacant() { return {store_.yes(), store_.number(Number(0))}; }

/// Only what a double holds exactly: the semantics computes on with it.
std::optional<double> SymbolicInterpretation::constantOf(const Value &value) const {
  if (value.vacant != store_.no() || !store_.isNumber(value.number))
    return std::nullopt;
  const Number &exact = store_[value.number].number;
  const double nearest = exact.toDouble();
  return Number::fromDouble(nearest) == exact ? std::optional(nearest) : std::nullopt;
}

bool SymbolicInterpretation::isFixed(const Value &value) const {
  return std::ranges::none_of(store_.variablesOf(value.number),
                              [&](TermId variable) { return store_[variable].sort == Sort::Real; });
}

SymbolicValue SymbolicInterpretation::select(Truth truth, const Value &first, const Value &second) {
  return {store_.ite(truth.term, first.vacant, second.vacant), store_.ite(truth.term, first.number, second.number)};
}

SymbolicValue SymbolicInterpretation::between(const Value &start, const Value &end) {
  const Value stop = anyNumber();
  const auto within = [&](TermId low, TermId high) {
    return store_.logicalAnd(store_.lessOrEqual(low, stop.number), store_.lessOrEqual(stop.number, high));
  };
  facts_.push_back(store_.logicalOr(within(start.number, end.number), within(end.number, start.number)));
  return stop;
}

void SymbolicInterpretation::beginSkip() {
  const bool isGiven = readings_ && readings_->contains(kSkipShare);
  skipShare_ = isGiven ? std::optional(volatileRead(kSkipShare)) : std::nullopt;
}
SymbolicValue SymbolicInterpretation::endOfSkip(const Value &start, const Value &end) {
  return skipShare_ ? add(start, multiply(*skipShare_, subtract(end, start))) : between(start, end);
}

// ---- arithmetic ----

/// By its form: roots, absolute values, squares, and sums and products of such.  Each term is looked at once: a
/// rounding has its argument several times, and nested roundings would be walked through without an end.
bool SymbolicInterpretation::isNeverNegative(TermId id) {
  const auto known = neverNegative_.find(id);
  return known != neverNegative_.end() ? known->second
                                       : neverNegative_.emplace(id, hasFormNeverNegative(id)).first->second;
}

bool SymbolicInterpretation::hasFormNeverNegative(TermId id) {
  const Term term = store_[id]; // a copy: telling absolute values makes terms
  const auto allNeverNegative = [&](const auto &terms) {
    return std::all_of(terms.begin(), terms.end(), [&](TermId each) { return isNeverNegative(each); });
  };
  switch (term.kind) {
  case TermKind::Number: return term.number.sign() >= 0;
  case TermKind::Add:
  case TermKind::Divide: return allNeverNegative(term.arguments);
  case TermKind::Multiply:
    return allNeverNegative(term.arguments) || (term.arguments.size() == 2 && term.arguments[0] == term.arguments[1]);
  case TermKind::Ite: {
    const TermId first = term.arguments[1];
    const TermId second = term.arguments[2];
    const bool isAbsolute = store_.absolute(first) == id || store_.absolute(second) == id;
    return isAbsolute || (isNeverNegative(first) && isNeverNegative(second));
  }
  case TermKind::Apply:
    if (term.function == Function::Floor || term.function == Function::Nearest)
      return isNeverNegative(term.arguments[0]);
    return term.function == Function::Sqrt || term.function == Function::Exp;
  case TermKind::True:
  case TermKind::False:
  case TermKind::Variable:
  case TermKind::Less:
  case TermKind::LessOrEqual:
  case TermKind::Equal:
  case TermKind::And:
  case TermKind::Or:
  case TermKind::Not: return false;
  }
  return false;
}

SymbolicValue SymbolicInterpretation::fix(const Value &a) {
  return of(isNeverNegative(a.number) ? store_.floor(a.number) : store_.truncate(a.number));
}
SymbolicValue SymbolicInterpretation::fup(const Value &a) {
  const TermId up = store_.ceiling(a.number);
  if (isNeverNegative(a.number))
    return of(up);
  const TermId zero = store_.number(Number(0));
  return of(store_.ite(store_.lessOrEqual(zero, a.number), up, store_.floor(a.number)));
}
/// Exact in doubles, too (C, fmod).  With shorter mantissas, a quotient that is off may have another whole part.
SymbolicValue SymbolicInterpretation::remainder(const Value &a, const Value &b) {
  const auto isWhole = [&](const Value &value) { return grids_.of(value.number).value_or(-1) >= 0; };
  if (hasShortMantissas() && !(isWhole(a) && isWhole(b)))
    return anyNumber();
  const Rounds rounded = roundResults(Rounds::No);
  const Value rest = subtract(a, multiply(b, fix(divide(a, b))));
  roundResults(rounded);
  return rest;
}

/// Halves go away from zero.  Finer steps are the increment of the control, which exact reals do not have.
SymbolicValue SymbolicInterpretation::roundTo(const Value &value, Decimal step) {
  if (step.scale() != 0 || step.mantissa() != 1)
    return rounds_ != Rounds::No ? roundedWord(value, step) : asNumber(value);
  if (grids_.of(value.number).value_or(-1) >= 0)
    return asNumber(value);
  const TermId half = store_.number(Number(1) / Number(2));
  const TermId up = store_.floor(store_.add(value.number, half));
  if (isNeverNegative(value.number))
    return of(up);
  const TermId down = store_.ceiling(store_.subtract(value.number, half));
  return of(store_.ite(store_.lessOrEqual(store_.number(Number(0)), value.number), up, down));
}

SymbolicValue SymbolicInterpretation::function(FunctionKind kind, const Value &argument) {
  if (kind == FunctionKind::Abs) {
    if (const auto cases = literalCases(store_, argument.number, argument.number))
      return select({cases->condition}, function(kind, of(cases->ifSo[0])), function(kind, of(cases->ifNot[0])));
    return of(isNeverNegative(argument.number) ? argument.number : store_.absolute(argument.number));
  }
  const auto function = functionOf(kind);
  return function ? resultOf(kind, store_.apply(*function, argument.number), argument) : anyNumber();
}
SymbolicValue SymbolicInterpretation::atan2(const Value &y, const Value &x) {
  const std::array arguments{y.number, x.number};
  return resultOf(FunctionKind::Atan, store_.apply(Function::Atan2, arguments), y);
}
SymbolicValue SymbolicInterpretation::power(const Value &base, const Value &exponent) {
  const std::array arguments{base.number, exponent.number};
  return resultOf(FunctionKind::Pow, store_.apply(Function::Power, arguments), base);
}
SymbolicValue SymbolicInterpretation::bitwise(OperatorKind op, const Value &a, const Value &b) {
  const Function function = op == OperatorKind::And  ? Function::BitAnd
                            : op == OperatorKind::Or ? Function::BitOr
                                                     : Function::BitXor;
  const std::array arguments{a.number, b.number};
  return of(store_.apply(function, arguments));
}

/// Whole numbers are counted, others are measured.
Condition SymbolicInterpretation::equal(const Value &a, const Value &b) {
  if (const auto typed = tolerance_ ? std::nullopt : increments_.typedPair(a.number, b.number))
    return {store_.equal(typed->first, typed->second)};
  const auto isWhole = [&](const Value &value) { return grids_.of(value.number).value_or(-1) >= 0; };
  if (!tolerance_ || (isWhole(a) && isWhole(b)))
    return {store_.equal(a.number, b.number)};
  return {store_.logicalAnd(store_.lessOrEqual(store_.subtract(a.number, b.number), *tolerance_),
                            store_.lessOrEqual(store_.subtract(b.number, a.number), *tolerance_))};
}

Condition SymbolicInterpretation::compare(Relation relation, const Value &a, const Value &b) {
  if (const auto cases = literalCases(store_, a.number, b.number)) {
    const auto in = [&](const std::array<TermId, 2> &numbers) {
      return compare(relation, of(numbers[0]), of(numbers[1])).term;
    };
    const TermId ifSo = in(cases->ifSo);
    return {store_.ite(cases->condition, ifSo, in(cases->ifNot))};
  }
  const auto [left, right] = increments_.typedPair(a.number, b.number).value_or(std::pair(a.number, b.number));
  switch (relation) {
  case Relation::Equal: return equal(a, b);
  case Relation::NotEqual: return negation(equal(a, b));
  case Relation::Greater: return {store_.greater(left, right)};
  case Relation::GreaterOrEqual: return {store_.greaterOrEqual(left, right)};
  case Relation::Less: return {store_.less(left, right)};
  case Relation::LessOrEqual: return {store_.lessOrEqual(left, right)};
  }
  return unknownTruth();
}

bool SymbolicInterpretation::mayBe(Truth a) {
  return a.term != store_.no() && !(path_ && path_->says(store_.logicalNot(a.term)));
}

// ---- modal codes ----

Condition SymbolicInterpretation::isOneOf(ModalCode code, CodeMask mask) {
  if (const auto only = onlyCode(code))
    return truth(((mask >> *only) & 1) != 0);
  std::vector<TermId> cases;
  for (CodeMask rest = mask; rest != 0; rest &= rest - 1)
    cases.push_back(store_.equal(code.index, store_.number(Number(std::countr_zero(rest)))));
  return {store_.logicalOr(cases)};
}
std::optional<std::uint8_t> SymbolicInterpretation::onlyCode(ModalCode code) {
  if (!store_.isNumber(code.index))
    return std::nullopt;
  return static_cast<std::uint8_t>(store_[code.index].number.toDouble());
}
SymbolicCode SymbolicInterpretation::selectCode(Truth truth, ModalCode first, ModalCode second) {
  return {store_.ite(truth.term, first.index, second.index)};
}
SymbolicValue SymbolicInterpretation::numberOfCode(ModalCode code, const ModalTable &modes, std::uint8_t group) {
  const auto only = onlyCode(code);
  if (only && *only < modes.group(group).codes.size())
    return literal(Decimal(modes.group(group).codes[*only]->tenths, 1));
  const Value number = named(fmt::format("number of code {} of group {}", code.index.index(), group), MayBeVacant::No);
  if (codeNumbers_.insert_or_assign(number.number, std::pair{group, code}).second)
    tieToCode(number.number, code, modes, group);
  return number;
}

/// The number is that of the code.  Of the groups that a control resets to one of their codes (FANUC parameter 3402)
/// one of those that the dialect lists is always active.
void SymbolicInterpretation::tieToCode(TermId number, ModalCode code, const ModalTable &modes, std::uint8_t group) {
  std::vector<TermId> cases;
  for (std::size_t i = 0; i < modes.group(group).codes.size(); ++i) {
    const TermId isInForce = store_.equal(code.index, store_.number(Number(static_cast<int>(i))));
    const TermId itsNumber = literal(Decimal(modes.group(group).codes[i]->tenths, 1)).number;
    facts_.push_back(store_.implies(isInForce, store_.equal(number, itsNumber)));
    cases.push_back(isInForce);
  }
  if (modes.isNeverWithout(group))
    facts_.push_back(store_.logicalOr(cases));
}

std::optional<std::pair<std::uint8_t, SymbolicCode>> SymbolicInterpretation::codeFrom(const Value &value,
                                                                                      const ModalTable &) const {
  const auto known = codeNumbers_.find(value.number);
  if (known == codeNumbers_.end() || value.vacant != store_.no())
    return std::nullopt;
  return known->second;
}

// ---- what happens ----

void SymbolicInterpretation::alarm(Truth truth, const AlarmReport &report) {
  if (!mayBe(truth) || stopped_)
    return;
  possibleStops_.push_back({truth, report.kind, {}, report.place});
  stopped_ = truth.term == store_.yes();
}

void SymbolicInterpretation::userAlarm(const Value &number, Span place) {
  if (stopped_)
    return;
  possibleStops_.push_back({truth(true), std::nullopt, number, place});
  stopped_ = true;
}

void SymbolicInterpretation::move(const Move<Value> &move) {
  if (stopped_ || move.kind == MoveKind::Dwell)
    return;
  moved_ = true;
  moves_.push_back(move);
}

} // namespace feedhold::prove
