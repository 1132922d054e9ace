// empty-contract-range: `50..0.5`.
#include "rules/contract/contract_view.h"

#include <fmt/format.h>

namespace feedhold::rules {
namespace {

void check(const ContractIssue &issue, const FileContext &, const Reporter &reporter) {
  reporter.report({.message = fmt::format("no value is in this range: {}", issue.detail),
                   .span = issue.span,
                   .notes = {"no call could keep the contract, and everything would hold of it"}});
}

constexpr ContractIssueKind kKinds[] = {ContractIssueKind::EmptyRange};

} // namespace

extern const Rule emptyContractRange;
const Rule emptyContractRange{.info = {"empty-contract-range", Category::Contract, Severity::Error,
                                       "Reports a range of a contract that no value is in."},
                              .hooks = {.contract = check, .contractKinds = kKinds}};

} // namespace feedhold::rules
