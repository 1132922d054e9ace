// Where clauses stand: in comments that begin with `@`, and in the lines of sidecar files.
#include "base/support/text.h"
#include "language/contract/clauses.h"
#include "language/model/block_facts.h"

#include <algorithm>

namespace feedhold {

namespace {

/// The part of a span without blanks at its ends.
Span trimmedSpan(std::string_view text, Span span) {
  const std::string_view inner = trimmed(text.substr(span.begin, span.size()));
  if (inner.empty())
    return {span.begin, span.begin};
  const auto begin = static_cast<std::uint32_t>(inner.data() - text.data());
  return {begin, begin + static_cast<std::uint32_t>(inner.size())};
}

/// What stands between parentheses that may be missing.
Span bodyOf(std::string_view text, Span span) {
  span = trimmedSpan(text, span);
  if (span.empty() || text[span.begin] != '(')
    return span;
  ++span.begin;
  if (!span.empty() && text[span.end - 1] == ')')
    --span.end;
  return trimmedSpan(text, span);
}

/// The clause of a program's comments stands at its block, or at the next one that does something; asked in the order
/// of the text, so that a long run of comments is walked once.
class Placer {
public:
  explicit Placer(const SyntaxTree &tree) : tree_(tree) {}

  std::optional<BlockId> placeOf(BlockId block) {
    at_ = std::max(at_, block);
    while (at_.index() < tree_.blockCount() && isEmpty(tree_, at_))
      at_ = at_.next();
    return at_.index() < tree_.blockCount() ? std::optional(at_) : std::nullopt;
  }

private:
  const SyntaxTree &tree_;
  BlockId at_{0};
};

void findInComments(const ContractReading &reading, std::vector<RawClause> &found) {
  const std::string_view text = reading.program.text();
  Placer placer(reading.programTree);
  for (const Comment &comment : reading.programTree.comments) {
    const Span span = comment.span;
    const std::size_t first = text.find_first_not_of(" \t", span.begin + 1);
    if (text[span.begin] != '(' || first >= span.end || text[first] != '@')
      continue;
    const BlockId block = reading.programTree.blockAt(span.begin);
    const std::optional<BlockId> place = placer.placeOf(block);
    found.push_back({kProgramText,
                     bodyOf(text, span),
                     reading.model.programOf(place.value_or(block)),
                     place,
                     {},
                     SidecarScope::Program});
  }
}

/// Cuts `@AT N30 ` off; the rest begins with the name of its clause, with or without `@`.
void takePlace(std::string_view text, RawClause &clause) {
  const auto word = [&](std::uint32_t from) {
    std::uint32_t begin = from;
    while (begin < clause.span.end && isBlank(text[begin]))
      ++begin;
    std::uint32_t end = begin;
    while (end < clause.span.end && !isBlank(text[end]))
      ++end;
    return Span{begin, end};
  };
  const Span head = word(clause.span.begin);
  if (toUpper(text.substr(head.begin, head.size())) != "@AT")
    return;
  clause.number = word(head.end);
  clause.span.begin = word(clause.number->end).begin;
}

void findInSidecar(ContractSourceId id, const Sidecar &sidecar, ProgramId program, std::vector<RawClause> &found) {
  const std::string_view text = sidecar.source.text();
  for (std::uint32_t line = 1; line <= sidecar.source.lineCount(); ++line) {
    Span span = sidecar.source.lineSpan(line);
    constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";
    if (line == 1 && text.starts_with(kByteOrderMark))
      span.begin = std::min(span.end, static_cast<std::uint32_t>(kByteOrderMark.size()));
    const std::size_t remark = text.substr(span.begin, span.size()).find(';');
    if (remark != std::string_view::npos)
      span.end = span.begin + static_cast<std::uint32_t>(remark);
    RawClause clause{id, bodyOf(text, span), program, {}, {}, sidecar.scope};
    if (clause.span.empty())
      continue;
    takePlace(text, clause);
    found.push_back(clause);
  }
}

} // namespace

std::optional<ProgramId> programOf(const ProgramModel &model, const Sidecar &sidecar) {
  if (!sidecar.program)
    return ProgramId(0);
  for (std::size_t i = 0; i < model.programs.size(); ++i)
    if (model.programs[ProgramId(i)].name.number == sidecar.program)
      return ProgramId(i);
  return std::nullopt;
}

std::vector<RawClause> findClauses(ContractReading &reading, std::span<const Sidecar> sidecars) {
  std::vector<RawClause> found;
  findInComments(reading, found);
  for (std::size_t i = 0; i < sidecars.size(); ++i)
    if (const auto program = programOf(reading.model, sidecars[i]);
        program && sidecars[i].scope == SidecarScope::Program)
      findInSidecar(ContractSourceId(i + 1), sidecars[i], *program, found);
  return found;
}

std::vector<RawClause> findSetUp(std::span<const Sidecar> sidecars, ProgramId program) {
  std::vector<RawClause> found;
  for (std::size_t i = 0; i < sidecars.size(); ++i)
    if (sidecars[i].scope == SidecarScope::Machine)
      findInSidecar(ContractSourceId(i + 1), sidecars[i], program, found);
  return found;
}

} // namespace feedhold
