// Ladders of cases: `IF[#1EQ1]GOTO10`, `IF[#1EQ2]GOTO20` one below the other.
#pragma once

#include "findings/rule/rule.h"

#include <optional>
#include <vector>

namespace feedhold::rules {

/// One `IF[#1EQ3]` alone in its block, whatever its action.
struct CaseLine {
  BlockId block;
  const Statement *statement;
  std::uint32_t variable;
  ExpressionId selector; // the variable in the condition
  Decimal value;
  const Jump *jump = nullptr; // its GOTO; null: another action
};

/// The case of a block; absent when it asks for something else, or nothing.
std::optional<CaseLine> caseAt(const FileContext &context, BlockId block);

/// The next block in which more than comments stands; behind the last block of the text where there is none.
BlockId nextContent(const FileContext &context, BlockId block);

/// Lines of one variable directly below each other, two or more.
struct CaseLadder {
  std::vector<CaseLine> cases;
  BlockId behind; // the block at which any other value arrives
};
std::vector<CaseLadder> caseLaddersOf(const FileContext &context, ProgramId program);

} // namespace feedhold::rules
