// Proof records: verdicts as bytes, to be kept and read again.
#pragma once

#include "proof/prove/prove.h"

#include <map>
#include <optional>
#include <string>
#include <string_view>

namespace feedhold {

/// Claims that were certified on the way to the verdicts, and their certificates.
using ProofSteps = std::map<std::string, std::string>;

/// `steps`: null: the evidence is left out, as from a record that is only to save time; who wants it proves anew.
std::string writeProofRecord(const prove::ProgramProof &proof, const ProofSteps *steps = nullptr);

struct RecordedProof {
  prove::ProgramProof proof; // reasons in it lie in the record
  ProofSteps steps;
};
/// Absent: that is no record, or one of another program.
std::optional<RecordedProof> readProofRecord(std::string_view record, const ProgramSet &programs);

} // namespace feedhold
