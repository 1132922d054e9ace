// The part of LoopSummarizer that starts from what was found of the loop when it was last opened.  A guess like the
// others: one iteration has to confirm it, and otherwise the search begins from nothing.
#include "proof/explore/explorer.h"
#include "proof/explore/loop_work.h"

#include <algorithm>

namespace feedhold::prove {

using smt::TermId;

namespace {

std::vector<PartId> layoutOf(const SymbolicState &state) {
  std::vector<PartId> layout;
  forEachPart([&](PartId id, const auto &) { layout.push_back(id); }, state);
  return layout;
}

} // namespace

bool LoopSummarizer::startAsKnown(Work &work) {
  const auto known = explorer_.knownLoops_.find(keyOf(work));
  if (known == explorer_.knownLoops_.end() || known->second.layout != layoutOf(work.arrival.state))
    return false;
  bool grew = false;
  if (takeParts(work, known->second) && tryKinds(work, grew) && !isAnyUnchanged(work))
    return true;
  work.shape.travels.clear();
  work.facts.clear();
  return false;
}

/// The same kinds, under new names.  False: what iterations add is not known before this loop.
bool LoopSummarizer::takeParts(Work &work, const KnownLoop &known) {
  smt::TermStore &store = explorer_.store_;
  smt::Substitution renamed{{known.iterations, work.iterations}};
  auto remembered = known.parts.begin();
  for (const TermId arrival : termsOf(work.arrival.state, work.arrival.moved)) {
    LoopPart part{remembered->kind, arrival, arrival, arrival, arrival};
    if (part.kind != PartKind::Kept) {
      part.symbol = this->part(arrival, remembered->symbol);
      renamed.emplace(remembered->symbol, part.symbol);
    }
    work.parts().push_back(part);
    ++remembered;
  }
  for (std::size_t i = 0; i < work.parts().size(); ++i) {
    LoopPart &part = work.parts()[i];
    if (part.kind != PartKind::Closed && part.kind != PartKind::Derived)
      continue;
    part.step = smt::substitute(store, known.parts[i].step, renamed);
    if (part.kind == PartKind::Closed && !isConstant(work, part.step))
      return false;
    if (known.parts[i].error)
      part.error = newError(known.parts[i].error->bound);
  }
  return true;
}

/// Some part that was thought to change does not.
bool LoopSummarizer::isAnyUnchanged(const Work &work) const {
  for (std::size_t i = 0; i < work.parts().size(); ++i)
    if (const LoopPart &part = work.parts()[i];
        part.kind == PartKind::Free &&
        std::ranges::all_of(work.left, [&](const auto &left) { return left[i] == part.symbol; }))
      return true;
  return false;
}

KnownLoops::key_type LoopSummarizer::keyOf(const Work &work) const {
  const LoopInstance &loop = explorer_.result_.loops[work.instance];
  return {loop.calls, loop.head};
}

void LoopSummarizer::remember(const Work &work) {
  explorer_.knownLoops_.insert_or_assign(keyOf(work),
                                         KnownLoop{layoutOf(work.arrival.state), work.shape.parts, work.iterations});
}

} // namespace feedhold::prove
