// Shards: the files of a run in parts of about the same cost, for several machines.
#pragma once

#include "findings/project/workload.h"

#include <cstdint>
#include <map>
#include <set>
#include <string>
#include <string_view>

namespace feedhold {

/// One of `count` parts, counted from 1.
struct Shard {
  std::uint32_t index = 1;
  std::uint32_t count = 1;
  friend bool operator==(const Shard &, const Shard &) = default;
};

inline constexpr std::uint32_t kMostShards = 100'000;
inline bool isShard(Shard shard) {
  return 1 <= shard.index && shard.index <= shard.count && shard.count <= kMostShards;
}

/// How the names of files end that hold what a shard has found; they are no programs.
inline constexpr std::string_view kPartEnd = ".part";

/// By file as it is shown; what is not in it costs about as much as its size says.
using FileCosts = std::map<std::string, std::uint64_t>;

/// The files of a shard as they are shown.  Files whose programs call one another are in one shard.  The same files
/// and the same costs give the same shards on every machine.
std::set<std::string> filesOfShard(const CheckOptions &options, const KnownNames &known, Shard shard,
                                   const FileCosts &costs);

} // namespace feedhold
