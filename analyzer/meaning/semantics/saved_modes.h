// Saved modes: M70 to M73 of LinuxCNC save the modal state of a level, and restore it on demand or when the program of
// the level returns (LinuxCNC, G-Code, M70 to M73).  The motion code is not saved, nor are positions and origins.
#pragma once

#include "meaning/semantics/modes.h"

namespace feedhold {

/// `word`: a code that saves, drops or restores.  Beside other words in its block, whose order is not told, nothing is
/// known behind it.
template <ValueAlgebra R> void savedModes(StepContext<R> &context, const ExecutedWords<R> &words, const CodeWord &word);

/// The program of the level returns.
template <ValueAlgebra R> void restoreModesAtReturn(StepContext<R> &context);

/// M02 and M30 of LinuxCNC: G01, G17, G40, G54, G90 and G94 are in force behind them, F is 0, and the spindle stands.
template <ValueAlgebra R> void restoreModesAtEnd(StepContext<R> &context);

// ---- implementation -----------------------------------------------------------------------------------------------

namespace detail {

inline constexpr std::uint8_t kSavedSpindle = kModalGroups; // of MachineState::savedCodes, behind the groups

template <ValueAlgebra R> void dropModes(StepContext<R> &context) {
  context.state.savedCodes.clear();
  context.state.savedWords.clear();
  context.state.restoresModes = context.interpretation.truth(false);
}

template <ValueAlgebra R> void saveModes(StepContext<R> &context) {
  MachineState<R> &state = context.state;
  state.savedCodes.clear();
  state.savedWords.clear();
  for (std::uint8_t group = 0; group < kModalGroups; ++group)
    if (!context.modes.group(group).codes.empty() && group != context.modes.groupOf(ModalKind::Motion))
      state.savedCodes.emplace_back(group, state.codes[group]);
  state.savedCodes.emplace_back(kSavedSpindle, state.spindle);
  for (const char letter : {'F', 'S'})
    state.savedWords.emplace_back(static_cast<std::uint8_t>(indexOfModalWord(letter)), state.word(letter));
}

/// As a block does that names each code; one of which it is not known which it is, or that is given more than its name,
/// as one that is restored from a variable: `G#1`.
template <ValueAlgebra R> void restoreModes(StepContext<R> &context) {
  MachineState<R> &state = context.state;
  ExecutedWords<R> restored;
  restored.clear();
  const auto takesMore = [&](std::uint8_t group) {
    return group == context.modes.groupOf(ModalKind::Length) || group == context.modes.groupOf(ModalKind::Compensation);
  };
  for (const auto &[group, code] : state.savedCodes) {
    if (group == kSavedSpindle)
      state.spindle = code;
    else if (!context.interpretation.isSameCode(state.codes[group], code)) {
      if (takesMore(group)) // with which length or offset is not followed
        context.interpretation.havoc(state, "a tool length or a cutter compensation that is restored", context.place());
      const auto only = takesMore(group) ? std::nullopt : context.interpretation.onlyCode(code);
      if (only)
        restored.codes.push_back({context.modes.group(group).codes[*only], 'G', context.place()});
      else
        restored.computed.emplace_back(group, code);
    }
  }
  applyModes(context, restored);
  for (const auto &[index, value] : state.savedWords)
    state.words[index] = value;
}

} // namespace detail

template <ValueAlgebra R>
void savedModes(StepContext<R> &context, const ExecutedWords<R> &words, const CodeWord &word) {
  const CodeAction action = word.code->action;
  const bool isAlone = words.codes.size() == 1 && words.entries.empty() && words.computed.empty();
  const bool isRestored = action == CodeAction::ModesRestore;
  if (!isAlone || (isRestored && context.state.savedCodes.empty())) // nothing to restore is an error
    return context.interpretation.havoc(context.state, word.code->meaning, word.span);
  if (isRestored)
    return detail::restoreModes(context);
  if (action == CodeAction::ModesDrop)
    return detail::dropModes(context);
  detail::saveModes(context);
  if (action == CodeAction::ModesSaveForReturn)
    context.state.restoresModes = context.interpretation.truth(true);
}

template <ValueAlgebra R> void restoreModesAtReturn(StepContext<R> &context) {
  R &interpretation = context.interpretation;
  if (!savesModes(context.dialect()))
    return;
  const auto restores = context.state.restoresModes;
  if (interpretation.mayBe(restores)) {
    const auto asTheyAre = context.state;
    if (context.state.savedCodes.empty()) // something that is not followed may have saved them
      interpretation.havoc(context.state, "modal state that may be restored", context.place());
    else
      detail::restoreModes(context);
    if (!context.certain(restores))
      interpretation.join(context.state, interpretation.negation(restores), asTheyAre);
  }
  detail::dropModes(context);
}

template <ValueAlgebra R> void restoreModesAtEnd(StepContext<R> &context) {
  if (!context.behaviour().endRestoresModes)
    return;
  constexpr std::array kModes = {std::pair{ModalKind::Motion, CodeAction::Linear},
                                 std::pair{ModalKind::Plane, CodeAction::PlaneXY},
                                 std::pair{ModalKind::Distance, CodeAction::Absolute},
                                 std::pair{ModalKind::FeedMode, CodeAction::FeedPerMinute},
                                 std::pair{ModalKind::Compensation, CodeAction::CompensationOff},
                                 std::pair{ModalKind::WorkOffset, CodeAction::WorkOffset}};
  ExecutedWords<R> restored;
  restored.clear();
  for (const auto &[kind, action] : kModes) {
    const auto group = context.modes.groupOf(kind);
    const CodeMask mask = context.modes.maskOf(kind, {action});
    if (group && mask != 0)
      restored.codes.push_back(
          {context.modes.group(*group).codes[static_cast<std::size_t>(std::countr_zero(mask))], 'G', context.place()});
  }
  applyModes(context, restored);
  context.state.word('F') = context.zero();
  context.state.spindle = context.interpretation.code(static_cast<std::uint8_t>(
      std::find(kSpindleActions.begin(), kSpindleActions.end(), CodeAction::SpindleStop) - kSpindleActions.begin()));
}

} // namespace feedhold
