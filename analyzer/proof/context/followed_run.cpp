#include "proof/context/followed_run.h"

namespace feedhold::prove {

namespace {

/// The inputs may be outside of the contract, too: a program answers for the calls that it refuses.
Exploration explored(ProofStart &start, const ProofSubject &subject, const GivenVariables &given, Outcomes outcomes) {
  ExploreOptions options = start.exploreOptions(subject, exactOptions());
  options.assumptions.clear();
  options.relyOn = Reliance::Nobody; // what no text shows refutes nothing
  if (outcomes == Outcomes::Usual) {
    start.interpretation().takeUsual(given.start.settings);
    options.cutterOffset = {};
  }
  return explore(start.interpretation(), subject.programs, subject.program, start.entry(), options);
}

} // namespace

FollowedRun::FollowedRun(const ProofSubject &subject, const GivenVariables &given, Arithmetic arithmetic,
                         Outcomes outcomes)
    : options_{.guards = InferGuards::No,
               .arithmetic = arithmetic,
               .missing = subject.options.missing,
               .contractsOf = subject.options.contractsOf,
               .missingContracts = subject.options.missingContracts},
      subject_{subject.programs, subject.program, subject.contracts, options_}, start_(subject_, &given),
      found_(explored(start_, subject_, given, outcomes)) {}

} // namespace feedhold::prove
