// UnsatProblem: constraints over polynomials that a certificate claims to be unsatisfiable.
#pragma once

#include "base/support/result.h"
#include "proof/check/polynomial.h"
#include "proof/smt/term.h"

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace feedhold::check {

enum class Relation : std::uint8_t { NonNegative, Positive, Zero };
struct Constraint {
  Polynomial polynomial;
  Relation relation;
  friend bool operator==(const Constraint &, const Constraint &) = default;
};

struct Clause;
/// All constraints hold, and of each clause one alternative.
struct Conjunction {
  std::vector<Constraint> constraints;
  std::vector<Clause> clauses;
  friend bool operator==(const Conjunction &, const Conjunction &);
};
struct Clause {
  std::vector<Conjunction> alternatives;
  friend bool operator==(const Clause &, const Clause &) = default;
};
inline bool operator==(const Conjunction &left, const Conjunction &right) {
  return left.constraints == right.constraints && left.clauses == right.clauses;
}

enum class Range : std::uint8_t { Real, Integer };
struct ClaimVariable {
  std::string name;
  Range range;
  friend bool operator==(const ClaimVariable &, const ClaimVariable &) = default;
};

struct UnsatProblem {
  std::vector<ClaimVariable> variables; ///< by the number that polynomials use
  Conjunction conjunction;
  friend bool operator==(const UnsatProblem &, const UnsatProblem &) = default;
};

/// The claim that the formulas (Bool terms without Divide and Apply) contradict one another.  The claim is
/// satisfiable wherever the formulas are: a Bool variable becomes an integer in 0..1, an ite of numbers a new
/// variable that equals one branch or the other.  Refused when it grows beyond a bound.
Result<UnsatProblem> claimOf(const smt::TermStore &store, std::span<const smt::TermId> formulas);

/// As SMT-LIB 2: `unsat` says that the claim is right. `readClaim` gives the same claim back.
std::string writeClaim(const UnsatProblem &claim);
Result<UnsatProblem> readClaim(std::string_view text);

} // namespace feedhold::check
