// Short programs: random ones of the kind that shops write and a prover can follow: guards, one or two loops, alarms,
// divisions, a call; half of them with a contract.
#pragma once

#include "soundness/sample_start.h"

namespace feedhold::proof_tests {

/// Its numbers are those that doubles hold exactly, and quotients are made whole.
soundness::Sample shortSample(soundness::Random &random);

/// Small numbers, near those where the conditions of such programs turn; some vacant.
soundness::EntryValues shortEntry(const soundness::LoadedSample &machine, soundness::Random &random);

} // namespace feedhold::proof_tests
