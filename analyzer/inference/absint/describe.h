// Describe: abstract values in words and signs that a machinist can read.
#pragma once

#include "inference/domain/value.h"

#include <string>

namespace feedhold {

/// `vacant`, `3`, `0 to 17 in steps of 0.25`, `any number`, `vacant or 1 to 3`.
std::string describe(const AbstractValue &value);

} // namespace feedhold
