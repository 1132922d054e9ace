// Variables in the text of a program, and calls that share them.
#include "rules/flow/flow_view.h"

#include "base/support/match.h"
#include "meaning/cfg/block_words.h"

#include <algorithm>
#include <fmt/format.h>
#include <unordered_set>

namespace feedhold::rules {
namespace {

/// Goes through the expressions of one block and says what becomes of each variable.
class ReadCollector {
public:
  ReadCollector(const ProgramFile &file, BlockId block) : tree_(*file.tree), file_(file), block_(block) {}

  std::vector<Read> run() {
    for (const Statement &statement : tree_.statementsOf(block_))
      addStatement(statement);
    for (const Word &word : tree_.wordsOf(block_))
      if (word.form() == WordForm::Expression)
        add(word.expression(), isArgument(word) ? ReadUse::Argument : ReadUse::Word);
    return std::move(reads_);
  }
  std::vector<Read> run(ExpressionId root, ReadUse use) {
    add(root, use);
    return std::move(reads_);
  }

private:
  void addStatement(const Statement &statement) {
    if (const auto *assignment = std::get_if<Assignment>(&statement.node)) {
      if (const auto *indirect = as<IndirectVariable>(tree_, unwrapped(tree_, assignment->target)))
        add(indirect->index, ReadUse::Other);
      add(assignment->value, ReadUse::Copied);
    } else if (const auto condition = conditionOf(statement)) {
      add(*condition, ReadUse::Other);
    } else if (const auto *jump = std::get_if<Goto>(&statement.node)) {
      if (jump->target)
        add(*jump->target, ReadUse::Other);
    } else if (const auto *print = std::get_if<Print>(&statement.node)) {
      for (ExpressionId id = print->firstVariable; id < print->lastVariable; id = id.next())
        add(id, ReadUse::Other);
    } else if (const auto *oWord = std::get_if<OWord>(&statement.node)) {
      for (const ExpressionId argument : tree_.argumentsOf(*oWord))
        add(argument, oWord->kind == OWordKind::Call ? ReadUse::Argument : ReadUse::Other);
    } else if (const auto *lone = std::get_if<LoneExpression>(&statement.node)) {
      add(lone->expression, ReadUse::Other);
    }
  }
  bool isArgument(const Word &word) const {
    for (const Call &call : file_.model->callsIn(block_, block_.next()))
      if (takesArguments(call, tree_, *file_.dialect) && tree_.idOf(word) > call.code)
        return true;
    return false;
  }
  /// Without recursion: a sum is a tree as deep as it is long.
  void add(ExpressionId root, ReadUse use) {
    pending_.push_back({root, use});
    while (!pending_.empty()) {
      const auto [id, useOfId] = pending_.back();
      pending_.pop_back();
      addOne(id, useOfId);
    }
  }
  void addOne(ExpressionId id, ReadUse use) {
    const auto later = [&](ExpressionId part, ReadUse useOfPart) { pending_.push_back({part, useOfPart}); };
    match(
        tree_.expressions[id].node, [](const NumberLiteral &) {}, [](const BrokenExpression &) {},
        [&](const NumberedVariable &) {
          reads_.push_back({id, variableNumber(tree_, id), use, block_});
        },
        [&](const NamedVariable &) {
          reads_.push_back({id, std::nullopt, use, block_});
        },
        [&](const IndirectVariable &variable) {
          reads_.push_back({id, std::nullopt, use, block_});
          later(variable.index, ReadUse::Other);
        },
        [&](const Negation &negation) { later(negation.operand, ReadUse::Computed); },
        [&](const Identity &identity) { later(identity.operand, use); },
        [&](const Bracketed &bracketed) { later(bracketed.inner, use); },
        [&](const BinaryOperation &operation) {
          later(operation.right, useIn(operation.op));
          later(operation.left, useIn(operation.op));
        },
        [&](const FunctionCall &call) {
          for (std::size_t i = call.arguments().size(); i-- > 0;)
            later(call.arguments()[i], ReadUse::Computed);
        });
  }
  static ReadUse useIn(OperatorKind op) {
    if (op == OperatorKind::Equal || op == OperatorKind::NotEqual)
      return ReadUse::Equality;
    return isRelation(op) ? ReadUse::Ordering : ReadUse::Computed;
  }

