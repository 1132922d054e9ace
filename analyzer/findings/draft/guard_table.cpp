// See the header.
#include "findings/draft/guard_table.h"

#include "base/support/text.h"
#include "meaning/cfg/program_nodes.h"

#include <algorithm>
#include <map>

namespace feedhold::draft {

namespace {

constexpr std::size_t kMostNodes = 4'000;
constexpr std::size_t kMostPaths = 48;

/// A test and its outcome; without a test, something that no condition tells.
struct Step {
  std::optional<NodeId> test;
  bool holds;
};
using Path = std::vector<Step>;
using Paths = std::vector<Path>;

/// The nodes of a program from which every path raises an alarm of the program.
class Doomed {
public:
  explicit Doomed(const FlowFacts &facts) : facts_(facts), first_(facts.entry()) {
    doomed_.resize(facts.end().index() - first_.index());
    for (bool isChanged = true; isChanged;) {
      isChanged = false;
      for (std::size_t i = doomed_.size(); i-- > 0;)
        if (!doomed_[i] && isDoomed(NodeId(first_.index() + i)))
          isChanged = doomed_[i] = true;
    }
  }

  bool contains(NodeId node) const {
    return first_ <= node && node < facts_.end() && doomed_[node.index() - first_.index()];
  }
  /// That is raised behind the node; absent where tests decide which.
  std::optional<std::uint32_t> alarmBehind(NodeId node) const {
    for (std::size_t i = 0; i < doomed_.size(); ++i) {
      if (const Assignment *alarm = alarmAt(node)) {
        const auto number = literalValue(*facts_.file.tree, alarm->value);
        const auto whole = number ? number->asInteger() : std::nullopt;
        return whole && *whole > 0 && *whole < 10'000 ? std::optional(static_cast<std::uint32_t>(*whole))
                                                      : std::nullopt;
      }
      if (std::holds_alternative<Test>(facts_.node(node).instruction))
        return std::nullopt;
      node = facts_.node(node).next;
    }
    return std::nullopt;
  }

private:
  const Assignment *alarmAt(NodeId node) const { return ownAlarmAt(facts_.file, node); }
  bool isDoomed(NodeId node) const {
    if (alarmAt(node))
      return true;
    if (neverReturns(node))
      return false;
    bool isAll = true;
    bool isAny = false;
    forEachSuccessor(facts_.file.cfg, *facts_.file.model, node, ProgramUse::Called, [&](NodeId next) {
      isAny = true;
      isAll = isAll && contains(next);
    });
    return isAny && isAll;
  }

  /// A call of a program that ends the run.
  bool neverReturns(NodeId node) const {
    const auto *call = std::get_if<CallProgram>(&facts_.node(node).instruction);
    const auto callee = call ? facts_.programs.callee(facts_.file.file, call->call) : std::nullopt;
    return callee && !facts_.programs.file(callee->file).model->programs[callee->program].returns;
  }

  const FlowFacts &facts_;
  NodeId first_;
  std::vector<bool> doomed_;
};

class TableWalk {
public:
  explicit TableWalk(const FlowFacts &facts) : facts_(facts), doomed_(facts), entry_(facts) {
    for (NodeId node = facts.entry(); node < facts.end(); node = node.next())
      forEachSuccessor(facts.file.cfg, *facts.file.model, node, ProgramUse::Called, [&](NodeId next) {
        if (next <= node)
          loops_.emplace_back(next, node);
      });
  }

