#include "proof/symbolic/increments.h"

#include <algorithm>

namespace feedhold::prove {

using smt::Function;
using smt::Number;
using smt::TermId;
using smt::TermKind;

namespace {

constexpr int kBitsOfDouble = 53;
constexpr int kBitsOfNumber = 30; // of what is rounded to the nearest double
constexpr int kBitsOfSize = 14;   // of what a control with mantissas of 32 bits rounds
constexpr int kBitsOfShort = 30;  // fewer than such a mantissa has
constexpr std::size_t kMostSmall = 32;

Number powerOfTwo(int exponent) {
  const Number power(std::int64_t{1} << std::abs(exponent));
  return exponent < 0 ? Number(1) / power : power;
}

Number commonStep(const Number &a, const Number &b) {
  return gcd(a.numerator() * b.denominator(), b.numerator() * a.denominator()) / (a.denominator() * b.denominator());
}

/// The decimal number that was typed where the control holds this one; absent: it has too many places.
std::optional<Number> typed(const Number &held) {
  const auto hasFewPlaces = [scale = Number(100'000'000)](const Number &number) {
    return (number * scale).isInteger();
  };
  if (hasFewPlaces(held))
    return held;
  const double nearest = held.toDouble();
  const Number decimal = Number::fromTyped(nearest);
  return hasFewPlaces(decimal) && Number::fromDouble(nearest) == held ? std::optional(decimal) : std::nullopt;
}

void append(std::vector<TakenAsSmall> &to, const std::vector<TakenAsSmall> &from) {
  to.insert(to.end(), from.begin(), from.end());
}

} // namespace

TermId shortRounding(smt::TermStore &store, TermId size) { return store.scale(powerOfTwo(-32), size); }

void Increments::setStep(TermId variable, const Number &step) {
  steps_.insert_or_assign(variable, step);
  known_.clear();
  counted_.clear();
}

void Increments::believeInputs(bool believes) {
  believesInputs_ = believes;
  known_.clear();
}

std::optional<Multiple> Increments::of(TermId number) {
  const auto known = known_.find(number);
  if (known != known_.end())
    return known->second;
  std::optional<Multiple> found = find(number);
  if (found && found->small.size() > kMostSmall)
    found.reset();
  return known_.emplace(number, std::move(found)).first->second;
}

std::optional<Multiple> Increments::find(TermId id) {
  const smt::Term &term = store_[id];
  if (term.kind == TermKind::Number) {
    const auto decimal = typed(term.number);
    return decimal ? std::optional(Multiple{store_.number(*decimal), abs(*decimal), abs(term.number - *decimal), {}})
                   : std::nullopt;
  }
  if (const auto step = steps_.find(id); step != steps_.end())
    return Multiple{id, step->second, Number(0), {}};
  if (term.kind == TermKind::Add || (term.kind == TermKind::Multiply && store_.isNumber(term.arguments.front())))
    return ofSum(id);
  if (term.kind == TermKind::Ite)
    return ofChoice(id);
  if (smt::isRounding(term))
    return ofRounded(id);
  return term.sort == smt::Sort::Int ? std::optional(Multiple{id, Number(1), Number(0), {}}) : std::nullopt;
}

std::optional<Multiple> Increments::ofSum(TermId id) {
  const smt::LinearSum sum = store_.linear(id);
  auto all = of(store_.number(sum.constant));
  for (const auto &[part, factor] : sum.terms) {
    const auto decimal = typed(factor);
    const auto one = decimal ? of(part) : std::nullopt;
    if (!all || !one)
      return std::nullopt;
    all->exact = store_.add(all->exact, store_.scale(*decimal, one->exact));
    all->step = commonStep(all->step, abs(*decimal) * one->step);
    all->error += abs(factor) * one->error + abs(factor - *decimal) * powerOfTwo(kBitsOfNumber);
    append(all->small, one->small);
    if (factor != *decimal)
      all->small.push_back({one->exact, kBitsOfNumber});
  }
  return all;
}

std::optional<Multiple> Increments::ofChoice(TermId id) {
  const std::vector<TermId> arguments = store_[id].arguments;
  auto first = of(arguments[1]);
  const auto second = of(arguments[2]);
  if (!first || !second)
    return std::nullopt;
  first->exact = store_.ite(arguments[0], first->exact, second->exact);
  first->step = commonStep(first->step, second->step);
  first->error = std::max(first->error, second->error);
  append(first->small, second->small);
  return first;
}

/// Nearest: half a unit in the last place.  Near: as far away as it says.
std::optional<Multiple> Increments::ofRounded(TermId id) {
  const std::vector<TermId> arguments = store_[id].arguments;
  auto from = of(arguments[0]);
  if (!from)
    return std::nullopt;
  if (store_[id].function == Function::Nearest) {
    from->error += powerOfTwo(kBitsOfNumber - kBitsOfDouble);
    from->small.push_back({arguments[0], kBitsOfNumber});
    return from;
  }
  const smt::LinearSum distance = store_.linear(arguments[1]);
  from->error += abs(distance.constant);
  for (const auto &[size, factor] : distance.terms) {
    from->error += abs(factor) * powerOfTwo(kBitsOfSize);
    from->small.push_back({size, kBitsOfSize});
  }
  return from;
}

std::optional<TermId> Increments::wordOf(TermId number, const Number &increment, std::vector<TakenAsSmall> &small) {
  if (!isUsed())
    return std::nullopt;
  const auto multiple = of(number);
  if (!multiple || !(multiple->step / increment).isInteger() || increment <= multiple->error * Number(4))
    return std::nullopt;
  append(small, multiple->small);
  return multiple->exact;
}

bool Increments::isCounted(TermId number) {
  if (steps_.empty() || smt::isRounding(store_[number]))
    return false;
  if (steps_.contains(number))
    return true;
  if (const auto known = counted_.find(number); known != counted_.end())
    return known->second;
  const smt::Term &term = store_[number];
  const auto first = term.arguments.begin() + (term.kind == TermKind::Ite ? 1 : 0);
  const bool isOne = std::any_of(first, term.arguments.end(), [&](TermId each) { return isCounted(each); });
  return counted_.emplace(number, isOne).first->second;
}

std::optional<TermId> Increments::sumOfWords(TermId sum) {
  if (!isUsed() || !isCounted(sum) || store_.shape(sum).hasRounding)
    return std::nullopt;
  const auto multiple = of(sum);
  return multiple ? std::optional(multiple->exact) : std::nullopt;
}

/// As a control holds what is typed: not what is computed, which may be off by more.
std::optional<TermId> Increments::heldFrom(TermId held) const {
  const smt::Term &term = store_[held];
  if (!smt::isRounding(term))
    return held;
  const TermId typed = term.arguments.front();
  if (term.function == Function::Nearest)
    return typed;
  const auto isShort = [&](TermId size) { return term.arguments[1] == shortRounding(store_, size); };
  const bool isHeld = isShort(typed) || isShort(store_.absolute(typed));
  return isHeld ? std::optional(typed) : std::nullopt;
}

TermId Increments::typedInput(TermId number) const {
  const auto exact = heldFrom(number);
  return exact && steps_.contains(*exact) ? *exact : number;
}

std::optional<Multiple> Increments::typedNumber(TermId number) {
  const TermId typed = heldFrom(number).value_or(number);
  return store_.isNumber(typed) || steps_.contains(typed) ? of(typed) : std::nullopt;
}

/// Rounding keeps the order.  Multiples of one step below 2^30 of it that differ are still different in a mantissa of
/// 31 bits; an input is at most 10^8 of its step.
std::optional<std::pair<TermId, TermId>> Increments::typedPair(TermId a, TermId b) {
  if (!isUsed() || (store_.isNumber(a) && store_.isNumber(b)))
    return std::nullopt;
  const auto first = typedNumber(a), second = first ? typedNumber(b) : std::nullopt;
  if (!first || !second)
    return std::nullopt;
  const Number step = commonStep(first->step, second->step);
  const auto isFew = [&](const Multiple &each) {
    const Number largest = store_.isNumber(each.exact) ? each.step : Number(kMostTypedSteps) * each.step;
    return largest <= powerOfTwo(kBitsOfShort) * step;
  };
  return isFew(*first) && isFew(*second) ? std::optional(std::pair(first->exact, second->exact)) : std::nullopt;
}

bool Increments::isTypedMultiple(TermId number, const Number &step) {
  const auto multiple = isUsed() || store_.isNumber(number) ? typedNumber(number) : std::nullopt;
  return multiple && (multiple->step / step).isInteger();
}

} // namespace feedhold::prove
