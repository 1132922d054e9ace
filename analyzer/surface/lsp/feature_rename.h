// Rename: one name for another at all its places, or the reason why that is not safe.
#pragma once

#include "surface/lsp/feature_edits.h"

#include <string_view>

namespace feedhold::lsp {

// All throw Refused.

/// `newName`: `N20` or `20`.
void renameLabel(const View &view, const LabelRef &label, std::string_view newName, Edits &edits);
/// `newName`: `#105`, `105`, or `#<depth>` for a variable with a name.
void renameVariable(const View &view, const VariableRef &variable, std::string_view newName, Edits &edits);
/// What speaks against it whatever the new name.
void checkLabelCanChange(const View &view, const LabelRef &label);
void checkVariableCanChange(const View &view, const VariableRef &variable);

/// Jumps of a program whose targets are not known, and those from elsewhere that may lead into it.
void checkJumpsAreKnown(const Project &programs, ProgramRef program);
/// Numbers behind `@AT N` in the contracts beside a program.
struct NamedBlock {
  ContractSourceId source;
  Span span; // `N30`
  std::uint32_t number;
};
std::vector<NamedBlock> blocksNamedBeside(const ProjectFile &file, ProgramId program);
/// A jump's number, or an N word, as it is written with another number.
std::string withNumber(const ProjectFile &file, Span span, std::uint32_t number);

} // namespace feedhold::lsp
