// Table programs: short random programs that read and write variables through indices, in ranges that a contract, a
// guard or a loop gives, and that compare what they find.
#pragma once

#include "soundness/sample_start.h"

namespace feedhold::proof_tests {

soundness::Sample tableSample(soundness::Random &random);
/// Values for the tables, too.
soundness::EntryValues tableEntry(const soundness::LoadedSample &machine, soundness::Random &random);

} // namespace feedhold::proof_tests
