// Whether a run breaks a promise of a contract.  Promises speak of the state at the return, which runs of the machine
// do not show: the program is explored from these inputs in exact numbers instead.
#pragma once

#include "proof/context/proof_start.h"
#include "proof/obligation/obligation.h"
#include "proof/replay/exact_run.h"

#include <functional>
#include <map>

namespace feedhold::prove {

struct ExploredProgram;
struct Question;

class BrokenPromises {
public:
  /// `promisesOf`: what a program promises, as questions.
  using PromisesOf = std::function<std::vector<Question>(const ExploredProgram &)>;
  BrokenPromises(const ProofSubject &subject, PromisesOf promisesOf)
      : subject_(subject), promisesOf_(std::move(promisesOf)) {}
  /// The run on these inputs breaks the claim.
  bool breaks(const GivenVariables &given, const Obligation &claim) { return broken(given, claim) != nullptr; }
  /// What that run does; empty: no more is known.
  std::string howBroken(const GivenVariables &given, const Obligation &claim);

private:
  struct Broken {
    Obligation claim;
    std::string how;
  };
  const Broken *broken(const GivenVariables &given, const Obligation &claim);
  std::vector<Broken> follow(const GivenVariables &given) const;

  const ProofSubject &subject_;
  PromisesOf promisesOf_;
  std::map<InputsKey, std::vector<Broken>> known_;
};

} // namespace feedhold::prove
