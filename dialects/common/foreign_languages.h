// Languages that are recognised and refused.
#pragma once

#include "language/dialect/dialect.h"

#include <span>

namespace feedhold {

std::span<const ForeignLanguage> foreignLanguages();

} // namespace feedhold
