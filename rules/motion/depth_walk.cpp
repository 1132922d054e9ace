#include "rules/motion/depth_walk.h"

#include <algorithm>

namespace feedhold::rules {

namespace {

constexpr std::initializer_list<CodeAction> kFeeding = {CodeAction::Linear, CodeAction::ArcClockwise,
                                                        CodeAction::ArcCounterclockwise};

const Word *levelIn(const std::vector<const Word *> &words) {
  const auto found = std::ranges::find(words, 'Z', [](const Word *word) { return word->address(); });
  return found == words.end() ? nullptr : *found;
}

} // namespace

void DepthWalk::after(NodeId node, const AbstractState &state) {
  if (!asked_)
    return;
  const bool isNext = stands(node);
  next_ = node.next();
  const auto &instruction = view_.node(node).instruction;
  if (isNext && std::holds_alternative<Pass>(instruction))
    return;
  if (!isNext || !std::holds_alternative<ExecuteWords>(instruction) || changesDepths(node))
    return forget();
  if (takesAway(node))
    return;
  const auto words = view_.modalMotionWords(node);
  if (words.empty()) {
    if (!view_.axisWords(node).empty())
      forget();
    return;
  }
  if (!view_.surely(state, ModalKind::Distance, {CodeAction::Absolute}) ||
      !view_.surely(state, ModalKind::Cycle, {CodeAction::CycleOff}) ||
      view_.wasSet(state, ModalKind::Plane, {CodeAction::PlaneZX, CodeAction::PlaneYZ}))
    return forget();
  const Word *level = levelIn(words);
  const bool feeds = view_.surely(state, ModalKind::Motion, kFeeding);
  if ((!feeds && !view_.surely(state, ModalKind::Motion, {CodeAction::Rapid})) || (level && !level->isNumber()))
    return forget();
  follow({node, level, feeds, words.size() == 1});
}

} // namespace feedhold::rules
