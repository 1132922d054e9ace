// empty-contract-range: `50..0.5`.
#include "rules/contract/contract_view.h"

#include <fmt/format.h>

namespace feedhold::rules::empty_contract_range {
namespace {

void check(const ContractIssue &issue, const FileContext &, const Reporter &reporter) {
  reporter.report(
      {.message = fmt::format("this range contains no value: {}", issue.detail),
       .span = issue.span,
       .notes = {"nothing is proved from this contract until it is corrected; often the two ends are swapped"}});
}

constexpr ContractIssueKind kKinds[] = {ContractIssueKind::EmptyRange};

} // namespace

extern const Rule emptyContractRange;
const Rule emptyContractRange{.info = {"empty-contract-range", Category::Contract, Severity::Error,
                                       "Reports a range in a contract that contains no value."},
                              .hooks = {.contract = check, .contractKinds = kKinds}};

} // namespace feedhold::rules::empty_contract_range
