#include "proof/symbolic/shop_terms.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace feedhold::prove {

using smt::Function;
using smt::LinearSum;
using smt::Number;
using smt::Term;
using smt::TermId;
using smt::TermKind;

namespace {

/// How tightly a text holds together: brackets are written where it is looser than its place asks for.
enum class Hold : std::uint8_t { Sum, Product, Whole };

struct Text {
  std::string text;
  Hold hold;
};
using Shown = std::optional<Text>;

std::string inside(const Text &text, Hold least) { return text.hold < least ? "[" + text.text + "]" : text.text; }
Text call(std::string_view function, const Text &argument) {
  return {std::string(function) + "[" + argument.text + "]", Hold::Whole};
}

/// A decimal where there is a short one, else a quotient.
Text textOf(const Number &exact) {
  const double near = exact.toDouble(); // 0.1 as it is written, not the double that stands for it
  const bool isDouble = std::isfinite(near) && Number::fromDouble(near) == exact;
  const Number number = isDouble ? Number::fromTyped(near) : exact;
  constexpr int kMostDecimals = 6;
  Number scaled = number;
  for (int decimals = 0; decimals <= kMostDecimals; ++decimals, scaled *= Number(10)) {
    if (!scaled.isInteger())
      continue;
    std::string digits = abs(scaled).toString();
    if (decimals != 0) {
      const auto places = static_cast<std::size_t>(decimals);
      digits.insert(0, digits.size() <= places ? places + 1 - digits.size() : 0, '0');
      digits.insert(digits.size() - places, ".");
    }
    return {(number.sign() < 0 ? "-" : "") + digits, number.sign() < 0 ? Hold::Sum : Hold::Whole};
  }
  const Hold hold = number.sign() < 0 ? Hold::Sum : Hold::Product;
  return {number.numerator().toString() + "/" + number.denominator().toString(), hold};
}

class Writer {
public:
  Writer(smt::TermStore &store, const TermNames &names) : store_(store), names_(names) {}

  Shown write(TermId id) {
    if (const auto name = names_.find(id); name != names_.end())
      return Text{name->second, Hold::Whole};
    const Term term = store_[id]; // a copy: the store may grow
    switch (term.kind) {
    case TermKind::Number: return textOf(term.number);
    case TermKind::Add: return sum(store_.linear(id));
    case TermKind::Multiply:
      return store_.isNumber(term.arguments[0]) ? sum(store_.linear(id)) : product(term.arguments);
    case TermKind::Divide: return quotient(term.arguments[0], term.arguments[1]);
    case TermKind::Ite: return choice(id, term);
    case TermKind::Apply: return function(term);
    case TermKind::Variable:
    case TermKind::True:
    case TermKind::False:
    case TermKind::Less:
    case TermKind::LessOrEqual:
    case TermKind::Equal:
    case TermKind::And:
    case TermKind::Or:
    case TermKind::Not: return std::nullopt;
    }
    return std::nullopt;
  }

private:
  /// What is added comes first.
  Shown sum(LinearSum linear) {
    std::stable_partition(linear.terms.begin(), linear.terms.end(), [](const auto &t) { return t.second.sign() > 0; });
    std::string text;
    Hold hold = Hold::Whole;
    std::size_t parts = 0;
    for (const auto &[id, factor] : linear.terms) {
      Shown part = scaled(id, factor);
      if (!part)
        return std::nullopt;
      const bool isNegative = part->text.starts_with('-');
      hold = isNegative ? Hold::Sum : part->hold;
      text += isNegative || parts == 0 ? part->text : "+" + part->text;
      ++parts;
    }
    if (!linear.constant.isZero() || parts == 0) {
      const Text part = textOf(linear.constant);
      text += parts == 0 || linear.constant.sign() < 0 ? part.text : "+" + part.text;
      ++parts;
    }
    return Text{std::move(text), parts > 1 ? Hold::Sum : hold};
  }
  Shown scaled(TermId id, const Number &factor) {
    Number size = abs(factor);
    std::string sign = factor.sign() < 0 ? "-" : "";
    const Term term = store_[id];
    Shown part;
    if (factor.sign() < 0 && term.kind == TermKind::Apply && term.function == Function::Floor && falls(term)) {
      part = bracketed("FUP", store_.negate(term.arguments[0]));
      sign.clear();
    } else if (term.kind == TermKind::Divide && size.isInteger()) {
      part = quotient(store_.scale(size, term.arguments[0]), term.arguments[1]);
      size = Number(1);
    } else {
      part = write(id);
    }
    if (!part)
      return std::nullopt;
    if (size == Number(1))
      return Text{sign + (sign.empty() ? part->text : inside(*part, Hold::Product)), part->hold};
    if (size.numerator() == Number(1))
      return Text{sign + inside(*part, Hold::Product) + "/" + textOf(size.denominator()).text, Hold::Product};
    return Text{sign + inside(textOf(size), Hold::Whole) + "*" + inside(*part, Hold::Whole), Hold::Product};
  }
  /// The ceiling of something: what is rounded is written with a minus.  FUP goes away from zero, so that `FUP[-x]` is
  /// not `-FIX[x]`.
  bool falls(const Term &floor) const {
    const LinearSum sum = store_.linear(floor.arguments[0]);
    return std::any_of(sum.terms.begin(), sum.terms.end(), [](const auto &part) { return part.second.sign() < 0; });
  }
  Shown product(const std::vector<TermId> &factors) {
    std::string text;
    for (const TermId factor : factors) {
      const Shown part = write(factor);
      if (!part)
        return std::nullopt;
      text += (text.empty() ? "" : "*") + inside(*part, Hold::Whole);
    }
    return Text{std::move(text), Hold::Product};
  }
  Shown quotient(TermId dividend, TermId divisor) {
    const Shown above = write(dividend);
    const Shown below = write(divisor);
    if (!above || !below)
      return std::nullopt;
    return Text{inside(*above, Hold::Product) + "/" + inside(*below, Hold::Whole), Hold::Product};
  }

