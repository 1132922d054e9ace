#include "inference/absint/engine.h"

#include "inference/absint/propagation.h"

#include <algorithm>
#include <bit>

namespace feedhold {

namespace {

constexpr std::size_t kMostThresholds = 128;

/// The constants of a program: where bounds tend to come to rest.
std::vector<double> thresholdsOf(const ProgramFile &file, ProgramId program) {
  const Program &range = file.model->programs[program];
  const std::uint32_t begin = file.tree->blocks[range.first].begin;
  const std::uint32_t end = file.tree->blocks[range.last].begin;
  std::vector<double> thresholds{-1, 0, 1};
  // Expressions stand in the order of the blocks.
  const auto first = std::partition_point(file.tree->expressions.begin(), file.tree->expressions.end(),
                                          [&](const Expression &expression) { return expression.span.begin < begin; });
  for (auto at = first; at != file.tree->expressions.end() && at->span.begin < end; ++at)
    if (const auto *literal = std::get_if<NumberLiteral>(&at->node);
        literal && thresholds.size() < 4 * kMostThresholds) {
      thresholds.push_back(literal->value.toDouble());
      thresholds.push_back(-literal->value.toDouble());
    }
  std::sort(thresholds.begin(), thresholds.end());
  thresholds.erase(std::unique(thresholds.begin(), thresholds.end()), thresholds.end());
  if (thresholds.size() > kMostThresholds)
    thresholds.resize(kMostThresholds);
  return thresholds;
}

std::vector<bool> joinsOf(const ProgramFile &file, const Wto &wto, ProgramUse use) {
  std::vector<std::uint8_t> ways(wto.order().size(), 0);
  for (const NodeId node : wto.order())
    forEachSuccessor(file.cfg, *file.model, node, use, [&](NodeId next) {
      const std::uint32_t position = wto.positionOf(next);
      if (position != Wto::kUnreachable && ways[position] < 2)
        ++ways[position];
    });
  std::vector<bool> joins(ways.size());
  for (std::size_t i = 0; i < ways.size(); ++i)
    joins[i] = ways[i] > 1;
  return joins;
}

std::pair<std::uint32_t, std::uint32_t> keyOf(Callee entry) { return {entry.file.index(), entry.entry.index()}; }

} // namespace

Engine::Engine(const ProgramSet &programs, AnalysisOptions options)
    : programs_(programs), options_(options), interpretation_(*programs.file(FileId(0)).dialect) {}

const ModalTable &Engine::modesOf(FileId file) {
  auto &modes = modes_[file.index()];
  if (!modes)
    modes = std::make_unique<ModalTable>(*programs_.file(file).dialect);
  return *modes;
}

const ProgramFacts &Engine::factsOf(Callee entry) {
  auto &facts = facts_[keyOf(entry)];
  if (!facts) {
    const ProgramFile &file = programs_.file(entry.file);
    Wto wto(file.cfg, *file.model, entry.entry, ProgramUse::Started);
    std::vector<bool> joins = joinsOf(file, wto, ProgramUse::Started);
    const auto loops =
        std::count_if(wto.order().begin(), wto.order().end(), [&](NodeId node) { return wto.isHead(node); });
    if (loops > kMostLoops && !gaveUp_)
      gaveUp_ = "a program has too many loops for the analysis";
    facts = std::make_unique<ProgramFacts>(ProgramFacts{entry, &file, std::move(wto), std::move(joins),
                                                        partitionBy(file, entry.program, modesOf(entry.file)),
                                                        thresholdsOf(file, entry.program)});
  }
  return *facts;
}

bool Engine::isOpen(Callee entry) const {
  return std::any_of(open_.begin(), open_.end(), [&](const Callee &other) { return keyOf(other) == keyOf(entry); });
}

bool Engine::spend(std::uint64_t cost) {
  spent_ += cost;
  if (spent_ > options_.budget && !gaveUp_)
    gaveUp_ = "the programs are too complex for the budget of the analysis";
  if (!gaveUp_)
    gaveUp_ = interpretation_.abandoned();
  return !gaveUp_;
}

void Engine::solve(const ProgramFacts &facts, Summary &summary) {
  open_.push_back(facts.entry);
  interpretation_.useDialect(*facts.file->dialect);
  Propagation(*this, facts, summary, Propagation::Phase::Ascend).run();
  if (!summary.heads.empty())
    descend(facts, summary);
  open_.pop_back();
}

/// Each iteration checks what the one before has narrowed, and leaves the exits of the states that hold.
void Engine::descend(const ProgramFacts &facts, Summary &summary) {
  constexpr int kNarrowings = 2;
  const auto collect = [&] {
    summary.exits.clear();
    Propagation iteration(*this, facts, summary, Propagation::Phase::Collect);
    iteration.run();
    return iteration.arrived();
  };
  auto held = summary.heads; // the last states that are known to be a fixpoint
  for (int round = 0; !gaveUp_; ++round) {
    const auto arrived = collect();
    const bool holds = std::all_of(arrived.begin(), arrived.end(), [&](const auto &states) {
      return states.second.within(interpretation_, summary.heads.at(states.first));
    });
    if (!holds) {
      summary.heads = std::move(held);
      collect();
      return;
    }
    held = summary.heads;
    bool narrower = false;
    for (auto &[position, states] : summary.heads)
      if (const auto found = arrived.find(position); found != arrived.end()) {
        states = states.narrowedBy(interpretation_, found->second);
        narrower = narrower || !held.at(position).within(interpretation_, states);
      }
    if (!narrower || round == kNarrowings) {
      summary.heads = std::move(held);
      return;
    }
  }
}

Summary &Engine::summaryOf(Callee entry, const AbstractState &state, std::optional<std::size_t> modalLimit) {
  const ProgramFacts &facts = factsOf(entry);
  auto &known = summaries_[keyOf(entry)];
  for (const auto &summary : known)
    if (summary->modalLimit == modalLimit && leq(interpretation_, state, summary->entry))
      return *summary;
  AbstractState wanted = known.size() >= kMostContexts ? known.back()->entry : state;
  if (known.size() >= kMostContexts)
    widenInto(interpretation_, wanted, state, facts.thresholds);
  auto summary = std::make_unique<Summary>();
  summary->entry = std::move(wanted);
  summary->modalLimit = modalLimit;
  solve(facts, *summary);
  auto &now = summaries_[keyOf(entry)]; // solving may have added some
  now.push_back(std::move(summary));
  return *now.back();
}

/// Without loops and calls one iteration is enough.
bool Engine::isStraight(const ProgramFacts &facts) const {
  return std::none_of(facts.wto.order().begin(), facts.wto.order().end(), [&](NodeId node) {
    return facts.wto.isHead(node) || std::holds_alternative<CallProgram>(facts.file->cfg.nodes[node].instruction);
  });
}

AbstractState Engine::entryStateOf(Callee entry, const FileContracts *contracts) {
  AbstractState state = entryState(interpretation_);
  const ModalTable &modes = modesOf(entry.file);
  const auto polar = modes.groupOf(ModalKind::Polar);
  interpretation_.keepPolar(polar);
  if (polar) // otherwise no word of the program would say where it leads
    state.codes[*polar] =
        CodeSet::of(static_cast<std::size_t>(std::countr_zero(modes.maskOf(ModalKind::Polar, {CodeAction::PolarOff}))));
  if (const Contract *contract = contracts ? contracts->of(entry.program) : nullptr)
    assumeContract(interpretation_, programs_, entry.file, *contracts, *contract, state);
  return state;
}

void Engine::walk(Callee entry, const AbstractState &state, AnalysisVisitor &visitor) {
  const ProgramFacts &facts = factsOf(entry);
  interpretation_.useDialect(*facts.file->dialect);
  Summary straight;
  straight.entry = state;
  Summary &summary = isStraight(facts) ? straight : summaryOf(entry, state, std::nullopt);
  visitor_ = &visitor;
  interpretation_.observe(&visitor);
  open_.push_back(entry);
  Propagation(*this, facts, summary, Propagation::Phase::Walk).run();
  open_.pop_back();
  walkWithNothingKnown(visitor);
  interpretation_.observe(nullptr);
  visitor_ = nullptr;
}

void Engine::walkWithNothingKnown(AnalysisVisitor &visitor) {
  std::set<Callee> walked;
  depthKnown_ = false;
  while (!unmodelledEntries_.empty() && !gaveUp_) {
    const Callee entry = *unmodelledEntries_.begin();
    unmodelledEntries_.erase(unmodelledEntries_.begin());
    if (!walked.insert(entry).second || !visitor.wantsUnmodelledEntry(entry))
      continue;
    interpretation_.useDialect(*programs_.file(entry.file).dialect);
    interpretation_.observe(nullptr);
    AbstractState anything = entryStateOf(entry, nullptr);
    anything.transformed = Truth::Maybe;
    interpretation_.havoc(anything, "a program that calls itself", {});
    Summary &summary = summaryOf(entry, anything, std::nullopt);
    interpretation_.observe(&visitor);
    interpretation_.useDialect(*programs_.file(entry.file).dialect);
    open_.push_back(entry);
    Propagation(*this, factsOf(entry), summary, Propagation::Phase::Walk).run();
    open_.pop_back();
  }
  depthKnown_ = true;
  unmodelledEntries_.clear();
}

// ---- symbols of summaries ------------------------------------------------------------------------------------------

AbstractState translated(const AbstractInterpretation &interpretation, AbstractState exit, AbstractState summaryEntry,
                         AbstractState entry) {
  align(interpretation, summaryEntry, entry);
  dropDifferentModalCalls(summaryEntry, entry); // one of them knows only that there may be some
  std::map<std::uint32_t, Origin> meaning;      // symbol of the summary: what it is in the caller
  forEachPart(Overloaded{[&](PartId, const AbstractValue &theirs, const AbstractValue &mine) {
                           if (!theirs.origin() || !mine.origin() || theirs.origin()->symbol == kZeroSymbol)
                             return;
                           if (const auto offset = subtract(mine.origin()->offset, theirs.origin()->offset))
                             meaning.emplace(theirs.origin()->symbol, Origin{mine.origin()->symbol, *offset});
                         },
                         [](PartId, const auto &, const auto &) {}},
              summaryEntry, entry);
  meaning.emplace(kZeroSymbol, Origin{kZeroSymbol, Rational()});
  forEachValue(exit, [&](AbstractValue &value) {
    if (!value.origin())
      return;
    std::optional<Origin> origin;
    if (const auto found = meaning.find(value.origin()->symbol); found != meaning.end()) {
      if (const auto offset = add(found->second.offset, value.origin()->offset))
        origin = Origin{found->second.symbol, *offset};
    } else if (isEntrySymbol(value.origin()->symbol)) {
      origin = value.origin(); // a cell that neither state has written
    }
    value = value.withOrigin(origin);
  });
  return exit;
}

// ---- Analysis ------------------------------------------------------------------------------------------------------

struct Analysis::Impl {
  Engine engine;
};

Analysis::Analysis(const ProgramSet &programs, AnalysisOptions options)
    : impl_(std::make_unique<Impl>(Impl{Engine(programs, options)})) {}
Analysis::~Analysis() = default;

AbstractInterpretation &Analysis::interpretation() { return impl_->engine.interpretation(); }
std::optional<std::string_view> Analysis::gaveUp() const { return impl_->engine.gaveUp(); }

AbstractState Analysis::entryState(Callee entry, const FileContracts *contracts) {
  return impl_->engine.entryStateOf(entry, contracts);
}
void Analysis::walk(Callee entry, AnalysisVisitor &visitor) { walk(entry, entryState(entry), visitor); }
void Analysis::walk(Callee entry, const AbstractState &state, AnalysisVisitor &visitor) {
  impl_->engine.walk(entry, state, visitor);
}

} // namespace feedhold
