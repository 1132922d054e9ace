// Here: what is known before a block of the document, put into facts.
#pragma once

#include "surface/lsp/feature.h"
#include "surface/sink/ranges_facts.h"

#include <optional>
#include <string>
#include <vector>

namespace feedhold::lsp {

/// As one way of calls reaches the line.
struct FactsHere {
  std::string way; // `called in line 12`; empty: started by itself
  StateFacts facts;
};
struct KnownHere {
  std::vector<FactsHere> ways; // empty: no run comes here
  std::string assumed;         // `assuming the contract`; empty: nothing
};

/// Absent: nothing is executed there, or the program could not be followed.
std::optional<KnownHere> knownBefore(const View &view, BlockId block);

/// One line for each different text, with the ways that lead to it where there are several.
std::string together(const std::vector<std::pair<std::string, std::string>> &wayAndText);

} // namespace feedhold::lsp
