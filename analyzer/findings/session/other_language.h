// What is said of a file in another language: that it is refused, or that it seems to be in one.  Internal to session/.
#pragma once

#include "findings/project/workload.h"
#include "findings/rule/rule.h"

#include <optional>
#include <vector>

namespace feedhold {

/// Of an item with a foreign language, whose profile has the rule that says it.
RawFinding refusalOf(const WorkItem &item);

/// Of a file whose control is a guess, and whose text does not read as the language of that control.
std::optional<RawFinding> doubtOf(const WorkItem &item, const FileContext &context);

/// What the language of the control forbids is an error only if the program is for that control.  Where nothing in the
/// text shows it, the first such error says so and lists the others, which become information; so do warnings beside
/// several errors: what a control would do with a text in another language is no claim about the program.
void doubtErrors(std::vector<RawFinding> &found, const WorkItem &item, const FileContext &context);

} // namespace feedhold
