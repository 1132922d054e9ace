#include "inference/absint/block_states.h"

#include "inference/absint/contract_entry.h"

#include <algorithm>

namespace feedhold {

namespace {

/// A person waits for the answer: more than `check` spends on a program, and still only seconds.
std::uint64_t stateBudget(const ProgramFile &file) { return 2'000'000 + 10 * file.cfg.nodes.size(); }

/// The nodes at which a run comes into a block from another one: the first, and that of a WHILE to which its END leads.
std::vector<bool> blockEntries(const ProgramFile &file) {
  std::vector<bool> entries(file.cfg.nodes.size(), false);
  for (const NodeId node : file.cfg.blockNode)
    if (node.index() < entries.size())
      entries[node.index()] = true;
  for (NodeId node(0); node.index() < entries.size(); node = node.next())
    if (!std::holds_alternative<JumpTo>(file.cfg.nodes[node].instruction))
      forEachSuccessor(file.cfg, *file.model, node, ProgramUse::Called, [&](NodeId next) {
        if (file.cfg.nodes[next].block != file.cfg.nodes[node].block)
          entries[next.index()] = true;
      });
  return entries;
}

class StateCollector : public AnalysisVisitor {
public:
  StateCollector(const ProgramSet &programs, const std::function<bool(FileId, BlockId)> &wants, BlockStates &result)
      : programs_(programs), wants_(wants), result_(result) {}

  void begin(Callee start, const FileContracts *contracts, AbstractInterpretation &interpretation) {
    start_ = start;
    const Contract *contract = contracts ? contracts->of(start.program) : nullptr;
    assumesContract_ = contract && speaksOfEntry(*contract);
    interpretation_ = &interpretation;
    first_ = result_.contexts.size();
  }

  void visit(Place place, const AbstractState &state, std::span<const Place> calls) override {
    place_ = place;
    const BlockId block = programs_.node(place).block;
    if (!wants_(place.file, block) || !entriesOf(place.file)[place.node.index()])
      return;
    ContextStates &context = contextOf(place, block, calls);
    const auto known = context.blocks.find(block);
    if (known != context.blocks.end())
      join(known->second, state);
    else if (values_ < BlockStates::kMostValues)
      keep(context, block, state);
    else
      result_.isCutShort = true;
  }
  void resumed(Place place, std::span<const Place>) override { place_ = place; }
  bool tellsCallsApart() const override { return true; }
  void leftOut(Place) override { result_.isCutShort = true; }
  void unmodelled(std::string_view reason, Span) override {
    const UnmodelledNote note{reason, place_};
    if (result_.unmodelled.size() < kMostNotes &&
        std::find(result_.unmodelled.begin(), result_.unmodelled.end(), note) == result_.unmodelled.end())
      result_.unmodelled.push_back(note);
  }

private:
  static constexpr std::size_t kMostNotes = 100;

  void keep(ContextStates &context, BlockId block, const AbstractState &state) {
    const KeptState &kept = context.blocks.emplace(block, keeper_.keep(state)).first->second;
    values_ += kept.valueCount();
  }
  void join(KeptState &known, const AbstractState &state) {
    AbstractState joined = known.state();
    joinInto(*interpretation_, joined, state);
    values_ -= known.valueCount();
    known = keeper_.keep(joined);
    values_ += known.valueCount();
  }

  const std::vector<bool> &entriesOf(FileId file) {
    std::vector<bool> &entries = entries_[file.index()];
    if (entries.empty())
      entries = blockEntries(programs_.file(file));
    return entries;
  }
  ContextStates &contextOf(Place place, BlockId block, std::span<const Place> calls) {
    const ProgramId program = programs_.file(place.file).model->programOf(block);
    const auto found =
        std::find_if(result_.contexts.begin() + static_cast<std::ptrdiff_t>(first_), result_.contexts.end(),
                     [&](const ContextStates &context) {
                       return context.file == place.file && context.program == program &&
                              std::equal(context.calls.begin(), context.calls.end(), calls.begin(), calls.end());
                     });
    if (found != result_.contexts.end())
      return *found;
    result_.contexts.push_back({*start_, assumesContract_, {calls.begin(), calls.end()}, place.file, program, {}});
    return result_.contexts.back();
  }

  const ProgramSet &programs_;
  const std::function<bool(FileId, BlockId)> &wants_;
  BlockStates &result_;
  std::optional<Callee> start_;
  bool assumesContract_ = false;
  AbstractInterpretation *interpretation_ = nullptr;
  std::size_t first_ = 0; // of the contexts of this start
  StateKeeper keeper_;
  std::size_t values_ = 0; // kept
  Place place_{FileId(0), NodeId(0)};
  std::map<std::size_t, std::vector<bool>> entries_; // by file
};

} // namespace

BlockStates collectBlockStates(const ProgramSet &programs, std::span<const Callee> starts,
                               const std::function<bool(FileId, BlockId)> &wants, const FileContracts *contracts) {
  BlockStates result;
  StateCollector collector(programs, wants, result);
  for (const Callee &start : starts) {
    const ProgramFile &file = programs.file(start.file);
    if (computedEdges(file.cfg, *file.model, start.program) > kMostComputedEdges) {
      result.gaveUp = "too many computed jumps, each of which may lead to any sequence number";
    } else {
      Analysis analysis(programs, {.budget = stateBudget(file)});
      collector.begin(start, contracts, analysis.interpretation());
      analysis.walk(start, analysis.entryState(start, contracts), collector);
      result.gaveUp = analysis.gaveUp();
    }
    if (result.gaveUp) {
      result.contexts.clear();
      return result;
    }
  }
  return result;
}

} // namespace feedhold
