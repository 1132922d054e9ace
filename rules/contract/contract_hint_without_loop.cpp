// contract-hint-without-loop: `@INVARIANT` where no loop begins.
#include "rules/contract/contract_view.h"

#include <fmt/format.h>

namespace feedhold::rules::contract_hint_without_loop {
namespace {

void check(const ContractIssue &issue, const FileContext &, const Reporter &reporter) {
  reporter.report(
      {.message = fmt::format("this hint is not at a loop: {}", issue.detail),
       .span = issue.span,
       .notes = {
           "put it at the first block of the loop or on the line above; in a sidecar file write `@AT N30` before it"}});
}

constexpr ContractIssueKind kKinds[] = {ContractIssueKind::Place};

} // namespace

extern const Rule contractHintWithoutLoop;
const Rule contractHintWithoutLoop{.info = {"contract-hint-without-loop", Category::Contract, Severity::Error,
                                            "Reports an `@INVARIANT` or `@VARIANT` that is not at a loop."},
                                   .hooks = {.contract = check, .contractKinds = kKinds}};

} // namespace feedhold::rules::contract_hint_without_loop
