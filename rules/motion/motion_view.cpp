// See the header.
#include "rules/motion/motion_view.h"

#include "meaning/cfg/block_words.h"

#include <algorithm>
#include <set>
#include <string_view>

namespace feedhold::rules {
namespace {

/// Axis words beside such a code are no end point of a movement in the sense of G00 to G03.
bool takesAxisWords(const Code &code) {
  switch (code.role) {
  case CodeRole::Dwell:
  case CodeRole::DataSetting:
  case CodeRole::DataSettingEnd:
  case CodeRole::CoordinateShift:
  case CodeRole::OwnWords:
  case CodeRole::MacroCall:
  case CodeRole::ModalCall:
  case CodeRole::ModalCallEach: return true;
  case CodeRole::Plain:
  case CodeRole::Motion:
  case CodeRole::Arc:
  case CodeRole::CannedCycle:
  case CodeRole::MachinePosition:
  case CodeRole::ModalCallCancel:
  case CodeRole::ReferenceReturn:
  case CodeRole::Skip:
  case CodeRole::SkipOrAlarm:
  case CodeRole::Contour:
  case CodeRole::SubprogramCall:
  case CodeRole::LocalCall:
  case CodeRole::ExternalCall:
  case CodeRole::Return:
  case CodeRole::ProgramEnd:
  case CodeRole::ProgramStop:
  case CodeRole::JumpOnInput: break;
  }
  constexpr std::array kTaking = {CodeAction::RotationOn, CodeAction::ScalingOn,  CodeAction::MirrorOn,
                                  CodeAction::MirrorOff,  CodeAction::Unmodelled, CodeAction::Anything,
                                  CodeAction::OtherCycle, CodeAction::SideCycle,  CodeAction::LengthGiven};
  return isTurningCycle(code.action) || isCirclePocket(code.action) ||
         std::ranges::find(kTaking, code.action) != kTaking.end();
}

bool movesByItself(const Code &code) {
  return code.role == CodeRole::ReferenceReturn || isSkip(code.role) || code.role == CodeRole::MachinePosition;
}

template <typename Is> std::vector<const Word *> endPoint(const MotionView &view, NodeId node, Is &&takes) {
  std::vector<const Word *> axes;
  for (const Word *word : view.wordsOf(node)) {
    const bool isCode = word->address() == 'G';
    const Code *code = isCode ? codeOf(*word, view.context().dialect) : nullptr;
    if (isCode && (code ? takes(*code) : word->isNumber()))
      return {};
    if (axisOf(word->address()) && !word->has(Word::kComma))
      axes.push_back(word);
  }
  return axes;
}

} // namespace

StartedBy startedBy(const FileContext &context, ProgramId program) {
  const Program &its = context.model.programs[program];
  return its.returns || its.name.isSubroutine || context.callGraph.isCalled({context.file, program})
             ? StartedBy::Caller
             : StartedBy::Operator;
}

bool comesToItsEnd(const FlowFacts &facts) {
  return std::ranges::any_of(facts.exits(), [&](const ExitFact &exit) {
    const auto *end = std::get_if<EndProgram>(&facts.node(exit.node).instruction);
    return !end || end->end != ProgramEnd::EndOfFile;
  });
}

bool isOfLocalCall(const ExitFact &exit, const FlowFacts &facts) {
  return exit.end == PathEnd::Returns && !findPath(facts, facts.entry(), exit.node, [](NodeId) { return false; });
}

MotionView::MotionView(ProgramId program, const FileContext &context)
    : context_(context), program_(program), cfg_(context.programs->file(context.file).cfg),
      modes_(context.modes ? context.modes : std::make_shared<const ModalTable>(context.dialect)) {}

std::vector<const Word *> MotionView::wordsOf(NodeId id) const {
  std::vector<const Word *> words;
  const auto *execute = std::get_if<ExecuteWords>(&node(id).instruction);
  if (!execute)
    return words;
  forEachExecutedWord(context_.tree, context_.model, context_.dialect, node(id).block, *execute,
                      [&](const Word &word) { words.push_back(&word); });
  return words;
}

bool MotionView::mayDo(NodeId id, std::initializer_list<CodeAction> actions) const {
  const auto *execute = std::get_if<ExecuteWords>(&node(id).instruction);
  return execute && std::ranges::any_of(actions, [&](CodeAction action) { return execute->traits.mayDo(action); });
}

bool MotionView::mayHave(NodeId id, char address) const {
  const auto *execute = std::get_if<ExecuteWords>(&node(id).instruction);
  return execute && execute->traits.mayHave(address);
}

std::vector<const Word *> MotionView::axisWords(NodeId node) const { return endPoint(*this, node, takesAxisWords); }

std::vector<const Word *> MotionView::modalMotionWords(NodeId node) const {
  return endPoint(*this, node, [](const Code &code) { return takesAxisWords(code) || movesByItself(code); });
}

const Word *MotionView::findAction(NodeId node, std::initializer_list<CodeAction> actions) const {
  if (!mayDo(node, actions))
    return nullptr;
  for (const Word *word : wordsOf(node))
    if (const Code *code = codeOf(*word, context_.dialect))
      if (std::ranges::find(actions, code->action) != actions.end())
        return word;
  return nullptr;
}

bool MotionView::sets(NodeId node, ModalKind kind) const {
  const auto group = modes_->groupOf(kind);
  return group && mayHave(node, 'G') && std::ranges::any_of(wordsOf(node), [&](const Word *word) {
           const Code *code = word->address() == 'G' ? codeOf(*word, context_.dialect) : nullptr;
           return code && code->group == *group;
         });
}

Span MotionView::blockSpan(NodeId id) const { return context_.tree.blocks[node(id).block].span(); }

std::optional<CodeSet> MotionView::inForce(const AbstractState &state, ModalKind kind) const {
  const auto group = modes_->groupOf(kind);
  return group ? std::optional(state.codes[*group]) : std::nullopt;
}

bool MotionView::wasSet(const AbstractState &state, ModalKind kind, std::initializer_list<CodeAction> actions) const {
  const auto codes = inForce(state, kind);
  if (isHavocked(state)) // set behind what is not known, or not at all
    return surely(state, kind, actions);
  return codes && (codes->codes() & modes_->maskOf(kind, actions)) != 0;
}

bool MotionView::surely(const AbstractState &state, ModalKind kind, std::initializer_list<CodeAction> actions) const {
  const auto codes = inForce(state, kind);
  return codes && !codes->mayBeAtEntry() && (codes->codes() & ~modes_->maskOf(kind, actions)) == 0;
}

bool MotionView::mayBe(const AbstractState &state, ModalKind kind, std::initializer_list<CodeAction> actions) const {
  const auto codes = inForce(state, kind);
  return codes && (codes->mayBeAtEntry() || (codes->codes() & modes_->maskOf(kind, actions)) != 0);
}

std::optional<Plane> MotionView::planeIn(const AbstractState &state) const {
  for (const auto &[code, plane] : {std::pair{CodeAction::PlaneXY, kPlaneXY}, std::pair{CodeAction::PlaneZX, kPlaneZX},
                                    std::pair{CodeAction::PlaneYZ, kPlaneYZ}})
    if (surely(state, ModalKind::Plane, {code}))
      return plane;
  return std::nullopt;
}

Plane MotionView::usualPlane() const { return context_.dialect.machine == MachineKind::Turning ? kPlaneZX : kPlaneXY; }

std::array<CodeAction, 2> MotionView::otherPlanes() const {
  return {context_.dialect.machine == MachineKind::Turning ? CodeAction::PlaneXY : CodeAction::PlaneZX,
          CodeAction::PlaneYZ};
}

bool MotionView::choseOtherPlane(const AbstractState &state) const {
  const auto [first, second] = otherPlanes();
  return wasSet(state, ModalKind::Plane, {first, second}) || callersChooseOtherPlane();
}

/// A file that calls the program has such a code.
bool MotionView::callersChooseOtherPlane() const {
  if (callersChooseOtherPlane_)
    return *callersChooseOtherPlane_;
  std::set<FileId> files;
  for (const CallGraph::Caller &caller : context_.callGraph.callers({context_.file, program_}))
    files.insert(caller.file);
  const auto chooses = [&](const Node &node) {
    const auto *words = std::get_if<ExecuteWords>(&node.instruction);
    return words && std::ranges::any_of(otherPlanes(), [&](CodeAction code) { return words->traits.mayDo(code); });
  };
  callersChooseOtherPlane_ = std::ranges::any_of(
      files, [&](FileId file) { return std::ranges::any_of(context_.programs->file(file).cfg.nodes, chooses); });
  return *callersChooseOtherPlane_;
}

bool MotionView::namesOtherPlane(NodeId node) const {
  const std::string_view letters = context_.dialect.machine == MachineKind::Turning ? "JYC" : "K";
  return std::ranges::any_of(letters, [&](char letter) { return mayHave(node, letter); });
}

double MotionView::lengthOf(Axis axis) const {
  return context_.dialect.machine == MachineKind::Turning && axis == Axis::X ? 0.5 : 1;
}

} // namespace feedhold::rules
