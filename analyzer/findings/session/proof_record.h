// Proof records: verdicts as bytes, to be kept and read again.  Evidence is left out: who wants it proves anew.
#pragma once

#include "proof/prove/prove.h"

#include <optional>
#include <string>
#include <string_view>

namespace feedhold {

std::string writeProofRecord(const prove::ProgramProof &proof);

/// Reasons in the result lie in the record.  Absent: that is no record, or one of another program.
std::optional<prove::ProgramProof> readProofRecord(std::string_view record, const ProgramSet &programs);

} // namespace feedhold
