// LoopRelations: relations between the variables of programs that may hold before the iterations of a loop.  They come
// from what runs have shown and from what open claims ask.  An exploration tries them (ExploreOptions::invariants): a
// relation that is wrong costs time and nothing else.
#pragma once

#include "proof/context/proof_context.h"

namespace feedhold::prove {

class LoopRelations {
public:
  /// Over the variables that placeholder() gives, and those of the start of the run.
  void add(Place head, smt::TermId relation);
  bool isEmpty() const { return relations_.empty(); }
  /// Over the state at the head.
  std::vector<smt::TermId> in(smt::TermStore &store, Place head, const SymbolicState &state) const;

  /// Stands for the number of a variable of programs, before any iteration.
  smt::TermId placeholder(smt::TermStore &store, std::uint32_t variable);

private:
  std::map<Place, std::vector<smt::TermId>> relations_;
  std::map<std::uint32_t, smt::TermId> placeholders_;
};

/// Equalities and comparisons that hold in each state of the runs.
void addRelationsOfRuns(const ProofContext &context, LoopRelations &relations);
/// The comparisons on the paths to what has not been proved.
void addRelationsOfGoals(const ProofContext &context, const std::vector<Question> &open, LoopRelations &relations);

} // namespace feedhold::prove
