// Reads the suppression comments of a file and takes out what they allow.
#include "findings/rule/suppression.h"

#include "base/support/text.h"
#include "findings/rule/run_rules.h"

#include <fmt/format.h>

#include <algorithm>

namespace feedhold {

namespace {

constexpr std::string_view kMark = "@ALLOW";
constexpr std::string_view kProgramMark = "@ALLOW-PROGRAM";

bool isNameCharacter(char c) { return isLetter(c) || isDigit(c) || c == '-'; }

/// The head of `rest` as long as `belongs` holds, cut off from `rest`.
template <typename Predicate> std::string_view takeWhile(std::string_view &rest, Predicate belongs) {
  const auto end = std::find_if_not(rest.begin(), rest.end(), belongs);
  const std::string_view head = rest.substr(0, static_cast<std::size_t>(end - rest.begin()));
  rest.remove_prefix(head.size());
  return head;
}

/// What stands between the parentheses of a comment.
std::string_view bodyOf(std::string_view comment) {
  if (!comment.empty() && comment.front() == '(')
    comment.remove_prefix(1);
  if (!comment.empty() && comment.back() == ')')
    comment.remove_suffix(1);
  return trimmed(comment);
}

/// `rule, rule reason` -> the rules in lower case, and the reason is what is left in `rest`.
std::vector<std::string> takeRules(std::string_view &rest) {
  std::vector<std::string> rules;
  for (;;) {
    takeWhile(rest, isBlank);
    rules.push_back(toLower(takeWhile(rest, isNameCharacter)));
    takeWhile(rest, isBlank);
    if (!rest.starts_with(','))
      return rules;
    rest.remove_prefix(1);
  }
}

/// The block that a suppression on `block` speaks of: itself, or the next one that does something.
BlockId coveredBlock(const SyntaxTree &tree, BlockId block) {
  BlockId covered = block;
  while (covered.index() + 1 < tree.blockCount() && isEmpty(tree, covered))
    covered = covered.next();
  return covered;
}

/// One for each rule that the comment names; none when it is another comment.
std::vector<Suppression> readComment(const Comment &comment, const FileContext &context) {
  std::string_view rest = bodyOf(context.text(comment.span));
  if (!rest.starts_with('@'))
    return {};
  const std::string_view keyword = takeWhile(rest, [](char c) { return c == '@' || isNameCharacter(c); });
  const std::string mark = toUpper(keyword);
  if (mark != kMark && mark != kProgramMark)
    return {};
  const BlockId block = context.tree.blockAt(comment.span.begin);
  const std::vector<std::string> rules = takeRules(rest);
  const auto begin = static_cast<std::uint32_t>(rest.data() - context.source.text().data());
  const std::string reason = context.source.utf8({begin, begin + static_cast<std::uint32_t>(rest.size())});
  std::vector<Suppression> found;
  for (const std::string &rule : rules)
    found.push_back({comment.span, rule, reason, coveredBlock(context.tree, block), mark == kProgramMark});
  return found;
}

bool covers(const Suppression &suppression, const RawFinding &finding, BlockId block, const FileContext &context) {
  if (suppression.rule != finding.rule->name)
    return false;
  const BlockId own = context.tree.blockAt(suppression.span.begin);
  if (suppression.wholeProgram)
    return context.model.programOf(own) == context.model.programOf(block);
  return own <= block && block <= suppression.block;
}

/// Marks every suppression that covers the finding as used; true when there is one.
bool isSuppressed(const RawFinding &finding, std::vector<Suppression> &suppressions, const FileContext &context) {
  const BlockId block = context.tree.blockAt(finding.diagnostic.span.begin);
  bool suppressed = false;
  for (Suppression &suppression : suppressions) {
    if (!covers(suppression, finding, block, context))
      continue;
    suppression.used = true;
    suppressed = true;
  }
  return suppressed;
}

/// Says what is wrong with the suppressions themselves, by those rules that were selected.
class SuppressionReview {
public:
  SuppressionReview(const RuleRegistry &registry, std::span<const Rule *const> selected, const SyntaxTree &tree)
      : registry_(registry), selected_(selected), tree_(tree) {}

