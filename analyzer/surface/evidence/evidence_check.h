// Evidence checked: every certificate of a bundle is followed, and solvers are asked every question again.
#pragma once

#include "proof/decide/discharge.h"
#include "surface/evidence/evidence_bundle.h"

namespace feedhold {

enum class AskSolvers : std::uint8_t {
  Always,     // also what has a certificate, which needs no solver
  WhereNeeded // only what rests on their answers
};

enum class SolverSays : std::uint8_t { Refutes, Satisfiable, NoAnswer, NotAsked };
std::string_view nameOf(SolverSays says);

/// What became of one question: a text of SMT-LIB, alone or with a certificate that it cannot be satisfied.
struct Question {
  std::string file;
  bool hasCertificate = false;
  bool isFollowed = false; // the checker has followed its certificate to the end
  SolverSays z3 = SolverSays::NotAsked;
  SolverSays cvc5 = SolverSays::NotAsked;
  std::string problem = {}; // empty: none

  bool holds() const { return problem.empty(); }
};

struct EvidenceOptions {
  AskSolvers ask = AskSolvers::Always;
  unsigned jobs = 0; // 0: one for each processor
};

/// In the order of the files' names.  A question with a certificate holds when the checker follows that and no solver
/// contradicts; one without when both solvers refute it.
std::vector<Question> checkEvidence(const Bundle &bundle, const EvidenceOptions &options);

} // namespace feedhold
