// broken-contract-expression: `(@REQUIRE #7 <= #2)`, `(@REQUIRE [#7*2 LT #2)`.
#include "rules/contract/contract_view.h"

#include <fmt/format.h>

namespace feedhold::rules::broken_contract_expression {
namespace {

void check(const ContractIssue &issue, const FileContext &, const Reporter &reporter) {
  reporter.report({.message = fmt::format("this expression cannot be read: {}", issue.detail),
                   .span = issue.span,
                   .notes = {std::string(kClauseNotUsed)}});
}

constexpr ContractIssueKind kKinds[] = {ContractIssueKind::Expression};

} // namespace

extern const Rule brokenContractExpression;
const Rule brokenContractExpression{
    .info = {"broken-contract-expression", Category::Contract, Severity::Error,
             "Reports a condition or value in a contract that is not a valid expression."},
    .hooks = {.contract = check, .contractKinds = kKinds}};

} // namespace feedhold::rules::broken_contract_expression