  void review(std::span<const Suppression> suppressions, std::vector<RawFinding> &into) const {
    for (const Suppression &suppression : suppressions) {
      reviewName(suppression, into);
      if (suppression.reason.empty() && findRule(registry_, suppression.rule) != nullptr)
        report("suppression-without-reason", withoutReason(suppression), into);
      const bool itsRuleRan = findSelected(suppression.rule) != nullptr;
      if (!suppression.used && itsRuleRan)
        report("unused-suppression", unused(suppression, suppressions), into);
    }
  }

private:
  const Rule *findSelected(std::string_view name) const {
    const auto found =
        std::find_if(selected_.begin(), selected_.end(), [&](const Rule *rule) { return rule->info.name == name; });
    return found == selected_.end() ? nullptr : *found;
  }

  void report(std::string_view rule, Diagnostic diagnostic, std::vector<RawFinding> &into) const {
    if (const Rule *selected = findSelected(rule))
      into.push_back({&selected->info, selected->info.severity, std::move(diagnostic)});
  }

  void reviewName(const Suppression &suppression, std::vector<RawFinding> &into) const {
    if (findRule(registry_, suppression.rule) != nullptr)
      return;
    Diagnostic diagnostic{.message = fmt::format("there is no rule `{}` to allow", suppression.rule),
                          .span = suppression.span};
    if (suppression.rule.empty())
      diagnostic.message = "the suppression names no rule";
    diagnostic.notes.push_back(adviceFor(suppression.rule));
    report("unknown-suppressed-rule", std::move(diagnostic), into);
  }

  std::string adviceFor(std::string_view name) const {
    std::vector<std::string_view> names;
    for (const RegisteredRule &entry : registry_.rules)
      names.push_back(entry.rule->info.name);
    if (const auto nearest = nearestWord(name, names))
      return fmt::format("did you mean `{}`?", *nearest);
    return "`feedhold rules` lists the names; write `(@ALLOW rule reason)`";
  }

  static Diagnostic withoutReason(const Suppression &suppression) {
    return {.message = fmt::format("`{}` is allowed without a reason", suppression.rule),
            .span = suppression.span,
            .notes = {fmt::format("the next reader must know why: `(@ALLOW {} reason)`", suppression.rule)}};
  }

  Diagnostic unused(const Suppression &suppression, std::span<const Suppression> all) const {
    const std::string_view where = suppression.wholeProgram ? "this program" : "this place";
    Diagnostic diagnostic{.message = fmt::format("`{}` is allowed here and finds nothing", suppression.rule),
                          .span = suppression.span,
                          .notes = {fmt::format("left in, it would hide the next finding of this rule at {}", where)}};
    const auto sameComment =
        std::count_if(all.begin(), all.end(), [&](const Suppression &other) { return other.span == suppression.span; });
    if (sameComment == 1)
      diagnostic.fixes = {{isOnScreen(suppression.span) ? FixSafety::NeedsReview : FixSafety::Safe,
                           "take the comment out",
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

std::vector<Suppression> findSuppressions(const FileContext &context) {
  std::vector<Suppression> found;
  for (const Comment &comment : context.tree.comments)
    for (Suppression &suppression : readComment(comment, context))
      found.push_back(std::move(suppression));
  return found;
}

SuppressionResult applySuppressions(std::vector<RawFinding> findings, const FileContext &context,
                                    const RuleRegistry &registry, std::span<const Rule *const> selected) {
  std::vector<Suppression> suppressions = findSuppressions(context);
  if (suppressions.empty())
    return {std::move(findings), {}};
  SuppressionResult result;
  for (RawFinding &finding : findings)
    (isSuppressed(finding, suppressions, context) ? result.suppressed : result.kept).push_back(std::move(finding));
  SuppressionReview(registry, selected, context.tree).review(suppressions, result.kept);
  std::stable_sort(result.kept.begin(), result.kept.end(), comesBefore);
  return result;
}

} // namespace feedhold
