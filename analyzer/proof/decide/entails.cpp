#include "proof/decide/entails.h"

#include "proof/smt/steps.h"

#include <algorithm>
#include <set>

namespace feedhold::prove {

using smt::TermId;

void FactIndex::add(std::span<const TermId> facts) {
  for (const TermId fact : facts.subspan(std::min(indexed_.size(), facts.size()))) {
    const std::vector<TermId> &variables = smt::variablesOf(store_, fact);
    smt::spend(5 + 10 * variables.size());
    for (const TermId variable : variables)
      users_[variable.index()].push_back(indexed_.size());
    indexed_.push_back(fact);
  }
}

void FactIndex::follow(std::span<const TermId> conditions) {
  const auto parted = std::ranges::mismatch(indexed_, conditions).in1;
  const auto kept = static_cast<std::size_t>(parted - indexed_.begin());
  while (indexed_.size() > kept) {
    for (const TermId variable : smt::variablesOf(store_, indexed_.back()))
      users_[variable.index()].pop_back(); // the last condition is the last of each of its variables
    indexed_.pop_back();
  }
  smt::spend(kept / 16);
  add(conditions);
}

const std::vector<std::size_t> *FactIndex::factsOn(TermId variable) const {
  const auto found = users_.find(variable.index());
  return found == users_.end() ? nullptr : &found->second;
}

namespace {

/// Follows variables to what speaks of them, and on to its variables.
class Relevant {
public:
  Relevant(const smt::TermStore &store, const FactIndex &ofFacts, const FactIndex &ofConditions,
           std::span<const TermId> facts, std::span<const TermId> conditions)
      : store_(store), ofFacts_(ofFacts), ofConditions_(ofConditions), facts_(facts), conditions_(conditions) {}

  std::vector<TermId> to(TermId goal) {
    want(goal);
    while (!open_.empty()) {
      const TermId variable = open_.back();
      open_.pop_back();
      take(ofFacts_, variable, facts_, takenFacts_);
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
  const FactIndex &ofFacts_;
  const FactIndex &ofConditions_;
  std::span<const TermId> facts_;
  std::span<const TermId> conditions_;
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
  FactIndex ofConditions(store);
  ofConditions.add(conditions);
  return {Relevant(store, index, ofConditions, facts, conditions).to(goal), goal};
}

namespace {
constexpr std::uint64_t kWorkOfTerm = 20;        // to look at it, compared with a step of the search
constexpr std::uint64_t kConditionsOfWork = 100; // that are compared with those of the question before
} // namespace

bool Entailment::operator()(std::span<const TermId> facts, std::span<const TermId> conditions, TermId goal) {
  if (goal == store_.yes() || std::find(conditions.begin(), conditions.end(), goal) != conditions.end())
    return true;
  if (isExhausted())
    return false;
  ofFacts_.add(facts);
  ofConditions_.follow(conditions);
  const Query query{Relevant(store_, ofFacts_, ofConditions_, facts, conditions).to(goal), goal};
  std::vector<TermId> key = query.assumptions;
  key.push_back(goal);
  const auto known = known_.find(key);
  work_ += kWorkOfTerm * key.size() + conditions.size() / kConditionsOfWork;
  if (known != known_.end())
    return known->second;
  if (models_.refute(query)) {
    known_.emplace(std::move(key), false);
    return false;
  }
  const Outcome outcome = discharge(store_, query, budget_);
  work_ += outcome.effort;
  if (const smt::Model *model = outcome.counterexample())
    models_.add(*model);
  known_.emplace(std::move(key), outcome.proved());
  return outcome.proved();
}

} // namespace feedhold::prove
