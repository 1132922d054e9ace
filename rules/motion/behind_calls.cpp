// See the header.
#include "rules/motion/behind_calls.h"

#include "rules/motion/folder_programs.h"

#include <algorithm>
#include <set>

namespace feedhold::rules {
namespace {

/// A code of the group that is none of those that leave the mode on.
bool putsRight(const MotionView &view, NodeId node, const LeftOn &mode) {
  return decides(mode, view, node) && !switchedBy(mode, view, node);
}

/// What the called program may do to the mode; it is not followed into further calls.
struct CalleeEffect {
  bool putsOn = false;
  bool putsRight = false;
};
/// Absent for a program that is not known.
std::optional<CalleeEffect> effectOf(const CallProgram &call, const ProgramFile &file, const LeftOn &mode,
                                     const FileContext &context) {
  const auto callee = context.programs->callee(file.file, call.call);
  if (!callee)
    return std::nullopt;
  const FileContext its = contextOf(context.programs->file(callee->file), context);
  const MotionView view(callee->program, its);
  CalleeEffect effect;
  std::set<NodeId> seen{callee->entry};
  std::vector<NodeId> open{callee->entry};
  while (!open.empty()) {
    const NodeId node = open.back();
    open.pop_back();
    effect.putsOn = effect.putsOn || switchedBy(mode, view, node);
    effect.putsRight = effect.putsRight || putsRight(view, node, mode);
    forEachSuccessor(view.cfg(), its.model, node, ProgramUse::Called, [&](NodeId next) {
      if (seen.insert(next).second)
        open.push_back(next);
    });
  }
  return effect;
}

/// Moves for which the mode matters: by inverse time feed a cutting block needs its own F, and one that has it is meant
/// so.
bool minds(const MotionView &view, NodeId node, const LeftOn &mode) {
  if (view.modalMotionWords(node).empty())
    return false;
  return mode.kind != ModalKind::FeedMode ||
         (!view.mayHave(node, 'F') &&
          view.mayDo(node, {CodeAction::Linear, CodeAction::ArcClockwise, CodeAction::ArcCounterclockwise}));
}

/// The last code in the text before the call that decides the mode puts it right: the program does not want it on.
bool hadOther(NodeId call, const MotionView &view, const LeftOn &mode) {
  for (NodeId node = call; node != view.cfg().entryOf(view.program());) {
    node = NodeId(node.index() - 1);
    if (decides(mode, view, node))
      return !switchedBy(mode, view, node);
  }
  return false;
}

/// The last code in the text before the call that decides the mode puts it on: nothing changes for the caller.
bool hasItself(NodeId call, const ProgramFile &file, const LeftOn &mode, const FileContext &context) {
  const FileContext its = contextOf(file, context);
  const MotionView view(file.model->programOf(file.cfg.nodes[call].block), its);
  for (NodeId node = call; node != view.cfg().entryOf(view.program());) {
    node = NodeId(node.index() - 1);
    if (decides(mode, view, node))
      return switchedBy(mode, view, node) != nullptr;
  }
  return false;
}

/// Where the program goes on behind one call.
BehindCalls behindCall(NodeId call, const CallProgram &instruction, const ProgramFile &file, const LeftOn &mode,
                       const FileContext &context) {
  // Of several local subroutines of a program (M97), each call enters one.
  const bool isLocal = file.model->calls[instruction.call].kind == CallKind::Local;
  if (const auto effect = effectOf(instruction, file, mode, context); isLocal && effect && !effect->putsOn)
    return BehindCalls::PutRight;
  const FileContext its = contextOf(file, context);
  const MotionView view(file.model->programOf(file.cfg.nodes[call].block), its);
  std::set<NodeId> seen;
  std::vector<NodeId> open{call};
  bool moves = false;
  bool isLeft = false;
  bool isSetAgain = false;
  while (!open.empty()) {
    const NodeId node = open.back();
    open.pop_back();
    const auto *end = std::get_if<EndProgram>(&view.node(node).instruction);
    isLeft = isLeft || std::holds_alternative<ReturnFromProgram>(view.node(node).instruction) ||
             (end && !its.dialect.behaviour.endRestoresModes);
    forEachSuccessor(file.cfg, *file.model, node, ProgramUse::Called, [&](NodeId next) {
      if (decides(mode, view, next)) {
        isSetAgain = isSetAgain || switchedBy(mode, view, next);
        return;
      }
      if (!seen.insert(next).second)
        return;
      if (const auto *another = std::get_if<CallProgram>(&view.node(next).instruction))
        if (const auto effect = effectOf(*another, file, mode, context); !effect || effect->putsRight) {
          isSetAgain = isSetAgain || (effect && effect->putsOn);
          return;
        }
      moves = moves || minds(view, next, mode);
      open.push_back(next);
    });
  }
  // An entry macro leaves compensation on for its caller; nobody wants G91 so.
  const bool isUnwanted = mode.kind == ModalKind::Distance && (isSetAgain || hadOther(call, view, mode));
  if (moves && (isLeft || isUnwanted))
    return BehindCalls::MovesOn;
  return isLeft ? BehindCalls::LeftAtEnd : BehindCalls::PutRight;
}

/// Calls of the program by others, and those of its own blocks (M97).
std::vector<CallGraph::Caller> callsOf(const FlowFacts &facts, const FileContext &context) {
  std::vector<CallGraph::Caller> calls = context.callGraph.callers({context.file, facts.program});
  for (CallId call(0); call.index() < context.model.calls.size(); call = call.next())
    if (context.model.calls[call].kind == CallKind::Local && context.model.calls[call].caller == facts.program)
      calls.push_back({context.file, call});
  return calls;
}

} // namespace

CallersOfMode behindCalls(const LeftOn &mode, const FlowFacts &facts, const FileContext &context) {
  const std::vector<CallGraph::Caller> calls = callsOf(facts, context);
  CallersOfMode found{.allInFile = !calls.empty()};
  for (const CallGraph::Caller &caller : calls) {
    const ProgramFile &file = facts.programs.file(caller.file);
    const BlockId block = file.model->calls[caller.call].block;
    found.allInFile = found.allInFile && caller.file == context.file;
    for (NodeId node = file.cfg.nodeOf(block);
         node.index() < file.cfg.nodes.size() && file.cfg.nodes[node].block == block; node = node.next())
      if (const auto *instruction = std::get_if<CallProgram>(&file.cfg.nodes[node].instruction)) {
        const BehindCalls behind = behindCall(node, *instruction, file, mode, context);
        found.behind = std::max(found.behind, behind);
        if (file.model->calls[instruction->call].kind == CallKind::Local)
          found.behindLocal =
              std::max(found.behindLocal, hasItself(node, file, mode, context) ? BehindCalls::PutRight : behind);
      }
  }
  return found;
}

} // namespace feedhold::rules
