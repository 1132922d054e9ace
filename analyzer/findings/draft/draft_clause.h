// DraftClause: one line of a drafted contract.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace feedhold::draft {

/// What a clause rests on, which decides when it is kept.
enum class Ground : std::uint8_t {
  Guard,   // the program itself refuses other calls
  Notes,   // the program serves a call without it: it only says so
  Guess,   // an assumption that callers have to keep: kept if a proof needs it
  Promise, // kept if it is proved
  Hint,    // for the reader: written as a remark
};

struct DraftClause {
  std::string text;   // `@PARAM #18 R 0.1..`
  std::string reason; // `otherwise alarm 121 (line 7)`
  Ground ground;
  /// Of a Guess or a Hint: a clause that asks for less.
  std::string weaker = {};
};
using DraftClauses = std::vector<DraftClause>;

} // namespace feedhold::draft
