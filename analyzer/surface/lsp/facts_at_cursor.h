// FactsAtCursor: what is known before a block of the document, for each chain of calls that leads to it.
#pragma once

#include "surface/lsp/feature.h"
#include "surface/sink/ranges_facts.h"

#include <optional>
#include <string>
#include <vector>

namespace feedhold::lsp {

struct FactsOfContext {
  std::string caller; // `called in line 12`; empty: started by itself
  StateFacts facts;
};
struct FactsAtCursor {
  std::vector<FactsOfContext> contexts; // empty: no run comes here
  std::string assumed;                  // `assuming the contract`; empty: nothing
};

/// Absent: nothing is executed there, or the program could not be followed.
std::optional<FactsAtCursor> knownBefore(const View &view, BlockId block);

/// One line for each different text, with the callers for which it holds where texts differ.
std::string together(const std::vector<std::pair<std::string, std::string>> &callerAndText);

} // namespace feedhold::lsp
