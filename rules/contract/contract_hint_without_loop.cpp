// contract-hint-without-loop: `@INVARIANT` where no loop begins.
#include "rules/contract/contract_view.h"

#include <fmt/format.h>

namespace feedhold::rules {
namespace {

void check(const ContractIssue &issue, const FileContext &, const Reporter &reporter) {
  reporter.report(
      {.message = fmt::format("the hint belongs to a loop: {}", issue.detail),
       .span = issue.span,
       .notes = {"in a program it stands at the block where the loop begins or on the line above; in a file "
                 "beside it `@AT N30` names the block"}});
}

constexpr ContractIssueKind kKinds[] = {ContractIssueKind::Place};

} // namespace

extern const Rule contractHintWithoutLoop;
const Rule contractHintWithoutLoop{.info = {"contract-hint-without-loop", Category::Contract, Severity::Error,
                                            "Reports an `@INVARIANT` or `@VARIANT` that does not stand at a loop."},
                                   .hooks = {.contract = check, .contractKinds = kKinds}};

} // namespace feedhold::rules
