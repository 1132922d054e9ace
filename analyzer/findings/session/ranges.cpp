#include "findings/session/ranges.h"

#include "meaning/cfg/reached_programs.h"

#include <fmt/format.h>

#include <algorithm>

namespace feedhold {

namespace {

constexpr FileId kFirstFile{0};

std::vector<Callee> allStarts(const Project &loaded) {
  const ProgramSet &programs = *loaded.set;
  const ProgramFile &file = programs.file(kFirstFile);
  std::vector<Callee> starts;
  ReachedPrograms reached;
  const auto start = [&](ProgramId program) {
    starts.push_back({kFirstFile, file.cfg.entryOf(program), program});
    collectReached(programs, {kFirstFile, program}, reached);
  };
  const auto isCalledHere = [&](ProgramId program) {
    const auto callers = programs.callGraph().callers({kFirstFile, program});
    return std::any_of(callers.begin(), callers.end(), [&](const CallGraph::Caller &caller) {
      return caller.file == kFirstFile && file.model->calls[caller.call].caller != program;
    });
  };
  for (std::size_t i = 0; i < file.model->programs.size(); ++i)
    if (!isCalledHere(ProgramId(i)))
      start(ProgramId(i));
  for (std::size_t i = 0; i < file.model->programs.size(); ++i)
    if (!reached.programs.contains({kFirstFile, ProgramId(i)})) // they call one another
      start(ProgramId(i));
  return starts;
}

/// The block of a line, or of the next one that is executed.
std::optional<BlockId> blockAt(const ProgramFile &file, std::uint32_t line) {
  for (BlockId block(0); block.index() < file.tree->blocks.size(); block = block.next()) {
    if (file.source->lineOf(file.tree->blocks[block].begin) < line)
      continue;
    const NodeId node = file.cfg.nodeOf(block);
    return node.index() < file.cfg.nodes.size() ? std::optional(file.cfg.nodes[node].block) : std::nullopt;
  }
  return std::nullopt;
}

} // namespace

Result<BlockStates> rangesOf(const Project &programs, const RangesOptions &options) {
  std::vector<Callee> starts;
  if (options.program) {
    const auto start = startOf(programs, options.program);
    if (!start)
      return Error{fmt::format("contains no program `{}`", *options.program)};
    starts.push_back(*start);
  } else {
    starts = allStarts(programs);
  }
  const ProgramFile &file = programs.set->file(kFirstFile);
  std::optional<BlockId> block;
  if (options.line) {
    block = blockAt(file, *options.line);
    if (!block || *options.line == 0)
      return Error{fmt::format("no block is executed in line {} or after it", *options.line)};
  }
  const auto wants = [&](FileId at, BlockId which) {
    return (at == kFirstFile || (options.files == RangesOptions::Files::All && !block)) && (!block || *block == which);
  };
  return collectBlockStates(*programs.set, starts, wants, &programs.file(kFirstFile).contracts);
}

} // namespace feedhold
