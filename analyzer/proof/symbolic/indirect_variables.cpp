// Variables that an index chooses, and variables that change as a range (region_memory.h).
#include "proof/symbolic/path_memory.h"
#include "proof/symbolic/symbolic_interpretation.h"

#include <algorithm>
#include <fmt/format.h>

namespace feedhold::prove {

using smt::Number;
using smt::TermId;

namespace {

constexpr std::uint32_t kFewRead = 64;   // variables: each of them is a case of what is read
constexpr std::uint32_t kFewWritten = 4; // each of them becomes a case of its own
constexpr int kMostChanges = 6;          // that are looked behind for what a variable holds
constexpr int kMostPassed = 64;          // changes of other variables, that are passed over on the way
constexpr std::uint32_t kNoEnd = 0xffffffff;

bool meets(VariableSpan a, VariableSpan b) { return a.first <= b.last && b.first <= a.last; }
bool isIn(VariableSpan span, std::uint32_t variable) { return span.first <= variable && variable <= span.last; }
std::uint32_t countIn(VariableSpan span) { return span.last - span.first + 1; }
VariableSpan rowSpan(const VariableRange &row) { return {row.first, row.last}; }

bool isPlain(const VariableRange &row) { return row.role == VariableRole::Plain || row.role == VariableRole::Stored; }

bool hasChanged(const SymbolicState &state, VariableSpan span) {
  return std::ranges::any_of(state.havocked, [&](const auto &range) {
    return meets(span, {range.first, range.second});
  });
}

/// No change yet: it is the same in every state.
TermId tokenOf(const smt::TermStore &store, const SymbolicState &state) {
  const SymbolicValue *token = state.variables.find(kRegionToken);
  return token ? token->vacant : store.no();
}

} // namespace

// ---- regions ----

void SymbolicInterpretation::changeRegion(State &state, RegionChange change) {
  const VariableSpan span = change.span;
  change.before = tokenOf(store_, state);
  auto &entries = state.variables.entries();
  const auto changes = [&](const auto &entry) { return isIn(span, entry.first) && entry.first != kRegionToken; };
  std::ranges::copy_if(entries, std::back_inserter(change.held), [&](const auto &entry) {
    return changes(entry) && (change.write || staysDefined(entry.first));
  });
  std::erase_if(entries, changes);
  const std::pair range{span.first, span.last};
  if (std::ranges::find(state.havocked, range) == state.havocked.end())
    state.havocked.push_back(range);
  const TermId token = fresh("region", smt::Sort::Bool);
  regionChanges_.emplace(token, std::move(change));
  state.variables.set(kRegionToken, {token, store_.number(Number(0))});
}

void SymbolicInterpretation::havocVariables(State &state, std::uint32_t first, std::uint32_t last) {
  changeRegion(state, {{first, last}, std::nullopt});
}

SymbolicValue SymbolicInterpretation::unwritten(const State &state, std::uint32_t variable) {
  if (variable == kRegionToken)
    return number(0);
  return hasChanged(state, {variable, variable}) ? regionCell(tokenOf(store_, state), variable, 0) : atEntry(variable);
}

/// What a variable holds that states with this token do not keep.
SymbolicValue SymbolicInterpretation::regionCell(TermId token, std::uint32_t variable, int depth) {
  auto known = regionChanges_.find(token);
  for (int passed = 0; known != regionChanges_.end() && !isIn(known->second.span, variable); ++passed) {
    if (passed == kMostPassed)
      return anyCell(token, variable);
    token = known->second.before;
    known = regionChanges_.find(token);
  }
  if (token == store_.no())
    return atEntry(variable);
  if (known != regionChanges_.end() && depth < kMostChanges) {
    const RegionChange &change = known->second;
    const auto old = [&] {
      const auto held = std::ranges::find(change.held, variable, &Cells::value_type::first);
      return held == change.held.end() ? regionCell(change.before, variable, depth + 1) : held->second;
    };
    if (change.write)
      return select({isCell(change.write->index, variable)}, change.write->value, old());
    if (staysDefined(variable)) {
      Value cell = anyCell(token, variable);
      cell.vacant = store_.logicalAnd(cell.vacant, old().vacant);
      return cell;
    }
  }
  return anyCell(token, variable);
}

SymbolicValue SymbolicInterpretation::anyCell(TermId token, std::uint32_t variable) {
  return named(fmt::format("#{} of region {}", variable, token.index()), vacancyIn({variable, variable}));
}

/// A global parameter that has been set once cannot be taken away: no code and no statement does that.
bool SymbolicInterpretation::staysDefined(std::uint32_t variable) const {
  return isGlobalName_ && isGlobalName_(variable) && !dialect_->behaviour.variablesMayBeVacant;
}

std::optional<std::vector<const RegionChange *>> SymbolicInterpretation::changesBetween(const State &before,
                                                                                        const State &after) const {
  std::vector<const RegionChange *> changes;
  const TermId first = tokenOf(store_, before);
  for (TermId token = tokenOf(store_, after); token != first; token = changes.back()->before) {
    const auto known = regionChanges_.find(token);
    if (known == regionChanges_.end())
      return std::nullopt;
    changes.push_back(&known->second);
  }
  return changes;
}

// ---- which variables an index may choose ----

/// An index chooses the variable that it is nearest to.
TermId SymbolicInterpretation::isAmong(TermId index, VariableSpan span) {
  const auto bound = [&](std::uint32_t variable) { return store_.number(Number(static_cast<std::int64_t>(variable))); };
  const bool isWhole = grids_.of(index).value_or(-1) >= 0;
  if (isWhole && span.first == span.last)
    return store_.equal(index, bound(span.first));
  const TermId half = isWhole ? store_.number(Number(0)) : store_.number(Number(1) / Number(2));
  const TermId low = store_.lessOrEqual(store_.subtract(bound(span.first), half), index);
  if (span.last == kNoEnd)
    return low;
  const TermId end = store_.add(bound(span.last), half);
  return store_.logicalAnd(low, isWhole ? store_.lessOrEqual(index, end) : store_.less(index, end));
}

/// That is told for the place, where it is right.  Below 1 the least number above rounds to a variable of its own
/// (0.49999999999999994 + 0.5 is 1).
std::optional<VariableSpan> SymbolicInterpretation::spanOf(const Value &index, Span place) {
  const auto told = place_ ? indexRanges_.find({place_->file.index(), place.begin}) : indexRanges_.end();
  if (!path_ || isContract_ || told == indexRanges_.end() || told->second.last == 0)
    return std::nullopt;
  const VariableSpan span{std::max(told->second.first, 1U), told->second.last};
  TermId claim = isAmong(index.number, span);
  for (const PossibleStop &stop : possibleStops_) // a run that stops before chooses none
    claim = store_.logicalOr(claim, stop.when.term);
  return path_->mayRelyOn(told->first, claim) ? std::optional(span) : std::nullopt;
}

std::set<IndexPlace> SymbolicInterpretation::suggestedIndices() const {
  std::set<IndexPlace> places;
  for (const auto &[place, span] : indexRanges_)
    places.insert(place);
  return places;
}

void SymbolicInterpretation::alarmsOfAnyOf(const Value &index, Use use, const Value &value, Span place) {
  std::vector<TermId> rows;
  std::vector<TermId> guarded;
  TermId stops = store_.no();
  for (const VariableRange &row : dialect_->variables) {
    rows.push_back(isAmong(index.number, rowSpan(row)));
    if (row.access == (use == Use::Read ? VariableAccess::WriteOnly : VariableAccess::ReadOnly))
      guarded.push_back(rows.back());
    if (use == Use::Write && row.role == VariableRole::Alarm)
      stops = store_.logicalOr(stops, rows.back());
  }
  alarm({store_.logicalNot(store_.logicalOr(rows))}, {AlarmKind::VariableNotAvailable, place});
  alarm({store_.logicalOr(guarded)}, {use == Use::Read ? AlarmKind::ReadProtected : AlarmKind::WriteProtected, place});
  if (mayBe({stops}) && !stopped_)
    possibleStops_.push_back({{stops}, std::nullopt, value, place});
}

// ---- reading ----

SymbolicValue SymbolicInterpretation::readAnyOf(State &state, const Value &index, Span place) {
  alarmsOfAnyOf(index, Use::Read, index, place);
  const auto span = spanOf(index, place);
  return span && isStored(*span) ? readAmong(state, index.number, *span) : anything();
}

/// Each variable of the span is a cell of its own that keeps what was written.
bool SymbolicInterpretation::isStored(VariableSpan span) const {
  const auto keeps = [](const VariableRange &row) {
    switch (row.role) {
    case VariableRole::Plain:
    case VariableRole::Stored:
    case VariableRole::WorkOffset:
    case VariableRole::AdditionalWorkOffset: return true;
    case VariableRole::Volatile:
    case VariableRole::Signal:
    case VariableRole::SignalWord:
    case VariableRole::Clock:
    case VariableRole::Alarm:
    case VariableRole::MessageStop:
    case VariableRole::ModalCode:
    case VariableRole::ModalWord:
    case VariableRole::BlockEndPosition:
    case VariableRole::MachinePosition:
    case VariableRole::WorkPosition:
    case VariableRole::SkipPosition:
    case VariableRole::SetOffset:
    case VariableRole::WorkRotation:
    case VariableRole::Reference:
    case VariableRole::SecondReference:
    case VariableRole::Pi:
    case VariableRole::EulersNumber:
    case VariableRole::Predefined: return false;
    }
    return false;
  };
  return cellsBeside(*dialect_, span.first, span.last).empty() &&
         std::ranges::all_of(dialect_->variables,
                             [&](const VariableRange &row) { return !meets(span, rowSpan(row)) || keeps(row); });
}

SymbolicInterpretation::MayBeVacant SymbolicInterpretation::vacancyIn(VariableSpan span) const {
  const auto rows = [&](auto holds) {
    return std::ranges::any_of(dialect_->variables, [&](const VariableRange &row) {
      return meets(span, rowSpan(row)) && holds(row.kind == VariableKind::System);
    });
  };
  const bool isSystem = rows([](bool system) { return system; }) && !rows([](bool system) { return !system; });
  return isSystem ? MayBeVacant::No : MayBeVacant::Yes;
}

/// Of a variable that an index may choose.  Nobody shows that a caller has left a number in it that can be typed:
/// callers answer for the variables that a program names (families/call_inputs.cpp).
SymbolicValue SymbolicInterpretation::heldIn(const State &state, std::uint32_t variable) {
  if (const Value *written = state.variables.find(variable))
    return *written;
  const bool before = std::exchange(assumesTyped_, false);
  const Value value = unwritten(state, variable);
  assumesTyped_ = before;
  return value;
}

/// The cell that the index chooses, where it is one of these.
SymbolicValue SymbolicInterpretation::chosen(TermId index, const Cells &cells, Value otherwise) {
  for (const auto &[variable, value] : cells)
    otherwise = select({isCell(index, variable)}, value, otherwise);
  return otherwise;
}

/// The index lies in the span; the control stops at those of its numbers that it does not have.
SymbolicValue SymbolicInterpretation::readAmong(const State &state, TermId index, VariableSpan span) {
  if (span.first <= kLocalVariables) // likewise: what has been passed to the program was typed only if it names it
    return anything();
  Cells cells;
  if (countIn(span) <= kFewRead && span.last != kNoEnd) {
    for (std::uint32_t variable = span.first; variable <= span.last; ++variable)
      if (findVariable(*dialect_, variable))
        cells.emplace_back(variable, heldIn(state, variable));
    if (cells.empty())
      return anything();
    const Value last = cells.back().second;
    cells.pop_back();
    return chosen(index, cells, last);
  }
  std::ranges::copy_if(state.variables.entries(), std::back_inserter(cells),
                       [&](const auto &entry) { return isIn(span, entry.first); });
  if (cells.size() > kFewRead)
    return anything();
  return chosen(index, cells,
                hasChanged(state, span) ? regionAt(tokenOf(store_, state), index, span, 0) : startAt(index));
}

/// What the variable holds that the index chooses, if it is none that states with this token keep.
SymbolicValue SymbolicInterpretation::regionAt(TermId token, TermId index, VariableSpan span, int depth) {
  const auto known = regionChanges_.find(token);
  if (token == store_.no())
    return startAt(index);
  if (known != regionChanges_.end() && depth < kMostChanges) {
    const RegionChange &change = known->second;
    if (!meets(change.span, span))
      return regionAt(change.before, index, span, depth + 1);
    if (change.write && change.write->index == index && change.write->isInSpan)
      return change.write->value;
    const TermId apart = change.write ? store_.subtract(index, change.write->index) : index;
    const bool isOther = change.write && store_.isNumber(apart) &&
                         !(store_[apart].number < Number(1) && Number(-1) < store_[apart].number);
    if (isOther && change.held.size() <= kFewRead)
      return chosen(index, change.held, regionAt(change.before, index, span, depth + 1));
  }
  return named(fmt::format("#[{}] of region {}", index.index(), token.index()), MayBeVacant::Yes);
}

/// One value for each term: equal indices that are written differently are not known to find the same.
SymbolicValue SymbolicInterpretation::startAt(TermId index) {
  if (given_)
    return anything();
  const Value value = named(fmt::format("#[{}] at the start", index.index()), MayBeVacant::Yes);
  startReads_.emplace(index, value);
  const auto &variables = smt::variablesOf(store_, index);
  if (std::ranges::all_of(variables, [&](TermId variable) { return isFromEntry(variable); })) {
    entry_.insert(value.number);
    entry_.insert(value.vacant);
  }
  return value;
}

// ---- writing ----

bool SymbolicInterpretation::writeAnyOf(State &state, const Value &index, const Value &value, Span place) {
  alarmsOfAnyOf(index, Use::Write, value, place);
  const auto span = spanOf(index, place);
  return span ? writeAmong(state, index.number, value, *span) : writeAnywhere(state, index);
}

/// Whether a zero point may have moved.
bool SymbolicInterpretation::writeAmong(State &state, TermId index, const Value &value, VariableSpan span) {
  std::vector<VariableRange> rows; // those that lie side by side and are of one kind as one
  for (VariableRange row : dialect_->variables) {
    if (row.access == VariableAccess::ReadOnly || !meets(span, rowSpan(row)))
      continue;
    row.first = std::max(row.first, span.first);
    row.last = std::min(row.last, span.last);
    if (!rows.empty() && rows.back().last + 1 == row.first && rows.back().kind == row.kind && isPlain(rows.back()) &&
        isPlain(row))
      rows.back().last = row.last;
    else
      rows.push_back(row);
  }
  bool mayMoveZero = false;
  for (const VariableRange &row : rows)
    mayMoveZero |= writeRow(state, row, {index, value, row.first == span.first && row.last == span.last});
  return mayMoveZero;
}

/// To the part of a row that the index may choose.
bool SymbolicInterpretation::writeRow(State &state, const VariableRange &row, const RegionWrite &write) {
  const VariableSpan span = rowSpan(row);
  const bool isFew = countIn(span) <= kFewWritten;
  if (row.kind == VariableKind::Local && span.last <= kLocalVariables) {
    for (std::uint32_t local = span.first; local <= span.last; ++local)
      state.locals[local] = isFew ? select({isCell(write.index, local)}, write.value, state.locals[local]) : anything();
    return false;
  }
  const std::vector<VariableSpan> beside = cellsBeside(*dialect_, span.first, span.last);
  const Value value = row.kind == VariableKind::System ? asNumber(write.value) : write.value;
  if (!isPlain(row) || !beside.empty()) {
    changeRegion(state, {span, std::nullopt});
    for (const VariableSpan &other : beside)
      changeRegion(state, {other, std::nullopt});
    return true;
  }
  if (!isFew)
    changeRegion(state, {span, RegionWrite{write.index, value, write.isInSpan}});
  else
    for (std::uint32_t variable = span.first; variable <= span.last; ++variable)
      state.variables.set(variable, select({isCell(write.index, variable)}, value, heldIn(state, variable)));
  return false;
}

/// Of the index nothing is known but the conditions of the path.
bool SymbolicInterpretation::writeAnywhere(State &state, const Value &index) {
  bool mayMoveZero = false;
  for (const VariableRange &row : dialect_->variables) {
    if (row.access == VariableAccess::ReadOnly)
      continue;
    if (path_ && path_->proves(store_.logicalNot(isAmong(index.number, rowSpan(row)))))
      continue;
    if (row.kind == VariableKind::Local) {
      for (std::size_t local = 1; local < state.locals.size(); ++local)
        state.locals[local] = anything();
      continue;
    }
    havocVariables(state, row.first, row.last);
    const std::vector<VariableSpan> beside = cellsBeside(*dialect_, row.first, row.last);
    for (const VariableSpan &other : beside)
      havocVariables(state, other.first, other.last);
    mayMoveZero |= !isPlain(row) || !beside.empty();
  }
  return mayMoveZero;
}

} // namespace feedhold::prove
