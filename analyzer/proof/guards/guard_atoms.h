// Guard atoms: simple conditions on what a program is given, each a term and the words of the shop for it.
#pragma once

#include "meaning/cfg/program_set.h"
#include "proof/symbolic/shop_terms.h"
#include "proof/symbolic/symbolic_interpretation.h"

#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

namespace feedhold::prove {

/// What is thought of first: what the claim itself says, then what shops ask of arguments; last what is no bound and
/// no linear relation.
enum class AtomRank : std::uint8_t { Claim, Sign, Projection, FarSign, Pair, Bound, Path, Curved };

enum class Comparison : std::uint8_t { Above, NotBelow, Differs, Equals };

struct GuardAtom {
  smt::TermId holds;
  std::string text;     // `#22 GT 0`
  std::string opposite; // `#22LE0`, as it stands in a block
  AtomRank rank;
  smt::TermId side;                     // what is compared with 0; of Vacancy the number
  std::optional<Comparison> comparison; // absent: the variable is not vacant
};

/// Makes atoms over the inputs that a program or a contract can ask about: local and common variables.
class AtomMaker {
public:
  AtomMaker(SymbolicInterpretation &interpretation, const ProgramSet &programs, const Dialect &dialect);

  /// The term is compared with 0.  Absent when it speaks of anything else than such inputs, or of more than their sums
  /// and products.
  std::optional<GuardAtom> compare(smt::TermId term, Comparison comparison, AtomRank rank);
  /// The variable that the term is the number or the vacancy of is not vacant.
  std::optional<GuardAtom> given(smt::TermId input, AtomRank rank);

  bool isInput(smt::TermId variable) const { return numbers_.contains(variable) || vacancies_.contains(variable); }
  /// Its number; the same for the vacancy.
  smt::TermId numberOf(smt::TermId input) const;

private:
  bool isSimple(smt::TermId term) const;
  bool isLinear(const smt::LinearSum &sum) const;
  std::optional<GuardAtom> equality(smt::TermId term, Comparison comparison, AtomRank rank);
  struct Sides {
    std::string left;
    std::string_view relation;
    std::string_view opposite;
    std::string right;
  };
  std::optional<Sides> sides(smt::LinearSum sum, Comparison comparison);
  std::optional<std::string> side(const smt::LinearSum &sum);

  smt::TermStore &store_;
  bool comparesExactly_;
  TermNames names_;
  std::map<smt::TermId, smt::TermId> numbers_;   // to the vacancy
  std::map<smt::TermId, smt::TermId> vacancies_; // to the number
};

} // namespace feedhold::prove
