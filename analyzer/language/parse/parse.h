// parse: text -> tree of one file.  Never fails: what does not parse becomes a Broken node and an issue.
#pragma once

#include "base/source/source_file.h"
#include "language/dialect/dialect.h"
#include "language/syntax/tree.h"

namespace feedhold {

SyntaxTree parse(const SourceFile &source, const Dialect &dialect);

/// An operand beside those of the dialect: the bytes that it takes, and the number of the variable that stands for it.
struct ReservedOperand {
  std::uint32_t length;
  Decimal variable;
};
/// Looks at the text where an operand is expected that the dialect does not know.
using FindReserved = std::optional<ReservedOperand> (*)(std::string_view rest);

/// `a EQ b WITHIN t`, `a NE b WITHIN t`: whether two numbers differ by at most t.
inline constexpr std::string_view kWithin = "WITHIN";

/// Reads a part of a text as one expression and adds it to `tree`, issues included.  A symbol (`<`, `=`) may compare.
ExpressionId parseExpression(SyntaxTree &tree, const SourceFile &source, Span part, const Dialect &dialect,
                             FindReserved reserved = nullptr);

} // namespace feedhold
