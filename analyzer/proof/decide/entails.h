// Entailment on a path: a query with the facts and conditions that are relevant to it.
#pragma once

#include "proof/decide/discharge.h"
#include "proof/decide/known_models.h"

#include <map>
#include <span>
#include <unordered_map>
#include <utility>
#include <vector>

namespace feedhold::prove {

/// The facts and conditions that speak of a variable of the goal, or of one that such a condition speaks of, and so on.
/// Leaving others out loses proofs and never makes one.
Query relevantQuery(const smt::TermStore &store, std::span<const smt::TermId> facts,
                    std::span<const smt::TermId> conditions, smt::TermId goal);

/// Which facts, or conditions of a path, speak of a variable.
class FactIndex {
public:
  explicit FactIndex(const smt::TermStore &store) : store_(store) {}
  /// All facts, those that are known already included: the facts only ever grow.
  void add(std::span<const smt::TermId> facts);
  /// Others, which mostly begin as the last ones did: paths grow, and return to where they parted.
  void follow(std::span<const smt::TermId> conditions);
  /// By number; null: none.
  const std::vector<std::size_t> *factsOn(smt::TermId variable) const;

private:
  const smt::TermStore &store_;
  std::vector<smt::TermId> indexed_;
  std::unordered_map<std::uint32_t, std::vector<std::size_t>> users_; // by variable
};

/// The same, with an index that has all the facts.
Query relevantQuery(const smt::TermStore &store, const FactIndex &index, std::span<const smt::TermId> facts,
                    std::span<const smt::TermId> conditions, smt::TermId goal);

/// Quick answers for the explorer, memoised.
class Entailment {
public:
  explicit Entailment(smt::TermStore &store) : store_(store), ofFacts_(store), ofConditions_(store), models_(store) {}
  /// The facts are those of the question before, and perhaps more.
  /// False when there is no work left to find out.
  bool operator()(std::span<const smt::TermId> facts, std::span<const smt::TermId> conditions, smt::TermId goal);

  /// How much work all questions together may still take; Outcome::effort and what putting a question takes.
  void allow(std::uint64_t work) { allowed_ = work; }
  std::uint64_t work() const { return work_; }
  /// Nothing is asked any more.
  bool isExhausted() const { return work_ >= allowed_; }
  /// Of a question from now on; what it was before.
  Budget spendAtMost(const Budget &budget) { return std::exchange(budget_, budget); }

private:
  smt::TermStore &store_;
  FactIndex ofFacts_;
  FactIndex ofConditions_;
  KnownModels models_;
  std::map<std::vector<smt::TermId>, bool> known_; // by assumptions, the goal last
  Budget budget_ = Budget::quick();                // of a question
  std::uint64_t work_ = 0;
  std::uint64_t allowed_ = ~std::uint64_t{0};
};

} // namespace feedhold::prove
