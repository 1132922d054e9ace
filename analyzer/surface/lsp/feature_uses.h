// Uses: all places at which a name of a program stands.
#pragma once

#include "surface/lsp/feature_symbol.h"

#include <vector>

namespace feedhold::lsp {

enum class UseRole : std::uint8_t {
  Definition, // the N word, the O word, the DO; an assignment
  Reference,
};
struct Use {
  FileId file;
  Span span;
  UseRole role;
  friend auto operator<=>(const Use &, const Use &) = default;
};

// In order of files and places.
std::vector<Use> usesOf(const Project &programs, const LabelRef &label);
std::vector<Use> usesOf(const Project &programs, const VariableRef &variable);
std::vector<Use> usesOf(const Project &programs, ProgramRef program);
/// Of what stands at a place of the document; empty: it has no name, or its name is computed.
std::vector<Use> usesOf(const Project &programs, const ProgramSymbol &symbol);

} // namespace feedhold::lsp
