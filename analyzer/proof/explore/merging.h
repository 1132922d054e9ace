// Merging: paths that meet at a place continue as one where there are too many to follow each of them.
//
// The merged path holds what both held, and what only one of them held on condition of a selector: a Bool that is a
// condition of one path and the opposite of a condition of the other, or else a new variable, free to be either.  Its
// state is that of the one path where the selector holds and that of the other where it does not.  So every run that
// one of the paths stands for is a run that the merged one stands for.
#pragma once

#include "proof/explore/path.h"

#include <map>

namespace feedhold::prove {

/// At the same place, in the same calls and loops, with the same modal calls active.
bool canMerge(const Path &a, const Path &b);
/// Of paths that can be merged.
void mergeInto(SymbolicInterpretation &interpretation, Path &path, Path other);
/// The same, without the conditions that one of them lacks and with new variables for values that have become large:
/// the merged path stands for more runs.
void mergeAndForget(SymbolicInterpretation &interpretation, Path &path, Path other);

/// The paths that are still to be followed, those that others may meet later first.
class Worklist {
public:
  /// Where a path stands: for each program that is open, the position of its node in weak topological order.
  using Position = std::vector<std::uint32_t>;

  void add(Position position, Path path);
  bool empty() const { return paths_.empty(); }
  std::size_t size() const { return size_; }
  /// The program in which most of the paths are; absent: there are none.
  std::optional<Callee> busiestProgram() const;
  /// The paths at the first position.
  std::vector<Path> takeFirst();

private:
  std::map<Position, std::vector<Path>> paths_;
  std::size_t size_ = 0;
};

} // namespace feedhold::prove