  GuardTable run() {
    open_[facts_.entry()] = {{}};
    while (!open_.empty() && isShort()) {
      const auto [node, paths] = *open_.begin();
      open_.erase(open_.begin());
      const bool allMeet = open_.empty() && !hasEnded_;
      visit(node, allMeet ? Paths{{}} : merged(paths));
    }
    return std::move(table_);
  }

private:
  /// Two paths that differ in the outcome of one test are one path without it.
  static Paths merged(Paths paths) {
    for (bool isChanged = true; isChanged;) {
      isChanged = false;
      for (std::size_t i = 0; i < paths.size() && !isChanged; ++i)
        for (std::size_t j = i + 1; j < paths.size() && !isChanged; ++j)
          if (const auto at = onlyDifference(paths[i], paths[j])) {
            paths[i].erase(paths[i].begin() + static_cast<std::ptrdiff_t>(*at));
            paths.erase(paths.begin() + static_cast<std::ptrdiff_t>(j));
            isChanged = true;
          }
    }
    return paths;
  }
  static std::optional<std::size_t> onlyDifference(const Path &a, const Path &b) {
    if (a.size() != b.size())
      return std::nullopt;
    std::optional<std::size_t> found;
    for (std::size_t i = 0; i < a.size(); ++i) {
      if (a[i].test != b[i].test || !a[i].test)
        return std::nullopt;
      if (a[i].holds != b[i].holds && found)
        return std::nullopt;
      found = a[i].holds != b[i].holds ? i : found;
    }
    return found;
  }

  bool isShort() const {
    std::size_t paths = 0;
    for (const auto &[node, open] : open_)
      paths += open.size();
    return paths <= kMostPaths;
  }

  void visit(NodeId node, const Paths &paths) {
    const Node &at = facts_.node(node);
    if (const auto *test = std::get_if<Test>(&at.instruction)) {
      const auto side = [&](bool holds) { return test->condition ? Step{node, holds} : Step{std::nullopt, holds}; };
      // Where nothing goes on, the test is no guard: every call is refused, or none.
      if (!doomed_.contains(at.next) || goesOn(test->taken))
        goOn(node, at.next, paths, side(false));
      if (!doomed_.contains(test->taken) || goesOn(at.next))
        goOn(node, test->taken, paths, side(true));
      return;
    }
    if (std::holds_alternative<Assign>(at.instruction))
      noteDefaults(node, paths);
    std::vector<NodeId> next;
    forEachSuccessor(facts_.file.cfg, *facts_.file.model, node, ProgramUse::Called,
                     [&](NodeId each) { next.push_back(each); });
    hasEnded_ = hasEnded_ || (next.empty() && !std::holds_alternative<StopWithAlarm>(at.instruction));
    for (const NodeId each : next)
      goOn(node, each, paths, next.size() == 1 ? std::nullopt : std::optional(Step{std::nullopt, true}));
  }

  bool goesOn(NodeId node) const { return !doomed_.contains(node) && facts_.isReached(node); }

  /// A path that leads back is part of a loop, the other paths of which go on.
  void goOn(NodeId from, NodeId to, const Paths &paths, std::optional<Step> step) {
    Paths longer = paths;
    if (step)
      for (Path &path : longer)
        path.push_back(*step);
    if (doomed_.contains(to)) {
      for (const Path &path : longer)
        noteGuards(path, to);
      return;
    }
    if (to <= from || !facts_.isReached(to))
      return;
    Paths &known = open_[to];
    known.insert(known.end(), longer.begin(), longer.end());
  }

  /// What is asked again and again waits for an answer from outside, or is asked of what the loop computes.
  bool isInLoop(NodeId node) const {
    return std::ranges::any_of(loops_, [&](const auto &loop) { return loop.first <= node && node <= loop.second; });
  }

  const ExpressionId &conditionOf(NodeId test) const {
    return *std::get<Test>(facts_.node(test).instruction).condition;
  }

  /// On the path one of its tests must have had the other outcome.
  void noteGuards(const Path &path, NodeId alarm) {
    std::vector<Alternatives> needs = {{}};
    std::optional<NodeId> last;
    for (const Step &step : path) {
      const auto other = step.test ? entry_.conditionsOf(conditionOf(*step.test), !step.holds) : std::nullopt;
      const auto longer = other ? either(needs, *other) : std::nullopt;
      if (!longer)
        return;
      needs = *longer;
      last = step.test;
    }
    if (last && !isInLoop(*last))
      for (Alternatives &each : needs)
        table_.guards.push_back({std::move(each), doomed_.alarmBehind(alarm), facts_.node(*last).block});
  }

