#include "proof/guards/guard_search.h"

#include <algorithm>

namespace feedhold::prove {

namespace {

constexpr std::size_t kMostGuardAtoms = 4;
/// Fewer runs than these say nothing about what a condition leaves.
constexpr std::size_t kFewRuns = 4;

} // namespace

bool GuardSearch::Sample::satisfies(const Conjunction &conjunction) const {
  return std::all_of(conjunction.begin(), conjunction.end(), [&](std::size_t atom) { return holds[atom]; });
}

std::vector<GuardAtom> GuardSearch::atomsOf(const Conjunction &conjunction) const {
  std::vector<GuardAtom> atoms;
  for (const std::size_t atom : conjunction)
    atoms.push_back(atoms_[atom]);
  return atoms;
}

void GuardSearch::add(SampleKind kind, std::vector<bool> holds) { samples_.push_back({kind, std::move(holds)}); }

/// Of the runs that end as they should; where none does, of those that do not break the claim.
std::size_t GuardSearch::kept(const Conjunction &conjunction) const {
  const bool someEnd =
      std::any_of(samples_.begin(), samples_.end(), [](const Sample &each) { return each.kind == SampleKind::Ends; });
  return static_cast<std::size_t>(std::count_if(samples_.begin(), samples_.end(), [&](const Sample &each) {
    return each.kind == (someEnd ? SampleKind::Ends : SampleKind::Other) && each.satisfies(conjunction);
  }));
}

bool GuardSearch::neverEnds() const {
  return samples_.size() >= kFewRuns && std::none_of(samples_.begin(), samples_.end(),
                                                     [](const Sample &each) { return each.kind == SampleKind::Ends; });
}

bool GuardSearch::fits(const Conjunction &conjunction) const {
  if (tried_.contains(conjunction) || std::any_of(samples_.begin(), samples_.end(), [&](const Sample &each) {
        return each.kind == SampleKind::Breaks && each.satisfies(conjunction);
      }))
    return false;
  return kept({}) < kFewRuns || kept(conjunction) > 0;
}

std::vector<Conjunction> GuardSearch::ones() const {
  std::vector<Conjunction> ones;
  for (std::size_t i = 0; i < atoms_.size(); ++i)
    if (fits({i}))
      ones.push_back({i});
  std::stable_sort(ones.begin(), ones.end(), [&](const Conjunction &a, const Conjunction &b) {
    const AtomRank first = atoms_[a.front()].rank;
    const AtomRank second = atoms_[b.front()].rank;
    return first != second ? first < second : kept(a) > kept(b);
  });
  return ones;
}

/// The likeliest; atoms are sorted by rank.
std::optional<Conjunction> GuardSearch::pair() const {
  std::optional<Conjunction> best;
  const auto ranks = [&](const Conjunction &pair) {
    return static_cast<int>(atoms_[pair[0]].rank) + static_cast<int>(atoms_[pair[1]].rank);
  };
  for (std::size_t i = 0; i < atoms_.size(); ++i)
    for (std::size_t j = i + 1; j < atoms_.size(); ++j) {
      const Conjunction next{i, j};
      if ((!best || ranks(next) < ranks(*best)) && fits(next))
        best = next;
    }
  return best;
}

/// Atom by atom, the one that excludes most of what is left.
std::optional<Conjunction> GuardSearch::cover() const {
  Conjunction chosen;
  while (chosen.size() < kMostGuardAtoms) {
    std::size_t best = atoms_.size();
    std::size_t fewest = samples_.size() + 1;
    for (std::size_t i = 0; i < atoms_.size(); ++i) {
      Conjunction next = chosen;
      next.push_back(i);
      const auto left =
          static_cast<std::size_t>(std::count_if(samples_.begin(), samples_.end(), [&](const Sample &each) {
            return each.kind == SampleKind::Breaks && each.satisfies(next);
          }));
      if (left < fewest && (kept({}) < kFewRuns || kept(next) > 0)) {
        fewest = left;
        best = i;
      }
    }
    if (best == atoms_.size())
      return std::nullopt;
    chosen.push_back(best);
    Conjunction sorted = chosen;
    std::sort(sorted.begin(), sorted.end());
    sorted.erase(std::unique(sorted.begin(), sorted.end()), sorted.end());
    if (sorted.size() > 2 && fits(sorted))
      return sorted;
  }
  return std::nullopt;
}

std::optional<Conjunction> GuardSearch::next() {
  const bool someBreak =
      std::any_of(samples_.begin(), samples_.end(), [](const Sample &each) { return each.kind == SampleKind::Breaks; });
  std::optional<Conjunction> next;
  if (const auto found = ones(); !found.empty())
    next = found.front();
  else if (someBreak) { // else nothing says which atoms belong together
    next = pair();
    if (!next)
      next = cover();
  }
  if (next)
    tried_.insert(*next);
  return next;
}

std::vector<Conjunction> GuardSearch::weaker(const Conjunction &proved) const {
  std::vector<Conjunction> weaker;
  const auto take = [&](Conjunction next) {
    std::sort(next.begin(), next.end());
    if (fits(next) && std::find(weaker.begin(), weaker.end(), next) == weaker.end())
      weaker.push_back(std::move(next));
  };
  if (proved.size() > 1)
    for (std::size_t i = 0; i < proved.size(); ++i) {
      Conjunction fewer = proved;
      fewer.erase(fewer.begin() + static_cast<std::ptrdiff_t>(i));
      take(std::move(fewer));
    }
  for (std::size_t i = 0; i < proved.size(); ++i)
    for (std::size_t other = 0; other < atoms_.size(); ++other)
      if (atoms_[other].side == atoms_[proved[i]].side && atoms_[proved[i]].comparison == Comparison::Above &&
          atoms_[other].comparison == Comparison::NotBelow) {
        Conjunction wider = proved;
        wider[i] = other;
        take(std::move(wider));
      }
  for (std::size_t i = 0; i < proved.size(); ++i)
    for (std::size_t other = 0; other < atoms_.size(); ++other) {
      Conjunction wider = proved;
      wider[i] = other;
      const bool allowsAll = std::all_of(samples_.begin(), samples_.end(), [&](const Sample &each) {
        return each.kind == SampleKind::Breaks || !each.holds[proved[i]] || each.holds[other];
      });
      if (allowsAll && kept(wider) > kept(proved))
        take(std::move(wider));
    }
  std::stable_sort(weaker.begin(), weaker.end(), [&](const Conjunction &a, const Conjunction &b) {
    return a.size() != b.size() ? a.size() < b.size() : kept(a) > kept(b);
  });
  return weaker;
}

} // namespace feedhold::prove
