// Allowances: how a person says that a finding may stay: in a comment, or in the file beside a program whose bytes are
// not to change.
#pragma once

#include "findings/project/project.h"
#include "surface/lsp/published_diagnostics.h"

#include <optional>
#include <string>

namespace feedhold::lsp {

/// A comment behind what the block says.
std::optional<Edit> commentAllowing(const PublishedDiagnostic &published, const ProjectFile &file);

/// A clause in the file with contracts beside the program.
struct SidecarClause {
  std::filesystem::path file; // one that is there, if any is
  bool isNew;                 // it has to be made
  SourceFile before;
  Edit edit;         // at its end
  std::string place; // `N20`, `O9100`: what it covers
};
/// For the block, if it has a number of its own; else for the whole program.  Absent: the program has no name that a
/// clause could say.
std::optional<SidecarClause> clauseAllowing(const PublishedDiagnostic &published, const ProjectFile &file);

} // namespace feedhold::lsp
