#include "proof/decide/entails.h"

#include "proof/smt/steps.h"

#include <algorithm>
#include <functional>
#include <set>

namespace feedhold::prove {

using smt::TermId;

void FactIndex::add(std::span<const TermId> facts) {
  for (; indexed_ < facts.size(); ++indexed_) {
    const std::vector<TermId> &variables = smt::variablesOf(store_, facts[indexed_]);
    smt::spend(5 + 10 * variables.size());
    for (const TermId variable : variables)
      users_[variable.index()].push_back(indexed_);
  }
}

const std::vector<std::size_t> *FactIndex::factsOn(TermId variable) const {
  const auto found = users_.find(variable.index());
  return found == users_.end() ? nullptr : &found->second;
}

namespace {

/// Follows variables to what speaks of them, and on to its variables.
class Relevant {
public:
  Relevant(const smt::TermStore &store, const FactIndex &index, std::span<const TermId> facts,
           std::span<const TermId> conditions)
      : store_(store), index_(index), facts_(facts), conditions_(conditions), areTaken_(conditions.size()) {
    for (std::size_t i = 0; i < conditions.size(); ++i)
      for (const TermId variable : smt::variablesOf(store, conditions[i]))
        ofConditions_.emplace_back(variable, i);
    smt::spend(5 * (conditions.size() + ofConditions_.size()));
    std::ranges::sort(ofConditions_);
  }

  std::vector<TermId> to(TermId goal) {
    want(goal);
    while (!open_.empty()) {
      const TermId variable = open_.back();
      open_.pop_back();
      takeFacts(variable);
      takeConditions(variable);
    }
    std::vector<TermId> taken;
    for (const std::size_t fact : takenFacts_)
      taken.push_back(facts_[fact]);
    for (std::size_t i = 0; i < conditions_.size(); ++i)
      if (areTaken_[i])
        taken.push_back(conditions_[i]);
    return taken;
  }

private:
  void want(TermId term) {
    for (const TermId variable : smt::variablesOf(store_, term))
      if (wanted_.insert(variable).second)
        open_.push_back(variable);
  }
  void takeFacts(TermId variable) {
    const auto *users = index_.factsOn(variable);
    if (!users)
      return;
    smt::spend(5 * users->size());
    for (const std::size_t user : *users)
      if (user < facts_.size() && takenFacts_.insert(user).second)
        want(facts_[user]);
  }
  void takeConditions(TermId variable) {
    const auto users = std::ranges::equal_range(ofConditions_, variable, std::less(), &VariableOf::first);
    smt::spend(5 * users.size());
    for (const VariableOf &user : users)
      if (!areTaken_[user.second]) {
        areTaken_[user.second] = true;
        want(conditions_[user.second]);
      }
  }

  using VariableOf = std::pair<TermId, std::size_t>; // with the place of a condition

  const smt::TermStore &store_;
  const FactIndex &index_;
  std::span<const TermId> facts_;
  std::span<const TermId> conditions_;
  std::vector<VariableOf> ofConditions_; // sorted: there are few, and most are asked for once
  std::vector<bool> areTaken_;           // by place
  std::set<std::size_t> takenFacts_;     // their places: a query takes few of many
  std::set<TermId> wanted_;
  std::vector<TermId> open_;
};

} // namespace

Query relevantQuery(const smt::TermStore &store, std::span<const TermId> facts, std::span<const TermId> conditions,
                    TermId goal) {
  FactIndex index(store);
  index.add(facts);
  return relevantQuery(store, index, facts, conditions, goal);
}

Query relevantQuery(const smt::TermStore &store, const FactIndex &index, std::span<const TermId> facts,
                    std::span<const TermId> conditions, TermId goal) {
  if (smt::areStepsUsedUp()) // it will not be asked
    return {{}, goal};
  return {Relevant(store, index, facts, conditions).to(goal), goal};
}

namespace {
constexpr std::uint64_t kWorkOfTerm = 20; // to look at it, compared with a step of the search
}

bool Entailment::operator()(std::span<const TermId> facts, std::span<const TermId> conditions, TermId goal) {
  if (goal == store_.yes() || std::find(conditions.begin(), conditions.end(), goal) != conditions.end())
    return true;
  if (work_ >= allowed_)
    return false;
  index_.add(facts);
  const Query query{Relevant(store_, index_, facts, conditions).to(goal), goal};
  std::vector<TermId> key = query.assumptions;
  key.push_back(goal);
  const auto known = known_.find(key);
  work_ += kWorkOfTerm * (key.size() + conditions.size());
  if (known != known_.end())
    return known->second;
  const Outcome outcome = discharge(store_, query, budget_);
  work_ += outcome.effort;
  known_.emplace(std::move(key), outcome.proved());
  return outcome.proved();
}

} // namespace feedhold::prove
