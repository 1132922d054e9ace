// Increments: numbers that are, but for rounding, multiples of a decimal step: sums of arguments that a contract gives
// in steps (`BY 0.001`).  The word of such a number is the multiple itself, as an increment counter of the control
// holds it (docs/soundness-proofs.md, Rounding).
#pragma once

#include "proof/smt/term.h"

#include <map>
#include <optional>
#include <vector>

namespace feedhold::prove {

/// A number that was taken to be at most 2^bits: a result that is exact there, since it is a multiple of a power of
/// two; or a word.
struct TakenAsSmall {
  smt::TermId result;
  int bits;
};

/// Digits of an input: 8, as controls take them.
inline constexpr int kMostTypedSteps = 99'999'999;

/// What a number is without rounding.
struct Multiple {
  smt::TermId exact;               // a multiple of the step, without rounding
  smt::Number step;                // 0: of the number 0
  smt::Number error;               // the number is at most so far from it, if
  std::vector<TakenAsSmall> small; // these are as small as is said here
};

/// How far a number of this size is from that of a control with mantissas of 32 bits, at most.
smt::TermId shortRounding(smt::TermStore &store, smt::TermId size);

class Increments {
public:
  explicit Increments(smt::TermStore &store) : store_(store) {}

  /// The variable of an input is a multiple of the step, of at most 8 digits, if the contract is kept.  What the
  /// program reads is the number of the control that is nearest to it.
  void setStep(smt::TermId variable, const smt::Number &step);
  /// Whether that is believed: not of calls that the contract does not allow.
  void believeInputs(bool believes);
  bool isUsed() const { return believesInputs_ && !steps_.empty(); }

  /// Absent: it is not known to be one.
  std::optional<Multiple> of(smt::TermId number);
  /// The multiple, if the number is near enough to it to be rounded to it as a word; what that takes for granted is
  /// added to `small`.
  std::optional<smt::TermId> wordOf(smt::TermId number, const smt::Number &increment, std::vector<TakenAsSmall> &small);
  /// What a counter of increments holds, not a variable of the program: an input without rounding is in it.
  bool isCounted(smt::TermId number);
  /// A sum of such and of numbers: counters add exactly.
  std::optional<smt::TermId> sumOfWords(smt::TermId sum);
  /// Both are inputs or numbers that can be typed, of which every control sees which one is larger: what they are
  /// without rounding.
  std::optional<std::pair<smt::TermId, smt::TermId>> typedPair(smt::TermId a, smt::TermId b);
  /// The input that the number is, without rounding; the number itself where it is none.
  smt::TermId typedInput(smt::TermId number) const;
  /// Whether the number is, without any doubt, the number of the control nearest to a multiple of the step.
  bool isTypedMultiple(smt::TermId number, const smt::Number &step);

private:
  std::optional<Multiple> find(smt::TermId number);
  std::optional<Multiple> ofSum(smt::TermId sum);
  std::optional<Multiple> ofChoice(smt::TermId choice);
  std::optional<Multiple> ofRounded(smt::TermId rounded);
  std::optional<smt::TermId> heldFrom(smt::TermId held) const;
  std::optional<Multiple> typedNumber(smt::TermId number);

  smt::TermStore &store_;
  std::map<smt::TermId, smt::Number> steps_; // of variables
  bool believesInputs_ = true;
  std::map<smt::TermId, std::optional<Multiple>> known_;
  std::map<smt::TermId, bool> counted_;
};

} // namespace feedhold::prove
