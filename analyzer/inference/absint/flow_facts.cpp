#include "inference/absint/flow_facts.h"

#include "meaning/cfg/program_nodes.h"
#include "meaning/cfg/reached_programs.h"

#include <algorithm>
#include <tuple>

namespace feedhold {

namespace {

/// Expressions stand in the order of the blocks.
std::size_t firstExpressionOf(const ProgramFile &file, BlockId block) {
  const std::uint32_t begin = file.tree->blocks[block].begin;
  const auto first = std::partition_point(file.tree->expressions.begin(), file.tree->expressions.end(),
                                          [&](const Expression &expression) { return expression.span.begin < begin; });
  return static_cast<std::size_t>(first - file.tree->expressions.begin());
}

/// So much work that a program in use never needs it, so little that a hostile one ends soon.
std::uint64_t factBudget(const ProgramFile &file) { return 300'000 + 5 * file.cfg.nodes.size(); }

} // namespace

FlowFacts::FlowFacts(const ProgramSet &set, FileId file_, ProgramId program_)
    : programs(set), file(set.file(file_)), program(program_), modes(*file.dialect),
      first_(file.cfg.entryOf(program_).index()), reached_(nodesOf(file, program_)),
      values_(firstExpressionOf(file, file.model->programs[program_].first),
              firstExpressionOf(file, file.model->programs[program_].last)) {}

std::optional<Truth> FlowFacts::truthOf(NodeId test) const {
  const auto found = truths_.find(test.index());
  return found == truths_.end() ? std::nullopt : std::optional(found->second);
}

const AbstractValue *FlowFacts::valueOf(ExpressionId expression) const { return values_.find(expression); }

/// Fills in the facts while the analysis tells what it sees.
class FactCollector : public AnalysisVisitor {
public:
  FactCollector(FlowFacts &facts, AbstractInterpretation &interpretation, std::span<FlowWatch *const> watches)
      : facts_(facts), interpretation_(interpretation), watches_(watches) {}

  void visit(Place place, const AbstractState &state, std::span<const Place> calls) override {
    resumed(place, calls);
    if (outer_)
      return;
    facts_.reached_[place.node.index() - facts_.first_] = true;
    for (FlowWatch *watch : watches_)
      watch->before(place.node, state);
  }
  /// A program that is gone through with nothing known is none of this one's either.
  void resumed(Place place, std::span<const Place> calls) override {
    place_ = place;
    const bool isCalled = !calls.empty() && isOwn(calls.front());
    outer_ = isOwn(place) ? std::nullopt : std::optional(isCalled ? calls.front().node : facts_.entry());
  }
  /// Only where it may come back to this program, or to one in which a variable was read that held nothing: without
  /// this each program of a long chain of calls would go through all those below it.
  bool wantsUnmodelledEntry(const Callee &callee) override {
    ReachedPrograms reached;
    collectReached(facts_.programs, {callee.file, callee.program}, reached);
    return comesBack(reached) || comesBack(reachedModally());
  }
  void left(Place place, const AbstractState &state) override {
    if (!outer_)
      for (FlowWatch *watch : watches_)
        watch->after(place.node, state);
  }
  void move(MoveKind kind) override {
    if (!outer_)
      for (FlowWatch *watch : watches_)
        watch->move(place_.node, kind);
  }
  void branch(Place place, Truth truth) override {
    if (outer_)
      return;
    const auto [found, isNew] = facts_.truths_.emplace(place.node.index(), truth);
    if (!isNew)
      found->second = join(found->second, truth);
  }
  void alarm(Truth truth, const AlarmReport &report) override {
    if (outer_)
      return;
    const bool always = truth == Truth::True;
    const auto key = std::tuple(report.place.begin, report.place.end, report.kind);
    const auto [known, isNew] = alarmAt_.emplace(key, facts_.alarms_.size());
    if (isNew)
      facts_.alarms_.push_back({report.kind, report.place, place_.node, always});
    else
      facts_.alarms_[known->second].always = facts_.alarms_[known->second].always && always;
  }
  void userAlarm(const AbstractValue &number, Span place) override {
    if (outer_)
      return noteAlarmInCall(place);
    const auto [known, isNew] = userAlarmAt_.emplace(std::pair(place.begin, place.end), facts_.userAlarms_.size());
    if (isNew)
      facts_.userAlarms_.push_back({place, place_.node, number});
    else
      facts_.userAlarms_[known->second].number = join(facts_.userAlarms_[known->second].number, number);
  }
  void unmodelled(std::string_view reason, Span) override {
    const NodeId node = outer_.value_or(place_.node);
    if (unmodelledAt_.emplace(node, reason).second)
      facts_.unmodelled_.push_back({node, reason});
  }
  void evaluated(ExpressionId expression, const AbstractValue &value) override {
    if (outer_)
      return noteVacantRead(expression, value);
    facts_.values_.add(expression, value);
  }
  void ended(Place place, PathEnd end, const AbstractState &state) override {
    if (outer_)
      return;
    for (FlowWatch *watch : watches_)
      watch->ended(place.node, end, state);
    const auto [known, isNew] = exitAt_.emplace(place.node, facts_.exits_.size());
    if (isNew)
      facts_.exits_.push_back({place.node, end, state});
    else
      joinInto(interpretation_, facts_.exits_[known->second].state, state);
  }
  void called(Place place, const CallRequest<AbstractInterpretation> &request) override {
    if (outer_)
      return;
    const auto *instruction = std::get_if<CallProgram>(&facts_.node(place.node).instruction);
    if (!instruction)
      return;
    const auto [known, isNew] = callAt_.emplace(place.node, facts_.calls_.size());
    if (isNew) {
      facts_.calls_.push_back({place.node, instruction->call, request});
      return;
    }
    CallRequest<AbstractInterpretation> &all = facts_.calls_[known->second].request;
    for (std::size_t i = 0; i < all.locals.size(); ++i)
      all.locals[i] = join(all.locals[i], request.locals[i]);
    all.repeats = join(all.repeats, request.repeats);
  }

