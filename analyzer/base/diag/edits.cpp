// Applying fix-its, and showing what they changed as a unified diff.
#include "base/diag/edits.h"

#include "base/diag/line_diff.h"
#include "base/support/check.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <map>
#include <unordered_map>

namespace feedhold {

namespace {

/// Edits by place; several insertions at one place stay in the order of their fix-it.
using EditsByPlace = std::multimap<Span, const Edit *>;

/// Touching is no overlap, but two insertions at one place are: their order would decide the meaning.
bool overlap(Span a, Span b) {
  if (a.empty() && b.empty())
    return a.begin == b.begin;
  return a.begin < b.end && b.begin < a.end;
}

bool overlapsAny(Span span, const EditsByPlace &edits) {
  auto at = edits.lower_bound({span.begin, 0});
  if (at != edits.begin())
    --at;
  for (; at != edits.end() && at->first.begin <= span.end; ++at)
    if (overlap(span, at->first))
      return true;
  return false;
}

/// A fix-it that a rule built wrongly must not reach a program.
EditsByPlace checkedEdits(const FixIt &fix, std::size_t textSize) {
  EditsByPlace edits;
  for (const Edit &edit : fix.edits) {
    FEEDHOLD_CHECK(edit.span.begin <= edit.span.end && edit.span.end <= textSize, "an edit outside of the text");
    edits.emplace(edit.span, &edit);
  }
  std::uint32_t end = 0;
  for (const auto &[span, edit] : edits) {
    FEEDHOLD_CHECK(span.begin >= end, "a fix-it whose own edits overlap");
    end = span.end;
  }
  return edits;
}

std::string rewritten(std::string_view text, const EditsByPlace &edits) {
  std::string result;
  std::size_t copied = 0;
  for (const auto &[span, edit] : edits) {
    result += text.substr(copied, span.begin - copied);
    result += edit->replacement;
    copied = span.end;
  }
  result += text.substr(copied);
  return result;
}

} // namespace

AppliedEdits applyFixes(std::string_view text, std::span<const FixIt> fixes) {
  AppliedEdits result;
  EditsByPlace accepted;
  for (const FixIt &fix : fixes) {
    EditsByPlace edits = checkedEdits(fix, text.size());
    if (edits.empty())
      continue;
    if (std::ranges::any_of(edits, [&](const auto &edit) { return overlapsAny(edit.first, accepted); })) {
      ++result.conflicts;
      continue;
    }
    accepted.merge(edits);
    ++result.applied;
  }
  result.text = rewritten(text, accepted);
  return result;
}

namespace {

constexpr std::size_t kContext = 3;

/// The lines with their LF, as `patch` understands lines: a CR belongs to the line's text.
std::vector<std::string_view> linesOf(std::string_view text) {
  std::vector<std::string_view> lines;
  while (!text.empty()) {
    const std::size_t length = std::min(text.find('\n'), text.size() - 1) + 1;
    lines.push_back(text.substr(0, length));
    text.remove_prefix(length);
  }
  return lines;
}

using NumberOfLine = std::unordered_map<std::string_view, std::uint32_t>;

std::vector<std::uint32_t> numbered(const std::vector<std::string_view> &lines, NumberOfLine &known) {
  std::vector<std::uint32_t> numbers;
  numbers.reserve(lines.size());
  for (const std::string_view line : lines)
    numbers.push_back(known.try_emplace(line, static_cast<std::uint32_t>(known.size())).first->second);
  return numbers;
}

/// Changes whose context would touch, as one hunk.
using Hunk = std::span<const LineChange>;

std::vector<Hunk> hunksOf(std::span<const LineChange> changes) {
  std::vector<Hunk> hunks;
  for (std::size_t first = 0; first < changes.size();) {
    std::size_t last = first;
    while (last + 1 < changes.size() && changes[last + 1].beforeBegin - changes[last].beforeEnd <= 2 * kContext)
      ++last;
    hunks.push_back(changes.subspan(first, last - first + 1));
    first = last + 1;
  }
  return hunks;
}

std::string diffLine(char mark, std::string_view line) {
  std::string result = mark + std::string(line);
  if (!line.ends_with('\n'))
    result += "\n\\ No newline at end of file\n";
  return result;
}

/// `start,count`; a range without lines is named by the line before it (POSIX diff, "Diff Unified Output Format").
std::string rangeOf(std::size_t begin, std::size_t count) {
  return count == 1 ? fmt::format("{}", begin + 1) : fmt::format("{},{}", count == 0 ? begin : begin + 1, count);
}

std::string hunkText(Hunk hunk, const std::vector<std::string_view> &before,
                     const std::vector<std::string_view> &after) {
  const std::size_t lead = std::min(kContext, hunk.front().beforeBegin);
  const std::size_t tail = std::min(kContext, before.size() - hunk.back().beforeEnd);
  const std::size_t beforeBegin = hunk.front().beforeBegin - lead;
  const std::size_t afterBegin = hunk.front().afterBegin - lead;
  const std::size_t end = hunk.back().beforeEnd + tail;
  std::string text = fmt::format("@@ -{} +{} @@\n", rangeOf(beforeBegin, end - beforeBegin),
                                 rangeOf(afterBegin, hunk.back().afterEnd + tail - afterBegin));
  std::size_t at = beforeBegin;
  const auto contextUpTo = [&](std::size_t stop) {
    for (; at < stop; ++at)
      text += diffLine(' ', before[at]);
  };
  for (const LineChange &change : hunk) {
    contextUpTo(change.beforeBegin);
    for (; at < change.beforeEnd; ++at)
      text += diffLine('-', before[at]);
    for (std::size_t added = change.afterBegin; added < change.afterEnd; ++added)
      text += diffLine('+', after[added]);
  }
  contextUpTo(end);
  return text;
}

/// An absolute path keeps one slash; a name with a space ends with a tab, as git writes it, so that `patch` does not
/// take its second word for a date.
std::string headerLine(std::string_view mark, char side, std::string_view path) {
  const std::string_view slash = path.starts_with('/') ? "" : "/";
  const std::string_view stop = path.find(' ') != std::string_view::npos ? "\t" : "";
  return fmt::format("{} {}{}{}{}\n", mark, side, slash, path, stop);
}

} // namespace

std::string unifiedDiff(std::string_view path, std::string_view before, std::string_view after) {
  if (before == after)
    return {};
  const std::vector<std::string_view> oldLines = linesOf(before);
  const std::vector<std::string_view> newLines = linesOf(after);
  NumberOfLine known;
  const std::vector<std::uint32_t> oldNumbers = numbered(oldLines, known);
  const std::vector<std::uint32_t> newNumbers = numbered(newLines, known);
  const std::vector<LineChange> changes = diffLines(oldNumbers, newNumbers);
  std::string result = headerLine("---", 'a', path) + headerLine("+++", 'b', path);
  for (const Hunk hunk : hunksOf(changes))
    result += hunkText(hunk, oldLines, newLines);
  return result;
}

} // namespace feedhold
