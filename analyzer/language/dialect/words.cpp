// The spellings of the closed vocabularies.
#include "language/dialect/words.h"

#include <cstddef>

namespace feedhold {

std::string_view spellingOf(FunctionKind function) {
  static constexpr std::string_view kSpellings[] = {
#define FUNCTION(kind, spelling) spelling,
#include "language/dialect/functions.def"
  };
  return kSpellings[static_cast<std::size_t>(function)];
}

std::string_view spellingOf(OperatorKind op) {
  static constexpr std::string_view kSpellings[] = {
#define OPERATOR(kind, spelling) spelling,
#include "language/dialect/operators.def"
  };
  return kSpellings[static_cast<std::size_t>(op)];
}

std::string_view spellingOf(ControlWord word) {
  static constexpr std::string_view kSpellings[] = {
#define CONTROL_WORD(kind, spelling) spelling,
#include "language/dialect/control_words.def"
  };
  return kSpellings[static_cast<std::size_t>(word)];
}

std::string_view spellingOf(OWordKind word) {
  static constexpr std::string_view kSpellings[] = {
#define O_WORD(kind, spelling) spelling,
#include "language/dialect/o_words.def"
  };
  return kSpellings[static_cast<std::size_t>(word)];
}

} // namespace feedhold
