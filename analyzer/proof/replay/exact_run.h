// Exact runs: how a run on given inputs ends in exact arithmetic, where the machine computes with doubles.
#pragma once

#include "meaning/machine/machine.h"
#include "proof/explore/exploration.h"

#include <compare>
#include <functional>
#include <map>
#include <optional>
#include <utility>
#include <vector>

namespace feedhold::prove {

enum class Agreement : std::uint8_t {
  Same,      // the exact run ends there, too
  Different, // it does not
  NotKnown,  // it was too long to follow, or something in it has no exact value
};

/// To follow single runs.
ExploreOptions exactOptions();
/// The number that an input of the machine is: what was typed, or the number of the control that stands for it.
smt::Number inputNumber(const SymbolicInterpretation &interpretation, double value);
/// The interpretation starts from these inputs.
void startExactly(SymbolicInterpretation &interpretation, const GivenVariables &given);

/// Each input by its number; no value: vacant.  Then the readings, and the start.
struct InputsKey {
  std::vector<std::pair<std::uint32_t, std::optional<double>>> inputs;
  std::vector<std::pair<std::uint32_t, std::vector<double>>> readings;
  GivenStart start;
  friend std::partial_ordering operator<=>(const InputsKey &, const InputsKey &) = default;
};
InputsKey keyOf(const GivenVariables &given);

/// The program from these inputs, without a contract; where the control decides, as runs of the machine have it.
Exploration exploreExactly(const ProgramSet &programs, Callee entry, const GivenVariables &given);

/// The exact runs of one program, each followed once.
class ExactRuns {
public:
  using Explore = std::function<Exploration(const GivenVariables &)>;
  explicit ExactRuns(Explore explore) : explore_(std::move(explore)) {}
  /// Whether the run on these inputs also ends in exact numbers as the machine's run ended.
  Agreement agrees(const GivenVariables &given, const RunResult &run);

private:
  /// Where the paths of one run may end: one path, but where something is not known.
  struct Ends {
    std::vector<std::pair<Place, std::optional<AlarmKind>>> stops; ///< no kind: the program's own alarm
    std::vector<Place> exits;
    bool repeats = false;
    bool isIncomplete = false;
  };
  static bool has(const Ends &ends, const RunResult &run);
  Ends follow(const GivenVariables &given) const;

  Explore explore_;
  std::map<InputsKey, Ends> known_;
};

} // namespace feedhold::prove
