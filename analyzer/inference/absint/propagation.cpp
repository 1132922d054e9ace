#include "inference/absint/propagation.h"

#include <cmath>

namespace feedhold {

namespace {

constexpr int kIterationsBeforeWidening = 3;

const LoopCounters kNoCounters;

/// The operands that must not be zero once the value has been computed.
void collectDivisors(const SyntaxTree &tree, ExpressionId root, std::vector<ExpressionId> &divisors) {
  for (const ExpressionId id : subexpressions(tree, root))
    if (const auto *operation = std::get_if<BinaryOperation>(&tree.expressions[id].node))
      if (operation->op == OperatorKind::Divide)
        divisors.push_back(operation->right);
}

bool mentions(const SyntaxTree &tree, ExpressionId root, std::optional<std::uint32_t> variable) {
  for (const ExpressionId id : subexpressions(tree, root)) {
    const auto &node = tree.expressions[id].node;
    if (std::holds_alternative<IndirectVariable>(node) || std::holds_alternative<NamedVariable>(node))
      return true;
    if (variableNumber(tree, id) == variable && variable)
      return true;
  }
  return false;
}

} // namespace

Propagation::Propagation(Engine &engine, const ProgramFacts &facts, Summary &summary, Phase phase)
    : engine_(engine), facts_(facts), summary_(summary), phase_(phase), interpretation_(engine.interpretation_),
      modes_(engine.modesOf(facts.entry.file)) {}

AbstractContext Propagation::contextAt(NodeId node, AbstractState &state) {
  return {interpretation_, state, engine_.programs_, *facts_.file, modes_, nodeAt(node).block};
}

/// Places that the order does not know (an `M99 P` from elsewhere leads there) stand behind all others.
std::uint32_t Propagation::positionOf(NodeId node) const {
  const std::uint32_t position = facts_.wto.positionOf(node);
  return position == Wto::kUnreachable ? static_cast<std::uint32_t>(facts_.wto.order().size()) + node.index()
                                       : position;
}

bool Propagation::isHead(std::uint32_t position) const {
  if (position >= facts_.wto.order().size())
    return true;
  return facts_.wto.isHead(facts_.wto.order()[position]) || summary_.forcedHeads.contains(position);
}

bool Propagation::isCut(NodeId node) const {
  const std::uint32_t position = positionOf(node);
  return position >= facts_.wto.order().size() || facts_.isJoin[position] || isHead(position);
}

void Propagation::run() {
  deliver(facts_.entry.entry, AbstractState(summary_.entry));
  while (!pending_.empty() && !engine_.gaveUp_) {
    auto first = pending_.begin();
    const std::uint32_t position = first->first;
    Partitions states = std::move(first->second);
    pending_.erase(first);
    process(position, std::move(states));
    if (std::exchange(startAgain_, false))
      restart();
  }
}

void Propagation::restart() {
  pending_.clear();
  visits_.clear();
  summary_.heads.clear();
  summary_.exits.clear();
  deliver(facts_.entry.entry, AbstractState(summary_.entry));
}

void Propagation::deliver(NodeId node, AbstractState &&state) {
  const std::uint64_t key = keyOf(facts_.by, interpretation_, state);
  pending_[positionOf(node)].add(interpretation_, key, std::move(state));
}

void Propagation::process(std::uint32_t position, Partitions states) {
  const std::size_t known = facts_.wto.order().size();
  const NodeId node = position < known ? facts_.wto.order()[position] : NodeId(position - known);
  if (isHead(position)) {
    if (phase_ == Phase::Ascend) {
      const bool widening = ++visits_[position] > kIterationsBeforeWidening;
      const Growth growth{widening, facts_.thresholds, countersOf(position)};
      if (!summary_.heads[position].grow(interpretation_, states, growth))
        return;
      states = summary_.heads[position];
    } else {
      Partitions &arrived = arrived_[position];
      for (const Partitions::Part &part : states.parts())
        arrived.add(interpretation_, part.key, AbstractState(part.state));
      if (!passed_.insert(position).second)
        return;
      states = summary_.heads[position];
    }
  }
  for (Partitions::Part &part : states.parts())
    follow(node, std::move(part.state));
}

/// Found when the loop is about to be gone through once more, and kept.
const LoopCounters &Propagation::countersOf(std::uint32_t head) {
  const bool isLoop = head < facts_.wto.order().size() && facts_.wto.isHead(facts_.wto.order()[head]);
  if (!isLoop || visits_[head] < 2)
    return kNoCounters;
  const auto found = counters_.find(head);
  return found != counters_.end()
             ? found->second
             : counters_.emplace(head, LoopCounters(*facts_.file, facts_.wto, facts_.wto.order()[head])).first->second;
}

/// Straight on until a place where ways meet; side ways are put aside and followed afterwards.
void Propagation::follow(NodeId node, AbstractState &&state) {
  followOne(node, state);
  while (!work_.empty() && !engine_.gaveUp_) {
    Work next = std::move(work_.back());
    work_.pop_back();
    followOne(next.node, next.state);
  }
}

void Propagation::followOne(NodeId node, AbstractState &state) {
  while (engine_.spend() && execute(node, state)) {
    const NodeId next = nodeAt(node).next;
    if (next == node)
      return;
    if (isCut(next))
      return deliver(next, std::move(state));
    node = next;
  }
}

void Propagation::go(NodeId node, AbstractState &&state) {
  if (isCut(node))
    deliver(node, std::move(state));
  else
    work_.push_back({node, std::move(state)});
}

bool Propagation::execute(NodeId node, AbstractState &state) {
  if (phase_ == Phase::Walk)
    engine_.visitor_->visit(placeOf(node), state, engine_.calls_);
  interpretation_.start();
  if (AbstractContext context = contextAt(node, state); endsCorner(context, nodeAt(node).instruction))
    loseCorner(context);
  return match(
      nodeAt(node).instruction,
      [&](const BlockSkip &skip) {
        go(skip.skipped, AbstractState(state));
        return true;
      },
      [&](const Test &condition) { return test(node, condition, state); },
      [&](const JumpTo &target) { return jump(node, target, state); },
      [&](const CountDown &counting) { return count(node, counting, state); },
      [&](const CallProgram &calling) { return call(node, calling, state); },
      [&](const ReturnFromProgram &from) { return leave(node, from, state); },
      [&](const EndProgram &ending) { return end(node, ending, state); },
      [&](const auto &) { return straight(node, state); });
}

bool Propagation::straight(NodeId node, AbstractState &state) {
  AbstractContext context = contextAt(node, state);
  const Instruction &instruction = nodeAt(node).instruction;
  step(context, instruction, words_);
  if (interpretation_.stopped()) {
    if (phase_ == Phase::Walk)
      engine_.visitor_->ended(placeOf(node), PathEnd::Alarm, state);
    return false;
  }
  if (std::holds_alternative<Assign>(instruction))
    refineByAlarms(node, state);
  else if (std::holds_alternative<ExecuteWords>(instruction) && !modalCalls(node, state))
    return false;
  if (phase_ == Phase::Walk)
    engine_.visitor_->left(placeOf(node), state);
  return true;
}

/// A division that has been carried out had a divisor; and every value that has been stored gets a symbol, so that
/// copies of it are known as such.
void Propagation::refineByAlarms(NodeId node, AbstractState &state) {
  AbstractContext context = contextAt(node, state);
  const SyntaxTree &tree = context.tree();
  const auto &assign = std::get<Assign>(nodeAt(node).instruction);
  const bool mayHaveDivided = interpretation_.mayHaveDividedByZero();
  for (std::uint32_t i = 0; i < assign.count; ++i) {
    const auto *assignment = std::get_if<Assignment>(&tree.statements[StatementId(assign.first.index() + i)].node);
    if (!assignment)
      continue;
    const auto target = variableNumber(tree, assignment->target);
    std::vector<ExpressionId> divisors;
    if (mayHaveDivided)
      collectDivisors(tree, assignment->value, divisors);
    for (const ExpressionId divisor : divisors)
      if (target && !mentions(tree, divisor, target))
        assumeDiffers(context, divisor, 0);
    if (!target)
      continue;
    if (*target <= kLocalVariables) {
      if (AbstractValue &value = state.locals[*target]; !value.origin())
        value = interpretation_.withSymbol(value);
    } else if (const AbstractValue *value = state.variables.find(*target); value && !value->origin())
      state.variables.set(*target, interpretation_.withSymbol(*value));
  }
}

bool Propagation::test(NodeId node, const Test &condition, AbstractState &state) {
  AbstractContext context = contextAt(node, state);
  const Truth truth = conditionOf(context, condition);
  if (interpretation_.stopped())
    return false;
  if (phase_ == Phase::Walk)
    engine_.visitor_->branch(placeOf(node), truth);
  if (mayBeTrue(truth)) {
    AbstractState taken = state;
    AbstractContext there = contextAt(node, taken);
    if (!condition.condition || assume(there, *condition.condition, Holds::Yes))
      go(condition.taken, std::move(taken));
  }
  return mayBeFalse(truth) && (!condition.condition || assume(context, *condition.condition, Holds::No));
}

bool Propagation::count(NodeId node, const CountDown &counting, AbstractState &state) {
  const AbstractState before = state;
  AbstractContext context = contextAt(node, state);
  const Truth goesOn = countDown(context, counting);
  if (mayBeTrue(goesOn)) {
    AbstractState taken = state;
    if (auto &left = taken.counters[counting.counter.index()]; left.isNumber())
      if (const auto number = meetAtLeast(left.number(), 0))
        left = AbstractValue::number(*number);
    go(counting.taken, std::move(taken));
  }
  if (mayBeFalse(goesOn))
    state = before;
  return mayBeFalse(goesOn);
}

bool Propagation::jump(NodeId node, const JumpTo &target, AbstractState &state) {
  AbstractContext context = contextAt(node, state);
  const AbstractValue number = jumpTarget(context, target);
  if (interpretation_.stopped())
    return false;
  const BlockId from = nodeAt(node).block;
  std::set<std::uint32_t> reached;
  for (const LabelNode &label : labelsOf(facts_.file->cfg, *facts_.file->model, from)) {
    if (!mayBeTrue(isEqual(number.number(), AbstractNumber::constant(static_cast<double>(label.number)))) ||
        !reached.insert(label.number).second)
      continue;
    if (!engine_.spend(Engine::kCostOfJump))
      return false;
    const auto place = findLabel(facts_.file->cfg, *facts_.file->model, facts_.entry.program, label.number, from);
    AbstractState there = state;
    AbstractContext arriving = contextAt(node, there);
    if (place && assumeRoundsTo(arriving, target.target, label.number))
      go(*place, std::move(there));
  }
  searchAlarms(node, number);
  return false;
}

/// Of a search for a sequence number that several labels may have.
void Propagation::searchAlarms(NodeId node, const AbstractValue &number) {
  const Dialect &dialect = *facts_.file->dialect;
  const BlockId from = nodeAt(node).block;
  const Span place = facts_.file->tree->blocks[from].span();
  const double lowest = dialect.grammar.sequenceZero ? 0 : 1;
  const Truth inRange = conjunction(
      isAtMost(AbstractNumber::constant(lowest), number.number()),
      isAtMost(number.number(), AbstractNumber::constant(static_cast<double>(dialect.limits.lastSequenceNumber))));
  interpretation_.alarm(negate(inRange), {AlarmKind::SequenceOutOfRange, place});
  const auto exists = [&](double value) {
    return value >= lowest && value <= static_cast<double>(dialect.limits.lastSequenceNumber) &&
           findLabel(facts_.file->cfg, *facts_.file->model, facts_.entry.program, static_cast<std::uint32_t>(value),
                     from);
  };
  const auto values = number.number().set().values();
  const bool some = values.empty() || std::any_of(values.begin(), values.end(), exists);
  const bool all = !values.empty() && std::all_of(values.begin(), values.end(), exists);
  if (mayBeTrue(inRange))
    interpretation_.alarm(all ? Truth::False : some ? Truth::Maybe : Truth::True, {AlarmKind::SequenceNotFound, place});
}

bool Propagation::leave(NodeId node, const ReturnFromProgram &from, AbstractState &state) {
  AbstractContext context = contextAt(node, state);
  const std::optional<AbstractValue> target = returnTarget(context, from);
  if (phase_ == Phase::Walk)
    engine_.visitor_->ended(placeOf(node), PathEnd::Returns, state);
  if (target && engine_.open_.size() <= 1) // started by the operator: M99 P stays in the program
    startAgainAt(node, *target, state);
  addExit(target, std::move(state));
  return false;
}

void Propagation::startAgainAt(NodeId node, const AbstractValue &target, const AbstractState &state) {
  for (const NodeId label : returnsWithin(facts_.file->cfg, *facts_.file->model, node))
    go(label, AbstractState(state));
  searchAlarms(node, target);
  interpretation_.start();
}

void Propagation::addExit(std::optional<AbstractValue> target, AbstractState state) {
  if (phase_ == Phase::Walk)
    return;
  for (Exit &exit : summary_.exits)
    if (exit.target.has_value() == target.has_value() &&
        (!target || (leq(*exit.target, *target) && leq(*target, *exit.target)))) {
      joinInto(interpretation_, exit.state, state);
      return;
    }
  summary_.exits.push_back({std::move(target), std::move(state)});
}

bool Propagation::end(NodeId node, const EndProgram &ending, AbstractState &state) {
  if (ending.end == ProgramEnd::EndOfFile && alarmNumber(*facts_.file->dialect, AlarmKind::EndOfRecord))
    interpretation_.alarm(Truth::True, {AlarmKind::EndOfRecord, contextAt(node, state).place()});
  if (ending.end != ProgramEnd::EndOfFile) {
    auto context = contextAt(node, state);
    restoreModesAtEnd(context);
  }
  if (phase_ == Phase::Walk)
    engine_.visitor_->ended(placeOf(node), PathEnd::Ends, state);
  return false;
}

} // namespace feedhold
