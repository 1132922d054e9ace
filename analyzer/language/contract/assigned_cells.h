// The cells of the control that a contract lets its program write.
#pragma once

#include "language/contract/contract.h"

#include <set>

namespace feedhold {

/// Of all the clauses together.  Numbers that are one cell on some controls only are not allowed with each other.
std::set<std::uint32_t> assignedCells(const Dialect &dialect, const std::vector<Assigns> &clauses);

} // namespace feedhold
