// Entailment on a path: a question to discharge, with what has to do with it.
#pragma once

#include "proof/prove/discharge.h"

#include <map>
#include <span>
#include <vector>

namespace feedhold::prove {

/// The facts and conditions that speak of a variable of the goal, or of one that such a condition speaks of, and so on.
/// Leaving others out loses proofs and never makes one.
Query relevantQuery(const smt::TermStore &store, std::span<const smt::TermId> facts,
                    std::span<const smt::TermId> conditions, smt::TermId goal);

/// Quick answers for whoever follows paths, each given once.
class Entailment {
public:
  explicit Entailment(smt::TermStore &store) : store_(store) {}
  bool operator()(std::span<const smt::TermId> facts, std::span<const smt::TermId> conditions, smt::TermId goal);

private:
  smt::TermStore &store_;
  std::map<std::vector<smt::TermId>, bool> known_; // by assumptions, the goal last
};

} // namespace feedhold::prove
