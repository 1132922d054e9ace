#include "inference/absint/abstract_state.h"

#include "language/model/unread_blocks.h"

#include <map>
#include <tuple>
#include <unordered_map>

namespace feedhold {

namespace {

using Ranges = std::vector<std::pair<std::uint32_t, std::uint32_t>>;

bool isHavocked(const Ranges &ranges, std::uint32_t variable) {
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

std::uint32_t entrySymbol(PartId id) {
  if (id.part == Part::Position)
    return symbolOfPosition(id.key);
  return id.part == Part::ModalWord ? kWordSymbols + id.key : symbolOfVariable(id.key);
}

AbstractValue cellAtEntry(const Dialect &dialect, std::uint32_t variable) {
  const VariableRange *range = variable >= kFirstNamedVariable ? nullptr : findVariable(dialect, variable);
  const bool isNumber = range && range->kind == VariableKind::System;
  return entryValue(symbolOfVariable(variable), isNumber ? AbstractValue::anyNumber() : AbstractValue::any());
}

/// Values that keep their distance in both states get one new symbol (a labelled union-find, after Lesbre and Lemerre,
/// "Relational abstractions based on labeled union-find", 2025).
class CommonOrigins {
public:
  explicit CommonOrigins(AbstractInterpretation &interpretation) : interpretation_(interpretation) {}

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
      const Class fresh{interpretation_.freshSymbol(), left.offset};
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
  AbstractInterpretation &interpretation_;
  std::map<Key, Class> classes_;
};

template <typename Combine>
void combineInto(AbstractInterpretation &interpretation, AbstractState &a, const AbstractState &unaligned,
                 Combine &&combine) {
  std::optional<AbstractState> copy; // states are large: only one that has to change is copied
  if (!haveSameParts(a, unaligned)) {
    copy = unaligned;
    alignToJoin(interpretation, a, *copy);
  }
  const AbstractState &b = copy ? *copy : unaligned;
  for (const auto &range : b.havocked)
    forget(a.havocked, range);
  CommonOrigins origins(interpretation);
  forEachPart(Overloaded{[&](PartId, AbstractValue &left, const AbstractValue &right) {
                           if (left == right)
                             return;
                           const std::optional<Origin> origin = origins.of(left, right);
                           left = combine(left, right).withOrigin(origin);
                         },
                         [](PartId, CodeSet &left, const CodeSet &right) { left = join(left, right); },
                         [](PartId, Truth &left, const Truth &right) { left = join(left, right); }},
              a, b);
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

/// Of states with the same parts.
bool partsLeq(const AbstractState &a, const AbstractState &b) {
  SymbolMeaning meaning;
  return everyPart(Overloaded{[&](PartId, const AbstractValue &left, const AbstractValue &right) {
                                return (left == right || leq(left, right)) &&
                                       (!right.origin() ||
                                        (left.origin() && meaning.agrees(*left.origin(), *right.origin())));
                              },
                              [](PartId, const CodeSet &left, const CodeSet &right) { return leq(left, right); },
                              [](PartId, const Truth &left, const Truth &right) { return join(left, right) == right; }},
                   a, b);
}

} // namespace

AbstractState entryState(AbstractInterpretation &interpretation) {
  const auto given = Overloaded{[](PartId id, AbstractValue &value) {
                                  const bool isNumber = domainOf(id) == PartDomain::Number;
                                  value = isNumber ? AbstractValue::anyNumber() : AbstractValue::any();
                                  value = entryValue(entrySymbol(id), value);
                                  if (domainOf(id) == PartDomain::Vacancy)
                                    value = AbstractValue::vacant();
                                },
                                [](PartId, CodeSet &code) { code = CodeSet::atEntry(); },
                                [](PartId, Truth &truth) { truth = Truth::Maybe; }};
  const auto unknown = Overloaded{[&](PartId id, AbstractValue &value) {
                                    setAnything(interpretation, id, value);
                                    if (domainOf(id) == PartDomain::Number) // distances from it are told
                                      value = interpretation.withSymbol(value);
                                  },
                                  [&](PartId id, auto &part) { setAnything(interpretation, id, part); }};
  return entryParts<AbstractInterpretation>(interpretation, given, unknown);
}

AbstractValue AbstractInterpretation::unwritten(const State &state, std::uint32_t variable) const {
  const AbstractValue cell = cellAtEntry(*dialect_, variable);
  return isHavocked(state.havocked, variable) ? cell.withOrigin(std::nullopt) : cell;
}

bool leq(const AbstractInterpretation &interpretation, const AbstractState &a, const AbstractState &b) {
  if (!covers(b.havocked, a.havocked) || !(haveSameModalCalls(a, b) || mayBeTrue(b.modalCallsUnknown)))
    return false;
  if (haveSameParts(a, b))
    return partsLeq(a, b);
  AbstractState left = a;
  AbstractState right = b;
  align(interpretation, left, right);
  dropDifferentModalCalls(left, right);
  return partsLeq(left, right);
}

void joinInto(AbstractInterpretation &interpretation, AbstractState &state, const AbstractState &other) {
  combineInto(interpretation, state, other, [](const AbstractValue &x, const AbstractValue &y) { return join(x, y); });
}

void widenInto(AbstractInterpretation &interpretation, AbstractState &old, const AbstractState &next,
               std::span<const double> thresholds) {
  combineInto(interpretation, old, next,
              [&](const AbstractValue &x, const AbstractValue &y) { return widen(x, join(x, y), thresholds); });
}

// ---- operations on whole states -----------------------------------------------------------------------------------

void AbstractInterpretation::join(State &state, Truth truth, const State &second) {
  if (truth == Truth::True)
    state = second;
  else if (truth == Truth::Maybe)
    joinInto(*this, state, second);
}

void AbstractInterpretation::havocVariables(State &state, std::uint32_t first, std::uint32_t last) {
  forget(state.havocked, {first, last});
  auto &entries = state.variables.entries();
  std::erase_if(entries, [&](const auto &entry) { return first <= entry.first && entry.first <= last; });
}

void AbstractInterpretation::unlistedCode(State &state, const CodeName &, Span place) {
  alarm(Truth::Maybe, {AlarmKind::GCodeNotUsable, place});
  havoc(state, kUnlistedCode, place);
}

namespace {

/// The axes have moved, or a skip signal has stopped them; without a modal call nothing else happens.
void forgetMovement(AbstractInterpretation &interpretation, AbstractState &state, const Dialect &dialect) {
  for (AbstractValue &coordinate : state.position)
    coordinate = interpretation.either(coordinate, AbstractValue::anyNumber());
  auto &cycle = state.cycle; // Z and R are levels of a canned cycle, X and Z those of a turning cycle
  for (AbstractValue *level : {&cycle.bottom, &cycle.retract, &cycle.initial, &cycle.peck, &cycle.dwell})
    *level = interpretation.either(*level, interpretation.anything());
  for (AbstractValue *kept : {&state.kept.first, &state.kept.second})
    *kept = interpretation.either(*kept, interpretation.anything());
  for (AbstractValue &pending : state.transform.pending)
    if (pending.mayBeNumber())
      pending = interpretation.select(interpretation.isVacant(pending), pending,
                                      interpretation.either(pending, AbstractValue::anyNumber()));
  for (const VariableRange &range : dialect.variables)
    if (range.role == VariableRole::SkipPosition)
      interpretation.havocVariables(state, range.first, range.last);
}

void setMotionCode(AbstractState &state, const Dialect &dialect, std::uint16_t digit) {
  const Code *code = findGCode(dialect, static_cast<std::uint16_t>(digit * 10));
  if (const auto index = code ? ModalTable(dialect).indexOf(*code) : std::nullopt)
    state.codes[code->group] = CodeSet::of(*index);
}

} // namespace

void AbstractInterpretation::havoc(State &state, std::string_view reason, Span place) {
  unmodelled(reason, place);
  if (const auto digit = std::ranges::find(kUnreadMotionCodes, reason); digit != kUnreadMotionCodes.end())
    return setMotionCode(state, *dialect_, static_cast<std::uint16_t>(digit - kUnreadMotionCodes.begin()));
  if (reason == kUnreadMovement && state.modalCalls.empty() && !mayBeTrue(state.modalCallsUnknown))
    return forgetMovement(*this, state, *dialect_);
  const bool hasNone = state.modalCalls.empty() && !mayBeTrue(state.modalCallsUnknown);
  const bool keepsModalCalls = !hasModalCalls(*dialect_) || (hasNone && reason == kUnreadWithoutCall);
  havocParts(*this, state, {.polarGroup = polarGroup_, .modalCalls = keepsModalCalls});
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
void AbstractInterpretation::alarmsOfAnyOf(const Value &index, Use use, const Value &value, Span place) {
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
    isProtected =
        isProtected || row.access == (use == Use::Read ? VariableAccess::WriteOnly : VariableAccess::ReadOnly);
    stops = stops || (use == Use::Write && row.role == VariableRole::Alarm);
  }
  if (existing <= range.last - range.first)
    alarm(Truth::Maybe, {AlarmKind::VariableNotAvailable, place});
  if (isProtected)
    alarm(Truth::Maybe, {use == Use::Read ? AlarmKind::ReadProtected : AlarmKind::WriteProtected, place});
  if (stops && observer_ && !stopped_)
    observer_->userAlarm(value, place);
}

AbstractValue AbstractInterpretation::readAnyOf(State &state, const Value &index, Span place) {
  alarmsOfAnyOf(index, Use::Read, index, place);
  const auto range = indicesOf(index);
  if (!range || range->last - range->first > kMostIndices || !cellsBeside(*dialect_, range->first, range->last).empty())
    return anything();
  std::optional<AbstractValue> all;
  for (std::uint32_t variable = range->first; variable <= range->last; ++variable) {
    if (!hasIndex(index, variable))
      continue;
    const VariableRange *row = findVariable(*dialect_, variable);
    AbstractValue one = anything();
    if (row && row->kind == VariableKind::Local && variable <= kLocalVariables)
      one = state.locals[variable];
    else if (row && (row->role == VariableRole::Plain || row->role == VariableRole::Stored ||
                     row->role == VariableRole::AdditionalWorkOffset))
      one = state.variables.find(variable) ? *state.variables.find(variable) : unwritten(state, variable);
    all = all ? feedhold::join(*all, one) : one;
  }
  return all.value_or(anything());
}

bool AbstractInterpretation::writeAnyOf(State &state, const Value &index, const Value &value, Span place) {
  alarmsOfAnyOf(index, Use::Write, value, place);
  const IndexRange range = indicesOf(index).value_or(IndexRange{0, 0xffffffff});
  for (std::uint32_t local = 1; local <= kLocalVariables; ++local)
    if (range.first <= local && local <= range.last && hasIndex(index, local))
      state.locals[local] = feedhold::join(state.locals[local], value).withOrigin(std::nullopt);
  std::vector<std::pair<std::uint32_t, AbstractValue>> kept;
  for (const auto &[variable, old] : state.variables.entries())
    if (range.first <= variable && variable <= range.last)
      kept.emplace_back(variable,
                        hasIndex(index, variable) ? feedhold::join(old, value).withOrigin(std::nullopt) : old);
  forget(state.havocked, {range.first, range.last});
  for (auto &[variable, joined] : kept)
    state.variables.set(variable, joined);
  const std::vector<VariableSpan> beside = cellsBeside(*dialect_, range.first, range.last);
  for (const VariableSpan &other : beside)
    havocVariables(state, other.first, other.last);
  return range.last >= kFirstWorkOffset || !beside.empty();
}

} // namespace feedhold
