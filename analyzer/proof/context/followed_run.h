// Followed run: one program explored from given inputs alone, where the contract puts the modal codes and the tool.
#pragma once

#include "proof/context/proof_context.h"

namespace feedhold::prove {

/// Of what no text and no manual says.  Usual: as in a run of the machine, which follows cutter compensation by itself.
enum class Outcomes : std::uint8_t { All, Usual };

class FollowedRun {
public:
  FollowedRun(const ProofSubject &subject, const GivenVariables &given, Arithmetic arithmetic, Outcomes outcomes);

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
