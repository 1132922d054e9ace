// Which branches are those of Macro B.
#include "language/dialect/line_scanner.h"

#include <algorithm>

namespace feedhold {

namespace {

/// `IF [#200 > 150]`; `#<NAME>` is none.
bool comparesByCharacter(std::string_view text) {
  for (std::size_t at = text.find_first_of("<>"); at != std::string_view::npos; at = text.find_first_of("<>", at + 1)) {
    if (text[at] == '>' || at == 0 || text[at - 1] != '#')
      return true;
    at = std::min(text.find('>', at), text.size() - 1);
  }
  return false;
}

} // namespace

/// A branch over a comparison by a character is none of Macro B.
void LineScanner::noteBranch() {
  if (hasIf_ && !hasOWord_ && !comparesByCharacter(line_.substr(0, at_)))
    note(TextSignal::MacroBranch);
}

} // namespace feedhold
