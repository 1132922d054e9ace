// malformed-contract-clause: `(@PARAM DEPTH 0..5)`: the variable is missing.
#include "rules/contract/contract_view.h"

#include <fmt/format.h>

namespace feedhold::rules::malformed_contract_clause {
namespace {

void check(const ContractIssue &issue, const FileContext &context, const Reporter &reporter) {
  const std::string found = issue.span.empty() ? "the end of the clause" : context.quoted(issue.span);
  reporter.report({.message = fmt::format("found {}, expected {}", found, issue.detail),
                   .span = issue.span,
                   .notes = {std::string(kClauseNotUsed)}});
}

constexpr ContractIssueKind kKinds[] = {ContractIssueKind::Malformed};

} // namespace

extern const Rule malformedContractClause;
const Rule malformedContractClause{
    .info = {"malformed-contract-clause", Category::Contract, Severity::Error,
             "Reports a contract clause that is incomplete or contains text that does not belong there."},
    .hooks = {.contract = check, .contractKinds = kKinds}};

} // namespace feedhold::rules::malformed_contract_clause
