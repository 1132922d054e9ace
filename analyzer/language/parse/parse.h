// parse: text -> tree of one file.  Never fails: what does not parse becomes a Broken node and an issue.
#pragma once

#include "base/source/source_file.h"
#include "language/dialect/dialect.h"
#include "language/syntax/tree.h"

namespace feedhold {

SyntaxTree parse(const SourceFile &source, const Dialect &dialect);

} // namespace feedhold
