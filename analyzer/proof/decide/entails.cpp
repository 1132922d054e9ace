#include "proof/decide/entails.h"

#include "proof/smt/steps.h"

#include <algorithm>
#include <set>

namespace feedhold::prove {

using smt::TermId;

void FactIndex::add(std::span<const TermId> facts) {
  for (; indexed_ < facts.size(); ++indexed_) {
    const std::vector<TermId> &variables = smt::variablesOf(store_, facts[indexed_]);
    smt::spend(5 + 10 * variables.size());
    for (const TermId variable : variables)
      users_[variable].push_back(indexed_);
  }
}

const std::vector<std::size_t> *FactIndex::factsOn(TermId variable) const {
  const auto found = users_.find(variable);
  return found == users_.end() ? nullptr : &found->second;
}

namespace {

/// Follows variables to what speaks of them, and on to its variables.
class Relevant {
public:
  Relevant(const smt::TermStore &store, const FactIndex &index, std::span<const TermId> facts,
           std::span<const TermId> conditions)
      : store_(store), index_(index), facts_(facts), conditions_(conditions), ofConditions_(store) {
    ofConditions_.add(conditions);
  }

  std::vector<TermId> to(TermId goal) {
    want(goal);
    while (!open_.empty()) {
      const TermId variable = open_.back();
      open_.pop_back();
      take(index_, variable, facts_, takenFacts_);
      take(ofConditions_, variable, conditions_, takenConditions_);
    }
    std::vector<TermId> taken;
    collect(facts_, takenFacts_, taken);
    collect(conditions_, takenConditions_, taken);
    return taken;
  }

private:
  void want(TermId term) {
    for (const TermId variable : smt::variablesOf(store_, term))
      if (wanted_.insert(variable).second)
        open_.push_back(variable);
  }
  void take(const FactIndex &index, TermId variable, std::span<const TermId> terms, std::set<std::size_t> &taken) {
    const auto *users = index.factsOn(variable);
    if (!users)
      return;
    smt::spend(5 * users->size());
    for (const std::size_t user : *users)
      if (user < terms.size() && taken.insert(user).second)
        want(terms[user]);
  }
  static void collect(std::span<const TermId> terms, const std::set<std::size_t> &taken, std::vector<TermId> &into) {
    for (const std::size_t user : taken)
      into.push_back(terms[user]);
  }

  const smt::TermStore &store_;
  const FactIndex &index_;
  std::span<const TermId> facts_;
  std::span<const TermId> conditions_;
  FactIndex ofConditions_;
  std::set<std::size_t> takenFacts_; // their places: a query takes few of many
  std::set<std::size_t> takenConditions_;
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
