// Whether a program seems to be for another control than the one that it is checked for: it uses variables and G codes
// that this one does not have, or its blocks cannot be read.
#pragma once

#include "findings/rule/rule.h"

#include <map>
#include <optional>
#include <string>

namespace feedhold {

/// So many variables that do not exist are more than slips.
inline constexpr std::size_t kForeignVariables = 4;

/// Variables and G codes that the control does not have, each where it stands first.
using MissingVariables = std::map<std::uint32_t, Span>;
using MissingCodes = std::map<std::string, Span>;
MissingVariables missingVariablesOf(const FileContext &context);
MissingCodes missingCodesOf(const FileContext &context);

bool isOfOtherControl(const MissingVariables &variables, const MissingCodes &codes);
/// The same, or the variables alone, or the codes alone, are too many for slips.
bool seemsForOtherControl(const FileContext &context);

/// What other languages have where this one has something else, or nothing.
enum class ForeignHabit : std::uint8_t {
  SlashRemark,  // `// text`, `M00 /text`
  QuoteRemark,  // `'text`
  LongRemark,   // `(text` .. `text)` over several lines
  DecimalComma, // `F0,2`
  Checksum,     // `G01 X10 *45`
  NamedMacroB,  // `#<depth>` beside `IF [..] GOTO` and `DO1`
};

/// Absent: the issue may be a slip of somebody who writes for this control.
std::optional<ForeignHabit> habitAt(const SyntaxIssue &issue, const FileContext &context);

/// A text that does not read as the language of the control.
struct UnreadText {
  std::size_t unread = 0; // blocks that hold something else than words, statements and remarks
  std::size_t blocks = 0; // that do something
  Span first;
  std::optional<ForeignHabit> habit = std::nullopt; // that nearly all of them have
};

/// Absent where what cannot be read may be slips of somebody who writes for this control.
std::optional<UnreadText> unreadTextOf(const FileContext &context);

} // namespace feedhold
