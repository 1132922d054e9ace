// Turning cycles: the single cutting cycles of lathes, stroke by stroke: G90 and G94 of G code system A, G77 and G79 of
// B.
//
// G90 goes along X at rapid, cuts along Z, comes back along X at feed and along Z at rapid; G94 the same with both axes
// exchanged.  With R the cut is a cone: it begins R away from the end in radius, for G94 in Z.  X, Z and R stay in
// force as long as such blocks follow one another.  Source: FANUC lathe operator's manual, "canned cycle" (parity.md).
#pragma once

#include "meaning/semantics/cycles.h"
#include "meaning/semantics/turret.h"

#include <string_view>

namespace feedhold {

/// A block with axis words in such a cycle; false: its way is not known.  It ends where it starts.
template <ValueAlgebra R>
bool runTurningCycle(StepContext<R> &context, const ExecutedWords<R> &words, CodeAction action);

// ---- implementation -----------------------------------------------------------------------------------------------

namespace detail {

template <ValueAlgebra R> class TurningCycle {
public:
  using Value = typename R::Value;

  TurningCycle(StepContext<R> &context, const ExecutedWords<R> &words)
      : context_(context), interpretation_(context.interpretation), state_(context.state), words_(words) {}

  bool run(CodeAction action) {
    // Levels of machining centres hold the words in force: the depth is Z, the R level is X, the peck is R.
    CycleState<Value> &kept = state_.cycle;
    const auto target = targetOf(context_, words_);
    learn(kept.bottom, Axis::Z, 'W', target);
    learn(kept.retract, Axis::X, 'U', target);
    if (const auto *taper = words_.find('R'))
      kept.peck = interpretation_.select(taper->present, taper->value, kept.peck);
    const auto isOpen = context_.either(interpretation_.isVacant(kept.bottom), interpretation_.isVacant(kept.retract));
    if (interpretation_.mayBe(isOpen) || hasOtherWords())
      return false;
    const Value x = interpretation_.asNumber(kept.retract), z = interpretation_.asNumber(kept.bottom);
    const Value taper = interpretation_.asNumber(kept.peck);
    if (action == CodeAction::DiameterCycle)
      cut(Axis::X, x, interpretation_.multiply(taper, interpretation_.number(2)), Axis::Z, z);
    else
      cut(Axis::Z, z, taper, Axis::X, x);
    return true;
  }

private:
  void learn(Value &kept, Axis axis, char increment, const std::array<Value, kAxisCount> &target) {
    for (const char letter : {letterOf(axis), increment})
      if (const auto *entry = letter == letterOf(axis) || incrementsByLetter(context_) ? words_.find(letter) : nullptr)
        kept = interpretation_.select(entry->present, target[indexOf(axis)], kept);
  }
  bool hasOtherWords() const {
    constexpr std::string_view kKnown = "NGXZUWRFSTMP";
    const auto words = context_.tree().wordsOf(context_.block);
    return isOpenTarget(context_, words_) || std::ranges::any_of(words, [&](const Word &word) {
             return word.has(Word::kComma) || kKnown.find(word.address()) == std::string_view::npos;
           });
  }
  void cut(Axis across, const Value &level, const Value &taper, Axis along, const Value &end) {
    const Value fromLevel = state_.at(across), from = state_.at(along);
    go(MoveKind::Rapid, across, interpretation_.add(level, taper));
    const auto start = state_.position;
    state_.at(across) = level;
    state_.at(along) = end;
    tell(context_, MoveKind::Feed, start);
    go(MoveKind::Feed, across, fromLevel);
    go(MoveKind::Rapid, along, from);
  }
  void go(MoveKind kind, Axis axis, const Value &to) {
    const auto start = state_.position;
    state_.at(axis) = to;
    tell(context_, kind, start);
  }

  StepContext<R> &context_;
  R &interpretation_;
  MachineState<R> &state_;
  const ExecutedWords<R> &words_;
};

} // namespace detail

template <ValueAlgebra R>
bool runTurningCycle(StepContext<R> &context, const ExecutedWords<R> &words, CodeAction action) {
  return action != CodeAction::TurningCycle && detail::TurningCycle<R>(context, words).run(action);
}

} // namespace feedhold
