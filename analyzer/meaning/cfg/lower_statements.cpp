// Lowering of assignments, GOTO and IF.
#include "base/support/match.h"
#include "language/model/block_facts.h"
#include "meaning/cfg/lowering.h"

#include <algorithm>

namespace feedhold {

void Lowering::statements() {
  const std::span<const Statement> all = tree_.statementsOf(block_);
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (all[i].nested)
      continue;
    std::uint32_t together = 1;
    const auto isAssignment = [&](std::size_t at) {
      return at < all.size() && !all[at].nested && std::holds_alternative<Assignment>(all[at].node);
    };
    const std::optional<NodeId> skip = openInnerSkip(all[i].span);
    if (dialect_.behaviour.assignsAfterReading && isAssignment(i)) {
      while (isAssignment(i + together))
        ++together;
      emit(Assign{tree_.idOf(all[i]), together});
      i += together - 1;
    } else {
      statement(tree_.idOf(all[i]));
    }
    closeSkip(skip);
    leaveOutDo(skip);
  }
}

/// Of a block that could not be read: what may lead elsewhere.
void Lowering::flowStatements() {
  for (const Statement &each : tree_.statementsOf(block_)) {
    if (each.nested)
      continue;
    const auto *branch = std::get_if<If>(&each.node);
    const bool jumps = std::holds_alternative<Goto>(each.node);
    const bool leads = jumps || (branch && branch->action != IfAction::Statement) ||
                       std::holds_alternative<Else>(each.node) || std::holds_alternative<ElseIf>(each.node) ||
                       std::holds_alternative<EndIf>(each.node) || std::holds_alternative<While>(each.node) ||
                       std::holds_alternative<Do>(each.node) || std::holds_alternative<End>(each.node) ||
                       std::holds_alternative<OWord>(each.node);
    if (!leads)
      continue;
    const std::optional<NodeId> maybe = jumps ? std::optional(emitTest(std::nullopt)) : std::nullopt;
    statement(tree_.idOf(each));
    if (maybe)
      setNext(*maybe, end());
  }
}

void Lowering::statement(StatementId id) {
  const Statement &statement = tree_.statements[id];
  match(
      statement.node,
      [&](const Assignment &) {
        emit(Assign{id, 1});
      },
      [&](const LoneExpression &) { emit(Havoc{"an expression where a statement should stand"}); },
      [&](const Goto &) { gotoStatement(statement); }, [&](const If &branch) { ifStatement(branch); },
      [&](const Else &) { elseLine(); }, [&](const ElseIf &branch) { elseIfLine(branch); },
      [&](const EndIf &) { endIfLine(); }, [&](const While &loop) { whileStatement(id, loop); },
      [&](const Do &) { doStatement(id); }, [&](const End &) { endStatement(id); },
      [&](const NameVariables &) { emit(Pass{}); },
      [&](const ConditionalWords &words) { wordsUnderCondition(words.condition); },
      [&](const Print &) { emit(Pass{}); }, [&](const OWord &oWord) { oWordStatement(id, oWord); },
      [&](const BrokenStatement &) {
        if (!isStrayParenthesis(statement))
          emit(Havoc{"a statement that could not be read"});
      });
}

/// Nothing but `)`.  A control stops there, or reads on: it says nothing by itself.
bool Lowering::isStrayParenthesis(const Statement &statement) const {
  return std::holds_alternative<BrokenStatement>(statement.node) &&
         source_.text().substr(statement.span.begin, statement.span.size()).find_first_not_of(") \t") ==
             std::string_view::npos;
}

const Jump *Lowering::jumpOf(const Statement &statement) const {
  const std::span<const Jump> here = model_.jumpsIn(block_, block_.next());
  const auto found = std::find_if(here.begin(), here.end(), [&](const Jump &each) {
    return each.kind == JumpKind::Goto && each.span.begin == statement.span.begin;
  });
  return found == here.end() ? nullptr : &*found;
}

