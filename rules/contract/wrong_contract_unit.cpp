// wrong-contract-unit: `MMS`, `INT` with a range to 0.5, `MM` under G20.
#include "rules/contract/contract_view.h"

#include <fmt/format.h>

namespace feedhold::rules::wrong_contract_unit {
namespace {

void check(const ContractIssue &issue, const FileContext &context, const Reporter &reporter) {
  reporter.report({.message = fmt::format("unit {} does not fit: {}", context.quoted(issue.span), issue.detail),
                   .span = issue.span});
}

constexpr ContractIssueKind kKinds[] = {ContractIssueKind::Unit};

} // namespace

extern const Rule wrongContractUnit;
const Rule wrongContractUnit{.info = {"wrong-contract-unit", Category::Contract, Severity::Error,
                                      "Reports a unit in a contract that does not exist or does not fit."},
                             .hooks = {.contract = check, .contractKinds = kKinds}};

} // namespace feedhold::rules::wrong_contract_unit
