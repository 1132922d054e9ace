// See the header.
#include "findings/draft/sidecar_text.h"

#include "base/support/text.h"

#include <fmt/format.h>

#include <algorithm>

namespace feedhold::draft {

namespace {

constexpr std::string_view kDrafted = "drafted:";
constexpr std::string_view kSuggested = "suggested:";
constexpr std::string_view kHead =
    "; drafted: by `feedhold draft`. Read each clause. In a clause that you change, take the word `drafted:` away:\n"
    "; drafted: `feedhold draft --update` writes the clauses with that word anew.\n";
constexpr std::size_t kWidestClause = 60;

bool isDraftedLine(std::string_view line) {
  const std::size_t remark = line.find(';');
  if (remark == std::string_view::npos)
    return false;
  const std::string_view text = trimmed(line.substr(remark + 1));
  return text.starts_with(kDrafted) || text.starts_with(kSuggested);
}

} // namespace

std::string withoutDrafts(std::string_view text) {
  std::string kept;
  while (!text.empty()) {
    const std::size_t end = std::min(text.find('\n'), text.size() - 1) + 1;
    if (!isDraftedLine(text.substr(0, end)))
      kept += text.substr(0, end);
    text.remove_prefix(end);
  }
  return kept;
}

std::string withDrafts(std::string kept, const DraftClauses &clauses) {
  if (clauses.empty())
    return kept;
  if (!kept.empty() && !kept.ends_with('\n'))
    kept += '\n';
  std::size_t width = 0;
  for (const DraftClause &clause : clauses)
    if (clause.ground != Ground::Hint && clause.text.size() <= kWidestClause)
      width = std::max(width, clause.text.size());
  std::string text = kept + std::string(kHead);
  for (const DraftClause &clause : clauses)
    text += clause.ground == Ground::Hint
                ? fmt::format("; {} {} ; {}\n", kSuggested, clause.text, clause.reason)
                : fmt::format("{:<{}} ; {} {}\n", clause.text, width, kDrafted, clause.reason);
  return text;
}

} // namespace feedhold::draft
