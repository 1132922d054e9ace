// Followed run: one program explored from given inputs alone, where the contract puts the modal codes and the tool.
#pragma once

#include "proof/context/proof_context.h"

namespace feedhold::prove {

/// Whether cutter compensation is a claim about the path of the tool's centre, or a stop that may come.
enum class CompensationIs : std::uint8_t { Claim, Stop };

class FollowedRun {
public:
  FollowedRun(const ProofSubject &subject, const GivenVariables &given, Arithmetic arithmetic,
              CompensationIs compensation);

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
