#include "findings/session/other_language.h"

#include "base/support/check.h"
#include "base/support/text.h"
#include "findings/rule/other_control.h"
#include "findings/rule/suppression.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

namespace feedhold {
namespace {

/// Null where it was switched off.
const RuleInfo *foreignLanguageRule(const Profile &profile) {
  const auto rule = std::find_if(profile.rules.begin(), profile.rules.end(),
                                 [](const Rule *candidate) { return candidate->info.name == kForeignLanguageRule; });
  return rule == profile.rules.end() ? nullptr : &(*rule)->info;
}

Span firstLineWithText(const SourceFile &source) {
  for (std::uint32_t line = 1; line <= source.lineCount(); ++line)
    if (const Span span = source.lineSpan(line); !trimmed(source.text(span)).empty())
      return span;
  return {};
}

std::string_view describe(ForeignHabit habit) {
  switch (habit) {
  case ForeignHabit::SlashRemark: return "`//` or `/` begins remarks";
  case ForeignHabit::QuoteRemark: return "`'` begins remarks";
  case ForeignHabit::LongRemark: return "remarks go over several lines";
  case ForeignHabit::DecimalComma: return "numbers have a comma for the point";
  case ForeignHabit::Checksum: return "blocks end with a checksum";
  case ForeignHabit::NamedMacroB: return "parameters have names such as `#<depth>`, beside jumps and loops of Macro B";
  }
  FEEDHOLD_UNREACHABLE("a habit of other languages");
}

/// Of errors that are listed at the first one; a foreign program has dozens.
constexpr std::size_t kMostListed = 5;

/// Who writes suppressions has settled how the program is read.
bool isSettled(const WorkItem &item, const FileContext &context) {
  return item.isNamed || !findSuppressions(context).empty();
}

/// Whether another control may well accept what is found.
bool isOfLanguage(const RuleInfo &rule) {
  switch (rule.category) {
  case Category::Syntax:
  case Category::Structure:
  case Category::Expression:
  case Category::Variable:
  case Category::Word:
  case Category::Comment: return true;
  case Category::Alarm:
  case Category::Call:
  case Category::Suppression:
  case Category::Flow:
  case Category::Motion:
  case Category::Contract: return false;
  }
  FEEDHOLD_UNREACHABLE("a category of rules");
}

/// The others, and what to do.
std::vector<std::string> notesOfDoubt(const std::vector<RawFinding *> &errors, const FileContext &context) {
  std::vector<std::string> notes;
  for (std::size_t i = 1; i < errors.size() && i <= kMostListed; ++i) {
    const Diagnostic &other = errors[i]->diagnostic;
    notes.push_back(fmt::format("also in line {}: {}", context.source.lineOf(other.span.begin), other.message));
  }
  if (errors.size() > kMostListed + 1)
    notes.push_back(fmt::format("and {} more: shown with `--severity info`", errors.size() - 1 - kMostListed));
  notes.push_back(
      fmt::format("nothing in the program shows that it is for {0}: name its control with `--dialect` or in "
                  "feedhold.toml",
                  context.dialect.id));
  return notes;
}

} // namespace

RawFinding refusalOf(const WorkItem &item) {
  const RuleInfo *rule = foreignLanguageRule(*item.profile);
  FEEDHOLD_CHECK(rule != nullptr, "a foreign file came through without the rule that reports it");
  RawFinding finding{rule, rule->severity, {}};
  finding.diagnostic.message = fmt::format("this is {}, which Feedhold does not read", item.foreign->name);
  finding.diagnostic.span = firstLineWithText(item.source);
  if (!item.reasons.empty())
    finding.diagnostic.notes.push_back(fmt::format("recognised by: {}", fmt::join(item.reasons, "; ")));
  finding.diagnostic.notes.emplace_back(item.foreign->way);
  return finding;
}

std::optional<RawFinding> doubtOf(const WorkItem &item, const FileContext &context) {
  const RuleInfo *rule = foreignLanguageRule(*item.profile);
  if (rule == nullptr || isSettled(item, context))
    return std::nullopt;
  const std::optional<UnreadText> text = unreadTextOf(context);
  if (!text)
    return std::nullopt;
  const std::string why = text->habit ? fmt::format(": {}", describe(*text->habit)) : "";
  return RawFinding{
      rule,
      Severity::Warning,
      {.message = fmt::format("{} of {} blocks cannot be read as a program for {}{}", text->unread, text->blocks,
                              context.dialect.id, why),
       .span = text->first,
       .label = "the first of them",
       .notes = {"the program seems to be for another control, so nothing else is reported",
                 fmt::format("if {0} is right, name it with `--dialect {0}` or in feedhold.toml to see every error",
                             context.dialect.id),
                 "if Feedhold does not read its language, exclude the file"}}};
}

void doubtErrors(std::vector<RawFinding> &found, const WorkItem &item, const FileContext &context) {
  if (item.hasMarks || isSettled(item, context))
    return;
  std::vector<RawFinding *> errors;
  for (RawFinding &finding : found)
    if (finding.severity == Severity::Error && isOfLanguage(*finding.rule))
      errors.push_back(&finding);
  if (errors.empty())
    return;
  std::vector<std::string> notes = notesOfDoubt(errors, context);
  Diagnostic &first = errors.front()->diagnostic;
  first.message += fmt::format(", if the program is for {}", context.dialect.id);
  std::ranges::move(notes, std::back_inserter(first.notes));
  for (std::size_t i = 1; i < errors.size(); ++i)
    errors[i]->severity = Severity::Info;
  if (errors.size() > 1)
    for (RawFinding &finding : found)
      if (finding.severity == Severity::Warning)
        finding.severity = Severity::Info;
}

} // namespace feedhold
