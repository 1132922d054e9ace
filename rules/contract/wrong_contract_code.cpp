// wrong-contract-code: `(@MODAL G04)`, `(@MODAL G90 G91)`.
#include "rules/contract/contract_view.h"

#include <fmt/format.h>

namespace feedhold::rules::wrong_contract_code {
namespace {

void check(const ContractIssue &issue, const FileContext &context, const Reporter &reporter) {
  const std::string text = context.quoted(issue.span);
  const std::string_view what = text.starts_with("`@") ? "does not apply to this control" : "cannot be active here";
  Diagnostic diagnostic{.message = fmt::format("{} {}: {}", text, what, issue.detail), .span = issue.span};
  if (issue.other)
    pointAt(*issue.other, "the first one", context, diagnostic);
  reporter.report(std::move(diagnostic));
}

constexpr ContractIssueKind kKinds[] = {ContractIssueKind::Code};

} // namespace

extern const Rule wrongContractCode;
const Rule wrongContractCode{.info = {"wrong-contract-code", Category::Contract, Severity::Error,
                                      "Reports a code in a contract that cannot be active."},
                             .hooks = {.contract = check, .contractKinds = kKinds}};

} // namespace feedhold::rules::wrong_contract_code
