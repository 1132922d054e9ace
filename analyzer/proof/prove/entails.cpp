#include "proof/prove/entails.h"

#include <algorithm>
#include <set>

namespace feedhold::prove {

using smt::TermId;

namespace {

/// Conditions with their variables, taken over as soon as one of those is wanted.
class Relevant {
public:
  Relevant(const smt::TermStore &store, TermId goal) : store_(store) { want(smt::variablesOf(store, goal)); }

  void offer(std::span<const TermId> conditions) {
    for (const TermId condition : conditions)
      offered_.push_back({condition, smt::variablesOf(store_, condition)});
  }
  std::vector<TermId> take() {
    std::vector<TermId> taken;
    for (bool more = true; more;) {
      more = false;
      for (Offer &offer : offered_) {
        if (offer.taken || std::none_of(offer.variables.begin(), offer.variables.end(),
                                        [&](TermId variable) { return wanted_.contains(variable); }))
          continue;
        offer.taken = more = true;
        want(offer.variables);
      }
    }
    for (const Offer &offer : offered_)
      if (offer.taken)
        taken.push_back(offer.condition);
    return taken;
  }

private:
  struct Offer {
    TermId condition;
    std::vector<TermId> variables;
    bool taken = false;
  };
  void want(const std::vector<TermId> &variables) { wanted_.insert(variables.begin(), variables.end()); }

  const smt::TermStore &store_;
  std::set<TermId> wanted_;
  std::vector<Offer> offered_;
};

} // namespace

Query relevantQuery(const smt::TermStore &store, std::span<const TermId> facts, std::span<const TermId> conditions,
                    TermId goal) {
  Relevant relevant(store, goal);
  relevant.offer(facts);
  relevant.offer(conditions);
  return {relevant.take(), goal};
}

bool Entailment::operator()(std::span<const TermId> facts, std::span<const TermId> conditions, TermId goal) {
  if (goal == store_.yes() || std::find(conditions.begin(), conditions.end(), goal) != conditions.end())
    return true;
  const Query query = relevantQuery(store_, facts, conditions, goal);
  std::vector<TermId> key = query.assumptions;
  key.push_back(goal);
  const auto known = known_.find(key);
  if (known != known_.end())
    return known->second;
  const bool holds = discharge(store_, query, Budget::quick()).proved();
  known_.emplace(std::move(key), holds);
  return holds;
}

} // namespace feedhold::prove
