// A number whose address is missing: `G43 25.0`, of which the control reads `G4325.0`.
#pragma once

#include "findings/rule/rule.h"

#include <optional>

namespace feedhold::rules {

/// The digits of the word behind the blank that parts them; absent for a word that is written in one piece.
std::optional<Span> loneNumberIn(const Word &word, const FileContext &context);

} // namespace feedhold::rules
