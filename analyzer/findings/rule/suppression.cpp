// Takes out what is allowed, and says what is wrong with the suppressions.
#include "findings/rule/suppression.h"

#include "base/support/text.h"
#include "findings/rule/run_rules.h"

#include <fmt/format.h>

#include <algorithm>

namespace feedhold {

namespace {

bool covers(const Suppression &suppression, const RawFinding &finding, BlockId block, const FileContext &context) {
  if (!hasName(*finding.rule, suppression.rule) || !suppression.missing.empty())
    return false;
  if (suppression.wholeProgram)
    return *suppression.wholeProgram == context.model.programOf(block);
  return suppression.first <= block && block <= suppression.last;
}

/// Marks every suppression that covers the finding as used, and gives the first one; null when there is none.
const Suppression *suppressing(const RawFinding &finding, std::vector<Suppression> &suppressions,
                               const FileContext &context) {
  const BlockId block = context.tree.blockAt(finding.diagnostic.span.begin);
  const Suppression *first = nullptr;
  for (Suppression &suppression : suppressions) {
    if (!covers(suppression, finding, block, context))
      continue;
    suppression.used = true;
    first = first != nullptr ? first : &suppression;
  }
  return first;
}

/// Says what is wrong with the suppressions themselves, by those rules that were selected.
class SuppressionReview {
public:
  SuppressionReview(const RuleRegistry &registry, std::span<const Rule *const> selected, const SyntaxTree &tree)
      : registry_(registry), selected_(selected), tree_(tree) {}

  void review(std::span<const Suppression> suppressions, SuppressionResult &into) const {
    for (const Suppression &suppression : suppressions) {
      std::vector<RawFinding> found;
      reviewName(suppression, found);
      if (suppression.reason.empty() && findRule(registry_, suppression.rule) != nullptr)
        report("suppression-without-reason", withoutReason(suppression), found);
      const bool itsRuleRan = findSelected(suppression.rule) != nullptr;
      if (!suppression.used && itsRuleRan)
        report(kUnusedSuppressionRule, unused(suppression, suppressions), found);
      for (RawFinding &finding : found)
        if (suppression.source == kProgramText)
          into.kept.push_back(std::move(finding));
        else
          into.ofSidecars.push_back({suppression.source, std::move(finding)});
    }
  }

private:
  const Rule *findSelected(std::string_view name) const {
    const auto found =
        std::find_if(selected_.begin(), selected_.end(), [&](const Rule *rule) { return hasName(rule->info, name); });
    return found == selected_.end() ? nullptr : *found;
  }

  void report(std::string_view rule, Diagnostic diagnostic, std::vector<RawFinding> &into) const {
    if (const Rule *selected = findSelected(rule))
      into.push_back({&selected->info, selected->info.severity, std::move(diagnostic)});
  }

  void reviewName(const Suppression &suppression, std::vector<RawFinding> &into) const {
    if (findRule(registry_, suppression.rule) != nullptr)
      return;
    Diagnostic diagnostic{.message = fmt::format("there is no rule `{}`", suppression.rule), .span = suppression.span};
    if (suppression.rule.empty())
      diagnostic.message = "this suppression names no rule";
    diagnostic.notes.push_back(adviceFor(suppression));
    report("unknown-suppressed-rule", std::move(diagnostic), into);
  }

  /// How one is written where this one stands.
  static std::string written(const Suppression &suppression, std::string_view rule) {
    return suppression.source == kProgramText ? fmt::format("`(@ALLOW {} reason)`", rule)
                                              : fmt::format("`@ALLOW {} reason`", rule);
  }

  std::string adviceFor(const Suppression &suppression) const {
    std::vector<std::string_view> names;
    for (const RegisteredRule &entry : registry_.rules)
      names.push_back(entry.rule->info.name);
    if (const auto nearest = nearestWord(suppression.rule, names))
      return fmt::format("did you mean `{}`?", *nearest);
    return "`feedhold rules` lists the names; write " + written(suppression, "rule");
  }

  static Diagnostic withoutReason(const Suppression &suppression) {
    return {.message = fmt::format("`{}` is allowed without a reason", suppression.rule),
            .span = suppression.span,
            .notes = {"tell the next reader why: " + written(suppression, suppression.rule)}};
  }

  Diagnostic unused(const Suppression &suppression, std::span<const Suppression> all) const {
    if (!suppression.missing.empty())
      return {.message =
                  fmt::format("`{}` cannot be allowed here: there is no {}", suppression.rule, suppression.missing),
              .span = suppression.span};
    const std::string_view where = suppression.wholeProgram ? "this program" : "this block";
    Diagnostic diagnostic{
        .message = fmt::format("`{}` is allowed here but reports nothing", suppression.rule),
        .span = suppression.span,
        .notes = {fmt::format("left in place, it would hide the next finding of this rule in {}", where)}};
    if (suppression.source != kProgramText)
      return diagnostic; // only programs are repaired, not the files beside them
    const auto sameComment = std::count_if(all.begin(), all.end(), [&](const Suppression &other) {
      return other.source == suppression.source && other.span == suppression.span;
    });
    if (sameComment == 1)
      diagnostic.fixes = {{isOnScreen(suppression.span) ? FixSafety::NeedsReview : FixSafety::Safe,
                           "delete the comment",
                           {{suppression.span, ""}}}};
    return diagnostic;
  }

  /// Behind `#3000=` and `#3006=` a comment is the text that the operator sees.
  bool isOnScreen(Span comment) const {
    const auto statements = tree_.statementsOf(tree_.blockAt(comment.begin));
    return std::any_of(statements.begin(), statements.end(), [&](const Statement &statement) {
      const auto *assignment = std::get_if<Assignment>(&statement.node);
      const auto target = assignment ? variableNumber(tree_, assignment->target) : std::nullopt;
      return target == kAlarmVariable || target == kMessageVariable;
    });
  }

  const RuleRegistry &registry_;
  std::span<const Rule *const> selected_;
  const SyntaxTree &tree_;
};

} // namespace

SuppressionResult applySuppressions(std::vector<RawFinding> findings, const FileContext &context,
                                    const RuleRegistry &registry, std::span<const Rule *const> selected) {
  std::vector<Suppression> suppressions = findSuppressions(context);
  if (suppressions.empty())
    return {std::move(findings), {}, {}};
  SuppressionResult result;
  for (RawFinding &finding : findings)
    if (const Suppression *by = suppressing(finding, suppressions, context))
      result.suppressed.push_back({std::move(finding), by->reason, by->source});
    else
      result.kept.push_back(std::move(finding));
  SuppressionReview(registry, selected, context.tree).review(suppressions, result);
  std::stable_sort(result.kept.begin(), result.kept.end(), comesBefore);
  return result;
}

} // namespace feedhold
