// Turning strokes: what the cycles of lathes have in common: straight strokes in X and Z, words that are lengths, and
// the box that stands for strokes whose number is not known.
#pragma once

#include "meaning/semantics/cycles.h"
#include "meaning/semantics/turret.h"

#include <string_view>

namespace feedhold {

/// A run draws the strokes of a cycle, with the usual settings of the machine.  All else looks at every run, and takes
/// the box that holds the strokes of all settings.
template <ValueAlgebra R> bool drawsStrokes(StepContext<R> &context) { return context.certain(context.maybe(true)); }

template <ValueAlgebra R> class TurningStrokes {
public:
  using Value = typename R::Value;
  using Point = std::array<Value, kAxisCount>;

  TurningStrokes(StepContext<R> &context, const ExecutedWords<R> &words)
      : context_(context), interpretation_(context.interpretation), state_(context.state), words_(words) {}

  // ---- strokes ----

  void go(MoveKind kind, Axis axis, const Value &to) {
    const Point start = state_.position;
    state_.at(axis) = to;
    tell(context_, kind, start);
  }
  void go(MoveKind kind, const Value &x, const Value &z) {
    const Point start = state_.position;
    state_.at(Axis::X) = x;
    state_.at(Axis::Z) = z;
    tell(context_, kind, start);
  }
  /// Strokes somewhere in the box between two corners, behind which the tool is where it was.
  void cutInBox(Point corner, const Point &opposite) {
    const Point here = state_.position; // `corner` may be a part of the state
    state_.position = opposite;
    tell(context_, MoveKind::CutInBox, corner);
    state_.position = here;
  }
  Point at(const Value &x, const Value &z) const {
    Point point = state_.position;
    point[indexOf(Axis::X)] = x;
    point[indexOf(Axis::Z)] = z;
    return point;
  }

  // ---- words ----

  /// X, Z, U or W is written.
  bool namesAxes() const {
    return words_.find('X') || words_.find('Z') ||
           (incrementsByLetter(context_) && (words_.find('U') || words_.find('W')));
  }
  /// Only these letters are written, each for certain; U and W where they are increments.  Nothing turns or mirrors the
  /// strokes, of which no manual says whether their lengths turn with them.
  bool hasOnly(std::string_view letters) const {
    if (interpretation_.mayBe(state_.transformed))
      return false;
    for (const Word &word : context_.tree().wordsOf(context_.block)) {
      const char letter = word.address();
      const bool isIncrement = incrementsByLetter(context_) && (letter == 'U' || letter == 'W');
      if (word.has(Word::kComma) || (!isIncrement && letters.find(letter) == std::string_view::npos))
        return false;
      if (const auto *entry = word.isCode() ? nullptr : words_.find(letter); entry && !context_.certain(entry->present))
        return false;
    }
    return !isOpenTarget(context_, words_);
  }
  std::optional<Value> length(char letter) const {
    const auto *entry = words_.find(letter);
    return entry ? std::optional(entry->value) : std::nullopt;
  }
  /// A word that takes no decimal point (P, Q, D): least increments, whatever parameter DPI says; with a point all the
  /// same, the length itself.  Absent, too, where it depends on the control or a setting: D that is computed, and a
  /// whole D on controls whose D takes a point (Setting 162 of Haas).
  std::optional<Value> lengthInIncrements(char letter) const {
    const auto *entry = words_.find(letter);
    if (!entry)
      return std::nullopt;
    const Word *literal = nullptr;
    for (const Word &word : context_.tree().wordsOf(context_.block))
      if (word.address() == letter && word.isNumber())
        literal = &word;
    if (literal && literal->has(Word::kPoint))
      return interpretation_.literal(literal->number());
    if (letter == 'D' && (!literal || !context_.dialect().hasFanucParameters))
      return std::nullopt;
    return byIncrement(context_, AddressKind::Length, [&](Decimal step) {
      if (!literal)
        return interpretation_.multiply(entry->value, interpretation_.literal(step));
      const Decimal number = literal->number();
      return interpretation_.literal(
          Decimal(number.mantissa(), static_cast<std::uint8_t>(number.scale() + step.scale())));
    });
  }

  // ---- first blocks ----

  /// A block of two that says how the cycle `action` cuts; absent words are vacant, and without any nothing is kept.
  void learn(CodeAction action, const std::optional<Value> &first, const std::optional<Value> &second) {
    if (!first && !second)
      return;
    state_.cycle.retract = firstBlockOf(context_, action);
    state_.cycle.initial = first.value_or(interpretation_.vacant());
    state_.cycle.dwell = second.value_or(interpretation_.vacant());
  }
  /// What it has said; absent: no first block of this cycle is in force that says it (enterTurningCode).
  std::optional<Value> learned(const Value &kept) const {
    const bool isGiven = context_.certain(interpretation_.negation(interpretation_.isVacant(kept)));
    return isGiven ? std::optional(interpretation_.asNumber(kept)) : std::nullopt;
  }
  /// A way back with a sign is an alarm, or what no manual says.
  bool isNegative(const Value &value) const {
    return !context_.certain(
        interpretation_.compare(Relation::GreaterOrEqual, interpretation_.asNumber(value), context_.zero()));
  }

  // ---- values ----

  std::optional<double> constant(const std::optional<Value> &value) const {
    return value ? interpretation_.constantOf(interpretation_.asNumber(*value)) : std::nullopt;
  }
  bool isSame(const Value &a, const Value &b) const {
    return context_.certain(interpretation_.compare(Relation::Equal, a, b));
  }
  bool isZero(const Value &value) const { return isSame(value, context_.zero()); }
  /// Radii as X has them.
  Value twice(const Value &radius) const { return interpretation_.multiply(radius, interpretation_.number(2)); }
  /// `distance` further from `target` than `start` is; where both may be equal, once for Less and once for LessOrEqual
  /// the two sides.
  Value awayFrom(const Value &target, const Value &start, const Value &distance,
                 Relation below = Relation::Less) const {
    return interpretation_.select(interpretation_.compare(below, start, target),
                                  interpretation_.subtract(start, distance), interpretation_.add(start, distance));
  }
  /// At least 0.
  Value notNegative(const Value &value) const {
    return interpretation_.select(interpretation_.compare(Relation::Less, value, context_.zero()), context_.zero(),
                                  value);
  }

private:
  StepContext<R> &context_;
  R &interpretation_;
  MachineState<R> &state_;
  const ExecutedWords<R> &words_;
};

} // namespace feedhold
