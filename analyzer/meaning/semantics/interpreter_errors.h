// Interpreter errors: blocks at which the interpreter of LinuxCNC stops with a message.  No alarm of their own stands
// for them: an analysis gives up what it knows there, and a run that comes to one shows nothing.
//
// Source: its "G code reference"; tests/oracles runs programs with rs274.
#pragma once

#include "meaning/semantics/cycles.h"

#include <string_view>

namespace feedhold {

/// Why the interpreter stops at a block for what is written in it, or for the modes in force; empty: it does not, or it
/// is not seen.
template <ValueAlgebra R> std::string_view whyInterpreterStops(StepContext<R> &context, const ExecutedWords<R> &words);

// ---- implementation -----------------------------------------------------------------------------------------------

namespace detail {

/// Asked once the modes of the block are in force.
template <ValueAlgebra R> class InterpreterErrors {
public:
  InterpreterErrors(StepContext<R> &context, const ExecutedWords<R> &words)
      : context_(context), interpretation_(context.interpretation), words_(words) {}

  std::string_view find() {
    if (hasTwoOfGroup())
      return "two G codes of one modal group in a block";
    if (const std::string_view why = ofNumbers(); !why.empty())
      return why;
    if (const std::string_view why = ofCodes(); !why.empty())
      return why;
    return ofMotion();
  }

private:
  bool has(char letter) const { return words_.find(letter) != nullptr; }
  bool hasAxis() const {
    return std::ranges::any_of(kAllAxes, [&](Axis axis) { return has(letterOf(axis)); });
  }
  const Code *codeWith(std::uint16_t tenths) const {
    for (const CodeWord &word : words_.codes)
      if (word.address == 'G' && word.code->tenths == tenths)
        return word.code;
    return nullptr;
  }
  bool isInForce(ModalKind kind, std::initializer_list<CodeAction> actions) {
    return context_.certain(context_.inForce(kind, actions, interpretation_.truth(false)));
  }
  std::optional<double> numberOf(char letter) {
    const auto *entry = words_.find(letter);
    return entry ? interpretation_.constantOf(interpretation_.asNumber(entry->value)) : std::nullopt;
  }

  /// G80 may stand beside a code of its group.
  bool hasTwoOfGroup() const {
    std::array<bool, kModalGroups> seen{};
    for (const CodeWord &word : words_.codes)
      if (word.address == 'G' && word.code->action != CodeAction::CycleOff && word.code->group != 0 &&
          word.code->group < kModalGroups && std::exchange(seen[word.code->group], true))
        return true;
    return false;
  }
  std::string_view ofNumbers() {
    for (const char letter : {'F', 'S'})
      if (const auto number = numberOf(letter); number && *number < 0)
        return "a feed or a speed below 0";
    constexpr double kWhole = 1e-4;
    for (const char letter : {'L', 'T'})
      if (const auto number = numberOf(letter); number && std::abs(*number - std::round(*number)) > kWhole)
        return "L or T with a fraction";
    return {};
  }
  std::string_view ofCodes() {
    const auto &codes = words_.codes;
    const auto hasAction = [&](CodeAction action) {
      return std::ranges::any_of(codes, [&](const CodeWord &word) { return word.code->action == action; });
    };
    if (hasAction(CodeAction::Dwell) && (!has('P') || numberOf('P').value_or(0) < 0))
      return "G4 without P";
    if (hasAction(CodeAction::CoordinateSet) && !hasAxis())
      return "G92 without an axis";
    if (hasAction(CodeAction::MachineMove) &&
        !interpretation_.mayBe(
            context_.inForce(ModalKind::Motion, {CodeAction::Rapid, CodeAction::Linear}, interpretation_.truth(false))))
      return "G53 without G0 or G1";
    if (const auto system = numberOf('P'); codeWith(kDataSetting) && (numberOf('L') == 2.0 || numberOf('L') == 20.0) &&
                                           system && (*system < 0 || *system > 9))
      return "G10 of a coordinate system that is not there";
    return {};
  }
  std::string_view ofMotion() {
    const bool isFree = std::ranges::none_of(words_.codes, [](const CodeWord &word) {
      return word.address == 'G' && (word.code->action == CodeAction::LengthGiven ||
                                     (word.code->group == 0 && word.code->role != CodeRole::Plain));
    });
    if (isFree && hasAxis() && isInForce(ModalKind::Cycle, {CodeAction::CycleOff}))
      return "axis words while no motion is in force";
    const bool isArc = isInForce(ModalKind::Motion, {CodeAction::ArcClockwise, CodeAction::ArcCounterclockwise});
    if (isArc && has('R') && (has('I') || has('J') || has('K')))
      return "R beside I, J or K";
    const bool feeds = isArc || isInForce(ModalKind::Motion, {CodeAction::Linear});
    if (isFree && feeds && hasAxis() && isFeedZero())
      return "a movement at feed 0";
    if (isInForce(ModalKind::Cycle, {CodeAction::CyclePeck, CodeAction::CycleChipBreak}) && hasAxis() &&
        (context_.certain(interpretation_.isVacant(context_.state.cycle.peck)) && !has('Q')))
      return "a peck cycle without Q";
    if (isInForce(ModalKind::Cycle, {CodeAction::CycleDwell}) && hasAxis() &&
        (context_.certain(interpretation_.isVacant(context_.state.cycle.dwell)) && !has('P')))
      return "G82 without P";
    const bool drills =
        context_.certain(context_.inForce(ModalKind::Cycle, kDrillingCycles, interpretation_.truth(false)));
    return drills && numberOf('L') == 0.0 && hasAxis() ? "L0" : std::string_view();
  }
  bool isFeedZero() {
    const auto &feed = context_.state.word('F'); // one that was never written may be that of the caller
    return context_.certain(interpretation_.negation(interpretation_.isVacant(feed))) &&
           interpretation_.constantOf(interpretation_.asNumber(feed)) == 0.0;
  }

  static constexpr std::uint16_t kDataSetting = 100; // G10
  StepContext<R> &context_;
  R &interpretation_;
  const ExecutedWords<R> &words_;
};

} // namespace detail

template <ValueAlgebra R> std::string_view whyInterpreterStops(StepContext<R> &context, const ExecutedWords<R> &words) {
  // An analysis that goes on behind mistakes looks at what would follow; nothing does, so that it says too much at
  // most.
  if constexpr (!requires { R::kGoesOnBehindMistakes; })
    if (context.behaviour().stopsAtStrayWords)
      return detail::InterpreterErrors<R>(context, words).find();
  return {};
}

} // namespace feedhold
