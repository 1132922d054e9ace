// unused-contract-variable: the contract speaks of `#7`, and the program never reads it.
#include "rules/contract/contract_view.h"

#include <fmt/format.h>

namespace feedhold::rules::unused_contract_variable {
namespace {

void check(const ContractIssue &issue, const FileContext &context, const Reporter &reporter) {
  reporter.report({.message = fmt::format("the contract names {}, but {} never {} it", context.quoted(issue.span),
                                          programOf(issue, context), issue.detail),
                   .span = issue.span,
                   .notes = {"probably another variable was meant, which is now without a clause"}});
}

constexpr ContractIssueKind kKinds[] = {ContractIssueKind::UnusedVariable};

} // namespace

extern const Rule unusedContractVariable;
const Rule unusedContractVariable{.info = {"unused-contract-variable", Category::Contract, Severity::Error,
                                           "Reports a variable in a contract that the program does not use."},
                                  .hooks = {.contract = check, .contractKinds = kKinds}};

} // namespace feedhold::rules::unused_contract_variable
