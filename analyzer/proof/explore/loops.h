// Loops: an inductive invariant of a loop, found by trial and verified by one symbolic iteration.
//
// A path that reaches a loop continues before an arbitrary iteration, of which only the number of iterations before it
// has a name (`iterations`).  Each part of the state is then
//
//   kept     what it was at the arrival, because no iteration changes it;
//   closed   arrival + iterations * step, because every iteration adds the same step, which no iteration changes;
//            and where the control rounds the sum, an error that grows by at most the same amount in every iteration;
//   derived  the arrival before the first iteration, and afterwards what each iteration computes from closed parts;
//   free     a variable, of which some invariants are known.
//
// All of it is a guess until an iteration that starts in such a state ends in one; record() refuses an iteration that
// does not.
#pragma once

#include "proof/explore/path.h"

#include <map>

namespace feedhold::prove {

class Explorer;

enum class PartKind : std::uint8_t { Kept, Closed, Derived, Free };

struct LoopPart {
  PartKind kind = PartKind::Kept;
  smt::TermId arrival;
  smt::TermId symbol;  // stands for the part while its kind is looked for; of Free: for good
  smt::TermId generic; // before any iteration
  smt::TermId
      step; // of Closed: what an iteration adds; of Derived: what an iteration leaves, over the symbols of closed parts
  /// Of Closed, where the control rounds: by how much the sum is off, and an iteration before.
  struct Error {
    smt::TermId now;
    smt::TermId before;
    std::size_t bound; // which of the amounts that are tried an iteration adds at most
  };
  std::optional<Error> error = {};
};

/// iterations * step under a name of its own, so that a proof need not multiply.  A numeric step needs none.
struct Travel {
  smt::TermId step;
  smt::TermId distance;
};

/// What is known of a loop that has been opened.
struct LoopShape {
  SymbolicState state;         // before any iteration
  std::vector<LoopPart> parts; // of `state`, then whether an axis has moved
  std::vector<Travel> travels;

  /// From the symbols of closed parts to what those are before the iteration.
  smt::Substitution closedParts() const;
};

/// What was found of a loop when it was last opened.  Each trial of a loop opens the loops in it again, where mostly
/// the same parts change in the same way: that is tried first (reopened_loop.cpp).
struct KnownLoop {
  std::vector<PartId> layout;  // of the state
  std::vector<LoopPart> parts; // of it, then whether an axis has moved
  smt::TermId iterations;
};
/// By the calls that led to its head, and the head.
using KnownLoops = std::map<std::pair<std::vector<Place>, Place>, KnownLoop>;

class LoopSummarizer {
public:
  explicit LoopSummarizer(Explorer &explorer) : explorer_(explorer) {}

  /// The path is at the head of a loop: moves it before an arbitrary iteration.  False: no invariant was found.
  bool open(Path &path);
  /// The same in a trial, of a loop around it: the paths that leave it.
  std::vector<Path> tryAll(const Path &path);
  /// The path has returned to the head: adds the iteration.  False: it does not preserve the invariant.
  bool record(std::size_t instance, const Path &path);

private:
  struct Work;
  // ---- opened before (reopened_loop.cpp) ----
  bool startAsKnown(Work &work);
  bool takeParts(Work &work, const KnownLoop &known);
  bool isAnyUnchanged(const Work &work) const;
  void remember(const Work &work);
  KnownLoops::key_type keyOf(const Work &work) const;

  std::optional<Work> summarised(const Path &path);
  bool findChanged(Work &work);
  bool findKinds(Work &work);
  bool tryKinds(Work &work, bool &grew);
  void classify(Work &work);
  bool verify(Work &work);
  void addInvariants(Work &work);
  bool changesInLoop(const Work &work, smt::TermId candidate) const;
  std::vector<smt::TermId> thoseThatHold(Work &work, const std::vector<smt::TermId> &known,
                                         std::vector<smt::TermId> candidates);
  bool holdsAfterFirst(const Work &work, smt::TermId candidate);
  void addLastIteration(Work &work);
  std::vector<smt::TermId> candidates(const Work &work) const;
  bool holdsAtArrival(const Work &work, smt::TermId candidate);
  bool holdsAfter(const Work &work, const Path &iteration, smt::TermId candidate,
                  const std::vector<smt::TermId> &also = {});

  bool tryIterations(Work &work);
  void build(Work &work);
  smt::TermId travelled(Work &work, smt::TermId step);
  void addTravels(Work &work);
  void addErrors(Work &work);
  LoopPart::Error newError(std::size_t bound);
  std::size_t leastError(const Work &work, std::size_t part);
  smt::TermId part(smt::TermId arrival, smt::TermId left);
  /// An iteration on these conditions that leaves this in a part leaves it as the kind of the part says; `closed`:
  /// closedParts().
  bool isKeptBy(const LoopPart &part, smt::TermId left, const smt::Substitution &closed,
                const std::vector<smt::TermId> &conditions);
  void addErrorsBehind(const LoopPart &part, smt::TermId left, smt::Substitution &next);
  bool isSame(smt::TermId before, smt::TermId left, const std::vector<smt::TermId> &conditions);
  bool isSymbolOf(smt::TermId symbol, smt::TermId left);
  smt::Substitution atIteration(const Work &work, int distance) const;
  smt::Substitution atArrival(const Work &work) const;
  bool relayout(Work &work, bool &grew);
  bool isConstant(const Work &work, smt::TermId term) const;
  smt::TermId lastIteration(const Work &work, smt::TermId term) const;

  Explorer &explorer_;
};

} // namespace feedhold::prove
