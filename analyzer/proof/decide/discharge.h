// discharge: the only place where a formula becomes Proved.
#pragma once

#include "proof/smt/model.h"
#include "proof/smt/term.h"

#include <algorithm>
#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace feedhold::prove {

/// "Whenever all assumptions hold and every function and quotient in them is defined, the goal holds."  Facts about
/// functions are added by discharge, each guarded by its domain, so that a term that is undefined never proves
/// anything.
struct Query {
  std::vector<smt::TermId> assumptions; ///< Bool
  smt::TermId goal;                     ///< Bool
};

/// How much work may be done, in units that do not depend on the machine.
struct Budget {
  /// Steps of the certificate search: coefficients touched (about a million in a second).
  std::uint64_t search = 1'000'000;
  /// Resource units of Z3 (about a million in a second); 0: Z3 is not asked.
  std::uint64_t z3 = 2'000'000;
  /// Resource units of cvc5; 0: cvc5 is not asked.
  std::uint64_t cvc5 = 40'000;

  /// What is left of it after so much effort, of whatever kind.
  Budget without(std::uint64_t effort) const {
    const auto rest = [effort](std::uint64_t part) { return part - std::min(part, effort); };
    return {.search = rest(search), .z3 = rest(z3), .cvc5 = cvc5};
  }

  /// One of so many equal parts of it; cvc5, which confirms what Z3 proves, keeps all of its units.
  Budget part(std::uint64_t parts) const { return {.search = search / parts, .z3 = z3 / parts, .cvc5 = cvc5}; }

  /// For the many small questions of a search for invariants: linear reasoning and few splits, no solver.
  static Budget quick() { return {.search = 40'000, .z3 = 0, .cvc5 = 0}; }
};

enum class Grade : std::uint8_t {
  Certified,  ///< a certificate was found, and the checker of `check/` verified it
  TwoSolvers, ///< two solvers of different makers answer `unsat` on the same text
};

/// The texts that `check::readClaim` and `check::readCertificate` read.
struct CertificateEvidence {
  std::string claim;
  std::string certificate;
};
struct SolverEvidence {
  std::string smtlib;
  std::vector<std::string> solvers; ///< names and versions
};

struct Proved {
  Grade grade;
  std::variant<CertificateEvidence, SolverEvidence> evidence;
};
/// Values that seem to break the goal.  A candidate: roots may be rounded, and functions such as a sine are known to
/// the search by some of their facts only.  The concrete machine must replay it.
struct Counterexample {
  smt::Model model;
};
struct Unknown {
  std::string reason; ///< lower case, no full stop
};

struct Outcome {
  std::variant<Proved, Counterexample, Unknown> answer;
  std::string method;       ///< `folding`, `linear`, `products`, `z3`, `z3+cvc5`: who found the answer
  std::uint64_t effort = 0; ///< units spent, of all kinds together; the same in every run

  bool proved() const { return std::holds_alternative<Proved>(answer); }
  const smt::Model *counterexample() const {
    const auto *found = std::get_if<Counterexample>(&answer);
    return found == nullptr ? nullptr : &found->model;
  }
};

/// Of a step of a search or a unit of work: about a microsecond.
constexpr std::uint64_t kStepsOfWork = 100;
/// Of the proof of one program, 12 to 20 seconds (smt/steps.h).
constexpr std::uint64_t kStepsOfProgram = 1'000'000'000;
constexpr std::string_view kProgramStepsUsedUp = "gave up: the step budget for this program is used up";

/// Never spends more steps than go with the budget, and no more than the program has left.
Outcome discharge(smt::TermStore &store, const Query &query, const Budget &budget = {});

/// Records what is certified on this thread while it lives, during the search for verdicts, too: which paths are
/// possible, what holds in a loop.  Claims with their certificates, each claim once.
class CertificateLog {
public:
  CertificateLog();
  CertificateLog(const CertificateLog &) = delete;
  CertificateLog &operator=(const CertificateLog &) = delete;
  ~CertificateLog();

  std::map<std::string, std::string> take() { return std::move(certificates_); }
  void add(const CertificateEvidence &evidence) { certificates_.emplace(evidence.claim, evidence.certificate); }

private:
  CertificateLog *outer_;
  std::map<std::string, std::string> certificates_;
};

} // namespace feedhold::prove
