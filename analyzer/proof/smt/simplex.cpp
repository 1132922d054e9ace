#include "proof/smt/simplex.h"

#include "base/support/check.h"
#include "proof/smt/steps.h"

namespace feedhold::smt {
namespace {

/// Of reckoning with a number: digits multiply in a tableau.
std::uint64_t costOf(const Number &number) {
  const std::uint64_t words = number.words();
  return 1 + words * words / 8;
}

} // namespace

Simplex::Column Simplex::addColumn(const Number &start) {
  variables_.emplace_back();
  variables_.back().value.real = start;
  return static_cast<Column>(variables_.size() - 1);
}

void Simplex::require(std::uint32_t reason, const Form &form, const Number &constant, LinearRelation relation) {
  if (infeasible_)
    return;
  if (form.empty()) {
    const int sign = constant.sign();
    const bool holds = relation == LinearRelation::Zero       ? sign == 0
                       : relation == LinearRelation::Positive ? sign > 0
                                                              : sign >= 0;
    if (holds)
      return;
    conflict_ = {{reason, Number(relation == LinearRelation::Zero && sign > 0 ? -1 : 1)}};
    infeasible_ = true;
    trail_.push_back({0, Change::Side::Conflict, {}});
    return;
  }
  const Number first = form.front().second;
  Form normalized = form;
  for (auto &part : normalized)
    part.second /= first;
  const Index index = variableOf(normalized);
  // form + constant = first * (row - limit)
  DeltaNumber limit{-constant / first, Number()};
  const Number multiplier = Number(1) / first;
  if (relation == LinearRelation::Zero) {
    bound(index, Change::Side::Lower, {limit, reason, multiplier});
    if (!infeasible_)
      bound(index, Change::Side::Upper, {limit, reason, -multiplier});
    return;
  }
  const bool isLower = first.sign() > 0;
  if (relation == LinearRelation::Positive)
    limit.infinitesimal = Number(isLower ? 1 : -1);
  bound(index, isLower ? Change::Side::Lower : Change::Side::Upper, {limit, reason, abs(multiplier)});
}

Simplex::Index Simplex::variableOf(const Form &normalized) {
  if (normalized.size() == 1)
    return normalized.front().first;
  auto [known, isNew] = rows_.try_emplace(normalized, static_cast<Index>(variables_.size()));
  if (isNew) {
    variables_.emplace_back();
    variables_.back().place = Place::Detached;
    variables_.back().definition = normalized;
  }
  if (variables_[known->second].place == Place::Detached)
    attach(known->second);
  return known->second;
}

void Simplex::attach(Index index) {
  std::map<Index, Number> row;
  auto add = [&](Index column, const Number &factor) {
    Number &place = row[column];
    place += factor;
    if (place.isZero())
      row.erase(column);
  };
  DeltaNumber value;
  for (const auto &[column, factor] : variables_[index].definition) {
    const Variable &variable = variables_[column];
    value += variable.value * factor;
    work_ += costOf(value.real);
    if (variable.place == Place::Nonbasic)
      add(column, factor);
    else
      for (const auto &[inner, innerFactor] : variable.row)
        add(inner, innerFactor * factor);
    work_ += 1 + variable.row.size();
  }
  spend(20 * variables_[index].definition.size() + 10 * row.size());
  Variable &variable = variables_[index];
  variable.row = std::move(row);
  variable.value = value;
  variable.place = Place::Basic;
}

void Simplex::bound(Index index, Change::Side side, Bound bound) {
  Variable &variable = variables_[index];
  const bool isLower = side == Change::Side::Lower;
  std::optional<Bound> &mine = isLower ? variable.lower : variable.upper;
  const std::optional<Bound> &other = isLower ? variable.upper : variable.lower;
  if (mine && (isLower ? bound.limit <= mine->limit : bound.limit >= mine->limit))
    return;
  if (other && (isLower ? bound.limit > other->limit : bound.limit < other->limit)) {
    conflict_.clear();
    addTo(conflict_, bound, 1);
    addTo(conflict_, *other, 1);
    infeasible_ = true;
    trail_.push_back({0, Change::Side::Conflict, {}});
    return;
  }
  trail_.push_back({index, side, std::move(mine)});
  mine = std::move(bound);
  const bool outside = isLower ? variable.value < mine->limit : variable.value > mine->limit;
  if (outside && variable.place == Place::Nonbasic)
    shift(index, mine->limit - variable.value);
}

/// A nonbasic variable moves, and with it all basic ones that depend on it.
void Simplex::shift(Index index, const DeltaNumber &step) {
  variables_[index].value += step;
  spend(2 * variables_.size());
  for (Variable &variable : variables_) {
    if (variable.place != Place::Basic)
      continue;
    auto found = variable.row.find(index);
    if (found == variable.row.end())
      continue;
    variable.value += step * found->second;
    work_ += costOf(variable.value.real);
  }
}

void Simplex::undo(Mark mark) {
  while (trail_.size() > mark) {
    Change &change = trail_.back();
    if (change.side == Change::Side::Conflict) { // of constants alone: there may be no variable
      infeasible_ = false;
      trail_.pop_back();
      continue;
    }
    Variable &variable = variables_[change.variable];
    (change.side == Change::Side::Lower ? variable.lower : variable.upper) = std::move(change.before);
    // A row without bounds says nothing; it would only be carried along.
    if (variable.place == Place::Basic && !variable.lower && !variable.upper && !variable.definition.empty()) {
      variable.place = Place::Detached;
      variable.row.clear();
    }
    trail_.pop_back();
  }
  if (feasibleMark_ < mark)
    return;
  feasibleMark_ = mark;
  restore();
}

/// The last feasible point satisfies what is left of the bounds; where a failed check stopped, need not.
void Simplex::restore() {
  for (const auto &[column, value] : feasible_)
    variables_[column].value = value;
  for (Variable &variable : variables_) {
    if (variable.definition.empty() || variable.place == Place::Detached)
      continue;
    variable.value = {};
    for (const auto &[column, factor] : variable.definition)
      variable.value += variables_[column].value * factor;
    work_ += variable.definition.size();
  }
}

void Simplex::remember() {
  feasibleMark_ = trail_.size();
  feasible_.clear();
  for (Index index = 0; index < variables_.size(); ++index)
    if (variables_[index].definition.empty())
      feasible_.emplace_back(index, variables_[index].value);
}

Simplex::Status Simplex::check(std::uint64_t workLimit) {
  while (!infeasible_) {
    std::optional<Index> leaving = violated();
    if (!leaving) {
      remember();
      return Status::Feasible;
    }
    if (work_ > workLimit)
      return Status::OutOfBudget;
    const Variable &basic = variables_[*leaving];
    const Change::Side side =
        basic.lower && basic.value < basic.lower->limit ? Change::Side::Lower : Change::Side::Upper;
    std::optional<Index> enters = entering(basic, side);
    if (!enters) {
      explain(basic, side);
      infeasible_ = true;
      trail_.push_back({0, Change::Side::Conflict, {}});
      break;
    }
    const DeltaNumber target = side == Change::Side::Lower ? basic.lower->limit : basic.upper->limit;
    const Number rate = basic.row.at(*enters);
    shift(*enters, (target - basic.value) * (Number(1) / rate));
    pivot(*leaving, *enters);
  }
  return Status::Infeasible;
}

/// The first of them (Bland's rule, which cannot cycle).
std::optional<Simplex::Index> Simplex::violated() const {
  spend(variables_.size());
  for (Index index = 0; index < variables_.size(); ++index) {
    const Variable &variable = variables_[index];
    if (variable.place == Place::Basic && ((variable.lower && variable.value < variable.lower->limit) ||
                                           (variable.upper && variable.value > variable.upper->limit)))
      return index;
  }
  return std::nullopt;
}

std::optional<Simplex::Index> Simplex::entering(const Variable &leaving, Change::Side side) const {
  for (const auto &[index, factor] : leaving.row) {
    const Variable &variable = variables_[index];
    const bool mustRise = (side == Change::Side::Lower) == (factor.sign() > 0);
    if (mustRise ? !variable.upper || variable.value < variable.upper->limit
                 : !variable.lower || variable.value > variable.lower->limit)
      return index;
  }
  return std::nullopt;
}

void Simplex::pivot(Index basic, Index nonbasic) {
  std::map<Index, Number> row = std::move(variables_[basic].row);
  const Number rate = row.at(nonbasic);
  row.erase(nonbasic);
  for (auto &part : row)
    part.second /= -rate;
  row.emplace(basic, Number(1) / rate);
  work_ += row.size();
  variables_[basic].row.clear();
  variables_[basic].place = Place::Nonbasic;
  for (Variable &variable : variables_) {
    if (variable.place != Place::Basic)
      continue;
    auto found = variable.row.find(nonbasic);
    if (found == variable.row.end())
      continue;
    spend(10 * row.size());
    const Number factor = std::move(found->second);
    variable.row.erase(found);
    for (const auto &[index, coefficient] : row) {
      auto [place, isNew] = variable.row.try_emplace(index);
      place->second += coefficient * factor;
      work_ += costOf(place->second);
      if (place->second.isZero())
        variable.row.erase(place);
    }
  }
  variables_[nonbasic].row = std::move(row);
  variables_[nonbasic].place = Place::Basic;
}

/// Each bound of the row that stops the basic variable, in the measure in which it does.
void Simplex::explain(const Variable &basic, Change::Side side) {
  conflict_.clear();
  const bool isLower = side == Change::Side::Lower;
  addTo(conflict_, isLower ? *basic.lower : *basic.upper, 1);
  for (const auto &[index, factor] : basic.row) {
    const Variable &variable = variables_[index];
    addTo(conflict_, isLower == (factor.sign() > 0) ? *variable.upper : *variable.lower, abs(factor));
  }
}

void Simplex::addTo(Conflict &conflict, const Bound &bound, const Number &factor) const {
  auto [place, isNew] = conflict.try_emplace(bound.reason);
  place->second += bound.multiplier * factor;
  if (place->second.isZero())
    conflict.erase(place);
}

Number Simplex::smallDelta() const {
  Number delta(1);
  auto fit = [&](const DeltaNumber &below, const DeltaNumber &above) {
    if (below.infinitesimal <= above.infinitesimal)
      return;
    const Number most = (above.real - below.real) / (below.infinitesimal - above.infinitesimal);
    if (most < delta)
      delta = most;
  };
  for (const Variable &variable : variables_) {
    if (variable.place == Place::Detached)
      continue;
    if (variable.lower)
      fit(variable.lower->limit, variable.value);
    if (variable.upper)
      fit(variable.value, variable.upper->limit);
  }
  return delta;
}

} // namespace feedhold::smt
