// Applying fix-its to the bytes of a file.
#pragma once

#include "base/diag/diagnostic.h"

#include <span>
#include <string>
#include <string_view>

namespace feedhold {

struct AppliedEdits {
  std::string text;
  std::size_t applied = 0;   // fix-its applied
  std::size_t conflicts = 0; // fix-its left out because they overlap an earlier one
};

/// Applies whole fix-its in the order given; one whose edits overlap an applied one is left out entirely.
AppliedEdits applyFixes(std::string_view text, std::span<const FixIt> fixes);

/// A unified diff with three lines of context, `--- a/path` / `+++ b/path`; empty when both texts are equal.
std::string unifiedDiff(std::string_view path, std::string_view before, std::string_view after);

} // namespace feedhold
