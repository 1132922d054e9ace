// Joins findings that share a key, by union-find over their positions.
#include "surface/sink/causes.h"

#include "base/support/text.h"
#include "surface/sink/shown.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <numeric>

namespace feedhold {

namespace {

constexpr std::size_t kPlacesShown = 6;
constexpr std::uint32_t kNeighbours = 2; // lines; an empty one or a remark may lie between rows

/// Disjoint sets of indices; the smallest index stands for its set.
class Groups {
public:
  explicit Groups(std::size_t size) : parent_(size) { std::iota(parent_.begin(), parent_.end(), std::size_t{0}); }

  std::size_t find(std::size_t i) {
    while (parent_[i] != i)
      i = parent_[i] = parent_[parent_[i]];
    return i;
  }

  void join(std::size_t a, std::size_t b) {
    const std::size_t first = find(a);
    const std::size_t second = find(b);
    parent_[std::max(first, second)] = std::min(first, second);
  }

private:
  std::vector<std::size_t> parent_;
};

std::uint32_t lineOf(const FoundPlace &place) {
  return place.file->source.position(place.finding->diagnostic.span.begin).line;
}

std::string sayingOf(const FoundPlace &place) {
  return fmt::format("{}\n{}\n{}\n{}", place.finding->rule->name, nameOf(place.finding->severity),
                     place.finding->suppressed, place.finding->diagnostic.message);
}

/// The message without what stands in backticks.
std::string shapeOf(const FoundPlace &place) {
  std::string shape;
  bool isQuoted = false;
  for (const char c : place.finding->diagnostic.message) {
    isQuoted = isQuoted != (c == '`');
    if (!isQuoted)
      shape += c;
  }
  return shape;
}

bool isNextRow(const FoundPlace &row, const FoundPlace &next) {
  return row.file == next.file && row.finding->rule == next.finding->rule &&
         row.finding->suppressed == next.finding->suppressed && lineOf(next) - lineOf(row) <= kNeighbours &&
         shapeOf(row) == shapeOf(next);
}

std::string_view folderOf(std::string_view path) {
  const std::size_t slash = path.find_last_of("/\\");
  return slash == std::string_view::npos ? "" : path.substr(0, slash);
}

/// Findings of other rules may stand between the rows of a table.
void joinTables(const std::vector<FoundPlace> &places, Groups &groups) {
  std::map<std::pair<const CheckedFile *, const RuleInfo *>, std::vector<std::size_t>> byRule;
  for (std::size_t i = 0; i < places.size(); ++i)
    byRule[{places[i].file, places[i].finding->rule}].push_back(i);
  for (const auto &[key, rows] : byRule)
    for (std::size_t begin = 0, end = 1; begin < rows.size(); begin = end++) {
      while (end < rows.size() && isNextRow(places[rows[end - 1]], places[rows[end]]))
        ++end;
      for (std::size_t k = begin + 1; end - begin >= kTableRows && k < end; ++k)
        groups.join(rows[begin], rows[k]);
    }
}

} // namespace

std::vector<Cause> causesOf(const Report &report) {
  std::vector<FoundPlace> places;
  forEachShown(report, [&](const CheckedFile &file, const Finding &finding) { places.push_back({&file, &finding}); });
  Groups groups(places.size());
  std::map<std::string, std::size_t> first;
  const auto joinBy = [&](std::string key, std::size_t i) {
    const auto [known, isNew] = first.emplace(std::move(key), i);
    if (!isNew)
      groups.join(known->second, i);
  };
  for (std::size_t i = 0; i < places.size(); ++i) {
    const CheckedFile &file = *places[i].file;
    const std::string saying = sayingOf(places[i]);
    joinBy(fmt::format("file {}\n{}", file.path, saying), i);
    joinBy(file.foreign.empty()
               ? fmt::format("line {}\n{}", trimmed(file.source.text(file.source.lineSpan(lineOf(places[i])))), saying)
               : "language " + saying,
           i);
    if (places[i].finding->rule->cause == CauseScope::OneFolder)
      joinBy(fmt::format("folder {}\n{}", folderOf(file.path), saying), i);
  }
  joinTables(places, groups);
  std::map<std::size_t, Cause> causes;
  for (std::size_t i = 0; i < places.size(); ++i)
    causes[groups.find(i)].places.push_back(places[i]);
  std::vector<Cause> result;
  result.reserve(causes.size());
  for (auto &[index, cause] : causes)
    result.push_back(std::move(cause));
  return result;
}

std::string otherPlaces(const Cause &cause) {
  const CheckedFile *file = cause.places.front().file;
  const std::size_t others = cause.places.size() - 1;
  if (others == 0)
    return "";
  const bool isOneFile = cause.places.back().file == file; // they come file by file
  std::vector<std::string> names;
  for (std::size_t i = 1; i <= std::min(others, kPlacesShown); ++i) {
    const FoundPlace &place = cause.places[i];
    names.push_back(isOneFile ? fmt::format("{}", lineOf(place))
                              : fmt::format("{}:{}", place.file->path, lineOf(place)));
  }
  std::string text = fmt::format("the same in {} more place{}: ", others, others == 1 ? "" : "s");
  if (isOneFile)
    text += others == 1 ? "line " : "lines ";
  text += fmt::format("{}", fmt::join(names, ", "));
  return others > kPlacesShown ? text + fmt::format(" and {} more", others - kPlacesShown) : text;
}

} // namespace feedhold
