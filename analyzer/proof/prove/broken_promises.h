// Promises of a contract are seen from the state at the return, which runs of the machine do not show: the program is
// followed in exact numbers instead.
#pragma once

#include "proof/prove/exact_run.h"
#include "proof/prove/obligation.h"
#include "proof/prove/proof_start.h"

#include <map>

namespace feedhold::prove {

class BrokenPromises {
public:
  explicit BrokenPromises(const ProofSubject &subject) : subject_(subject) {}
  /// The run on these inputs breaks the claim.
  bool breaks(const GivenVariables &given, const Obligation &claim);

private:
  std::vector<Obligation> follow(const GivenVariables &given) const;

  const ProofSubject &subject_;
  std::map<InputsKey, std::vector<Obligation>> known_;
};

} // namespace feedhold::prove
