// What is said of a file in another language: that it is refused, or that it seems to be in one.  Internal to session/.
#pragma once

#include "findings/project/workload.h"
#include "findings/rule/rule.h"

#include <optional>

namespace feedhold {

/// Of an item with a foreign language, whose profile has the rule that says it.
RawFinding refusalOf(const WorkItem &item);

/// Of a file whose control is a guess, and whose text does not read as the language of that control.
std::optional<RawFinding> doubtOf(const WorkItem &item, const FileContext &context);

} // namespace feedhold
