// See the header.
#include "findings/draft/guard_promises.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>

namespace feedhold::draft {

namespace {

constexpr std::size_t kMostParts = 24; // of one clause

/// Conditions of which all hold, and the number of their comparisons.
struct Conjunction {
  std::vector<std::string> parts = {};
  std::size_t comparisons = 0;

  void add(const Alternatives &alternatives) {
    const std::string text = textOf(alternatives);
    if (std::ranges::find(parts, text) != parts.end())
      return;
    parts.push_back(text);
    comparisons += alternatives.size();
  }
  void addOpposite(const Alternatives &alternatives) {
    for (const Comparison &each : alternatives)
      add({opposite(each)});
  }
};

std::string joined(const std::vector<std::string> &parts, std::string_view by) {
  if (parts.size() == 1)
    return parts.front();
  std::string text;
  for (const std::string &part : parts)
    text += fmt::format("{}[{}]", text.empty() ? std::string() : fmt::format(" {} ", by), part);
  return text;
}

/// What the guards before this one that raise another alarm ask for: where it fails, this one is not come to.
Conjunction beforeOf(const GuardTable &table, const Guard &guard) {
  Conjunction before;
  for (const Guard &earlier : table.guards) {
    if (&earlier == &guard)
      break;
    if (earlier.alarm != guard.alarm)
      before.add(needsOf(table, earlier));
  }
  return before;
}

/// The calls that raise the alarm; absent: too long.
std::optional<std::string> callsOf(const GuardTable &table, const std::vector<const Guard *> &guards) {
  const Conjunction common = beforeOf(table, *guards.front());
  std::size_t comparisons = common.comparisons;
  std::vector<std::string> refused;
  for (const Guard *guard : guards) {
    Conjunction more;
    for (const Guard &earlier : table.guards) {
      if (&earlier == guard)
        break;
      if (&earlier > guards.front() && earlier.alarm != guard->alarm)
        more.add(needsOf(table, earlier));
    }
    more.addOpposite(needsOf(table, *guard));
    comparisons += more.comparisons;
    if (const std::string text = joined(more.parts, "AND"); std::ranges::find(refused, text) == refused.end())
      refused.push_back(text);
  }
  if (comparisons > kMostParts)
    return std::nullopt;
  std::vector<std::string> parts = common.parts;
  parts.push_back(joined(refused, "OR"));
  return joined(parts, "AND");
}

} // namespace

Alternatives needsOf(const GuardTable &table, const Guard &guard) {
  Alternatives needs = guard.needs;
  for (const Comparison &each : guard.needs)
    for (const std::uint32_t variable : each.reads) {
      const Comparison vacant{
          fmt::format("#{}", variable), OperatorKind::Equal, "#0", variable, std::nullopt, true, {variable}};
      if (table.defaultOf(variable) && std::ranges::find(needs, vacant) == needs.end())
        needs.insert(needs.begin(), vacant);
    }
  return needs;
}

std::optional<std::string> refusalOf(const GuardTable &table, const Guard &guard) {
  if (!guard.alarm)
    return std::nullopt;
  Conjunction refused;
  refused.addOpposite(needsOf(table, guard));
  const Conjunction before = beforeOf(table, guard);
  refused.parts.insert(refused.parts.end(), before.parts.begin(), before.parts.end());
  if (refused.comparisons + before.comparisons > kMostParts)
    return std::nullopt;
  return fmt::format("@ALARM {} IF {}", *guard.alarm, joined(refused.parts, "AND"));
}

std::vector<AlarmClauses> alarmClauses(const GuardTable &table, const SourceFile &source, const SyntaxTree &tree) {
  std::map<std::uint32_t, std::vector<const Guard *>> guards;
  for (const Guard &guard : table.guards)
    if (guard.alarm)
      guards[*guard.alarm].push_back(&guard);
  std::vector<AlarmClauses> all;
  for (const auto &[alarm, of] : guards) {
    const auto calls = callsOf(table, of);
    if (!calls)
      continue;
    std::set<std::uint32_t> lines;
    for (const Guard *guard : of)
      lines.insert(source.lineOf(tree.blocks[guard->test].begin));
    const std::string reason = fmt::format("line{} {} ask{}", lines.size() == 1 ? "" : "s", fmt::join(lines, ", "),
                                           lines.size() == 1 ? "s" : "");
    all.push_back({alarm,
                   {{fmt::format("@ALARM {} IFF {}", alarm, *calls), reason, Ground::Promise},
                    {fmt::format("@ALARM {} IF {}", alarm, *calls), reason, Ground::Promise}}});
  }
  return all;
}

} // namespace feedhold::draft
