// Likely calls: how near the inputs of a run are to a call that a shop makes.
//
// Of the runs that break a claim, a reader acts on the one that could be the next call.  What is likely is read from
// the text: what the calls in the files of the proof pass, what the program sets where an argument is missing, and what
// its guards let pass.  It decides which run is tried first and which is shown, and never what a verdict is.
#pragma once

#include "meaning/machine/machine.h"

#include <map>
#include <optional>
#include <random>
#include <set>
#include <vector>

namespace feedhold::prove {

class LikelyCalls {
public:
  LikelyCalls(const ProgramSet &programs, Callee program);

  /// Less is nearer; a call that is written there has 0.  In descending weight: arguments that the program needs and
  /// that are missing, values that its own guards refuse, another start than that of power-on, variables that no call
  /// sets, and numbers that nobody would choose.
  unsigned distanceOf(const GivenVariables &given) const;
  /// To try in place of what an input holds, the likeliest first.  Empty: the program does not need it.
  std::vector<double> valuesOf(std::uint32_t variable) const;
  /// The arguments that the program needs and that are missing have their likeliest values.
  GivenVariables completed(GivenVariables given) const;
  /// Calls that are written, then those that differ from a likely one in one argument: few.
  std::vector<GivenVariables> calls() const;
  /// One that the guards let pass, as far as their conditions are read and the search finds one.
  GivenVariables accepted(std::mt19937 &random) const;

private:
  enum class Need : std::uint8_t {
    None,
    Read,   // it is computed with, never tested for vacancy, and no call is known
    Passed, // by every call that is known
    Asked,  // a guard refuses calls without it
  };
  struct Input {
    Need need = Need::None;
    std::optional<double> preset = {}; // that the program sets where it is missing
    std::vector<double> values = {};   // that calls pass, the most frequent first, then what the program itself sets
  };
  struct Guard {
    ExpressionId condition;
    bool refuses; // where the condition is so
  };

  void readGuards();
  void readTest(NodeId test);
  void readDefault(NodeId node, std::uint32_t variable);
  void readUses(const std::set<ExpressionId> &compared);
  void readCalls();
  bool mayBePassed(std::uint32_t variable) const;
  bool mayBeGiven(std::uint32_t variable) const;
  ConcreteValue whereMissing(std::uint32_t variable) const;
  /// The conditions of the guards that refuse it.
  std::vector<ExpressionId> refusing(const GivenVariables &given) const;
  bool isRefusedAlone(std::uint32_t variable, const ConcreteValue &value) const;
  double likeliest(std::uint32_t variable) const;
  unsigned distanceOf(std::uint32_t variable, double value) const;

  const ProgramSet &programs_;
  Callee program_;
  const ProgramFile &file_;
  std::map<std::uint32_t, Input> inputs_; // that the text speaks of
  std::vector<Guard> guards_;
  std::vector<double> guardNumbers_;     // that stand in their conditions
  std::vector<GivenVariables> ofFolder_; // calls of which every argument is a number
};

} // namespace feedhold::prove
