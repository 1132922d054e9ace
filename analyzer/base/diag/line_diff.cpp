// Line differences: what is equal at both ends is cut off, lines that occur once in both texts are matched first
// (patience diff, B. Cohen), and the gaps between are compared with Myers' greedy algorithm ("An O(ND) difference
// algorithm and its variations", 1986).
#include "base/diag/line_diff.h"

#include <algorithm>
#include <iterator>
#include <optional>
#include <unordered_map>
#include <utility>

namespace feedhold {

namespace {

/// Old line `before` is new line `after`.
struct Match {
  std::size_t before;
  std::size_t after;
};

LineChange withoutEqualEnds(LineChange gap, LineNumbers before, LineNumbers after) {
  const auto open = [&] { return gap.beforeBegin < gap.beforeEnd && gap.afterBegin < gap.afterEnd; };
  for (; open() && before[gap.beforeBegin] == after[gap.afterBegin]; ++gap.afterBegin)
    ++gap.beforeBegin;
  for (; open() && before[gap.beforeEnd - 1] == after[gap.afterEnd - 1]; --gap.afterEnd)
    --gap.beforeEnd;
  return gap;
}

/// The longest chain that ascends on both sides, by patience sorting; `matches` ascend in `before`.
std::vector<Match> longestAscending(const std::vector<Match> &matches) {
  std::vector<std::size_t> tops;
  std::vector<std::optional<std::size_t>> previous(matches.size());
  for (std::size_t i = 0; i < matches.size(); ++i) {
    const auto pile =
        std::ranges::lower_bound(tops, matches[i].after, {}, [&](std::size_t top) { return matches[top].after; });
    if (pile != tops.begin())
      previous[i] = *std::prev(pile);
    if (pile == tops.end())
      tops.push_back(i);
    else
      *pile = i;
  }
  std::vector<Match> chain;
  for (std::optional<std::size_t> i = tops.empty() ? std::nullopt : std::optional(tops.back()); i; i = previous[*i])
    chain.push_back(matches[*i]);
  std::ranges::reverse(chain);
  return chain;
}

struct Occurrences {
  std::size_t before = 0;
  std::size_t after = 0;
  std::size_t lastAfter = 0;
};

/// Lines that occur once on each side, as far as they are in the same order.
std::vector<Match> anchorsOf(const LineChange &gap, LineNumbers before, LineNumbers after) {
  std::unordered_map<std::uint32_t, Occurrences> seen;
  for (std::size_t at = gap.beforeBegin; at < gap.beforeEnd; ++at)
    ++seen[before[at]].before;
  for (std::size_t at = gap.afterBegin; at < gap.afterEnd; ++at) {
    Occurrences &line = seen[after[at]];
    ++line.after;
    line.lastAfter = at;
  }
  std::vector<Match> unique;
  for (std::size_t at = gap.beforeBegin; at < gap.beforeEnd; ++at) {
    const Occurrences &line = seen[before[at]];
    if (line.before == 1 && line.after == 1)
      unique.push_back({at, line.lastAfter});
  }
  return longestAscending(unique);
}

/// Myers' table: for each number of differences, the furthest old line reached on each diagonal (old minus new line).
/// Row d has the diagonals -d, -d+2, ... d.
class FurthestReached {
public:
  struct Step {
    std::ptrdiff_t diagonal; // the one that the step leaves
    std::ptrdiff_t from;     // the old line where it leaves it
    std::ptrdiff_t to;       // the old line where it arrives
  };

  void add(std::vector<std::ptrdiff_t> row) { rows_.push_back(std::move(row)); }