  const SyntaxTree &tree_;
  const ProgramFile &file_;
  BlockId block_;
  std::vector<Read> reads_;
  std::vector<std::pair<ExpressionId, ReadUse>> pending_;
};

/// The index of `#[..]` may be the number of a local variable: unless a constant that is added leads beyond them.
bool mayNameLocal(const SyntaxTree &tree, ExpressionId index) {
  const auto parts = subexpressions(tree, index);
  return std::ranges::none_of(parts, [&](ExpressionId part) {
    const auto value = literalValue(tree, part);
    return value && *value > Decimal(kLocalVariables, 0);
  });
}

/// Programs that work on the local variables of one: itself, of which M97 calls a part, and what it reaches by M98.
/// Absent: that cannot be told.
std::optional<std::vector<ProgramRef>> sharersOf(const ProgramSet &programs, ProgramRef start) {
  std::vector<ProgramRef> found{start};
  for (std::size_t i = 0; i < found.size(); ++i) {
    const ProgramRef here = found[i];
    const ProgramFile &file = programs.file(here.file);
    for (const Call &call : file.model->callsOf(here.program)) {
      if (call.kind != CallKind::Subprogram && call.kind != CallKind::External)
        continue;
      const auto callee = programs.callGraph().callee(here.file, call);
      if (!callee)
        return std::nullopt;
      if (std::ranges::find(found, *callee) == found.end())
        found.push_back(*callee);
    }
  }
  return found;
}

/// What some programs may set.
struct Settable {
  bool all = false;            // that cannot be told
  bool otherThanLocal = false; // by a computed number
  bool local = false;          // by a computed number that may be one of a local variable
  std::unordered_set<std::uint32_t> numbers;

