// Names of categories, program text for messages, and how a rule hands in a finding.
#include "findings/rule/rule.h"

#include "base/support/text.h"

namespace feedhold {

namespace {

constexpr std::size_t kLongestQuote = 48; // bytes of UTF-8; a longer text would push the sentence off the screen

bool isContinuationByte(char c) { return (static_cast<unsigned char>(c) & 0xC0) == 0x80; }

/// The longest head of at most `size` bytes that does not cut a character.
std::string_view wholeCharacters(std::string_view text, std::size_t size) {
  while (size > 0 && isContinuationByte(text[size]))
    --size;
  return text.substr(0, size);
}

} // namespace

bool hasName(const RuleInfo &rule, std::string_view name) {
  return name == rule.name || (!rule.formerName.empty() && name == rule.formerName);
}

std::string_view nameOf(Category category) {
  switch (category) {
  case Category::Syntax: return "syntax";
  case Category::Structure: return "structure";
  case Category::Expression: return "expression";
  case Category::Variable: return "variable";
  case Category::Alarm: return "alarm";
  case Category::Word: return "word";
  case Category::Call: return "call";
  case Category::Comment: return "comment";
  case Category::Suppression: return "suppression";
  case Category::Flow: return "flow";
  case Category::Motion: return "motion";
  case Category::Contract: return "contract";
  }
  FEEDHOLD_UNREACHABLE("a category without a name");
}

std::string FileContext::quoted(Span span) const {
  // Every byte is at least one byte of UTF-8 or part of a character: four times the limit always holds a full quote.
  const std::uint32_t end = std::min<std::uint32_t>(span.end, span.begin + 4 * kLongestQuote);
  std::string text = source.utf8({span.begin, end});
  for (char &c : text)
    if (static_cast<unsigned char>(c) < ' ' || c == '\x7f')
      c = ' ';
  const std::string_view whole = trimmed(text);
  if (whole.size() <= kLongestQuote)
    return "`" + std::string(whole) + "`";
  return "`" + std::string(trimmed(wholeCharacters(whole, kLongestQuote))) + " ...`";
}

void Reporter::report(Diagnostic diagnostic) const { report(std::move(diagnostic), rule_->severity); }

void Reporter::report(Diagnostic diagnostic, Severity severity) const {
  if (sink_->kept.size() < RuleFindings::kMostKept)
    sink_->kept.push_back(RawFinding{rule_, severity, std::move(diagnostic)});
  else
    ++sink_->dropped;
}

} // namespace feedhold
