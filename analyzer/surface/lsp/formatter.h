// Formatting: blanks between words and at the beginning of lines, nothing else.
#pragma once

#include "base/diag/diagnostic.h"
#include "language/dialect/dialect.h"
#include "language/syntax/tree.h"

#include <string>
#include <vector>

namespace feedhold::lsp {

struct FormatStyle {
  std::string indent = "  "; // of one loop or branch: blanks, or a tab
};

/// The edits, in order, that put one blank where several stand between two words, none at the end of a line, and before
/// the blocks of a loop or a branch one indent for each that is open.  Each replaces blanks and tabs alone.  Words that
/// stand without a blank stay so, since some controls want it; comments, printed formats, data of `G10` and blocks that
/// are not understood keep every byte.  Empty when the tokens would be others with them.
std::vector<Edit> format(const SourceFile &source, const SyntaxTree &tree, const Dialect &dialect,
                         const FormatStyle &style);

} // namespace feedhold::lsp
