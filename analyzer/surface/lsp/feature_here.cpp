#include "surface/lsp/feature_here.h"

#include "findings/session/ranges.h"
#include "meaning/semantics/modal_table.h"
#include "surface/lsp/feature_thing.h"

#include <fmt/format.h>

#include <algorithm>

namespace feedhold::lsp {

namespace {

constexpr std::size_t kMostTexts = 4; // in one answer

std::string wayOf(const LoadedPrograms &programs, const ContextStates &context) {
  if (context.calls.empty())
    return {};
  const Place from = context.calls.back();
  const LoadedFile &file = programs.file(from.file);
  const std::uint32_t line = file.source.lineOf(file.tree.blocks[programs.set->node(from).block].begin);
  return from.file == kDocument ? fmt::format("called in line {}", line)
                                : fmt::format("called in {}:{}", file.path.filename().generic_string(), line);
}

} // namespace

std::optional<KnownHere> knownBefore(const View &view, std::uint32_t line) {
  const LoadedPrograms &programs = *view.programs;
  RangesWish wish;
  wish.line = line;
  const Result<BlockStates> states = rangesOf(programs, wish);
  if (!states || states.value().gaveUp)
    return std::nullopt;
  KnownHere known;
  const ModalTable modes(programs.dialect);
  for (const ContextStates &context : states.value().contexts)
    if (context.file == kDocument)
      for (const auto &[block, state] : context.blocks)
        if (view.file().source.lineOf(view.file().tree.blocks[block].begin) == line)
          known.ways.push_back({wayOf(programs, context), factsOf(state, context, *programs.set, modes)});
  known.isReached = !known.ways.empty();
  return known;
}

std::string together(const std::vector<std::pair<std::string, std::string>> &wayAndText) {
  std::vector<std::pair<std::string, std::string>> texts; // each text once, and its ways
  for (const auto &[way, text] : wayAndText) {
    const std::string &wanted = text;
    const auto found = std::find_if(texts.begin(), texts.end(), [&](const auto &each) { return each.first == wanted; });
    if (found == texts.end())
      texts.emplace_back(text, way);
    else if (!way.empty() && found->second.find(way) == std::string::npos)
      found->second += (found->second.empty() ? "" : ", ") + way;
  }
  std::string answer;
  for (std::size_t i = 0; i < std::min(texts.size(), kMostTexts); ++i)
    answer += fmt::format("{}{}{}", i == 0 ? "" : "; ", texts[i].first,
                          texts.size() > 1 && !texts[i].second.empty() ? " (" + texts[i].second + ")" : "");
  return texts.size() > kMostTexts ? answer + fmt::format("; and {} more", texts.size() - kMostTexts) : answer;
}

} // namespace feedhold::lsp
