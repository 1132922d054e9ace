// Termination: proofs that a loop ends, by ranking functions.
//
// A ranking function of the state that every iteration lowers by at least a positive amount that no iteration changes,
// and that is not negative before an iteration, allows finitely many iterations.  Several ranking functions are taken
// in lexicographic order (Bradley, Manna, Sipma, "Linear ranking with reachability", 2005), and iterations that lie on
// no cycle are set aside first.
#pragma once

#include "proof/decide/discharge.h"
#include "proof/explore/exploration.h"
#include "proof/obligation/obligation.h"

namespace feedhold::prove {

/// One ranking function and the iterations (by number) that lower it.
struct RankingFunction {
  smt::TermId value;
  smt::TermId decrease{0}; // of the first of its iterations
  std::vector<std::size_t> iterations{};
  bool isLate = false;     // decreases only from some iteration on
  bool isFollowed = false; // decreases only where another iteration follows
};

struct Termination {
  bool proved = false;
  std::vector<RankingFunction> rankings; // in lexicographic order
  std::vector<Outcome> evidence;
  std::optional<std::size_t> awaited = {}; // the place of the clause that ends the iterations which are left
  std::string reason;                      // why not
  std::optional<Witness> endless = {};     // inputs with which it never ends
};

/// A read of an input that a contract says comes in the end (@EVENTUALLY), at a place to which an iteration comes at
/// most once.  A run that comes there without end reads an awaited value at some time.
struct AwaitedRead {
  Place place;
  std::size_t clause;  // its place in the contract
  smt::TermId number;  // what the read gives
  smt::TermId isOther; // it is not an awaited value
};

Termination provesEnd(const SymbolicInterpretation &interpretation, smt::TermStore &store, const LoopInstance &loop,
                      std::span<const AwaitedRead> awaited = {});

/// The number of an iteration whose conditions hold again after it, so that it repeats for ever.
std::optional<std::size_t> recurrentIteration(const SymbolicInterpretation &interpretation, smt::TermStore &store,
                                              const LoopInstance &loop);

} // namespace feedhold::prove
