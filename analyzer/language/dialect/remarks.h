// Text that is meant for people and for simulators, not for the control: remarks behind `;`, which a control reads as
// the end of a block, and directives.
#pragma once

#include <string_view>

namespace feedhold {

/// Of the whole text: `G0 X1 ; to the left` in one line says what `;` is in all.
bool hasSemicolonRemarks(std::string_view text);

/// `[BILLET X40 Z80`: Denford's simulators read the stock and the tools from such lines; their controls skip them.
bool isSimulatorDirective(std::string_view line);

} // namespace feedhold
