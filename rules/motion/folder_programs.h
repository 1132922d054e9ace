// The programs that stand in one folder: what they have in common is the habit of a shop.
#pragma once

#include "findings/rule/rule.h"

#include <span>

namespace feedhold::rules {

/// The files in the folder of the file, itself included; so many as show a habit.
std::span<const FileId> filesOfFolder(const FileContext &context);

/// The same run, seen from another file.
FileContext contextOf(const ProgramFile &file, const FileContext &context);

} // namespace feedhold::rules
