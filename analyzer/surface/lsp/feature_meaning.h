// Meaning: what people call the parts of a program: titles, names of arguments, what a variable or a code is.
#pragma once

#include "surface/lsp/feature_symbol.h"

#include <optional>
#include <string>
#include <string_view>

namespace feedhold::lsp {

/// `O9100`, or `this program` for one without a name.
std::string nameOf(const Project &programs, ProgramRef program);
/// The comment behind the O word; empty: none.
std::string titleOf(const ProjectFile &file, ProgramId program);
/// What the contract calls a variable, else a comment of the program (`(#21 = DEPTH)`, `(U: DEPTH)`, or the one beside
/// its first assignment); empty: nothing does.
std::string meaningOf(const Project &programs, ProgramRef program, std::uint32_t variable);
/// The clause about a variable on entry as it stands in the contract; empty: none.
std::string clauseOf(const Project &programs, ProgramRef program, std::uint32_t variable);
/// The letter that passes a local variable; absent: none does.
std::optional<char> letterOf(const Dialect &dialect, std::uint32_t variable);
/// "common variable, kept at power-off", "local variable, argument U", "_CNTL1: ..".
std::string kindOf(const Project &programs, std::uint32_t variable);
/// What a clause of a contract says, by its kind.
std::string_view helpOf(ClauseKind kind);
/// The line of an offset, from 1.
std::uint32_t lineOf(const ProjectFile &file, BlockId block);

} // namespace feedhold::lsp
