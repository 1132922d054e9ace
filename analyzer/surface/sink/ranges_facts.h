// StateFacts: an abstract state told fact by fact: what is known of variables, positions, modes and what they bring.
#pragma once

#include "inference/absint/block_states.h"

#include <bitset>
#include <optional>
#include <string>
#include <vector>

namespace feedhold {

/// That a value is another one plus an offset.
struct KnownRelation {
  std::string name; // of the other: `#1`, `X`, `F`
  enum class Time : std::uint8_t { Now, AtStart } time;
  double offset;
  bool isItself = false; // what the thing itself was at the start
};

struct ValueFact {
  std::string name; // `#1`, `X`, `F`, `cycle R`, `G52 X`
  AbstractValue value;
  std::optional<KnownRelation> relation = std::nullopt;
  bool isAlwaysNumber = false; // never vacant: that it is a number is no news
};

struct ModeFact {
  std::string name;               // `distance`, `plane`
  std::vector<std::string> codes; // `G90`; those that are set on some path
  bool maybeAsAtStart;            // or nothing has set it
  bool isAnyCode = false;         // all that the control has
};

/// What is not named is as it was at the start, when nothing was known of it.
struct StateFacts {
  std::vector<ValueFact> variables;
  bool othersAreUnknown = false; // variables that are not named, local ones apart
  std::vector<ValueFact> positions;
  std::vector<ModeFact> modes;
  std::vector<ValueFact> settings;     // words in force, levels of a cycle, offsets, mappings
  std::vector<std::string> modalCalls; // `G66 P9010 in line 3`; innermost last
  bool maybeOtherModalCalls = false;
};

/// The facts of the states of one context, which has to outlive it.
class FactsOfStates {
public:
  FactsOfStates(const ContextStates &context, const ProgramSet &programs);
  StateFacts at(const AbstractState &state) const;

private:
  const ContextStates &context_;
  const ProgramSet &programs_;
  ModalTable modes_;
  std::bitset<kLocalVariables + 1> mentioned_; // local variables that the text of the program names
};

bool isUnknown(const ValueFact &fact);
/// `= #1 + 17`, `as at start`, `= X at start - 5`.
std::string textOf(const KnownRelation &relation);
/// `0 to 17, whole (= #1 + 17)`
std::string textOf(const ValueFact &fact);
/// `G90 or G91, or as at start`
std::string textOf(const ModeFact &fact);

} // namespace feedhold
