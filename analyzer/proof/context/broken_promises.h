// Promises of a contract are seen from the state at the return, which runs of the machine do not show: the program is
// followed in exact numbers instead.
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
  bool breaks(const GivenVariables &given, const Obligation &claim);

private:
  std::vector<Obligation> follow(const GivenVariables &given) const;

  const ProofSubject &subject_;
  PromisesOf promisesOf_;
  std::map<InputsKey, std::vector<Obligation>> known_;
};

} // namespace feedhold::prove