  /// Assigned on paths on which the variable was vacant.
  void noteDefaults(NodeId node, const Paths &paths) {
    const SyntaxTree &tree = *facts_.file.tree;
    const auto &assign = std::get<Assign>(facts_.node(node).instruction);
    const auto *assignment = std::get_if<Assignment>(&tree.statements[assign.first].node);
    const auto target = assignment ? variableNumber(tree, assignment->target) : std::nullopt;
    if (!target || !std::ranges::all_of(paths, [&](const Path &path) { return isVacantOn(path, *target); }))
      return;
    const Span value = tree.expressions[assignment->value].span;
    table_.defaults.push_back({*target, toUpper(facts_.file.source->text(value)), facts_.node(node).block});
    entry_.addDefault(*target);
  }
  bool isVacantOn(const Path &path, std::uint32_t variable) const {
    return std::ranges::any_of(path, [&](const Step &step) {
      const auto known = step.test ? entry_.conditionsOf(conditionOf(*step.test), step.holds) : std::nullopt;
      return known && std::ranges::any_of(*known, [&](const Alternatives &each) {
               return each.size() == 1 && each.front().isVacancy && each.front().variable == variable &&
                      each.front().relation == OperatorKind::Equal;
             });
    });
  }

  const FlowFacts &facts_;
  Doomed doomed_;
  EntryValues entry_;
  std::map<NodeId, Paths> open_;                 // paths that have come to a node, which was not visited yet
  std::vector<std::pair<NodeId, NodeId>> loops_; // first and last node
  bool hasEnded_ = false;                        // a path has come to an end without an alarm
  GuardTable table_;
};

/// `a OR NOT b` beside `a OR b`, or beside `b`: the part that the other rules out is left out.
bool shorten(Alternatives &needs, const Alternatives &other) {
  for (std::size_t i = 0; i < needs.size(); ++i) {
    const Comparison denied = opposite(needs[i]);
    const bool isRuledOut = std::ranges::all_of(other, [&](const Comparison &each) {
      return each == denied || (each != needs[i] && std::ranges::find(needs, each) != needs.end());
    });
    if (!isRuledOut || std::ranges::find(other, denied) == other.end() || needs.size() == 1)
      continue;
    needs.erase(needs.begin() + static_cast<std::ptrdiff_t>(i));
    return true;
  }
  return false;
}

/// It holds wherever the other does.
bool asksNoMore(const Alternatives &needs, const Alternatives &other) {
  return std::ranges::all_of(other,
                             [&](const Comparison &each) { return std::ranges::find(needs, each) != needs.end(); });
}

void simplify(std::vector<Guard> &guards) {
  for (bool isChanged = true; isChanged;) {
    isChanged = false;
    for (Guard &guard : guards)
      for (const Guard &other : guards)
        isChanged = isChanged || (&guard != &other && shorten(guard.needs, other.needs));
  }
  std::vector<Guard> kept;
  for (std::size_t i = 0; i < guards.size(); ++i) {
    bool isNew = true;
    for (std::size_t other = 0; other < guards.size(); ++other)
      if (other != i && asksNoMore(guards[i].needs, guards[other].needs))
        isNew = isNew && other > i && asksNoMore(guards[other].needs, guards[i].needs);
    if (isNew)
      kept.push_back(guards[i]);
  }
  guards = std::move(kept);
}

} // namespace

const Default *GuardTable::defaultOf(std::uint32_t variable) const {
  const auto found = std::ranges::find(defaults, variable, &Default::variable);
  return found == defaults.end() ? nullptr : &*found;
}

GuardTable guardTableOf(const FlowFacts &facts) {
  if (!facts.isComplete() || facts.end().index() - facts.entry().index() > kMostNodes)
    return {};
  GuardTable table = TableWalk(facts).run();
  simplify(table.guards);
  std::erase_if(table.defaults, [&](const Default &each) {
    return !isInput(*facts.file.dialect, each.variable) || !onlyAssignment(facts, each.variable);
  });
  return table;
}

} // namespace feedhold::draft
