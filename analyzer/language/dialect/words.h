// The closed vocabularies of the macro languages: functions, operators, control words, o-words.  Dialects choose from
// them.
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

namespace feedhold {

enum class FunctionKind : std::uint8_t {
#define FUNCTION(kind, spelling) kind,
#include "language/dialect/functions.def"
};

enum class OperatorKind : std::uint8_t {
#define OPERATOR(kind, spelling) kind,
#include "language/dialect/operators.def"
};

enum class ControlWord : std::uint8_t {
#define CONTROL_WORD(kind, spelling) kind,
#include "language/dialect/control_words.def"
};

enum class OWordKind : std::uint8_t {
#define O_WORD(kind, spelling) kind,
#include "language/dialect/o_words.def"
};

std::string_view spellingOf(FunctionKind function);
std::string_view spellingOf(OperatorKind op);
std::string_view spellingOf(ControlWord word);
std::string_view spellingOf(OWordKind word);

constexpr bool isRelation(OperatorKind op) { return op >= OperatorKind::Equal && op <= OperatorKind::LessOrEqual; }
constexpr bool isBitwise(OperatorKind op) {
  return op == OperatorKind::And || op == OperatorKind::Or || op == OperatorKind::Xor;
}

} // namespace feedhold
