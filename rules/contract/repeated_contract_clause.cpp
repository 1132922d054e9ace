// repeated-contract-clause: two `@PARAM #21`.
#include "rules/contract/contract_view.h"

#include <fmt/format.h>

namespace feedhold::rules::repeated_contract_clause {
namespace {

void check(const ContractIssue &issue, const FileContext &context, const Reporter &reporter) {
  Diagnostic diagnostic{.message = fmt::format("{} is already in the contract", issue.detail), .span = issue.span};
  if (issue.other)
    pointAt(*issue.other, "the first one", context, diagnostic);
  diagnostic.notes.push_back("only the first one is used");
  reporter.report(std::move(diagnostic));
}

constexpr ContractIssueKind kKinds[] = {ContractIssueKind::Repeated};

} // namespace

extern const Rule repeatedContractClause;
const Rule repeatedContractClause{
    .info = {"repeated-contract-clause", Category::Contract, Severity::Error,
             "Reports a contract clause for something that an earlier clause already states."},
    .hooks = {.contract = check, .contractKinds = kKinds}};

} // namespace feedhold::rules::repeated_contract_clause
