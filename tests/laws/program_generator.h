// Random macro programs for the laws: a list of pieces that can be joined with or without blanks.
#pragma once

#include <rapidcheck.h>
#include <string>
#include <string_view>
#include <vector>

namespace feedhold::laws {

/// The pieces of one block, each an indivisible run of characters (`G01`, `#`, `1.5`, `WHILE`, `(TEXT)`).
using BlockPieces = std::vector<std::string>;
using ProgramPieces = std::vector<BlockPieces>;

/// Blocks that a control accepts: words, assignments, conditions, loops, calls, comments.
rc::Gen<ProgramPieces> programPieces();

/// The same for controls with o-words: subroutines, branches, loops, calls, named parameters.
rc::Gen<ProgramPieces> oWordPieces();

std::string join(const ProgramPieces &program, std::string_view between, std::string_view endOfBlock);

/// `text` with some bytes removed, doubled, or replaced by others that programs are made of.
rc::Gen<std::string> mutated(std::string text);

} // namespace feedhold::laws
