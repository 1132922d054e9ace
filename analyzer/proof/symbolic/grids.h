// Grids: of which power of two a term is always a multiple.  Sums and products of such numbers are exact in doubles as
// long as they are small enough: quarters below 2^51, whole numbers up to 2^53.
#pragma once

#include "proof/smt/term.h"

#include <map>
#include <optional>

namespace feedhold::prove {

/// k: a multiple of 2^k.
using Grid = int;

class Grids {
public:
  explicit Grids(const smt::TermStore &store) : store_(store) {}

  /// The variable of an input is such a multiple, if the contract is kept.
  void setOfInput(smt::TermId variable, Grid grid) { ofInputs_.insert_or_assign(variable, grid); }
  /// Whether that is believed: not of calls that the contract does not allow.  Returns what it was.
  bool believeInputs(bool believes);
  /// The variable is always a multiple of 2^grid.
  void set(smt::TermId variable, Grid grid) { ofVariables_.insert_or_assign(variable, grid); }
  /// Absent: not known.  Of 0, which is a multiple of everything: kGridOfZero.
  std::optional<Grid> of(smt::TermId term);

private:
  std::optional<Grid> find(smt::TermId term);

  const smt::TermStore &store_;
  std::map<smt::TermId, Grid> ofVariables_;
  std::map<smt::TermId, Grid> ofInputs_;
  bool believesInputs_ = true;
  std::map<smt::TermId, std::optional<Grid>> known_; // of terms without variables of unknown grid
};

constexpr Grid kGridOfZero = 1000;
/// Finer multiples (0.1 is one of 2^-55) are as good as any number: their sums leave the range in which they are exact.
constexpr Grid kFinestGrid = -20;

} // namespace feedhold::prove
