// Sidecar text: drafted clauses as lines of a file, between those that people wrote.
#pragma once

#include "findings/draft/draft_clause.h"

#include <string>
#include <string_view>

namespace feedhold::draft {

/// The lines that no draft has written.
std::string withoutDrafts(std::string_view text);
/// Drafted lines stand behind those that people wrote.
std::string withDrafts(std::string kept, const DraftClauses &clauses);

} // namespace feedhold::draft
