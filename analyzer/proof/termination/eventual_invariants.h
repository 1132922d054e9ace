// Eventual invariants: facts that hold before every iteration of a loop from some iteration on, found by trial over the
// recorded iterations.
//
// A fact that one iteration establishes and every iteration preserves holds from then on.  If it holds on arrival, it
// holds before every iteration.
#pragma once

#include "proof/decide/entails.h"
#include "proof/explore/exploration.h"

#include <set>
#include <span>

namespace feedhold::prove {

class EventualInvariants {
public:
  EventualInvariants(const SymbolicInterpretation &interpretation, smt::TermStore &store, const LoopInstance &loop)
      : interpretation_(interpretation), store_(store), loop_(loop), index_(store) {
    index_.add(interpretation.facts());
  }

  struct Found {
    std::vector<smt::TermId> facts;
    std::vector<Outcome> evidence;
    std::uint64_t work = 0;
  };
  /// Which facts are tried: those that the conditions of the iterations speak of alone, or bounds and differences of
  /// variables, too.
  enum class Tried : std::uint8_t { Conditions, All };
  Found fromArrival(std::uint64_t mostWork) const;
  /// Behind one of the iterations, while no other iterations are made than these; `known`: holds before and behind all
  /// of them.
  Found behind(std::size_t iteration, std::span<const std::size_t> iterations, std::span<const smt::TermId> known,
               std::uint64_t mostWork, Tried tried) const;

private:
  struct Start {
    std::vector<smt::TermId> conditions;
    smt::Substitution state;
  };
  struct Trial;
  Found found(const Start &start, std::span<const std::size_t> iterations, std::span<const smt::TermId> known,
              std::set<smt::TermId> candidates, std::uint64_t mostWork) const;
  bool holds(Trial &trial, std::span<const smt::TermId> conditions, const smt::Substitution &state,
             smt::TermId candidate) const;

  std::vector<smt::TermId> numbers() const;
  std::vector<smt::TermId> forms() const;
  std::set<smt::TermId> candidates(std::span<const std::size_t> iterations) const;
  std::set<smt::TermId> ofConditions(std::span<const std::size_t> iterations) const;
  void addComparison(smt::TermId condition, std::span<const std::size_t> iterations, std::set<smt::TermId> &all) const;
  void addIntervals(const Start &start, std::span<const std::size_t> iterations, std::set<smt::TermId> &all) const;
  bool isOfTheLoop(smt::TermId term) const;

  const SymbolicInterpretation &interpretation_;
  smt::TermStore &store_;
  const LoopInstance &loop_;
  FactIndex index_;
};

} // namespace feedhold::prove