  /// The better of inserting a new line and of dropping an old one.
  Step stepInto(std::ptrdiff_t differences, std::ptrdiff_t diagonal) const {
    const auto reached = [&](std::ptrdiff_t other) {
      return rows_[static_cast<std::size_t>(differences - 1)][static_cast<std::size_t>((other + differences - 1) / 2)];
    };
    const bool inserts =
        diagonal == -differences || (diagonal != differences && reached(diagonal - 1) < reached(diagonal + 1));
    if (inserts)
      return {diagonal + 1, reached(diagonal + 1), reached(diagonal + 1)};
    return {diagonal - 1, reached(diagonal - 1), reached(diagonal - 1) + 1};
  }

private:
  std::vector<std::vector<std::ptrdiff_t>> rows_;
};

/// The table grows with the square of the differences; a gap with more than this is shown as replaced.
constexpr std::ptrdiff_t kMostDifferences = 1000;

std::vector<Match> traceBack(const FurthestReached &table, std::ptrdiff_t differences, std::ptrdiff_t oldSize,
                             std::ptrdiff_t newSize) {
  std::vector<Match> matches;
  std::ptrdiff_t oldLine = oldSize;
  std::ptrdiff_t newLine = newSize;
  const auto walkTo = [&](std::ptrdiff_t start) {
    for (; oldLine > start; --oldLine, --newLine)
      matches.push_back({static_cast<std::size_t>(oldLine - 1), static_cast<std::size_t>(newLine - 1)});
  };
  for (; differences > 0; --differences) {
    const FurthestReached::Step step = table.stepInto(differences, oldLine - newLine);
    walkTo(step.to);
    oldLine = step.from;
    newLine = step.from - step.diagonal;
  }
  walkTo(0);
  std::ranges::reverse(matches);
  return matches;
}

/// The matches of a shortest script from `before` to `after`; none when they differ too much.
std::vector<Match> shortestScript(LineNumbers before, LineNumbers after) {
  const auto oldSize = static_cast<std::ptrdiff_t>(before.size());
  const auto newSize = static_cast<std::ptrdiff_t>(after.size());
  FurthestReached table;
  for (std::ptrdiff_t differences = 0; differences <= std::min(oldSize + newSize, kMostDifferences); ++differences) {
    std::vector<std::ptrdiff_t> row;
    for (std::ptrdiff_t diagonal = -differences; diagonal <= differences; diagonal += 2) {
      std::ptrdiff_t reached = differences == 0 ? 0 : table.stepInto(differences, diagonal).to;
      while (reached < oldSize && reached - diagonal < newSize &&
             before[static_cast<std::size_t>(reached)] == after[static_cast<std::size_t>(reached - diagonal)])
        ++reached;
      row.push_back(reached);
      if (diagonal == oldSize - newSize && reached >= oldSize)
        return traceBack(table, differences, oldSize, newSize);
    }
    table.add(std::move(row));
  }
  return {};
}

/// The matches in a gap, numbered as in the whole texts.
std::vector<Match> matchesIn(const LineChange &gap, LineNumbers before, LineNumbers after) {
  std::vector<Match> matches = shortestScript(before.subspan(gap.beforeBegin, gap.beforeEnd - gap.beforeBegin),
                                              after.subspan(gap.afterBegin, gap.afterEnd - gap.afterBegin));
  for (Match &match : matches)
    match = {match.before + gap.beforeBegin, match.after + gap.afterBegin};
  return matches;
}

/// What lies between each match and the one before it; the last match stands for the end of `region`.
std::vector<LineChange> gapsBetween(const std::vector<Match> &matches, const LineChange &region) {
  std::vector<LineChange> gaps;
  LineChange gap = region;
  for (const Match match : matches) {
    gap.beforeEnd = match.before;
    gap.afterEnd = match.after;
    if (gap.beforeBegin < gap.beforeEnd || gap.afterBegin < gap.afterEnd)
      gaps.push_back(gap);
    gap.beforeBegin = match.before + 1;
    gap.afterBegin = match.after + 1;
  }
  return gaps;
}

} // namespace

std::vector<LineChange> diffLines(LineNumbers before, LineNumbers after) {
  const LineChange middle = withoutEqualEnds({0, before.size(), 0, after.size()}, before, after);
  std::vector<Match> anchors = anchorsOf(middle, before, after);
  anchors.push_back({middle.beforeEnd, middle.afterEnd});

  std::vector<LineChange> changes;
  for (const LineChange &gap : gapsBetween(anchors, middle)) {
    std::vector<Match> matches = matchesIn(gap, before, after);
    matches.push_back({gap.beforeEnd, gap.afterEnd});
    std::ranges::copy(gapsBetween(matches, gap), std::back_inserter(changes));
  }
  return changes;
}

} // namespace feedhold
