// All dialects and all languages that are recognised and refused.
#pragma once

#include "language/dialect/registry.h"

namespace feedhold {

const DialectRegistry &allDialects();

} // namespace feedhold
