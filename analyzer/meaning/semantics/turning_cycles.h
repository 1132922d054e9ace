// Turning cycles: the single cutting cycles of lathes, stroke by stroke: G90, G92 and G94 of G code system A, G77 to
// G79 of B; and the multiple ones, each in a file of its own.
//
// G90 goes along X at rapid, cuts along Z, comes back along X at feed and along Z at rapid; G94 the same with both axes
// exchanged.  With R the cut is a cone: it begins R away from the end in radius, for G94 in Z.  X, Z and R stay in
// force as long as such blocks follow one another.  Source: FANUC lathe operator's manual, "canned cycle" (parity.md).
//
// G92 cuts a thread as G90 cuts a cylinder, and comes back along X at rapid.  Where a parameter says so (5130, 5131;
// Settings 95 and 96), the thread runs out before its end, at an angle, towards the X of the start.  How far before,
// and at which angle, only the machine knows: a run draws none, and all else takes the box of the cycle.
#pragma once

#include "meaning/semantics/contour_cycles.h"
#include "meaning/semantics/groove_cycles.h"
#include "meaning/semantics/thread_passes.h"

#include <string_view>

namespace feedhold {

/// A block of such a cycle; false: its way is not known.  It ends where it starts.
template <ValueAlgebra R>
bool runTurningCycle(StepContext<R> &context, const ExecutedWords<R> &words, CodeAction action);

// ---- implementation -----------------------------------------------------------------------------------------------

namespace detail {

template <ValueAlgebra R> class TurningCycle {
public:
  using Value = typename R::Value;

  TurningCycle(StepContext<R> &context, const ExecutedWords<R> &words)
      : context_(context), interpretation_(context.interpretation), state_(context.state), words_(words),
        strokes_(context, words) {}

  bool run(CodeAction action) {
    // Levels of machining centres hold the words in force: the depth is Z, the R level is X, the peck is R.
    CycleState<Value> &kept = state_.cycle;
    const auto target = targetOf(context_, words_);
    learn(kept.bottom, Axis::Z, 'W', target);
    learn(kept.retract, Axis::X, 'U', target);
    if (const auto *taper = words_.find('R'))
      kept.peck = interpretation_.select(taper->present, taper->value, kept.peck);
    const auto isOpen = context_.either(interpretation_.isVacant(kept.bottom), interpretation_.isVacant(kept.retract));
    if (interpretation_.mayBe(isOpen) || isNotFollowed(action))
      return false;
    const Value x = interpretation_.asNumber(kept.retract), z = interpretation_.asNumber(kept.bottom);
    const Value taper = interpretation_.asNumber(kept.peck);
    if (action == CodeAction::FaceCycle)
      cut(Axis::Z, z, taper, Axis::X, x, MoveKind::Feed);
    else if (action == CodeAction::DiameterCycle)
      cut(Axis::X, x, strokes_.twice(taper), Axis::Z, z, MoveKind::Feed);
    else if (drawsStrokes(context_))
      cut(Axis::X, x, strokes_.twice(taper), Axis::Z, z, MoveKind::Rapid);
    else
      threadInBox(x, strokes_.twice(taper), z);
    return true;
  }

private:
  void learn(Value &kept, Axis axis, char increment, const std::array<Value, kAxisCount> &target) {
    for (const char letter : {letterOf(axis), increment})
      if (const auto *entry = letter == letterOf(axis) || incrementsByLetter(context_) ? words_.find(letter) : nullptr)
        kept = interpretation_.select(entry->present, target[indexOf(axis)], kept);
  }
  /// Q of a thread is the angle of the spindle at which it starts, E its lead.  Haas has I or K for the taper.
  bool isOther(const Word &word, CodeAction action) const {
    const char letter = word.address();
    if (word.has(Word::kComma) || (letter == 'R' && !context_.dialect().hasFanucParameters))
      return true;
    const std::string_view known = action == CodeAction::ThreadCycle ? "NGXZUWRFSTMPQE" : "NGXZUWRFSTMP";
    return known.find(letter) == std::string_view::npos;
  }
  bool isNotFollowed(CodeAction action) const {
    return interpretation_.mayBe(state_.transformed) || isOpenTarget(context_, words_) ||
           std::ranges::any_of(context_.tree().wordsOf(context_.block),
                               [&](const Word &word) { return isOther(word, action); });
  }
  void cut(Axis across, const Value &level, const Value &taper, Axis along, const Value &end, MoveKind back) {
    const Value fromLevel = state_.at(across), from = state_.at(along);
    strokes_.go(MoveKind::Rapid, across, interpretation_.add(level, taper));
    const auto start = state_.position;
    state_.at(across) = level;
    state_.at(along) = end;
    tell(context_, MoveKind::Feed, start);
    strokes_.go(back, across, fromLevel);
    strokes_.go(MoveKind::Rapid, along, from);
  }
  void threadInBox(const Value &x, const Value &taper, const Value &z) {
    strokes_.cutInBox(state_.position, strokes_.at(x, z));
    if (!strokes_.isZero(taper))
      strokes_.cutInBox(state_.position, strokes_.at(interpretation_.add(x, taper), z));
  }

  StepContext<R> &context_;
  R &interpretation_;
  MachineState<R> &state_;
  const ExecutedWords<R> &words_;
  TurningStrokes<R> strokes_;
};

} // namespace detail

template <ValueAlgebra R>
bool runTurningCycle(StepContext<R> &context, const ExecutedWords<R> &words, CodeAction action) {
  if (action == CodeAction::FaceGroove || action == CodeAction::DiameterGroove)
    return detail::GrooveCycle<R>(context, words, action).run();
  if (action == CodeAction::ThreadPasses)
    return detail::ThreadPasses<R>(context, words).run();
  if (isSingleTurningCycle(action))
    return detail::TurningCycle<R>(context, words).run(action);
  return detail::ContourCycle<R>(context, words, action).run();
}

} // namespace feedhold
