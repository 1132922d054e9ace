// Codes that take their offset from a word: the common part of the rules about a word that is left out.
#pragma once

#include "rules/motion/motion_view.h"

#include <string_view>

namespace feedhold::rules {

struct OffsetCode {
  std::initializer_list<CodeAction> actions;
  char letter;             // of the word
  std::string_view offset; // "the length offset"
};

/// Reports the codes of a main program for a mill that are executed before any such word, in all runs.
std::unique_ptr<FlowRule> watchForMissingNumber(const OffsetCode &code, ProgramId program, const FileContext &context);

} // namespace feedhold::rules
