// Whether `;` begins a remark in a text.  A control reads it as the end of a block; people and senders write remarks
// behind it.
#pragma once

#include <string_view>

namespace feedhold {

/// Of the whole text: `G0 X1 ; to the left` in one line says what `;` is in all.
bool hasSemicolonRemarks(std::string_view text);

} // namespace feedhold