  Shown bracketed(std::string_view name, TermId argument) {
    const Shown text = write(argument);
    return text ? Shown(call(name, *text)) : std::nullopt;
  }
  /// ABS, FIX and FUP are choices by the sign of their argument.
  Shown choice(TermId id, const Term &term) {
    for (const std::size_t branch : {1, 2}) {
      const TermId inner = term.arguments[branch];
      if (store_.absolute(inner) == id)
        return bracketed("ABS", inner);
      for (const TermId below : smt::reachable(store_, std::array{inner})) {
        const Term floor = store_[below];
        if (floor.kind != TermKind::Apply || floor.function != Function::Floor)
          continue;
        for (const TermId argument : {floor.arguments[0], store_.negate(floor.arguments[0])}) {
          if (store_.truncate(argument) == id)
            return bracketed("FIX", argument);
          const TermId isPositive = store_.lessOrEqual(store_.number(Number(0)), argument);
          if (store_.ite(isPositive, store_.ceiling(argument), store_.floor(argument)) == id)
            return bracketed("FUP", argument);
        }
      }
    }
    return std::nullopt;
  }
  Shown function(const Term &term) {
    switch (term.function) {
    case Function::Floor: return bracketed("FIX", term.arguments[0]);
    case Function::Sqrt: return bracketed("SQRT", term.arguments[0]);
    case Function::Sin: return bracketed("SIN", term.arguments[0]);
    case Function::Cos: return bracketed("COS", term.arguments[0]);
    case Function::Tan: return bracketed("TAN", term.arguments[0]);
    case Function::Asin: return bracketed("ASIN", term.arguments[0]);
    case Function::Acos: return bracketed("ACOS", term.arguments[0]);
    case Function::Ln: return bracketed("LN", term.arguments[0]);
    case Function::Exp: return bracketed("EXP", term.arguments[0]);
    case Function::Atan2: {
      const Shown y = write(term.arguments[0]);
      const Shown x = write(term.arguments[1]);
      return y && x ? Shown(Text{"ATAN[" + y->text + "]/[" + x->text + "]", Hold::Product}) : std::nullopt;
    }
    case Function::Power:
    case Function::BitAnd:
    case Function::BitOr:
    case Function::BitXor: return std::nullopt;
    case Function::Nearest: // what the same words give in a program
    case Function::Near: return write(term.arguments[0]);
    }
    return std::nullopt;
  }

  smt::TermStore &store_;
  const TermNames &names_;
};

} // namespace

std::optional<std::string> shopText(smt::TermStore &store, TermId term, const TermNames &names) {
  const Shown text = Writer(store, names).write(term);
  return text ? std::optional(text->text) : std::nullopt;
}

} // namespace feedhold::prove
