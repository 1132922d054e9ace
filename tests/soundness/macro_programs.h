// Random macro programs, and the inputs of their runs: the same for the same seed on every machine.
#pragma once

#include <cstdint>
#include <initializer_list>
#include <string>
#include <string_view>
#include <vector>

namespace feedhold::soundness {

/// SplitMix64 (Steele, Lea, Flood, "Fast splittable pseudorandom number generators", 2014).
class Random {
public:
  explicit Random(std::uint64_t seed) : state_(seed) {}
  std::uint64_t next();
  /// Below the limit.
  std::uint32_t below(std::uint32_t limit) { return static_cast<std::uint32_t>(next() % limit); }
  bool oneIn(std::uint32_t chances) { return below(chances) == 0; }
  template <typename T> T of(std::initializer_list<T> choices) {
    return *(choices.begin() + below(static_cast<std::uint32_t>(choices.size())));
  }

private:
  std::uint64_t state_;
};

/// One block a line.
using ProgramLines = std::vector<std::string>;

struct Sample {
  std::string_view dialect; // its id; `fanuc-30i-lathe/B`: a lathe of another G code system; `/lrp`: with this switch
  ProgramLines lines;       // the program that is run first, then those that it may call
};
/// Of any dialect; the commonest one more often than others.
Sample macroSample(Random &random);

std::string textOf(const ProgramLines &lines);

/// A number as operators type it: small, round, or neither.
double anyInput(Random &random);

} // namespace feedhold::soundness