  void finish(bool complete) {
    facts_.complete_ = complete;
    // Read as a vacant variable in one state of a call, and as a number in another, or in one of which nothing is
    // known: that is not always.
    std::erase_if(facts_.vacantReads_, [&](const VacantReadInCall &read) {
      return readAsNumber_.contains(readIn(read.call, read.read, read.expression)) ||
             readAsNumber_.contains(readIn(facts_.entry(), read.read, read.expression));
    });
    const auto byPlace = [](const auto &a, const auto &b) { return a.place < b.place; };
    std::stable_sort(facts_.alarms_.begin(), facts_.alarms_.end(), byPlace);
    const auto byNode = [](const auto &a, const auto &b) { return a.node < b.node; };
    std::stable_sort(facts_.exits_.begin(), facts_.exits_.end(), byNode);
    std::stable_sort(facts_.calls_.begin(), facts_.calls_.end(), byNode);
  }

private:
  const ReachedPrograms &reachedModally() {
    if (!reachedModally_) {
      reachedModally_.emplace();
      for (const Callee &modal : facts_.programs.modalCallees())
        collectReached(facts_.programs, {modal.file, modal.program}, *reachedModally_);
    }
    return *reachedModally_;
  }
  bool comesBack(const ReachedPrograms &reached) const {
    return reached.orAny || reached.programs.contains({facts_.file.file, facts_.program}) ||
           std::ranges::any_of(facts_.vacantReads_, [&](const VacantReadInCall &vacant) {
             const ProgramFile &file = facts_.programs.file(vacant.read.file);
             const ProgramId reader = file.model->programOf(file.cfg.nodes[vacant.read.node].block);
             return reached.programs.contains({vacant.read.file, reader});
           });
  }
  /// By M97 a program calls parts of itself.
  bool isOwn(Place place) const {
    return place.file == facts_.file.file && place.node.index() >= facts_.first_ &&
           place.node.index() - facts_.first_ < facts_.reached_.size();
  }
  using ReadInCall = std::tuple<std::size_t, std::size_t, std::size_t>;
  static ReadInCall readIn(NodeId call, Place place, ExpressionId expression) {
    return {call.index(), place.file.index(), expression.index()};
  }
  void noteVacantRead(ExpressionId expression, const AbstractValue &value) {
    const ProgramFile &file = facts_.programs.file(place_.file);
    const auto variable = variableNumber(*file.tree, expression);
    if (!variable || *variable == 0 || *variable > kLocalVariables)
      return;
    const ReadInCall key = readIn(*outer_, place_, expression);
    if (!value.isVacant()) {
      readAsNumber_.insert(key);
      return;
    }
    if (readAsVacant_.insert(key).second)
      facts_.vacantReads_.push_back({*outer_, place_, expression, *variable});
  }

  void noteAlarmInCall(Span place) {
    constexpr int kMostOfOneCall = 20; // more than one are alternatives that the reader is not shown
    if (++alarmsIn_[*outer_] <= kMostOfOneCall)
      facts_.alarmsInCalls_.push_back({*outer_, place_, place});
  }

  FlowFacts &facts_;
  AbstractInterpretation &interpretation_;
  std::span<FlowWatch *const> watches_;
  Place place_{FileId(0), NodeId(0)};
  std::optional<NodeId> outer_;                   // the call of this program through which the present place is reached
  std::optional<ReachedPrograms> reachedModally_; // from what the modal calls of all programs call
  // Which of the facts is about a place: a program of a million blocks may have one for each.
  std::map<std::tuple<std::uint32_t, std::uint32_t, AlarmKind>, std::size_t> alarmAt_;
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::size_t> userAlarmAt_;
  std::set<std::pair<NodeId, std::string_view>> unmodelledAt_;
  std::map<NodeId, std::size_t> exitAt_;
  std::map<NodeId, std::size_t> callAt_;
  std::set<ReadInCall> readAsVacant_;
  std::set<ReadInCall> readAsNumber_;
  std::map<NodeId, int> alarmsIn_;
};

// A called program with as many computed jumps is costly, but bounded by the budget.
FlowFacts collectFacts(const ProgramSet &programs, FileId file, ProgramId program, std::span<FlowWatch *const> watches,
                       const FileContracts *contracts) {
  FlowFacts facts(programs, file, program);
  if (computedEdges(facts.file.cfg, *facts.file.model, program) > kMostComputedEdges) {
    facts.complete_ = false;
    return facts;
  }
  Analysis analysis(programs, {.budget = factBudget(facts.file)});
  FactCollector collector(facts, analysis.interpretation(), watches);
  const Callee start{file, facts.entry(), program};
  const AbstractState entry = analysis.entryState(start, contracts);
  facts.entryCodes_ = entry.codes;
  analysis.walk(start, entry, collector);
  collector.finish(!analysis.gaveUp().has_value());
  return facts;
}

} // namespace feedhold
