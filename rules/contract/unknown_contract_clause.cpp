// unknown-contract-clause: `(@PARM #21 0..5)`.
#include "rules/contract/contract_view.h"

#include <fmt/format.h>

namespace feedhold::rules::unknown_contract_clause {
namespace {

void check(const ContractIssue &issue, const FileContext &context, const Reporter &reporter) {
  Diagnostic diagnostic{.message = fmt::format("{} is not a contract clause", context.quoted(issue.span)),
                        .span = issue.span,
                        .notes = {"a comment that begins with `@` is read as a contract clause"}};
  // Only programs are repaired, not the files beside them.
  if (!issue.detail.empty() && issue.source != kProgramText)
    diagnostic.notes.push_back(fmt::format("did you mean `{}`?", issue.detail));
  else if (!issue.detail.empty())
    diagnostic.fixes = {
        {FixSafety::NeedsReview, fmt::format("write `{}`", issue.detail), {{issue.span, issue.detail}}}};
  reporter.report(std::move(diagnostic));
}

constexpr ContractIssueKind kKinds[] = {ContractIssueKind::UnknownClause};

} // namespace

extern const Rule unknownContractClause;
const Rule unknownContractClause{.info = {"unknown-contract-clause", Category::Contract, Severity::Error,
                                          "Reports a comment that begins with `@` but is not a contract clause."},
                                 .hooks = {.contract = check, .contractKinds = kKinds}};

} // namespace feedhold::rules::unknown_contract_clause
