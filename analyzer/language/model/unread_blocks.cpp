// See the header.
#include "language/model/unread_blocks.h"

#include "base/support/text.h"

#include <algorithm>
#include <string>

namespace feedhold {

namespace {

constexpr std::string_view kCoordinates = "XYZABCUVWIJKRN";

std::string textWithoutRemarks(const SourceFile &source, const SyntaxTree &tree, BlockId id) {
  std::string text;
  std::uint32_t from = tree.blocks[id].begin;
  for (const Comment &comment : tree.commentsOf(id)) {
    text += source.text({from, std::max(from, comment.span.begin)});
    from = std::max(from, comment.span.end);
  }
  return text += source.text({from, std::max(from, tree.blocks[id].end)});
}

/// Of the digits at the head of a block whose letter is missing.  On a lathe: elsewhere it may end the tool length.
bool isReferenceReturn(std::string_view digits, const Dialect &dialect) {
  std::uint16_t tenths = 0;
  for (const char c : digits)
    tenths = static_cast<std::uint16_t>(tenths * 10 + (c - '0'));
  const Code *code = digits.size() <= 2 ? findGCode(dialect, static_cast<std::uint16_t>(tenths * 10)) : nullptr;
  return dialect.machine == MachineKind::Turning && code && code->role == CodeRole::ReferenceReturn;
}

} // namespace

bool namesAxesAlone(const SourceFile &source, const SyntaxTree &tree, const Dialect &dialect, BlockId id) {
  std::string text = toUpper(textWithoutRemarks(source, tree, id));
  std::erase_if(text, isBlank);
  const auto head = std::ranges::find_if_not(text, isDigit);
  const auto digits = static_cast<std::size_t>(head - text.begin());
  if (digits > 0 && !isReferenceReturn(std::string_view(text).substr(0, digits), dialect))
    return false;
  bool hasValue = true; // of the last letter
  for (auto c = head; c != text.end(); ++c) {
    const bool isZero = *c == 'O' && c != text.begin() && (isDigit(c[-1]) || c[-1] == '.');
    if (isLetter(*c) && !isZero) {
      if (!hasValue || kCoordinates.find(*c) == std::string_view::npos)
        return false;
      hasValue = false;
    } else if (isDigit(*c) || isZero) {
      hasValue = true;
    } else if (std::string_view("+-.,").find(*c) == std::string_view::npos) {
      return false;
    }
  }
  return head != text.end();
}

} // namespace feedhold