  bool has(const ProgramFile &file, std::uint32_t variable) const {
    return all || numbers.contains(variable) || (isLocal(file, variable) ? local : otherThanLocal);
  }
};

void addSettable(const ProgramFile &file, ProgramId program, Settable &settable) {
  for (const VariableUse &use : file.model->variablesOf(program)) {
    const bool isBroken = file.tree->blocks[use.block].has(Block::kBroken); // it did not parse: it may be an assignment
    if (use.number && (use.write || isBroken))
      settable.numbers.insert(*use.number);
    const auto *indirect = use.write && !use.number ? as<IndirectVariable>(*file.tree, use.expression) : nullptr;
    settable.otherThanLocal = settable.otherThanLocal || indirect;
    settable.local = settable.local || (indirect && mayNameLocal(*file.tree, indirect->index));
  }
}

Settable settableIn(const FlowFacts &facts) {
  const auto sharers = sharersOf(facts.programs, {facts.file.file, facts.program});
  Settable settable;
  settable.all = !sharers;
  for (const ProgramRef &program : sharers.value_or(std::vector<ProgramRef>{}))
    addSettable(facts.programs.file(program.file), program.program, settable);
  return settable;
}

} // namespace

std::vector<Read> readsOf(const ProgramFile &file, BlockId block) { return ReadCollector(file, block).run(); }

std::vector<Read> readsOf(const ProgramFile &file, ProgramId program) {
  std::vector<Read> all;
  std::optional<BlockId> last;
  for (const VariableUse &use : file.model->variablesOf(program)) {
    if (last == use.block)
      continue;
    last = use.block;
    const auto reads = readsOf(file, use.block);
    all.insert(all.end(), reads.begin(), reads.end());
  }
  return all;
}

const std::vector<Read> &readsOf(const FlowFacts &facts) {
  return facts.derived<std::vector<Read>>([&] { return readsOf(facts.file, facts.program); });
}

std::vector<Read> readsIn(const ProgramFile &file, ExpressionId root, BlockId block) {
  return ReadCollector(file, block).run(root, ReadUse::Other);
}

bool isLocal(const ProgramFile &file, std::uint32_t variable) {
  const VariableRange *range = variable >= kFirstNamedVariable ? nullptr : findVariable(*file.dialect, variable);
  return range && range->kind == VariableKind::Local && variable <= kLocalVariables;
}

std::optional<char> letterOfArgument(const Dialect &dialect, std::uint32_t variable) {
  const auto found = std::ranges::find(dialect.argumentVariables, variable);
  if (variable == 0 || found == dialect.argumentVariables.end())
    return std::nullopt;
  return static_cast<char>('A' + (found - dialect.argumentVariables.begin()));
}

bool isParameter(const FlowFacts &facts, std::uint32_t variable) {
  const Program &program = facts.file.model->programs[facts.program];
  return letterOfArgument(*facts.file.dialect, variable) ||
         (program.name.isSubroutine && isLocal(facts.file, variable));
}

std::string describeVariable(const Dialect &dialect, std::uint32_t variable) {
  const auto letter = letterOfArgument(dialect, variable);
  return letter ? fmt::format("`#{}` ({})", variable, *letter) : fmt::format("`#{}`", variable);
}

std::string adviceToCheck(const Dialect &dialect, std::uint32_t argument) {
  return dialect.behaviour.variablesMayBeVacant
             ? fmt::format("check `IF[#{} EQ #0]` and `IF[#{} EQ 0]` at the head of the program", argument, argument)
             : fmt::format("check `[#{} EQ 0]` at the head of the subroutine", argument);
}

bool isMainProgram(const FlowFacts &facts) {
  const ProgramFile &file = facts.file;
  if (file.model->programs[facts.program].returns || !file.dialect->behaviour.variablesMayBeVacant ||
      facts.programs.callGraph().isCalled({file.file, facts.program}))
    return false;
  return std::ranges::any_of(facts.exits(), [&](const ExitFact &exit) {
    const auto *end = std::get_if<EndProgram>(&facts.node(exit.node).instruction);
    return end && end->end != ProgramEnd::EndOfFile;
  });
}

bool isCalledAsSubprogram(const FlowFacts &facts) {
  const auto callers = facts.programs.callGraph().callers({facts.file.file, facts.program});
  return std::ranges::any_of(callers, [&](const CallGraph::Caller &caller) {
    const CallKind kind = facts.programs.file(caller.file).model->calls[caller.call].kind;
    return kind == CallKind::Subprogram || kind == CallKind::Local || kind == CallKind::External;
  });
}

bool mayHoldCallersValue(const FlowFacts &facts, std::uint32_t variable) {
  const CallGraph &graph = facts.programs.callGraph();
  return std::ranges::any_of(graph.callers({facts.file.file, facts.program}), [&](const CallGraph::Caller &caller) {
    const ProgramFile &file = facts.programs.file(caller.file);
    const Call &call = file.model->calls[caller.call];
    if (call.kind != CallKind::Subprogram && call.kind != CallKind::Local && call.kind != CallKind::External)
      return false;
    Settable settable;
    addSettable(file, call.caller, settable);
    return settable.has(file, variable) || isTested(file, call.caller, variable);
  });
}

bool isPromised(const FlowFacts &facts, const FileContext &context, std::uint32_t variable) {
  const Contract *contract = context.contractOf({context.file, facts.program});
  return contract && std::ranges::find(contract->globals, variable, &EntryValue::variable) != contract->globals.end();
}

bool isAlwaysPassed(const FlowFacts &facts, std::uint32_t variable) {
  const auto callers = facts.programs.callGraph().callers({facts.file.file, facts.program});
  return !callers.empty() && std::ranges::all_of(callers, [&](const CallGraph::Caller &caller) {
    const Call &call = facts.programs.file(caller.file).model->calls[caller.call];
    return call.kind == CallKind::OWord
               ? call.values.size() >= variable
               : std::ranges::find(call.arguments, variable, &Argument::variable) != call.arguments.end();
  });
}

bool maySet(const FlowFacts &facts, std::uint32_t variable) {
  return facts.derived<Settable>([&] { return settableIn(facts); }).has(facts.file, variable);
}

bool isWrittenInAny(const FlowFacts &facts, std::uint32_t variable) {
  return facts.programs.unnumberedUses().mayWriteCommon || facts.programs.usesOf(variable).writes != 0;
}

bool mayReadLocal(const ProgramFile &file, const VariableUse &use) {
  if (use.write || use.number)
    return false;
  const auto *indirect = as<IndirectVariable>(*file.tree, use.expression);
  if (!indirect)
    return false;
  const auto parts = subexpressions(*file.tree, indirect->index);
  return std::ranges::none_of(parts, [&](ExpressionId part) {
    const auto value = literalValue(*file.tree, part);
    return value && *value > Decimal(kLocalVariables, 0);
  });
}

bool isTested(const ProgramFile &file, ProgramId program, std::uint32_t variable) {
  std::optional<BlockId> last;
  for (const VariableUse &use : file.model->variablesOf(program)) {
    if (use.number != variable || use.write || last == use.block)
      continue;
    last = use.block;
    for (const Read &read : readsOf(file, use.block))
      if (read.number == variable && (read.use == ReadUse::Equality || read.use == ReadUse::Ordering))
        return true;
    for (const Statement &statement : file.tree->statementsOf(use.block))
      if (const auto condition = conditionOf(statement))
        if (file.tree->expressions[*condition].span.contains(file.tree->expressions[use.expression].span))
          return true;
  }
  return false;
}

bool isTestedForVacancy(const ProgramFile &file, ProgramId program, std::uint32_t variable) {
  std::optional<BlockId> last;
  for (const VariableUse &use : file.model->variablesOf(program)) {
    if (use.number != variable || use.write || last == use.block)
      continue;
    last = use.block;
    for (const Read &read : readsOf(file, use.block))
      if (read.number == variable && read.use == ReadUse::Equality)
        return true;
  }
  return false;
}

bool isNeverSet(const FlowFacts &facts, std::uint32_t variable) {
  return variable != kVacantVariable && isLocal(facts.file, variable) && isMainProgram(facts) &&
         !maySet(facts, variable);
}

std::optional<std::uint32_t> argumentBehind(const FlowFacts &facts, std::uint32_t variable) {
  const ProgramFile &file = facts.file;
  if (!maySet(facts, variable))
    return isParameter(facts, variable) ? std::optional(variable) : std::nullopt;
  std::optional<std::uint32_t> source;
  for (const BlockId block : blocksOf(file, facts.program))
    for (const Statement &statement : file.tree->statementsOf(block)) {
      const auto *assignment = std::get_if<Assignment>(&statement.node);
      if (!assignment || variableNumber(*file.tree, unwrapped(*file.tree, assignment->target)) != variable)
        continue;
      if (source || statement.nested)
        return std::nullopt;
      source = variableNumber(*file.tree, unwrapped(*file.tree, assignment->value));
      if (!source)
        return std::nullopt;
    }
  const bool isArgument = source && isLocal(file, *source) && isParameter(facts, *source) &&
                          (source == variable || !maySet(facts, *source));
  return isArgument ? source : std::nullopt;
}

std::vector<ExpressionId> expressionsOf(const ProgramFile &file, BlockId block) {
  const SyntaxTree &tree = *file.tree;
  std::vector<ExpressionId> all;
  const auto add = [&](ExpressionId root) {
    const auto parts = subexpressions(tree, root);
    all.insert(all.end(), parts.begin(), parts.end());
  };
  for (const Statement &statement : tree.statementsOf(block)) {
    if (const auto *assignment = std::get_if<Assignment>(&statement.node)) {
      add(assignment->target);
      add(assignment->value);
    }
    if (const auto condition = conditionOf(statement))
      add(*condition);
    if (const auto *oWord = std::get_if<OWord>(&statement.node))
      for (const ExpressionId argument : tree.argumentsOf(*oWord))
        add(argument);
  }
  for (const Word &word : tree.wordsOf(block))
    if (word.form() == WordForm::Expression)
      add(word.expression());
  return all;
}

std::optional<ExpressionId> expressionAt(const FlowFacts &facts, BlockId block, Span span) {
  for (const ExpressionId id : expressionsOf(facts.file, block))
    if (facts.file.tree->expressions[id].span == span)
      return id;
  return std::nullopt;
}

bool isTooLarge(const FlowFacts &facts) {
  constexpr std::size_t kMostNodes = 20'000;
  return facts.end().index() - facts.entry().index() > kMostNodes;
}

std::vector<BlockId> blocksOf(const ProgramFile &file, ProgramId program) {
  std::vector<BlockId> blocks;
  for (BlockId block = file.model->programs[program].first; block < file.model->programs[program].last;
       block = block.next())
    blocks.push_back(block);
  return blocks;
}

std::optional<std::uint32_t> variableOf(const FlowFacts &facts, ExpressionId id) {
  const SyntaxTree &tree = *facts.file.tree;
  const ExpressionId inner = unwrapped(tree, id);
  if (const auto *named = as<NamedVariable>(tree, inner))
    return facts.programs.variableOf(facts.file.file, named->name);
  return variableNumber(tree, inner);
}

std::vector<Assignment> assignmentsOf(const FlowFacts &facts, NodeId node) {
  std::vector<Assignment> found;
  const auto *assign = std::get_if<Assign>(&facts.node(node).instruction);
  for (std::uint32_t i = 0; assign && i < assign->count; ++i)
    if (const auto *assignment =
            std::get_if<Assignment>(&facts.file.tree->statements[StatementId(assign->first.index() + i)].node))
      found.push_back(*assignment);
  return found;
}

std::optional<NodeId> nodeOf(const FlowFacts &facts, BlockId block, ExpressionId expression) {
  const SyntaxTree &tree = *facts.file.tree;
  const Span wanted = tree.expressions[expression].span;
  const auto holds = [&](ExpressionId id) { return tree.expressions[id].span.contains(wanted); };
  std::optional<NodeId> other;
  for (NodeId node = facts.file.cfg.nodeOf(block); node < facts.end() && facts.node(node).block == block;
       node = node.next()) {
    const auto assignments = assignmentsOf(facts, node);
    const auto *test = std::get_if<Test>(&facts.node(node).instruction);
    if (std::ranges::any_of(assignments, [&](const Assignment &a) { return holds(a.target) || holds(a.value); }) ||
        (test && test->condition && holds(*test->condition)))
      return facts.isReached(node) ? std::optional(node) : std::nullopt;
    if (assignments.empty() && !test && !other && facts.isReached(node))
      other = node;
  }
  return other;
}

bool raisesAlarmAt(const ProgramFile &file, BlockId block) {
  const auto raises = [&](BlockId each) {
    const auto uses = file.model->variablesIn(each, each.next());
    return std::ranges::any_of(uses, [&](const VariableUse &use) {
      return use.write && use.number && raisesAlarm(*file.dialect, *use.number);
    });
  };
  return raises(block) || raises(block.next());
}

bool leadsToAlarm(const FlowFacts &facts, BlockId block) {
  const auto jumps = facts.file.model->jumpsIn(block, block.next());
  return std::ranges::any_of(
             jumps, [&](const Jump &jump) { return jump.target && raisesAlarmAt(facts.file, *jump.target); }) ||
         (jumps.empty() && raisesAlarmAt(facts.file, block));
}

std::optional<bool> alarmWhenTrue(const FlowFacts &facts, NodeId test) {
  if (leadsToAlarm(facts, facts.node(test).block))
    return true;
  const BlockId behind = facts.node(facts.node(test).next).block;
  return raisesAlarmAt(facts.file, behind) ? std::optional(false) : std::nullopt;
}

bool isLoneNumber(const FlowFacts &facts, NodeId node) {
  return std::holds_alternative<Pass>(facts.node(node).instruction) && facts.node(node).next == node.next() &&
         facts.file.tree->statementsOf(facts.node(node).block).empty();
}

std::optional<BlockId> blockBehind(const FlowFacts &facts, const Jump &jump) {
  if (!jump.target)
    return std::nullopt;
  NodeId node = facts.file.cfg.nodeOf(*jump.target);
  while (isLoneNumber(facts, node))
    node = node.next();
  return facts.node(node).block;
}

// ---- UnsetPaths ----------------------------------------------------------------------------------------------------

namespace {

bool mayAssign(const FlowFacts &facts, const Assignment &assignment, std::uint32_t variable) {
  const SyntaxTree &tree = *facts.file.tree;
  const ExpressionId target = unwrapped(tree, assignment.target);
  if (const auto number = variableNumber(tree, target))
    return *number == variable;
  if (as<NamedVariable>(tree, target))
    return variableOf(facts, target) == variable;
  const auto *indirect = as<IndirectVariable>(tree, target);
  return indirect && variable < kFirstNamedVariable &&
         (!isLocal(facts.file, variable) || mayNameLocal(tree, indirect->index));
}

bool maySetAt(const FlowFacts &facts, NodeId node, std::uint32_t variable) {
  const auto assignments = assignmentsOf(facts, node);
  if (std::ranges::any_of(assignments, [&](const Assignment &a) { return mayAssign(facts, a, variable); }))
    return true;
  if (std::holds_alternative<Havoc>(facts.node(node).instruction))
    return true;
  const auto *call = std::get_if<CallProgram>(&facts.node(node).instruction);
  if (!call)
    return false;
  const CallKind kind = facts.file.model->calls[call->call].kind;
  return kind == CallKind::Subprogram || kind == CallKind::Local || kind == CallKind::External;
}

} // namespace

UnsetPaths::UnsetPaths(const FlowFacts &facts, std::uint32_t variable)
    : facts_(facts), sets_(facts.end().index() - facts.entry().index()), reached_(sets_.size()) {
  for (NodeId node = facts.entry(); node < facts.end(); node = node.next())
    sets_[node.index() - facts.entry().index()] = facts.isReached(node) && maySetAt(facts, node, variable);
  walk();
}

template <typename Visit> void UnsetPaths::forEachNext(NodeId node, Visit &&visit) const {
  forEachSuccessor(facts_.file.cfg, *facts_.file.model, node, ProgramUse::Called, [&](NodeId next) {
    if (next >= facts_.entry() && next < facts_.end() && facts_.isReached(next))
      visit(next);
  });
}

void UnsetPaths::walk() {
  const std::size_t first = facts_.entry().index();
  const auto isWhile = [&](NodeId node) {
    const auto statements = facts_.file.tree->statementsOf(facts_.node(node).block);
    if (std::holds_alternative<CountDown>(facts_.node(node).instruction)) // `o1 repeat`
      return true;
    return std::holds_alternative<Test>(facts_.node(node).instruction) &&
           std::ranges::any_of(statements, [](const Statement &s) {
             const auto *oWord = std::get_if<OWord>(&s.node);
             return std::holds_alternative<While>(s.node) || (oWord && oWord->kind == OWordKind::While);
           });
  };
  // Whether a node is left on all its paths: a WHILE that was not come to from inside leads into its body only.
  std::vector<bool> leftFully(reached_.size());
  struct Step {
    NodeId node;
    bool fully;
  };
  std::vector<Step> open{{facts_.entry(), true}};
  reached_[0] = true;
  while (!open.empty()) {
    const NodeId node = open.back().node;
    const bool fully = open.back().fully;
    open.pop_back();
    if (sets_[node.index() - first])
      continue;
    NodeId bodyFirst = node;
    if (!fully) // the body stands directly behind the WHILE
      forEachNext(node, [&](NodeId next) {
        if (bodyFirst == node || next < bodyFirst)
          bodyFirst = next;
      });
    forEachNext(node, [&](NodeId next) {
      if (!fully && next != bodyFirst)
        return;
      const bool nextFully = !isWhile(next) || node > next;
      const std::size_t at = next.index() - first;
      if (reached_[at] && (leftFully[at] || !nextFully))
        return;
      reached_[at] = true;
      leftFully[at] = leftFully[at] || nextFully;
      open.push_back({next, nextFully});
    });
  }
}

bool UnsetPaths::isFirstUse(NodeId use) const {
  const std::size_t first = facts_.entry().index();
  std::vector<bool> seen(reached_.size());
  std::vector<NodeId> open;
  const auto goOn = [&](NodeId node) {
    forEachNext(node, [&](NodeId next) {
      if (!seen[next.index() - first]) {
        seen[next.index() - first] = true;
        open.push_back(next);
      }
    });
  };
  for (NodeId node = facts_.entry(); node < facts_.end(); node = node.next())
    if (sets(node) && node != use)
      goOn(node);
  while (!open.empty()) {
    const NodeId node = open.back();
    open.pop_back();
    if (node == use)
      return false;
    goOn(node);
  }
  return true;
}

} // namespace feedhold::rules
