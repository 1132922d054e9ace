// The choice of a work offset: G54 to G59, and which additional one.  `G54.1 P2` and `G154 P2` say it by P, `G110` of
// Haas by itself.
//
// FANUC controls with the option take `G54 P2` for the same (operator's manual, "Adding workpiece coordinate systems");
// others pass over the P.  Both are followed: which system is in force is then not known.  A run takes the first, and
// is no witness.
#pragma once

#include "meaning/semantics/executed_words.h"

#include <algorithm>

namespace feedhold::detail {

template <ValueAlgebra R> class WorkOffsetChoice {
public:
  using Value = typename R::Value;

  WorkOffsetChoice(StepContext<R> &context, const ExecutedWords<R> &words)
      : context_(context), interpretation_(context.interpretation), state_(context.state), words_(words) {}

  /// By a code of the block, another one may come into force.
  bool changesSystem() const {
    return std::ranges::any_of(words_.codes, [&](const CodeWord &word) {
      return mayBeAdditional(word) || (word.code->action == CodeAction::WorkOffset && !inForceAlready(word));
    });
  }
  bool mayBeAdditional(const CodeWord &word) const {
    return word.code->action == CodeAction::ExtendedWorkOffset || isOpen(word);
  }
  /// The code of the word is in force already.
  void enterAdditional(const CodeWord &word) {
    if (const auto own = additionalOffsetOf(context_.dialect(), *word.code))
      state_.word('P') = interpretation_.number(*own);
    else
      state_.word('P') = number();
    if (isOpen(word))
      enterEither(word);
    if (!workOffsetInForce(context_))
      interpretation_.unmodelled("the origin of an additional work coordinate system", word.span);
  }

private:
  static constexpr std::uint32_t kMost = 300; // above, P has another meaning

  bool inForceAlready(const CodeWord &word) const {
    const auto index = context_.modes.indexOf(*word.code);
    return index && interpretation_.onlyCode(state_.codes[word.code->group]) == index;
  }
  /// `G54 P2`.
  bool isOpen(const CodeWord &word) const {
    const bool isFirst = word.address == 'G' && word.code->tenths == 540 && context_.dialect().hasFanucParameters;
    const auto *number = isFirst && additionalOffsetCode(context_.dialect()) ? words_.find('P') : nullptr;
    const auto constant = number ? interpretation_.constantOf(interpretation_.asNumber(number->value)) : std::nullopt;
    return number && interpretation_.mayBe(number->present) && !(constant && *constant > kMost);
  }
  void enterEither(const CodeWord &word) {
    const auto index = context_.modes.indexOf(*additionalOffsetCode(context_.dialect()));
    auto &code = state_.codes[word.code->group];
    if (index)
      code = interpretation_.selectCode(context_.maybe(!isTaken()), interpretation_.code(*index), code);
    if constexpr (requires { interpretation_.passOpenReading(""); })
      interpretation_.passOpenReading("`G54` with a P");
  }
  Value number() const {
    const auto *number = words_.find('P');
    return number && !isTaken() ? interpretation_.select(number->present, number->value, interpretation_.anyNumber())
                                : interpretation_.anyNumber();
  }
  /// The P of the block may be that of another code, or of a canned cycle in force.
  bool isTaken() const {
    const auto off = context_.inForce(ModalKind::Cycle, {CodeAction::CycleOff}, interpretation_.truth(true));
    const auto words = context_.tree().wordsOf(context_.block);
    return !context_.certain(off) || std::ranges::count(words, 'P', &Word::address) != 1 ||
           std::ranges::any_of(words, [&](const Word &word) { return word.isCode() && mayTake(word); });
  }
  bool mayTake(const Word &word) const {
    constexpr std::array kWithout = {CodeAction::Rapid,
                                     CodeAction::Linear,
                                     CodeAction::Absolute,
                                     CodeAction::Incremental,
                                     CodeAction::PlaneXY,
                                     CodeAction::PlaneZX,
                                     CodeAction::PlaneYZ,
                                     CodeAction::Inch,
                                     CodeAction::Metric,
                                     CodeAction::FeedPerMinute,
                                     CodeAction::FeedPerRevolution,
                                     CodeAction::CompensationOff,
                                     CodeAction::LengthPlus,
                                     CodeAction::LengthMinus,
                                     CodeAction::LengthOff,
                                     CodeAction::CycleOff,
                                     CodeAction::ScalingOff,
                                     CodeAction::RotationOff,
                                     CodeAction::MirrorOff,
                                     CodeAction::CoolantOn,
                                     CodeAction::CoolantOff,
                                     CodeAction::SpindleClockwise,
                                     CodeAction::SpindleCounterclockwise,
                                     CodeAction::SpindleStop,
                                     CodeAction::ToolChange,
                                     CodeAction::WorkOffset,
                                     CodeAction::ExtendedWorkOffset};
    const Code *code = word.isNumber() ? codeOf(word, context_.dialect()) : nullptr;
    return !code || std::ranges::find(kWithout, code->action) == kWithout.end();
  }

  StepContext<R> &context_;
  R &interpretation_;
  MachineState<R> &state_;
  const ExecutedWords<R> &words_;
};

} // namespace feedhold::detail
