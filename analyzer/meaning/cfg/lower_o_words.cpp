// Lowering of o-words: if, while, do, repeat, break, continue, sub, call, return.  What each does: LinuxCNC, the
// chapter O-codes of its manual, and interp_o_word.cc for what the chapter leaves open.
#include "meaning/cfg/lowering.h"

#include <algorithm>

namespace feedhold {

namespace {

constexpr std::string_view kUnpaired = "an o-word without its partner";
constexpr std::string_view kLeftRepeat = "a repeat that a return may have left in an earlier call";
constexpr std::string_view kRepeated = "an o-word whose label may have been used before";

} // namespace

void Lowering::oWordStatement(StatementId id, const OWord &oWord) {
  const std::span<const OWordUse> here = model_.oWordsIn(block_, block_.next());
  const auto found = std::find_if(here.begin(), here.end(), [&](const OWordUse &each) { return each.statement == id; });
  const std::optional<ExpressionId> value = valueOf(id);
  const std::optional<ConstructId> construct = found == here.end() ? std::nullopt : found->construct;
  switch (oWord.kind) {
  case OWordKind::Call: return; // a node of its own, with the other calls of the block
  case OWordKind::Return: emitLast(ReturnFromProgram{std::nullopt, value}); return;
  case OWordKind::Sub: // the entry of its program
  case OWordKind::EndSub:
  case OWordKind::If:
  case OWordKind::ElseIf:
  case OWordKind::Else:
  case OWordKind::EndIf:
  case OWordKind::While:
  case OWordKind::EndWhile:
  case OWordKind::Do:
  case OWordKind::Repeat:
  case OWordKind::EndRepeat:
  case OWordKind::Break:
  case OWordKind::Continue: break;
  }
  if (construct) {
    if (model_.oWords[model_.constructs[*construct].parts.front()].statement == id)
      headOfConstruct(*construct);
    partOfConstruct(oWord.kind, *construct, value);
  } else {
    emit(Havoc{kUnpaired});
  }
}

/// The condition, the count, or the value that is returned.
std::optional<ExpressionId> Lowering::valueOf(StatementId oWord) const {
  const std::span<const ExpressionId> arguments = tree_.argumentsOf(std::get<OWord>(tree_.statements[oWord].node));
  return arguments.empty() ? std::nullopt : std::optional(arguments.front());
}

/// The interpreter keeps the counter by the label: the next call goes on with what is left of it.
bool Lowering::isLeftByReturn(const Construct &construct) const {
  for (OWordId each = construct.parts.front(); each < construct.parts.back(); each = each.next())
    if (model_.oWords[each].kind == OWordKind::Return)
      return true;
  return false;
}

void Lowering::headOfConstruct(ConstructId id) {
  if (model_.constructs[id].kind == OWordKind::Repeat && isLeftByReturn(model_.constructs[id]))
    emit(Havoc{kLeftRepeat});
  const auto repeated = repeatedLabels_.find(id);
  if (repeated == repeatedLabels_.end())
    return;
  if (repeated->second.kind == RepeatedLabel::Surely)
    stop(AlarmKind::RepeatedLabel);
  else
    emit(Havoc{kRepeated});
}

void Lowering::partOfConstruct(OWordKind kind, ConstructId id, std::optional<ExpressionId> value) {
  ConstructNodes &nodes = constructNodes_[id.index()];
  switch (kind) {
  case OWordKind::If: nodes.whenFalse = emitTest(value); return;
  case OWordKind::ElseIf:
  case OWordKind::Else: nextBranch(nodes, kind, value); return;
  case OWordKind::EndIf: closeConstruct(nodes); return;
  case OWordKind::While:
    if (model_.constructs[id].kind == OWordKind::Do) {
      resolve(nodes.continues);
      emit(Test{value, nodes.head.value_or(end())});
      closeConstruct(nodes);
      return;
    }
    nodes.head = emitTest(value);
    nodes.whenFalse = nodes.head;
    return;
  case OWordKind::Do: nodes.head = emit(Pass{}); return;
  case OWordKind::Repeat: startRepeat(nodes, value); return;
  case OWordKind::EndWhile:
  case OWordKind::EndRepeat:
    resolve(nodes.continues);
    setNext(emit(Pass{}), nodes.head.value_or(end()));
    closeConstruct(nodes);
    return;
  case OWordKind::Break:
  case OWordKind::Continue: leaveBody(nodes, kind, model_.constructs[id].kind); return;
  case OWordKind::Sub: return;
  case OWordKind::EndSub: emitLast(ReturnFromProgram{std::nullopt, value}); return;
  case OWordKind::Call:
  case OWordKind::Return: return;
  }
}

void Lowering::nextBranch(ConstructNodes &nodes, OWordKind kind, std::optional<ExpressionId> value) {
  nodes.ends.push_back(emit(Pass{}));
  if (nodes.whenFalse)
    setNext(*nodes.whenFalse, end());
  nodes.whenFalse = kind == OWordKind::ElseIf ? std::optional(emitTest(value)) : std::nullopt;
}

void Lowering::startRepeat(ConstructNodes &nodes, std::optional<ExpressionId> times) {
  if (!times) {
    emit(Havoc{"a repeat without its count"});
    nodes.head = emitTest(std::nullopt);
    nodes.whenFalse = nodes.head;
    return;
  }
  const CounterId counter(cfg_.counters++);
  emit(StartCount{counter, *times});
  nodes.head = emit(CountDown{counter, end().next()});
  nodes.whenFalse = nodes.head;
}

/// LinuxCNC takes break and continue in while and do only.
void Lowering::leaveBody(ConstructNodes &nodes, OWordKind kind, OWordKind loop) {
  if (loop == OWordKind::Repeat) {
    stop(AlarmKind::MacroFormat);
    return;
  }
  (kind == OWordKind::Break ? nodes.ends : nodes.continues).push_back(emit(Pass{}));
}

void Lowering::closeConstruct(ConstructNodes &nodes) {
  if (nodes.whenFalse)
    setNext(*nodes.whenFalse, end());
  nodes.whenFalse = std::nullopt;
  resolve(nodes.ends);
}

void Lowering::resolve(std::vector<NodeId> &nodes) {
  for (const NodeId each : nodes)
    setNext(each, end());
  nodes.clear();
}

/// What was never closed: the control reads on to the end of the file for the end of it, and stops.
void Lowering::closeOpenConstructs(ProgramId id) {
  for (const OWordUse &each : model_.oWordsIn(model_.programs[id].first, model_.programs[id].last)) {
    if (each.program != id || !each.construct || model_.constructs[*each.construct].closed)
      continue;
    ConstructNodes &nodes = constructNodes_[each.construct->index()];
    if (!nodes.whenFalse && nodes.ends.empty() && nodes.continues.empty())
      continue;
    resolve(nodes.continues);
    closeConstruct(nodes);
    stop(AlarmKind::MissingEnd);
  }
}

} // namespace feedhold
