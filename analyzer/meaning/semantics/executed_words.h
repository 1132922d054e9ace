// ExecutedWords: the words of a block as the control takes them: scaled, rounded, and dropped where vacant.
#pragma once

#include "meaning/cfg/block_words.h"
#include "meaning/semantics/evaluate.h"

#include <array>
#include <cmath>
#include <vector>

namespace feedhold {

/// A G or M code of the block that the dialect's table has.
struct CodeWord {
  const Code *code;
  char address;
  Span span;
};

template <typename R> struct ExecutedWords {
  struct Entry {
    typename R::Truth present; // false: the value was vacant, the word counts as not written
    typename R::Value value;
    Span span;
  };
  std::vector<CodeWord> codes;
  /// Groups whose code comes from a variable that can hold several.
  std::vector<std::pair<std::uint8_t, typename R::ModalCode>> computed;

  /// A code that is restored may be one that takes the axis words for itself: where they lead is not known.
  bool mayTakeAxes = false;
  /// One of the codes is not known: nothing that the block does can be relied on.
  bool unmodelled = false;
  /// A G code that the control does not have by its manual: a macro that its parameters call, with the other words of
  /// the block as its arguments, or an alarm.
  struct Unlisted {
    CodeName code;
    Span span;
  };
  std::vector<Unlisted> unlisted;

  void clear() {
    unmodelled = false;
    unlisted.clear();
    mayTakeAxes = false;
    codes.clear();
    computed.clear();
    entries.clear();
    slots.fill(kNone);
  }
  /// Whether the word of the letter is written, and not left out for want of a value.
  typename R::Truth present(R &interpretation, char letter) const {
    const Entry *entry = find(letter);
    return entry ? entry->present : interpretation.truth(false);
  }
  const Entry *find(char letter) const {
    const std::uint8_t slot = slots[static_cast<std::size_t>(letter - 'A')];
    return slot == kNone ? nullptr : &entries[slot];
  }
  bool has(CodeAction action) const { return findCode(action) != nullptr; }
  const CodeWord *findCode(CodeAction action) const {
    for (const CodeWord &word : codes)
      if (word.code->action == action)
        return &word;
    return nullptr;
  }

  static constexpr std::uint8_t kNone = 0xff;
  std::vector<Entry> entries;
  std::array<std::uint8_t, 26> slots{};
};

/// Fills `words`; codes that call, return or end are left out: they are nodes of their own.
template <ValueAlgebra R> void readWords(StepContext<R> &context, const ExecuteWords &execute, ExecutedWords<R> &words);

/// The least input increment of an address, in the units in force.
template <ValueAlgebra R>
typename R::Value roundedToIncrement(StepContext<R> &context, const AddressFormat &format,
                                     const typename R::Value &value);

/// Arguments of macro calls follow rules of their own.
enum class PointRule : std::uint8_t { OfAddress, OfArgument };

/// A literal without decimal point is counted in increments or in units: parameter DPI.
template <ValueAlgebra R>
typename R::Value scaledLiteral(StepContext<R> &context, char address, Decimal literal, bool point,
                                PointRule rule = PointRule::OfAddress);

// ---- implementation -----------------------------------------------------------------------------------------------

namespace detail {

/// The digits of a literal that a step of 0.1, 0.01 .. keeps; `half`: rounded, else cut off.
inline Decimal keptDigits(Decimal literal, Decimal step, bool half) {
  std::int64_t divisor = 1;
  for (int scale = step.scale(); scale < literal.scale(); ++scale)
    divisor *= 10;
  const std::int64_t rounding = half ? divisor / 2 : 0;
  return Decimal((literal.mantissa() + (literal.isNegative() ? -rounding : rounding)) / divisor,
                 std::min(literal.scale(), step.scale()));
}

inline bool takesIncrement(const AddressFormat &format, char address) {
  return format.kind == AddressKind::Length || format.kind == AddressKind::Angle ||
         (format.kind == AddressKind::Flexible && address != 'P');
}

/// Coordinates, centres and radii: one parameter says of all of them what a number without a point is (3401#0 of FANUC,
/// #1078 of Mitsubishi, Setting 162 of Haas).  Of other words (Q, E, F) manuals differ.
inline bool followsPointParameter(char address, PointRule rule) {
  return rule == PointRule::OfAddress && std::string_view("XYZUVWABCIJKR").find(address) != std::string_view::npos;
}

/// A word whose value is a lone vacant variable is dropped; for `X-#1` no manual says so, nor the contrary.
/// `value`: of the expression.
template <ValueAlgebra R>
typename R::Truth isWordPresent(StepContext<R> &context, ExpressionId expression, const typename R::Value &value) {
  R &interpretation = context.interpretation;
  if (const auto *negated = std::get_if<Negation>(&context.tree().expressions[expression].node)) {
    const auto operandVacant = interpretation.isVacant(evaluate(context, negated->operand));
    if (interpretation.mayBe(operandVacant))
      return interpretation.negation(
          interpretation.both(operandVacant, interpretation.answer(ControlQuestion::DropsNegatedVacantWord)));
  }
  return interpretation.negation(interpretation.isVacant(value));
}

/// G20 or G21 of the block.
template <ValueAlgebra R> const Code *unitsIn(StepContext<R> &context, const ExecuteWords &execute) {
  if (!execute.traits.mayDo(CodeAction::Inch) && !execute.traits.mayDo(CodeAction::Metric))
    return nullptr;
  const Code *found = nullptr;
  forEachExecutedWord(
      context.tree(), *context.file.model, context.dialect(), context.block, execute, [&](const Word &word) {
        const Code *code = word.address() == 'G' && word.isNumber() ? codeOf(word, context.dialect()) : nullptr;
        if (code && (code->action == CodeAction::Inch || code->action == CodeAction::Metric))
          found = code;
      });
  return found;
}

template <ValueAlgebra R> class WordReader {
public:
  WordReader(StepContext<R> &context, ExecutedWords<R> &words)
      : context_(context), interpretation_(context.interpretation), words_(words) {}

  void run(const ExecuteWords &execute) {
    forEachExecutedWord(context_.tree(), *context_.file.model, context_.dialect(), context_.block, execute,
                        [this](const Word &word) {
                          if (!word.has(Word::kComma))
                            read(word);
                        });
  }

private:
  using Value = typename R::Value;
  using Truth = typename R::Truth;

  void read(const Word &word) {
    if (word.address() == 'G' || word.address() == 'M')
      return readCode(word);
    const AddressFormat &format = formatOf(context_.dialect(), word.address());
    switch (word.form()) {
    case WordForm::Number:
      return add(word, interpretation_.truth(true),
                 scaledLiteral(context_, word.address(), word.number(), word.has(Word::kPoint)));
    case WordForm::Expression: return readExpression(word, format);
    case WordForm::Missing:
      interpretation_.alarm(interpretation_.truth(true), {AlarmKind::NoDataAfterAddress, word.span()});
      return;
    case WordForm::Name: return;
    case WordForm::Broken:
      interpretation_.unmodelled("a word that could not be read", word.span());
      return add(word, interpretation_.unknownTruth(), interpretation_.anyNumber());
    }
  }

  void readExpression(const Word &word, const AddressFormat &format) {
    const bool takesIncrement = context_.behaviour().roundsWords && detail::takesIncrement(format, word.address());
    const auto value = evaluate(context_, word.expression(), {takesIncrement ? format.kind : AddressKind::None});
    add(word, isWordPresent(context_, word.expression(), value),
        roundedToIncrement(context_, format, interpretation_.asNumber(value)));
  }

  void readCode(const Word &word) {
    std::optional<std::uint16_t> tenths = word.tenths();
    if (word.form() == WordForm::Expression)
      tenths = computedCode(word);
    else if (!tenths)
      return interpretation_.unmodelled("a code that could not be read", word.span());
    if (!tenths)
      return;
    const Dialect &dialect = context_.dialect();
    const Code *code = word.address() == 'G' ? findGCode(dialect, *tenths) : findMCode(dialect, *tenths);
    if (code)
      words_.codes.push_back({code, word.address(), word.span()});
    else if (isBuildersCode(dialect, word.address(), *tenths))
      buildersCode(word);
    else if (word.address() == 'G')
      words_.unlisted.push_back({CodeName{'G', *tenths}, word.span()});
  }
  std::optional<std::uint16_t> computedCode(const Word &word) {
    const auto value = evaluate(context_, word.expression());
    const std::optional<double> number =
        interpretation_.constantOf(interpretation_.roundTo(interpretation_.asNumber(value), Decimal(1, 1)));
    if (number && *number >= 0 && *number < 6000 && !interpretation_.mayBe(interpretation_.isVacant(value)))
      return static_cast<std::uint16_t>(std::lround(*number * 10));
    if (context_.certain(interpretation_.isVacant(value)))
      return std::nullopt;
    const auto code = word.address() == 'G' ? interpretation_.codeFrom(value, context_.modes) : std::nullopt;
    if (code && !isMapping(code->first)) {
      words_.computed.push_back(*code);
      words_.mayTakeAxes = words_.mayTakeAxes || mayTakeAxes(code->first, code->second);
    } else
      anyCode(word, value);
    return std::nullopt;
  }
  /// Such a code takes the axis words of the block for itself.
  bool isMapping(std::uint8_t group) const {
    for (const ModalKind kind : {ModalKind::Scaling, ModalKind::Mirror, ModalKind::Rotation})
      if (context_.modes.groupOf(kind) == group)
        return true;
    return false;
  }
  bool mayTakeAxes(std::uint8_t group, const typename R::ModalCode &code) {
    const auto &codes = context_.modes.group(group).codes;
    for (std::size_t i = 0; i < codes.size(); ++i)
      if (const CodeAction action = codes[i]->action;
          action == CodeAction::Unmodelled || action == CodeAction::OtherCycle || action == CodeAction::Skip ||
          isTurningCycle(action) || action == CodeAction::SideCycle || isCirclePocket(action))
        if (interpretation_.mayBe(interpretation_.isOneOf(code, CodeMask{1} << i)))
          return true;
    return false;
  }
  /// A number that is no code of the control, or one that it has and this option lacks.
  Truth mayBeNoCode(const Value &value) {
    const Value number = interpretation_.roundTo(interpretation_.asNumber(value), Decimal(1, 1));
    const Truth isListed = context_.anyOf(std::span(context_.dialect().gCodes), [&](const Code &code) {
      return interpretation_.compare(Relation::Equal, number, interpretation_.number(code.tenths / 10.0));
    });
    return interpretation_.both(interpretation_.unknownTruth(), interpretation_.negation(isListed));
  }
  void anyCode(const Word &word, const Value &value) {
    if (word.address() == 'G') {
      interpretation_.alarm(mayBeNoCode(value), {AlarmKind::GCodeNotUsable, word.span()});
      context_.state.transformed = interpretation_.unknownTruth(); // it may be one that turns or mirrors
      words_.unmodelled = true;
    }
    interpretation_.havoc(context_.state, "a code with a computed number", word.span());
  }
  /// Before the movement of its block or behind it.
  void buildersCode(const Word &word) {
    static constexpr Code kAnything{
        .role = CodeRole::OwnWords, .action = CodeAction::Anything, .meaning = "a code of the machine builder"};
    words_.codes.push_back({&kAnything, word.address(), word.span()});
    interpretation_.havoc(context_.state, kAnything.meaning, word.span());
  }
  void add(const Word &word, Truth present, Value value) {
    if (word.address() < 'A' || word.address() > 'Z') { // `@` and `^`, polar coordinates of LinuxCNC; `$`
      words_.unmodelled = true;
      return interpretation_.havoc(context_.state, "a word whose address is not a letter", word.span());
    }
    std::uint8_t &slot = words_.slots[static_cast<std::size_t>(word.address() - 'A')];
    if (slot == ExecutedWords<R>::kNone) {
      slot = static_cast<std::uint8_t>(words_.entries.size());
      words_.entries.push_back({present, std::move(value), word.span()});
      return;
    }
    auto &entry = words_.entries[slot]; // the later word wins
    entry.value = interpretation_.select(present, value, entry.value);
    entry.present = context_.either(present, entry.present);
    entry.span = word.span();
  }

  StepContext<R> &context_;
  R &interpretation_;
  ExecutedWords<R> &words_;
};

} // namespace detail

template <ValueAlgebra R>
typename R::Value roundedToIncrement(StepContext<R> &context, const AddressFormat &format,
                                     const typename R::Value &value) {
  if (!context.behaviour().roundsWords)
    return value;
  switch (format.kind) {
  case AddressKind::Length:
  case AddressKind::Angle:
    return byIncrement(context, format.kind, [&](Decimal step) { return context.interpretation.roundTo(value, step); });
  case AddressKind::Integer: return context.interpretation.roundTo(value, Decimal(1, 0));
  case AddressKind::None:
  case AddressKind::Rate:
  case AddressKind::Flexible: return value;
  }
  return value;
}

/// More digits than the control counts: FANUC cuts them off; of others it is not known whether they round, or keep
/// them.
template <ValueAlgebra R>
typename R::Value countedLiteral(StepContext<R> &context, const AddressFormat &format, Decimal literal) {
  R &interpretation = context.interpretation;
  return byIncrement(context, format.kind, [&](Decimal step) {
    const Decimal cut = detail::keptDigits(literal, step, false);
    const Decimal rounded = detail::keptDigits(literal, step, true);
    if (cut == literal || context.dialect().hasFanucParameters)
      return interpretation.literal(cut);
    const auto other = interpretation.either(interpretation.literal(rounded), interpretation.literal(literal));
    return interpretation.either(interpretation.literal(cut), other);
  });
}

template <ValueAlgebra R>
typename R::Value scaledLiteral(StepContext<R> &context, char address, Decimal literal, bool point, PointRule rule) {
  const AddressFormat &format = formatOf(context.dialect(), address);
  const bool isCounted = format.kind == AddressKind::Length || format.kind == AddressKind::Angle;
  if (isCounted && context.behaviour().roundsWords && !literal.isInteger())
    return countedLiteral(context, format, literal);
  if (format.kind == AddressKind::Rate && context.behaviour().feedByIncrements && !point && !literal.isZero() &&
      context.dialect().switches.dpi != Switch::On)
    return context.interpretation.either(
        context.interpretation.literal(literal),
        context.interpretation.literal(Decimal(literal.mantissa(), static_cast<std::uint8_t>(literal.scale() + 3))));
  if (point || literal.isZero() || !detail::takesIncrement(format, address) ||
      context.dialect().switches.dpi == Switch::On)
    return context.interpretation.literal(literal);
  const auto inIncrements = byIncrement(context, format.kind, [&](Decimal step) {
    return context.interpretation.literal(
        Decimal(literal.mantissa(), static_cast<std::uint8_t>(literal.scale() + step.scale())));
  });
  if (context.dialect().switches.dpi == Switch::Off)
    return inIncrements;
  R &interpretation = context.interpretation;
  const auto asWritten = interpretation.literal(literal);
  const auto isOn = context.isOn(&Switches::dpi);
  if (detail::followsPointParameter(address, rule))
    return interpretation.select(isOn, asWritten, inIncrements);
  // Whichever the parameter says; a run takes what it says.
  return interpretation.select(isOn, interpretation.either(asWritten, inIncrements),
                               interpretation.either(inIncrements, asWritten));
}

template <ValueAlgebra R>
void readWords(StepContext<R> &context, const ExecuteWords &execute, ExecutedWords<R> &words) {
  words.clear();
  const auto group = context.modes.groupOf(ModalKind::Units);
  const Code *units = group ? detail::unitsIn(context, execute) : nullptr;
  if (!units)
    return detail::WordReader<R>(context, words).run(execute);
  auto &inForce = context.state.codes[*group]; // its words are counted in the units of the block
  const auto before = inForce;
  inForce = context.interpretation.code(*context.modes.indexOf(*units));
  detail::WordReader<R>(context, words).run(execute);
  inForce = before;
}

} // namespace feedhold
