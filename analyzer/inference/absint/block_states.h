// BlockStates: what is known before the blocks of a program, apart for each way of calls that leads there.
#pragma once

#include "inference/absint/analysis.h"
#include "inference/absint/kept_state.h"

#include <functional>
#include <map>
#include <string>

namespace feedhold {

/// The states of the blocks of one program, as one way of calls reaches it.
struct ContextStates {
  Callee start;                 // of the run
  bool assumesContract = false; // of `start`
  std::vector<Place> calls;     // that led here, outermost first
  FileId file;
  ProgramId program;
  std::map<BlockId, KeptState> blocks; // over all runs that come to the block; absent: none does, or not asked for
};

struct UnmodelledNote {
  std::string_view reason;
  Place place;
  friend bool operator==(const UnmodelledNote &, const UnmodelledNote &) = default;
};

struct BlockStates {
  std::vector<ContextStates> contexts; // in the order in which they are reached
  std::vector<UnmodelledNote> unmodelled;
  std::optional<std::string_view> gaveUp; // then there are no contexts
  bool isCutShort = false;                // the states of all blocks would be more than kMostValues: some are left out
  static constexpr std::size_t kMostValues = 1'500'000; // of some 130 bytes each
};

/// Analyses the programs of one file one by one, each started with nothing known, or, with the contracts of the file,
/// as its contract allows.  `wants`: the blocks that are asked for.
BlockStates collectBlockStates(const ProgramSet &programs, std::span<const Callee> starts,
                               const std::function<bool(FileId, BlockId)> &wants,
                               const FileContracts *contracts = nullptr);

} // namespace feedhold
