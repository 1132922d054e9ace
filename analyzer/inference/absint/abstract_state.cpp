#include "inference/absint/abstract_state.h"

#include <map>
#include <tuple>
#include <unordered_map>

namespace feedhold {

namespace {

using Ranges = std::vector<std::pair<std::uint32_t, std::uint32_t>>;

bool isForgotten(const Ranges &ranges, std::uint32_t variable) {
  return std::any_of(ranges.begin(), ranges.end(),
                     [&](const auto &range) { return range.first <= variable && variable <= range.second; });
}

bool covers(const Ranges &outer, const Ranges &inner) {
  return std::all_of(inner.begin(), inner.end(), [&](const auto &range) {
    return std::any_of(outer.begin(), outer.end(),
                       [&](const auto &o) { return o.first <= range.first && range.second <= o.second; });
  });
}

constexpr std::size_t kMostRanges = 8;

void forget(Ranges &ranges, std::pair<std::uint32_t, std::uint32_t> range) {
  if (covers(ranges, {range}))
    return;
  std::erase_if(ranges, [&](const auto &r) { return range.first <= r.first && r.second <= range.second; });
  ranges.push_back(range);
  std::sort(ranges.begin(), ranges.end());
  if (ranges.size() <= kMostRanges)
    return;
  std::uint32_t last = 0;
  for (const auto &r : ranges)
    last = std::max(last, r.second);
  ranges = {{ranges.front().first, last}};
}

AbstractValue entryValue(std::uint32_t symbol, const AbstractValue &value) {
  return value.withOrigin(Origin{symbol, Rational()});
}

AbstractValue cellAtEntry(const Dialect &dialect, std::uint32_t variable) {
  const VariableRange *range = variable >= kFirstNamedVariable ? nullptr : findVariable(dialect, variable);
  const bool isNumber = range && range->kind == VariableKind::System;
  return entryValue(symbolOfVariable(variable), isNumber ? AbstractValue::anyNumber() : AbstractValue::any());
}

/// The parts of a state that are not values: joined in `a`.
void joinFlags(AbstractState &a, const AbstractState &b) {
  for (std::size_t group = 0; group < kModalGroups; ++group)
    a.codes[group] = join(a.codes[group], b.codes[group]);
  a.spindle = join(a.spindle, b.spindle);
  a.transformed = join(a.transformed, b.transformed);
  a.modalCallsUnknown = join(a.modalCallsUnknown, b.modalCallsUnknown);
  for (const auto &[number, entered] : b.enteredLoops) {
    const auto found = std::find_if(a.enteredLoops.begin(), a.enteredLoops.end(),
                                    [n = number](const auto &loop) { return loop.first == n; });
    if (found == a.enteredLoops.end())
      a.enteredLoops.emplace_back(number, join(entered, Truth::True));
    else
      found->second = join(found->second, entered);
  }
  std::sort(a.enteredLoops.begin(), a.enteredLoops.end(),
            [](const auto &x, const auto &y) { return x.first < y.first; });
}

bool sameCalls(const AbstractState &a, const AbstractState &b) {
  return std::equal(a.modalCalls.begin(), a.modalCalls.end(), b.modalCalls.begin(), b.modalCalls.end(),
                    [](const auto &x, const auto &y) { return x.file == y.file && x.call == y.call; });
}

bool flagsLeq(const AbstractState &a, const AbstractState &b) {
  for (std::size_t group = 0; group < kModalGroups; ++group)
    if (!leq(a.codes[group], b.codes[group]))
      return false;
  const auto within = [](Truth x, Truth y) { return join(x, y) == y; };
  for (const auto &[number, entered] : a.enteredLoops) {
    Truth other = Truth::True;
    for (const auto &[loop, truth] : b.enteredLoops)
      other = loop == number ? truth : other;
    if (!within(entered, other))
      return false;
  }
  return leq(a.spindle, b.spindle) && within(a.transformed, b.transformed) &&
         within(a.modalCallsUnknown, b.modalCallsUnknown) && (sameCalls(a, b) || mayBeTrue(b.modalCallsUnknown)) &&
         covers(b.forgotten, a.forgotten);
}

/// The values of a state, which is constant or not.
template <typename State> auto valuesOf(State &state) {
  using Value = std::conditional_t<std::is_const_v<State>, const AbstractValue, AbstractValue>;
  std::vector<Value *> values;
  values.reserve(160 + state.variables.entries().size());
  forEachValue(state, [&](Value &value) { values.push_back(&value); });
  return values;
}

bool isAligned(const AbstractState &a, const AbstractState &b) {
  return a.counters.size() == b.counters.size() &&
         std::equal(a.variables.entries().begin(), a.variables.entries().end(), b.variables.entries().begin(),
                    b.variables.entries().end(), [](const auto &x, const auto &y) { return x.first == y.first; });
}

/// Values that keep their distance in both states get one new symbol (a labelled union-find, after Lesbre and Lemerre,
/// "Relational abstractions based on labeled union-find", 2025).
class CommonOrigins {
public:
  explicit CommonOrigins(AbstractReading &reading) : reading_(reading) {}

