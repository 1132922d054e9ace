// The list made from dialects.def.
#include "dialects/registry.h"

#include "dialects/common/foreign_languages.h"

#include <array>

namespace feedhold {

#define DIALECT(function, id, folder) const Dialect &function();
#include "dialects/dialects.def"

const DialectRegistry &allDialects() {
  static const std::array kDialects = {
#define DIALECT(function, id, folder) &function(),
#include "dialects/dialects.def"
  };
  static const DialectRegistry kRegistry{kDialects, foreignLanguages()};
  return kRegistry;
}

} // namespace feedhold
