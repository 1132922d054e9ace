// Followed run: one program explored from given inputs alone, where the contract puts the modal codes and the tool.
#pragma once

#include "proof/context/proof_context.h"

namespace feedhold::prove {

class FollowedRun {
public:
  FollowedRun(const ProofSubject &subject, const GivenVariables &given, Arithmetic arithmetic);

  ExploredProgram program() { return {subject_, start_, found_}; }
  smt::TermStore &store() { return start_.store(); }
  const Exploration &found() const { return found_; }

private:
  ProveOptions options_;
  ProofSubject subject_;
  ProofStart start_;
  Exploration found_;
};

} // namespace feedhold::prove
