// contract-region-without-tool: `@KEEPIN` without `@TOOL`.
#include "rules/contract/contract_view.h"

#include <fmt/format.h>

namespace feedhold::rules::contract_region_without_tool {
namespace {

void check(const ContractIssue &issue, const FileContext &context, const Reporter &reporter) {
  reporter.report({.message = fmt::format("the contract of {} has the region `{}` but no tool",
                                          programOf(issue, context), issue.detail),
                   .span = issue.span,
                   .notes = {"the proof needs the radius of the tool: add `(@TOOL FLAT RADIUS #7)`"}});
}

constexpr ContractIssueKind kKinds[] = {ContractIssueKind::RegionWithoutTool};

} // namespace

extern const Rule contractRegionWithoutTool;
const Rule contractRegionWithoutTool{
    .info = {"contract-region-without-tool", Category::Contract, Severity::Warning,
             "Reports a contract with a region but without the tool that must stay inside or outside it."},
    .hooks = {.contract = check, .contractKinds = kKinds}};

} // namespace feedhold::rules::contract_region_without_tool
