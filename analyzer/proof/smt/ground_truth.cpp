#include "proof/smt/ground_truth.h"

#include "base/support/check.h"
#include "proof/smt/bounds.h"

namespace feedhold::smt {
namespace {

/// Terms are built from others that were enclosed before: deeper ones are not looked at.
constexpr int kDeepest = 1'000;

bool isWithin(const Interval &value, double low, double high) { return low <= value.lo && value.hi <= high; }

} // namespace

std::optional<bool> GroundTruth::truth(TermId condition, int depth) {
  if (depth > kDeepest)
    return std::nullopt;
  const Term &term = store_[condition];
  switch (term.kind) {
  case TermKind::True: return true;
  case TermKind::False: return false;
  case TermKind::Not: {
    const std::optional<bool> inner = truth(term.arguments[0], depth + 1);
    return inner ? std::optional(!*inner) : std::nullopt;
  }
  case TermKind::And:
  case TermKind::Or: {
    const bool deciding = term.kind == TermKind::Or;
    bool isKnown = true;
    for (const TermId part : term.arguments) {
      const std::optional<bool> known = truth(part, depth + 1);
      if (known == deciding)
        return deciding;
      isKnown = isKnown && known.has_value();
    }
    return isKnown ? std::optional(!deciding) : std::nullopt;
  }
  case TermKind::Less:
  case TermKind::LessOrEqual:
  case TermKind::Equal: return comparison(term, depth + 1);
  case TermKind::Variable: return std::nullopt;
  case TermKind::Number:
  case TermKind::Add:
  case TermKind::Multiply:
  case TermKind::Divide:
  case TermKind::Ite:
  case TermKind::Apply: break;
  }
  FEEDHOLD_UNREACHABLE("a number is no condition");
}

std::optional<bool> GroundTruth::comparison(const Term &term, int depth) {
  const std::optional<Interval> left = enclose(term.arguments[0], depth), right = enclose(term.arguments[1], depth);
  if (!left || !right)
    return std::nullopt;
  if (term.kind == TermKind::Equal)
    return left->hi < right->lo || right->hi < left->lo ? std::optional(false) : std::nullopt;
  if (left->hi < right->lo)
    return true;
  if (right->hi < left->lo)
    return false;
  // Bounds that touch are met by numbers that are known exactly alone.
  if (left->isConstant() && right->isConstant())
    return term.kind == TermKind::LessOrEqual;
  return std::nullopt;
}

std::optional<Interval> GroundTruth::enclose(TermId id, int depth) {
  if (depth > kDeepest)
    return std::nullopt;
  if (const auto known = known_.find(id.index()); known != known_.end())
    return known->second;
  const std::optional<Interval> interval = found(store_[id], depth + 1);
  known_.emplace(id.index(), interval);
  return interval;
}

std::optional<Interval> GroundTruth::found(const Term &term, int depth) {
  switch (term.kind) {
  case TermKind::Number: return around(term.number);
  case TermKind::Add:
  case TermKind::Multiply: {
    std::optional<Interval> result = enclose(term.arguments[0], depth);
    for (std::size_t i = 1; result && i < term.arguments.size(); ++i) {
      const std::optional<Interval> next = enclose(term.arguments[i], depth);
      if (!next)
        return std::nullopt;
      result = term.kind == TermKind::Add ? add(*result, *next) : multiply(*result, *next);
    }
    return result;
  }
  case TermKind::Divide: {
    const std::optional<Interval> above = enclose(term.arguments[0], depth), below = enclose(term.arguments[1], depth);
    return above && below && !below->contains(0) ? divide(*above, *below) : std::nullopt;
  }
  case TermKind::Ite: {
    const std::optional<bool> condition = truth(term.arguments[0], depth);
    return condition ? enclose(term.arguments[*condition ? 1 : 2], depth) : std::nullopt;
  }
  case TermKind::Apply: return ofFunction(term, depth);
  case TermKind::Variable:
  case TermKind::True:
  case TermKind::False:
  case TermKind::Not:
  case TermKind::And:
  case TermKind::Or:
  case TermKind::Less:
  case TermKind::LessOrEqual:
  case TermKind::Equal: break;
  }
  return std::nullopt;
}

std::optional<Interval> GroundTruth::ofFunction(const Term &term, int depth) {
  const std::optional<Interval> x = enclose(term.arguments[0], depth);
  if (!x)
    return std::nullopt;
  switch (term.function) {
  case Function::Floor: return floor(*x);
  case Function::Sqrt: return x->lo >= 0 ? sqrt(*x) : std::nullopt;
  case Function::Sin: return sin(*x);
  case Function::Cos: return cos(*x);
  case Function::Asin: return isWithin(*x, -1, 1) ? asin(*x) : std::nullopt;
  case Function::Acos: return isWithin(*x, -1, 1) ? acos(*x) : std::nullopt;
  case Function::Ln: return x->lo > 0 ? ln(*x) : std::nullopt;
  case Function::Exp: return exp(*x);
  case Function::Atan2: {
    const std::optional<Interval> other = enclose(term.arguments[1], depth);
    return other && !(x->contains(0) && other->contains(0)) ? std::optional(atan2Degrees(*x, *other)) : std::nullopt;
  }
  case Function::Nearest: return x; // bounds of intervals are those of rounded results, too
  case Function::Near: {
    const std::optional<Interval> distance = enclose(term.arguments[1], depth);
    return distance ? std::optional(add(*x, {-distance->hi, distance->hi})) : std::nullopt;
  }
  case Function::Tan:
  case Function::Power:
  case Function::BitAnd:
  case Function::BitOr:
  case Function::BitXor: return std::nullopt;
  }
  FEEDHOLD_UNREACHABLE("a new function needs its enclosure");
}

} // namespace feedhold::smt
