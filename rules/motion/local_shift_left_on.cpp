// local-shift-left-on: G52 at the end.
#include "rules/motion/left_on.h"

#include <algorithm>

namespace feedhold::rules::local_shift_left_on {
namespace {

bool isZero(const Word &word) { return word.isNumber() && word.number().isZero(); }

/// The axis words of a G52.
std::vector<const Word *> shiftsOf(const MotionView &view, NodeId node) {
  std::vector<const Word *> axes;
  if (view.findAction(node, {CodeAction::LocalShift}))
    for (const Word *word : view.wordsOf(node))
      if (axisOf(word->address()) && !word->has(Word::kComma))
        axes.push_back(word);
  return axes;
}

const Word *switchedBy(const MotionView &view, NodeId node) {
  const auto axes = shiftsOf(view, node);
  const bool shifts = std::ranges::any_of(axes, [](const Word *word) { return !isZero(*word); });
  return shifts ? view.findAction(node, {CodeAction::LocalShift}) : nullptr;
}

/// Any other G52: of one with variables it is not known.  G92 takes the shift away.
bool putsRight(const MotionView &view, NodeId node) {
  return !shiftsOf(view, node).empty() || view.findAction(node, {CodeAction::CoordinateSet});
}

/// What is not a constant is that of the start, or computed.
bool isOn(const AbstractState &state) {
  bool isZeroed = false;
  for (const AbstractValue &shift : state.local) {
    if (!shift.number().contains(0)) // X50 without a point is one of two lengths
      return true;
    isZeroed = isZeroed || shift.number().constantValue();
  }
  return !isZeroed;
}

void check(const FlowFacts &facts, const FileContext &context, const Reporter &reporter) {
  reportLeftOn({.kind = ModalKind::WorkOffset,
                .actions = {},
                .atProgramEnd = context.dialect.hasFanucParameters ? Severity::Warning : Severity::Info,
                .consequence = "every later position in this work offset, and in all others, is shifted, too",
                .remedy = "cancel it with `G52 X0 Y0 Z0` before the end",
                .special = LeftOn::Special{switchedBy, putsRight, isOn}},
               facts, context, reporter);
}

} // namespace

extern const Rule localShiftLeftOn;
const Rule localShiftLeftOn{.info = {"local-shift-left-on", Category::Motion, Severity::Warning,
                                     "Reports a `G52` shift that is still active when the program ends or returns, on "
                                     "some path."},
                            .hooks = {.flow = check}};

} // namespace feedhold::rules::local_shift_left_on
