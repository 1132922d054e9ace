// StartInputs: modal codes, words in force and coordinates at the start of a program, as inputs that a witness may set.
#pragma once

#include "meaning/machine/concrete_interpretation.h"
#include "proof/smt/model.h"
#include "proof/symbolic/symbolic_interpretation.h"

#include <map>
#include <vector>

namespace feedhold::prove {

class StartInputs {
public:
  StartInputs() = default;
  /// What neither the control nor the contract fixes of the state at the start.  `place`: coordinates that the contract
  /// says.
  StartInputs(const smt::TermStore &store, const Dialect &dialect, const SymbolicState &entry,
              const std::map<Axis, smt::TermId> &place);

  /// What a model names and a run can start with; what is as after power-on is left out.
  GivenStart startOf(const smt::TermStore &store, const smt::Model &model) const;
  /// With one other code than that of power-on, of the planes and the distance modes: what callers leave in force.
  std::vector<GivenStart> otherModes() const;
  /// Adds the numbers of a start; of what it does not list, those of power-on.
  void addTo(SymbolicInterpretation &interpretation, smt::Model &model, const GivenStart &start) const;

private:
  struct Code {
    std::uint8_t group;
    smt::TermId index;
    std::uint8_t powerOn;
    CodeMask whole; // the codes that are all that there is to their mode
    bool isSampled; // by otherModes()
  };
  std::vector<Code> codes_;
  std::vector<std::pair<char, SymbolicValue>> words_;
  std::vector<std::pair<Axis, smt::TermId>> place_;
};

/// The state at the start of a run, as far as `start` says.
void setStart(SymbolicInterpretation &interpretation, SymbolicState &entry, const GivenStart &start);

/// The same with less: nothing; without one of its parts; with whole numbers in place of others.  Plainest first.
std::vector<GivenStart> plainerStarts(const GivenStart &start);

} // namespace feedhold::prove