  std::optional<Origin> of(const AbstractValue &a, const AbstractValue &b) {
    if (!a.origin() || !b.origin())
      return std::nullopt;
    const Origin &left = *a.origin();
    const Origin &right = *b.origin();
    if (left == right)
      return left;
    const std::optional<Rational> skew = subtract(left.offset, right.offset);
    if (!skew)
      return std::nullopt;
    const Key key{left.symbol, right.symbol, skew->numerator(), skew->denominator()};
    const auto found = classes_.find(key);
    if (found == classes_.end()) {
      const Class fresh{reading_.freshSymbol(), left.offset};
      classes_.emplace(key, fresh);
      return Origin{fresh.symbol, Rational()};
    }
    const std::optional<Rational> offset = subtract(left.offset, found->second.base);
    return offset ? std::optional(Origin{found->second.symbol, *offset}) : std::nullopt;
  }

private:
  using Key = std::tuple<std::uint32_t, std::uint32_t, std::int64_t, std::int64_t>;
  struct Class {
    std::uint32_t symbol;
    Rational base;
  };
  AbstractReading &reading_;
  std::map<Key, Class> classes_;
};

template <typename Combine>
void combineInto(AbstractReading &reading, AbstractState &a, const AbstractState &unaligned, Combine &&combine) {
  std::optional<AbstractState> copy; // states are large: only one that has to change is copied
  if (!isAligned(a, unaligned) || !sameCalls(a, unaligned)) {
    copy = unaligned;
    align(reading, a, *copy);
    if (!sameCalls(a, *copy)) {
      a.modalCalls.clear();
      copy->modalCalls.clear();
      a.modalCallsUnknown = Truth::Maybe;
    }
  }
  const AbstractState &b = copy ? *copy : unaligned;
  joinFlags(a, b);
  for (const auto &range : b.forgotten)
    forget(a.forgotten, range);
  const std::vector<AbstractValue *> left = valuesOf(a);
  const std::vector<const AbstractValue *> right = valuesOf(b);
  CommonOrigins origins(reading);
  for (std::size_t i = 0; i < left.size(); ++i) {
    if (*left[i] == *right[i])
      continue;
    const std::optional<Origin> origin = origins.of(*left[i], *right[i]);
    *left[i] = combine(*left[i], *right[i]).withOrigin(origin);
  }
}

/// A symbol of the right state is one value of the left state, wherever it stands.
class SymbolMeaning {
public:
  bool agrees(const Origin &left, const Origin &right) {
    if (isEntrySymbol(right.symbol))
      return left == right;
    const std::optional<Rational> offset = subtract(left.offset, right.offset);
    if (!offset)
      return false;
    const Origin zero{left.symbol, *offset};
    const auto [known, isNew] = meaning_.emplace(right.symbol, zero);
    return isNew || known->second == zero;
  }

private:
  std::unordered_map<std::uint32_t, Origin> meaning_;
};

bool valuesLeq(const AbstractState &a, const AbstractState &b) {
  const std::vector<const AbstractValue *> left = valuesOf(a);
  const std::vector<const AbstractValue *> right = valuesOf(b);
  SymbolMeaning meaning;
  for (std::size_t i = 0; i < left.size(); ++i) {
    if (*left[i] != *right[i] && !leq(*left[i], *right[i]))
      return false;
    if (right[i]->origin() && (!left[i]->origin() || !meaning.agrees(*left[i]->origin(), *right[i]->origin())))
      return false;
  }
  return true;
}

/// Positions are told under the mappings that are in force now, whatever they are.
void noMapping(const AbstractReading &reading, AbstractState &state) {
  state.transform.scale.fill(reading.number(1));
  state.transform.scaleCentre.fill(reading.number(0));
  state.transform.mirrorAt.fill(AbstractValue::vacant());
  state.transform.angle = reading.number(0);
  state.transform.centre.fill(reading.number(0));
  state.transform.other = AbstractValue::vacant();
  state.transformed = Truth::False;
}

} // namespace

AbstractState entryState(AbstractReading &reading) {
  AbstractState state;
  for (std::uint32_t local = 0; local <= kLocalVariables; ++local)
    state.locals[local] = entryValue(symbolOfVariable(local), AbstractValue::any());
  state.locals[0] = AbstractValue::vacant();
  state.codes.fill(CodeSet::atEntry());
  for (std::size_t axis = 0; axis < kAxisCount; ++axis)
    state.position[axis] = entryValue(symbolOfPosition(axis), AbstractValue::anyNumber());
  for (std::size_t word = 0; word < state.words.size(); ++word)
    state.words[word] =
        entryValue(kWordSymbols + static_cast<std::uint32_t>(word), AbstractValue::any());
  // Distances from what was there at the start of the run, as the mappings are.
  state.shift.fill(AbstractValue::anyNumber());
  state.local.fill(AbstractValue::anyNumber());
  for (auto *shifts : {&state.shift, &state.local})
    for (AbstractValue &value : *shifts)
      value = reading.withSymbol(value);
  state.lengthOffset = reading.withSymbol(AbstractValue::anyNumber());
  const AbstractValue any = AbstractValue::any();
  state.cycle = {any, any, any, any, any};
  noMapping(reading, state);
  state.spindle = CodeSet::atEntry();
  state.modalCallsUnknown = Truth::False;
  return state;
}

AbstractValue AbstractReading::unwritten(const State &state, std::uint32_t variable) const {
  const AbstractValue cell = cellAtEntry(*dialect_, variable);
  return isForgotten(state.forgotten, variable) ? cell.withOrigin(std::nullopt) : cell;
}

void align(const AbstractReading &reading, AbstractState &a, AbstractState &b) {
  const auto complete = [&reading](AbstractState &to, const AbstractState &from) {
    for (const auto &[number, value] : from.variables.entries())
      if (!to.variables.find(number))
        to.variables.set(number, reading.unwritten(to, number));
  };
  if (isAligned(a, b))
    return;
  complete(a, b);
  complete(b, a);
  const std::size_t counters = std::max(a.counters.size(), b.counters.size());
  a.counters.resize(counters, reading.number(0));
  b.counters.resize(counters, reading.number(0));
}

bool leq(const AbstractReading &reading, const AbstractState &a, const AbstractState &b) {
  if (!flagsLeq(a, b))
    return false;
  if (isAligned(a, b) && sameCalls(a, b))
    return valuesLeq(a, b);
  AbstractState left = a;
  AbstractState right = b;
  align(reading, left, right);
  if (!sameCalls(left, right)) {
    left.modalCalls.clear();
    right.modalCalls.clear();
  }
  return valuesLeq(left, right);
}

void joinInto(AbstractReading &reading, AbstractState &state, const AbstractState &other) {
  combineInto(reading, state, other, [](const AbstractValue &x, const AbstractValue &y) { return join(x, y); });
}

void widenInto(AbstractReading &reading, AbstractState &old, const AbstractState &next,
               std::span<const double> thresholds) {
  combineInto(reading, old, next, [&](const AbstractValue &x, const AbstractValue &y) {
    return widen(x, join(x, y), thresholds);
  });
}

// ---- the reading's operations on whole states ----------------------------------------------------------------------

void AbstractReading::join(State &state, Truth truth, const State &second) {
  if (truth == Truth::True)
    state = second;
  else if (truth == Truth::Maybe)
    joinInto(*this, state, second);
}

void AbstractReading::forgetVariables(State &state, std::uint32_t first, std::uint32_t last) {
  forget(state.forgotten, {first, last});
  auto &entries = state.variables.entries();
  std::erase_if(entries, [&](const auto &entry) { return first <= entry.first && entry.first <= last; });
}

namespace {

void anyCentres(AbstractState &state) {
  state.transform.scaleCentre.fill(AbstractValue::anyNumber());
  state.transform.centre.fill(AbstractValue::anyNumber());
}

void anyMapping(AbstractState &state) {
  anyCentres(state);
  state.transform.scale.fill(AbstractValue::anyNumber());
  state.transform.mirrorAt.fill(AbstractValue::any());
  state.transform.angle = AbstractValue::anyNumber();
  state.transform.other = AbstractValue::any();
  state.transformed = Truth::Maybe;
}

} // namespace

void AbstractReading::havoc(State &state, std::string_view reason, Span place) {
  notModelled(reason, place);
  forgetVariables(state, 0, 0xffffffff);
  forEachValue(state, [](AbstractValue &value) { value = AbstractValue::any(); });
  state.locals[0] = AbstractValue::vacant();
  for (auto *numbers : {&state.position, &state.shift, &state.local})
    numbers->fill(AbstractValue::anyNumber());
  state.lengthOffset = AbstractValue::anyNumber();
  // What is not followed is taken to leave no mapping in force, as at entry; one of the program's own may stay or end.
  if (state.transformed == Truth::False) {
    noMapping(*this, state);
    anyCentres(state); // of a mapping that has ended, or of one that maps nothing
  } else {
    anyMapping(state);
  }
  for (AbstractValue &counter : state.counters)
    counter = AbstractValue::anyNumber();
  const CodeSet polar = polarGroup_ && state.transformed == Truth::False ? state.codes[*polarGroup_] : unknownCode();
  state.codes.fill(unknownCode());
  if (polarGroup_)
    state.codes[*polarGroup_] = polar;
  state.spindle = unknownCode();
  state.modalCallsUnknown = Truth::Maybe;
  for (auto &loop : state.enteredLoops)
    loop.second = Truth::Maybe;
}

namespace {

/// The whole numbers that an index can be, as variables; absent when there are too many to go through.
constexpr double kMostIndices = 64;

struct IndexRange {
  std::uint32_t first;
  std::uint32_t last;
};
std::optional<IndexRange> indicesOf(const AbstractValue &index) {
  const Interval &range = index.number().interval();
  const double first = std::max(0.0, std::floor(range.lo + 0.5));
  const double last = std::floor(range.hi + 0.5);
  if (!(last >= first) || !(last < 1e9))
    return std::nullopt;
  return IndexRange{static_cast<std::uint32_t>(first), static_cast<std::uint32_t>(last)};
}

bool hasIndex(const AbstractValue &index, std::uint32_t variable) {
  return feedhold::isEqual(round(index.number()), AbstractNumber::constant(static_cast<double>(variable))) !=
         Truth::False;
}

} // namespace

/// Of a variable that may be one of several: some may not exist, or be protected, or stop the program.
void AbstractReading::alarmsOfAnyOf(const Value &index, Use use, const Value &value, Span place) {
  const IndexRange range = indicesOf(index).value_or(IndexRange{0, kFirstNamedVariable - 1});
  std::uint64_t existing = 0;
  bool isProtected = false;
  bool stops = false;
  for (const VariableRange &row : dialect_->variables) {
    const std::uint32_t first = std::max(row.first, range.first);
    const std::uint32_t last = std::min(row.last, range.last);
    if (first > last || (first == last && !hasIndex(index, first)))
      continue;
    existing += last - first + 1;
    isProtected = isProtected || row.access == (use == Use::Read ? VariableAccess::WriteOnly : VariableAccess::ReadOnly);
    stops = stops || (use == Use::Write && row.role == VariableRole::Alarm);
  }
  if (existing <= range.last - range.first)
    alarm(Truth::Maybe, {AlarmKind::VariableNotAvailable, place});
  if (isProtected)
    alarm(Truth::Maybe, {use == Use::Read ? AlarmKind::ReadProtected : AlarmKind::WriteProtected, place});
  if (stops && observer_ && !stopped_)
    observer_->userAlarm(value, place);
}

AbstractValue AbstractReading::readAnyOf(State &state, const Value &index, Span place) {
  alarmsOfAnyOf(index, Use::Read, index, place);
  const auto range = indicesOf(index);
  if (!range || range->last - range->first > kMostIndices)
    return anything();
  std::optional<AbstractValue> all;
  for (std::uint32_t variable = range->first; variable <= range->last; ++variable) {
    if (!hasIndex(index, variable))
      continue;
    const VariableRange *row = findVariable(*dialect_, variable);
    AbstractValue one = anything();
    if (row && row->kind == VariableKind::Local && variable <= kLocalVariables)
      one = state.locals[variable];
    else if (row && (row->role == VariableRole::Plain || row->role == VariableRole::Stored))
      one = state.variables.find(variable) ? *state.variables.find(variable) : unwritten(state, variable);
    all = all ? feedhold::join(*all, one) : one;
  }
  return all.value_or(anything());
}

void AbstractReading::writeAnyOf(State &state, const Value &index, const Value &value, Span place) {
  alarmsOfAnyOf(index, Use::Write, value, place);
  const IndexRange range = indicesOf(index).value_or(IndexRange{0, 0xffffffff});
  for (std::uint32_t local = 1; local <= kLocalVariables; ++local)
    if (range.first <= local && local <= range.last && hasIndex(index, local))
      state.locals[local] = feedhold::join(state.locals[local], value).withOrigin(std::nullopt);
  std::vector<std::pair<std::uint32_t, AbstractValue>> kept;
  for (const auto &[variable, old] : state.variables.entries())
    if (range.first <= variable && variable <= range.last)
      kept.emplace_back(variable, hasIndex(index, variable)
                                      ? feedhold::join(old, value).withOrigin(std::nullopt)
                                      : old);
  forget(state.forgotten, {range.first, range.last});
  for (auto &[variable, joined] : kept)
    state.variables.set(variable, joined);
  if (range.last >= kFirstWorkOffset)
    state.position.fill(AbstractValue::anyNumber());
}

} // namespace feedhold
