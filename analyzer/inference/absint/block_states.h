// BlockStates: what is known before the blocks of a program, apart for each way of calls that leads there.
#pragma once

#include "inference/absint/analysis.h"

#include <functional>
#include <map>
#include <string>

namespace feedhold {

/// The states of the blocks of one program, as one way of calls reaches it.
struct ContextStates {
  Callee start;             // of the run
  std::vector<Place> calls; // that led here, outermost first
  FileId file;
  ProgramId program;
  std::map<BlockId, AbstractState> blocks; // over all runs that come to the block; absent: none does, or not asked for
};

struct NotFollowedNote {
  std::string_view reason;
  Place place;
  friend bool operator==(const NotFollowedNote &, const NotFollowedNote &) = default;
};

struct BlockStates {
  std::vector<ContextStates> contexts; // in the order in which they are reached
  std::vector<NotFollowedNote> notFollowed;
  std::optional<std::string_view> gaveUp; // then there are no contexts
  bool isCutShort = false;                // the states of all blocks would be more than kMostValues: some are left out
  static constexpr std::size_t kMostValues = 1'500'000; // of some 130 bytes each
};

/// Analyses the programs one by one, each started with nothing known.  `wants`: the blocks that are asked for.
BlockStates collectBlockStates(const ProgramSet &programs, std::span<const Callee> starts,
                               const std::function<bool(FileId, BlockId)> &wants);

} // namespace feedhold
