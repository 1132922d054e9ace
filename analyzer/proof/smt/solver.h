// Solvers, asked in SMT-LIB text.  Their answers are hints: see decide/discharge.h for their use.
#pragma once

#include "base/support/result.h"
#include "proof/smt/model.h"
#include "proof/smt/smtlib.h"

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <variant>
#include <vector>

namespace feedhold::smt {

/// Values by name; what the solver left open is missing, and irrational numbers are cut off.
struct Sat {
  Model model;
};
struct Unsat {};
struct NoAnswer {
  std::string reason;
};

struct Answer {
  std::variant<Sat, Unsat, NoAnswer> result;
  std::uint64_t effort = 0; ///< the solver's own resource units

  bool isUnsat() const { return std::holds_alternative<Unsat>(result); }
};

/// Z3: the library, or in a static build the program `z3`.  Nonlinear texts are solved in a child process: Z3 4.8.12
/// does not always obey its limits there.  An answer `unsat` of it to a nonlinear text is no proof: it is wrong for
/// some satisfiable ones (Z3 issue 6098).
Answer askZ3(const std::string &smtlib, Arithmetic arithmetic, std::uint64_t resources);
/// Absent where it is not installed.
std::optional<std::string> z3Version();

/// cvc5, run as a program.  Gives no models.  NoAnswer says so where it is not installed.
Answer askCvc5(const std::string &smtlib, std::uint64_t resources);
/// Of many questions one after the other, without starting the program for each: the answers in their order.
std::vector<Answer> askCvc5InTurn(std::span<const std::string> texts, std::uint64_t resources);
/// As of Z3.
std::optional<std::string> cvc5Version();

} // namespace feedhold::smt
