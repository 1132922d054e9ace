// Loops that jumps enter: for each number of a loop, the innermost loop around a block is looked up by bisection.
#include "meaning/cfg/loop_gates.h"

#include <algorithm>

namespace feedhold {

namespace {

bool holds(const Loop &loop, BlockId block) { return loop.doBlock < block && block <= *loop.endBlock; }

/// The loops of one number: from each place on, the innermost one around it.
class LoopsOfNumber {
public:
  explicit LoopsOfNumber(std::uint8_t number) : number_(number) {}

  std::uint8_t number() const { return number_; }
  void add(const std::vector<Loop> &loops, std::size_t loop) {
    closeBefore(loops, loops[loop].doBlock);
    open_.push_back(loop);
    places_.push_back({loops[loop].doBlock.next(), loop});
  }
  void closeAll(const std::vector<Loop> &loops) { closeBefore(loops, BlockId(0xffffffff)); }
  std::optional<std::size_t> around(BlockId block) const {
    const auto behind = std::upper_bound(places_.begin(), places_.end(), block,
                                         [](BlockId at, const Place &place) { return at < place.from; });
    return behind == places_.begin() ? std::nullopt : std::prev(behind)->loop;
  }

private:
  struct Place {
    BlockId from;
    std::optional<std::size_t> loop;
  };

  void closeBefore(const std::vector<Loop> &loops, BlockId block) {
    while (!open_.empty() && *loops[open_.back()].endBlock < block) {
      const BlockId behind = loops[open_.back()].endBlock->next();
      open_.pop_back();
      places_.push_back({behind, open_.empty() ? std::nullopt : std::optional(open_.back())});
    }
  }

  std::uint8_t number_;
  std::vector<std::size_t> open_;
  std::vector<Place> places_; // by block
};

std::vector<LoopsOfNumber> loopsByNumber(const ProgramModel &model, ProgramId program, const Dialect &dialect) {
  std::vector<LoopsOfNumber> all;
  const std::span<const Loop> own = model.loopsOf(program);
  for (const Loop &loop : own) {
    const std::optional<std::uint8_t> number = usableNumber(loop.number, dialect);
    if (!number || !loop.endBlock)
      continue;
    auto at = std::find_if(all.begin(), all.end(), [&](const LoopsOfNumber &each) { return each.number() == *number; });
    if (at == all.end())
      at = all.insert(all.end(), LoopsOfNumber(*number));
    at->add(model.loops, static_cast<std::size_t>(&loop - model.loops.data()));
  }
  for (LoopsOfNumber &each : all)
    each.closeAll(model.loops);
  return all;
}

bool staysInProgram(JumpKind kind) {
  return kind == JumpKind::Goto || kind == JumpKind::LocalCall || kind == JumpKind::ReturnTo;
}

/// Blocks from which control may go on at labels that only the run decides.
struct OpenSources {
  std::vector<BlockId> computed; // GOTO, M97 and M99 P with a computed number: any label
  std::vector<BlockId> calls;    // the callee may say where to go on
};

OpenSources openSources(const ProgramModel &model, ProgramId program) {
  OpenSources sources;
  for (const Jump &jump : model.jumpsOf(program))
    if (jump.computed && staysInProgram(jump.kind))
      sources.computed.push_back(jump.block);
  for (const Call &call : model.callsOf(program))
    sources.calls.push_back(call.block);
  return sources;
}

bool someOutside(const std::vector<BlockId> &sortedBlocks, const Loop &loop) {
  const auto first = std::upper_bound(sortedBlocks.begin(), sortedBlocks.end(), loop.doBlock);
  const auto last = std::upper_bound(first, sortedBlocks.end(), *loop.endBlock);
  return static_cast<std::size_t>(last - first) < sortedBlocks.size();
}

bool mayReturnTo(const ReturnTargets &returns, std::uint32_t number) {
  return returns.any || std::binary_search(returns.numbers.begin(), returns.numbers.end(), number);
}

} // namespace

std::optional<std::uint8_t> usableNumber(const std::optional<std::uint32_t> &number, const Dialect &dialect) {
  if (!number || *number == 0 || *number > dialect.limits.lastLoopNumber)
    return std::nullopt;
  return static_cast<std::uint8_t>(*number);
}

std::vector<LoopEntrance> loopEntrances(const ProgramModel &model, ProgramId program, const Dialect &dialect,
                                        const ReturnTargets &returns) {
  std::vector<LoopEntrance> entrances;
  const std::vector<LoopsOfNumber> numbers = loopsByNumber(model, program, dialect);
  if (numbers.empty())
    return entrances;
  const OpenSources sources = openSources(model, program);
  for (const LoopsOfNumber &number : numbers) {
    for (const Jump &jump : model.jumpsOf(program))
      if (jump.target && staysInProgram(jump.kind))
        if (const auto loop = number.around(*jump.target); loop && !holds(model.loops[*loop], jump.block))
          entrances.push_back({*jump.target, *loop});
    for (const SequenceNumber &label : model.sequenceNumbersOf(program)) {
      const auto loop = number.around(label.block);
      if (loop && (someOutside(sources.computed, model.loops[*loop]) ||
                   (mayReturnTo(returns, label.number) && someOutside(sources.calls, model.loops[*loop]))))
        entrances.push_back({label.block, *loop});
    }
  }
  const auto key = [](const LoopEntrance &each) { return std::pair(each.label, each.loop); };
  std::sort(entrances.begin(), entrances.end(), [&](const auto &a, const auto &b) { return key(a) < key(b); });
  entrances.erase(
      std::unique(entrances.begin(), entrances.end(), [&](const auto &a, const auto &b) { return key(a) == key(b); }),
      entrances.end());
  return entrances;
}

} // namespace feedhold
