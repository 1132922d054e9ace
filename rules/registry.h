// All rules there are.
#pragma once

#include "findings/rule/registry.h"

namespace feedhold {

const RuleRegistry &allRules();

} // namespace feedhold
