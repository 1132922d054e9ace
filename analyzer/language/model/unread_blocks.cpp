// See the header.
#include "language/model/unread_blocks.h"

#include "base/support/text.h"

#include <algorithm>
#include <optional>
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

/// Whatever the control takes the code for, no other program runs, and modal calls stay as they are.
bool isApartFromCalls(const Dialect &dialect, char address, std::uint16_t tenths) {
  if (findCodeCall(dialect, address, tenths) || mayDoAnything(dialect, address, tenths))
    return false;
  const Code *code = address == 'G' ? findGCode(dialect, tenths) : findMCode(dialect, tenths);
  if (!code)
    return address == 'M'; // of the machine builder
  constexpr std::array kOthers = {CodeRole::OwnWords,      CodeRole::MacroCall,       CodeRole::ModalCall,
                                  CodeRole::ModalCallEach, CodeRole::ModalCallCancel, CodeRole::SubprogramCall,
                                  CodeRole::LocalCall,     CodeRole::ExternalCall,    CodeRole::JumpOnInput};
  return std::ranges::find(kOthers, code->role) == kOthers.end() && code->action != CodeAction::Anything &&
         code->action != CodeAction::InterruptOn;
}

/// Ten times the number at the head of the text, and how long it is; absent: there is none, or more than a number.
std::optional<std::pair<std::uint16_t, std::size_t>> codeNumberIn(std::string_view text) {
  constexpr std::size_t kMostDigits = 4;
  const auto digits = static_cast<std::size_t>(std::ranges::find_if_not(text, isDigit) - text.begin());
  if (digits == 0 || digits > kMostDigits)
    return std::nullopt;
  std::uint32_t tenths = 0;
  for (const char c : text.substr(0, digits))
    tenths = tenths * 10 + static_cast<std::uint32_t>(c - '0');
  tenths *= 10;
  std::size_t length = digits;
  if (length < text.size() && text[length] == '.') {
    ++length;
    if (length < text.size() && isDigit(text[length]))
      tenths += static_cast<std::uint32_t>(text[length++] - '0');
  }
  const bool ends = length == text.size() || isLetter(text[length]) || text[length] == '(' || text[length] == ';';
  if (!ends || tenths > 0xffff)
    return std::nullopt;
  return std::pair{static_cast<std::uint16_t>(tenths), length};
}

} // namespace

/// Remarks are looked at, too: where one begins may be what could not be read.
bool leavesModalCalls(const SourceFile &source, const SyntaxTree &tree, const Dialect &dialect, BlockId id) {
  std::string whole = toUpper(source.text({tree.blocks[id].begin, tree.blocks[id].end}));
  const auto isSeen = [](char c) { return c > ' ' && c < 127; };
  std::erase_if(whole, [](char c) { return isBlank(c) || c == '\r' || c == '\n'; });
  if (!std::ranges::all_of(whole, isSeen))
    return false;
  const std::string_view text = whole;
  const auto callsByCode = [&](char address) { // by T, S or B, whatever its number
    return address != 'G' && address != 'M' &&
           std::ranges::any_of(dialect.switches.codeCalls,
                               [&](const CodeCall &call) { return call.address == address; });
  };
  for (std::size_t at = 0; at < text.size(); ++at) {
    if (callsByCode(text[at]))
      return false;
    if (text[at] != 'G' && text[at] != 'M')
      continue;
    if (at + 1 < text.size() && isLetter(text[at + 1]))
      continue; // a word of the macro language, or of a remark
    const auto number = codeNumberIn(text.substr(at + 1));
    if (!number || !isApartFromCalls(dialect, text[at], number->first))
      return false;
  }
  return true;
}

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
