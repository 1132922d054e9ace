// Linear algebra over exact numbers.
#pragma once

#include "proof/smt/number.h"

#include <vector>

namespace feedhold::prove {

/// A basis of the vectors that every row of the matrix takes to 0.  Rows have `columns` numbers.
std::vector<std::vector<smt::Number>> nullSpace(std::vector<std::vector<smt::Number>> rows, std::size_t columns);

} // namespace feedhold::prove
