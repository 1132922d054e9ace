// Reserved variables: what an expression of a contract names beside the variables of the program: positions and values
// on entry.
//
// In the syntax tree each is a NumberedVariable with a negative number, which no program text gives, so that a program
// cannot name one by accident; the number in the state of a machine is its negation and lies above all named variables.
// `evaluate` (meaning/semantics) reads it from the stored variables of the state: who evaluates a condition of a
// contract puts them there first.
#pragma once

#include "language/syntax/tree.h"

#include <cstdint>
#include <optional>

namespace feedhold {

/// `POS[X]`: where the tool is when the program returns, in the active work coordinate system.
inline constexpr std::uint32_t kFirstPositionVariable = 0xC0000000; // + letter
/// `ENTRY[X]`: where it was on entry.
inline constexpr std::uint32_t kFirstEntryVariable = 0xC0000100; // + letter
/// X, Y and Z of `WHERE`: any point of the region.
inline constexpr std::uint32_t kFirstPointVariable = 0xC0000200; // + letter
/// `OLD[#510]`: what the variable held on entry.
inline constexpr std::uint32_t kFirstOldVariable = 0xD0000000; // + number of the variable
inline constexpr std::uint32_t kLastOldVariable = 0xDFFFFFFF;

constexpr std::uint32_t positionVariable(char axis) { return kFirstPositionVariable + static_cast<std::uint8_t>(axis); }
constexpr std::uint32_t entryVariable(char axis) { return kFirstEntryVariable + static_cast<std::uint8_t>(axis); }
constexpr std::uint32_t pointVariable(char axis) { return kFirstPointVariable + static_cast<std::uint8_t>(axis); }
constexpr std::uint32_t oldVariable(std::uint32_t number) { return kFirstOldVariable + number; }

struct PositionOf {
  char axis;
};
struct EntryPositionOf {
  char axis;
};
struct PointOf {
  char axis;
};
struct OldValueOf {
  std::uint32_t variable;
};
using ReservedVariable = std::variant<PositionOf, EntryPositionOf, PointOf, OldValueOf>;

/// What a number of the state stands for; absent for those of a program.
std::optional<ReservedVariable> reservedVariable(std::uint32_t number);
/// The number in the state of a reserved variable of the tree; absent for every other expression.
std::optional<std::uint32_t> reservedNumber(const SyntaxTree &tree, ExpressionId expression);

} // namespace feedhold
