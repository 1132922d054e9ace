// What the rules about contracts share.
#pragma once

#include "findings/rule/rule.h"

#include <string>
#include <string_view>

namespace feedhold::rules {

/// Behind a clause that could not be read.
inline constexpr std::string_view kClauseNotUsed =
    "the clause is ignored, and nothing is proved from this contract until it is corrected";

/// "O9100", or "the program" for one without a name.
std::string programOf(const ContractIssue &issue, const FileContext &context);

/// Points at a clause: a label where it stands in the text of the finding, else a note that says where.
void pointAt(ClauseId clause, std::string label, const FileContext &context, Diagnostic &diagnostic);

/// Points at a clause of the contract of a program that is called, wherever it stands.
void pointAtContract(ClauseId clause, FileId callee, const FileContext &context, Diagnostic &diagnostic);

} // namespace feedhold::rules