void Lowering::gotoStatement(const Statement &statement) {
  if (!statement.nested && motionCodeWithLetter(tree_, block_, statement, dialect_)) {
    const NodeId maybe = emitTest(std::nullopt);
    if (const Jump *jump = jumpOf(statement))
      goTo(*jump);
    setNext(maybe, end());
    return;
  }
  if (const Jump *jump = jumpOf(statement))
    goTo(*jump);
  else
    emit(Havoc{"a GOTO whose target could not be read"});
}

void Lowering::goTo(const Jump &jump) {
  if (jump.computed)
    emitLast(JumpTo{*jump.computed});
  else if (const std::optional<AlarmKind> alarm = alarmOf(jump))
    stop(*alarm);
  else
    openJumps_.push_back({emit(Pass{}), Edge::Next, *jump.target});
}

std::optional<AlarmKind> Lowering::alarmOf(const Jump &jump) const {
  const std::optional<std::uint32_t> number = targetNumber(jump);
  const std::uint32_t first = dialect_.grammar.sequenceZero ? 0 : 1;
  if (!number || *number < first || *number > dialect_.limits.lastSequenceNumber)
    return AlarmKind::SequenceOutOfRange;
  return jump.target ? std::nullopt : std::optional(AlarmKind::SequenceNotFound);
}

void Lowering::ifStatement(const If &statement) {
  switch (statement.action) {
  case IfAction::Jump:
  case IfAction::Statement: {
    const Jump *jump = statement.action == IfAction::Jump && statement.statement
                           ? jumpOf(tree_.statements[*statement.statement])
                           : nullptr;
    if (jump && !jump->computed && !alarmOf(*jump)) {
      openJumps_.push_back({emit(Test{statement.condition, end()}), Edge::Taken, *jump->target});
      return;
    }
    const NodeId test = emitTest(statement.condition);
    if (statement.statement)
      Lowering::statement(*statement.statement);
    else
      emit(Havoc{"an IF whose action could not be read"});
    setNext(test, end());
    return;
  }
  case IfAction::Words: wordsUnderCondition(statement.condition); return;
  case IfAction::Lines:
    if (!dialect_.grammar.blockIf)
      emit(HavocVariables{"an IF without a statement"}); // it stops; else it is that of another control
    ifLines(statement);
    return;
  case IfAction::Nothing: emitTest(statement.condition); return; // it stops, or there is nothing to decide
  }
}

void Lowering::ifLines(const If &statement) {
  const NodeId test = emitTest(statement.condition);
  openIfs_.push_back({test, {}, test});
}

void Lowering::elseIfLine(const ElseIf &statement) {
  if (openIfs_.empty() || !openIfs_.back().test) {
    emit(HavocVariables{"an ELSEIF without its IF"});
    return;
  }
  OpenIf &open = openIfs_.back();
  open.ends.push_back(emit(Pass{}));
  setNext(*open.test, end());
  open.test = emitTest(statement.condition);
}

void Lowering::elseLine() {
  if (openIfs_.empty() || !openIfs_.back().test) {
    emit(HavocVariables{"an ELSE without its IF"});
    return;
  }
  OpenIf &open = openIfs_.back();
  open.ends.push_back(emit(Pass{}));
  setNext(*open.test, end());
  open.test = std::nullopt;
}

void Lowering::endIfLine() {
  if (openIfs_.empty()) {
    emit(HavocVariables{"an ENDIF without its IF"});
    return;
  }
  OpenIf &open = openIfs_.back();
  if (open.test)
    setNext(*open.test, end());
  for (const NodeId each : open.ends)
    setNext(each, end());
  openIfs_.pop_back();
}

/// IF without ENDIF: the control stops where it looks for it.
void Lowering::closeOpenIfs() {
  if (!dialect_.grammar.blockIf) { // it does not look for it
    openIfs_.clear();
    return;
  }
  const auto stopAt = [&](NodeId node) {
    cfg_.nodes[node].instruction = StopWithAlarm{AlarmKind::IfFormat};
    setNext(node, node);
  };
  for (const OpenIf &open : openIfs_) {
    stopAt(open.first);
    for (const NodeId each : open.ends)
      stopAt(each);
  }
  openIfs_.clear();
}

} // namespace feedhold
