#include "surface/lsp/facts_at_cursor.h"

#include "base/source/path_text.h"
#include "meaning/semantics/modal_table.h"
#include "surface/lsp/feature_meaning.h"

#include <fmt/format.h>

#include <algorithm>

namespace feedhold::lsp {

namespace {

constexpr std::size_t kMostTexts = 4; // in one answer

std::string callerOf(const Project &programs, const ContextStates &context) {
  if (context.calls.empty())
    return {};
  const Place from = context.calls.back();
  const ProjectFile &file = programs.file(from.file);
  const std::uint32_t line = lineOf(file, programs.set->node(from).block);
  return from.file == kDocument ? fmt::format("called in line {}", line)
                                : fmt::format("called in {}:{}", pathText(file.path.filename()), line);
}

/// Of the programs that are started where these chains of calls begin.
std::string assumedBy(const Project &programs, const std::vector<const ContextStates *> &contexts, ProgramId own) {
  std::vector<std::string> others;
  bool isOwn = false;
  for (const ContextStates *context : contexts) {
    const ProgramRef start{context->start.file, context->start.program};
    const bool isFollowed = !context->calls.empty() || start == ProgramRef{context->file, context->program};
    if (!context->assumesContract || !isFollowed)
      continue;
    const std::string name = nameOf(programs, start);
    if (start == ProgramRef{kDocument, own})
      isOwn = true;
    else if (std::find(others.begin(), others.end(), name) == others.end())
      others.push_back(name);
  }
  std::string text = isOwn ? "assuming the contract" : "";
  for (const std::string &name : others)
    text += (text.empty() ? "assuming the contract of " : " and that of ") + name;
  return text;
}

/// Of a program with more blocks than are kept together: of this one alone.
std::optional<BlockStates> statesOfOne(const View &view, BlockId block) {
  RangesOptions options;
  options.line = lineOf(view.file(), block);
  Result<BlockStates> states = rangesOf(*view.programs, options);
  if (!states || states.value().gaveUp)
    return std::nullopt;
  return states.take();
}

bool isExecuted(const View &view, BlockId block) {
  const Cfg &cfg = view.programs->set->file(kDocument).cfg;
  const NodeId node = cfg.nodeOf(block);
  return node.index() < cfg.nodes.size() && cfg.nodes[node].block == block;
}

} // namespace

std::optional<FactsAtCursor> knownBefore(const View &view, BlockId block) {
  const Project &programs = *view.programs;
  if (!isExecuted(view, block))
    return std::nullopt;
  const BlockStates *states = view.flow->statesOf(view.programs);
  const std::optional<BlockStates> one = states && states->isCutShort ? statesOfOne(view, block) : std::nullopt;
  if (!states || (states->isCutShort && !one))
    return std::nullopt;
  FactsAtCursor known;
  std::vector<const ContextStates *> contexts;
  for (const ContextStates &context : (one ? *one : *states).contexts)
    if (const auto found = context.blocks.find(block); context.file == kDocument && found != context.blocks.end()) {
      known.contexts.push_back(
          {callerOf(programs, context), FactsOfStates(context, *programs.set).at(found->second.state())});
      contexts.push_back(&context);
    }
  known.assumed = assumedBy(programs, contexts, view.file().model.programOf(block));
  return known;
}

std::string together(const std::vector<std::pair<std::string, std::string>> &callerAndText) {
  std::vector<std::pair<std::string, std::string>> texts; // each text once, and the callers for which it holds
  for (const auto &[caller, text] : callerAndText) {
    const std::string &wanted = text;
    const auto found = std::find_if(texts.begin(), texts.end(), [&](const auto &each) { return each.first == wanted; });
    if (found == texts.end())
      texts.emplace_back(text, caller);
    else if (!caller.empty() && found->second.find(caller) == std::string::npos)
      found->second += (found->second.empty() ? "" : ", ") + caller;
  }
  std::string answer;
  for (std::size_t i = 0; i < std::min(texts.size(), kMostTexts); ++i)
    answer += fmt::format("{}{}{}", i == 0 ? "" : "; ", texts[i].first,
                          texts.size() > 1 && !texts[i].second.empty() ? " (" + texts[i].second + ")" : "");
  return texts.size() > kMostTexts ? answer + fmt::format("; and {} more", texts.size() - kMostTexts) : answer;
}

} // namespace feedhold::lsp
