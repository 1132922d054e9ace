#include "language/contract/reserved.h"

namespace feedhold {

namespace {

/// The letter of a variable that is `first` + letter.
std::optional<char> letterFrom(std::uint32_t number, std::uint32_t first) {
  if (number < first || number - first < 'A' || number - first > 'Z')
    return std::nullopt;
  return static_cast<char>(number - first);
}

} // namespace

std::optional<ReservedVariable> reservedVariable(std::uint32_t number) {
  if (const auto axis = letterFrom(number, kFirstPositionVariable))
    return PositionOf{*axis};
  if (const auto axis = letterFrom(number, kFirstEntryVariable))
    return EntryPositionOf{*axis};
  if (const auto axis = letterFrom(number, kFirstPointVariable))
    return PointOf{*axis};
  if (number >= kFirstOldVariable && number <= kLastOldVariable)
    return OldValueOf{number - kFirstOldVariable};
  return std::nullopt;
}

std::optional<std::uint32_t> reservedNumber(const SyntaxTree &tree, ExpressionId expression) {
  const auto *variable = std::get_if<NumberedVariable>(&tree.expressions[expression].node);
  const std::optional<std::int64_t> number = variable ? variable->number.asInteger() : std::nullopt;
  if (!number || *number >= 0 || -*number > 0xffffffffLL)
    return std::nullopt;
  const auto positive = static_cast<std::uint32_t>(-*number);
  return reservedVariable(positive) ? std::optional(positive) : std::nullopt;
}

} // namespace feedhold
