#include "proof/smt/purify.h"

#include "base/support/check.h"
#include "proof/smt/exact_angles.h"
#include "proof/smt/rounding_facts.h"
#include "proof/smt/square_facts.h"

#include <algorithm>
#include <cmath>
#include <set>

namespace feedhold::smt {
namespace {

class Purifier {
public:
  explicit Purifier(TermStore &store) : store_(store) {}

  Purified run(std::span<const TermId> formulas, Hold holds) {
    Purified result;
    result.formulas = pureFormulas(formulas);
    const bool needsBounds = holds == Hold::Together && hasRoundedDefinitions();
    bounds_.emplace(store_, needsBounds ? std::span<const TermId>(result.formulas) : std::span<const TermId>());
    if (needsBounds)
      boundDefinitions(result.formulas);
    // Facts may speak of further functions (an arc sine of its sine); those have facts of their own.
    stateDefinitions();
    for (const TermId square : std::vector<TermId>(squares_)) // a proof would have to guess which sum to square
      fact(store_.lessOrEqual(number(Number(0)), square));
    for (const TermId formula : squareFacts(store_, result.formulas))
      fact(formula);
    stateOrders(result.formulas);
    result.facts = std::move(facts_);
    result.definitions = std::move(definitions_);
    return result;
  }

  /// What is learnt from formulas without rounding may bound what stands in others, so that these can do without, too.
  std::optional<std::vector<TermId>> unrounded(std::span<const TermId> formulas) {
    const std::vector<TermId> purified = pureFormulas(formulas);
    if (!hasRoundedDefinitions())
      return std::nullopt;
    bounds_.emplace(store_, purified);
    boundDefinitions(purified);
    const auto find = [&] {
      return withoutRounding(store_, formulas, [this](TermId term) { return bounds_->of(pure(term)); });
    };
    std::vector<TermId> found = find();
    if (std::ranges::none_of(found, [&](TermId each) { return store_.shape(each).hasRounding; }))
      return found;
    std::erase_if(found, [&](TermId each) { return store_.shape(each).hasFunctions; });
    bounds_->learn(found);
    return find();
  }

private:
  std::vector<TermId> pureFormulas(std::span<const TermId> formulas) {
    for (TermId variable : variablesOf(store_, formulas))
      FEEDHOLD_CHECK(!store_[variable].name.starts_with('!'), "names that begin with `!` are for new variables");
    std::vector<TermId> purified;
    for (TermId formula : formulas)
      purified.push_back(pure(formula));
    return purified;
  }
  bool hasRoundedDefinitions() const {
    return std::ranges::any_of(definitions_,
                               [&](const Definition &each) { return isRounding(store_[each.application]); });
  }

  TermId pure(TermId formula) {
    if (isPlain(formula))
      return formula;
    for (TermId id : reachable(store_, std::span(&formula, 1))) {
      if (isPlain(id) || done_.contains(id))
        continue;
      const TermKind kind = store_[id].kind;
      std::vector<TermId> arguments = store_[id].arguments;
      for (TermId &argument : arguments)
        argument = isPlain(argument) ? argument : done_.at(argument);
      const TermId over = arguments == store_[id].arguments ? id : withArguments(store_, id, arguments);
      if (isSquareOfSum(store_, store_[over]))
        squares_.push_back(over);
      done_.emplace(id, kind == TermKind::Divide || kind == TermKind::Apply ? named(over) : over);
    }
    return done_.at(formula);
  }

  /// Nothing in it gets a name or a fact.
  bool isPlain(TermId id) const {
    const TermShape &shape = store_.shape(id);
    return !shape.hasFunctions && !shape.hasSquares;
  }

  /// Folding may have left a number, or a sum with an application in it.
  TermId named(TermId id) {
    Substitution inside;
    for (TermId part : reachable(store_, std::span(&id, 1)))
      if (store_[part].kind == TermKind::Divide || store_[part].kind == TermKind::Apply)
        inside.emplace(part, variableFor(part));
    return inside.empty() ? id : substitute(store_, id, inside);
  }

  TermId variableFor(TermId application) {
    if (auto known = variables_.find(application); known != variables_.end())
      return known->second;
    const Term &term = store_[application];
    const std::string kind = term.kind == TermKind::Divide ? "quotient" : std::string(nameOf(term.function));
    const Sort sort = term.sort;
    TermId variable = store_.variable("!" + kind + std::to_string(definitions_.size() + 1), sort);
    variables_.emplace(application, variable);
    definitions_.push_back({variable, application});
    return variable;
  }

  TermId number(const Number &value) { return store_.number(value); }
  TermId equal(TermId left, TermId right) { return store_.equal(left, right); }
  TermId atMost(TermId left, TermId right) { return store_.lessOrEqual(left, right); }
  TermId less(TermId left, TermId right) { return store_.less(left, right); }
  TermId times(TermId left, TermId right) { return store_.multiply(left, right); }
  TermId within(TermId low, TermId term, TermId high) {
    return store_.logicalAnd(atMost(low, term), atMost(term, high));
  }
  TermId within(int low, TermId term, int high) { return within(number(low), term, number(high)); }
  void fact(TermId formula) {
    TermId pureFormula = pure(formula);
    if (pureFormula != store_.yes())
      facts_.push_back(pureFormula);
  }
  void factWhere(TermId condition, TermId formula) { fact(store_.implies(condition, formula)); }

  void state(Definition definition) {
    const std::vector<TermId> arguments = store_[definition.application].arguments;
    const TermId value = definition.variable, x = arguments[0];
    if (store_[definition.application].kind == TermKind::Divide)
      return quotient(value, x, arguments[1]);
    switch (store_[definition.application].function) {
    case Function::Floor: return fact(store_.logicalAnd(atMost(value, x), less(x, store_.add(value, number(1)))));
    case Function::Sqrt: return squareRoot(value, x);
    case Function::Sin: return sine(value, x);
    case Function::Cos: return cosine(value, x);
    case Function::Tan: return tangent(value, x);
    case Function::Asin: return arcSine(value, x);
    case Function::Acos: return arcCosine(value, x);
    case Function::Atan2: return direction(value, x, arguments[1]);
    case Function::Ln: return logarithm(value, x);
    case Function::Exp: return exponential(value, x);
    case Function::Power: return factWhere(less(number(0), x), less(number(0), value));
    case Function::BitAnd:
    case Function::BitOr:
    case Function::BitXor: return;
    case Function::Nearest: return nearest(value, x);
    case Function::Near: return facts(nearFacts(store_, value, x, arguments[1]));
    }
  }

  void nearest(TermId value, TermId x) {
    rounded_.emplace(value, x);
    facts(nearestFacts(store_, *bounds_, value, x));
    if (const auto root = roots_.find(x); root != roots_.end())
      roundedRoot(value, root->second);
    if (const auto sides = differenceOfDoubles(x))
      if (const auto exact = differenceFact(store_, *bounds_, value, sides->first, sides->second))
        fact(*exact);
  }
  /// The sides of a difference of doubles.  A double times a power of two is one.
  std::optional<std::pair<TermId, TermId>> differenceOfDoubles(TermId x) {
    const LinearSum sum = store_.linear(x);
    std::vector<TermId> added, taken;
    for (const auto &[term, factor] : sum.terms) {
      if (!isDouble(term) || !isPowerOfTwo(abs(factor)))
        return std::nullopt;
      (factor.sign() > 0 ? added : taken).push_back(store_.scale(abs(factor), term));
    }
    if (!sum.constant.isZero()) {
      if (Number::fromDouble(sum.constant.toDouble()) != sum.constant)
        return std::nullopt;
      (sum.constant.sign() > 0 ? added : taken).push_back(number(abs(sum.constant)));
    }
    if (added.size() != 1 || taken.size() != 1)
      return std::nullopt;
    return std::pair(added.front(), taken.front());
  }
  static bool isPowerOfTwo(const Number &factor) {
    int exponent = 0;
    return std::frexp(factor.toDouble(), &exponent) == 0.5 && Number::fromDouble(factor.toDouble()) == factor;
  }
  /// Of a number that has the rounded square of a double in it.
  void roundedRoot(TermId value, TermId argument) {
    const TermId exact = exactOf(argument);
    for (const auto &[square, factor] : store_.linear(exact).terms) {
      const TermId product = exactOf(square);
      if (factor == Number(1) && isDouble(square) && isSquare(product))
        facts(rootFacts(store_, value, exact, square, store_[product].arguments[0]));
    }
    if (isSquare(exact))
      facts(rootFacts(store_, value, exact, exact, store_[exact].arguments[0]));
  }
  bool isSquare(TermId id) const {
    const Term &term = store_[id];
    return term.kind == TermKind::Multiply && term.arguments.size() == 2 && term.arguments[0] == term.arguments[1] &&
           isDouble(term.arguments[0]);
  }
  bool isDouble(TermId term) const { return rounded_.contains(term) || store_.isMarkedAsDouble(term); }
  /// A double is rounded to itself.
  TermId exactOf(TermId value) const {
    const auto rounded = rounded_.find(value);
    return rounded == rounded_.end() ? value : rounded->second;
  }
  void facts(const std::vector<TermId> &formulas) {
    for (const TermId formula : formulas)
      fact(formula);
  }

  /// Of rounded numbers that are compared with, or taken from, one another.
  void stateOrders(std::span<const TermId> formulas) {
    std::vector<TermId> roots(formulas.begin(), formulas.end());
    for (const auto &[value, exact] : rounded_)
      roots.push_back(exact);
    std::set<std::pair<TermId, TermId>> pairs;
    for (const TermId id : reachable(store_, roots))
      if (store_[id].kind == TermKind::Add)
        pairsIn(store_.linear(id), pairs);
    for (const auto &[first, second] : pairs)
      stateOrder(first, second);
  }
  /// Each is a double, which is rounded to itself.
  void stateOrder(TermId first, TermId second) {
    facts(orderFacts(store_, *bounds_, {first, exactOf(first)}, {second, exactOf(second)}));
    if (!rounded_.contains(first) || !rounded_.contains(second))
      return;
    facts(orderFacts(store_, *bounds_, {first, exactOf(first)}, {second, second}));
    facts(orderFacts(store_, *bounds_, {first, first}, {second, exactOf(second)}));
  }
  void pairsIn(const LinearSum &sum, std::set<std::pair<TermId, TermId>> &pairs) const {
    constexpr std::size_t kMostPairs = 6; // each may split a proof in two
    for (const auto &[first, factor] : sum.terms)
      for (const auto &[second, other] : sum.terms)
        if (first < second && factor == -other && isDouble(first) && isDouble(second) &&
            (rounded_.contains(first) || rounded_.contains(second)) && pairs.size() < kMostPairs)
          pairs.emplace(first, second);
  }

  /// What is known of a number may depend on functions of others, and the other way round.
  void boundDefinitions(std::span<const TermId> formulas) {
    constexpr int kTimes = 2;
    for (int round = 0; round < kTimes; ++round) {
      for (const Definition &definition : definitions_)
        bound(definition);
      bounds_->learn(formulas);
    }
  }
  void bound(Definition definition) {
    const Term term = store_[definition.application];
    const Interval x = bounds_->of(term.arguments[0]);
    const auto within = [&](const Interval &range) { bounds_->restrict(definition.variable, range); };
    if (term.kind == TermKind::Divide) {
      const Interval divisor = bounds_->of(term.arguments[1]);
      if (const auto range = divisor.contains(0.0) ? std::nullopt : divide(x, divisor))
        within(*range);
      return;
    }
    if (term.function == Function::Floor)
      within(feedhold::floor(x));
    else if (term.function == Function::Nearest)
      within(x);
    else if (term.function == Function::Near)
      within(feedhold::add(x, {-bounds_->of(term.arguments[1]).hi, bounds_->of(term.arguments[1]).hi}));
    else if (term.function == Function::Sin || term.function == Function::Cos)
      within({-1, 1});
    else if (term.function == Function::Sqrt && x.lo >= 0)
      within(sqrt(x).value_or(Interval::all()));
  }
  void stateDefinitions() {
    for (; stated_ < definitions_.size(); ++stated_) {
      bound(definitions_[stated_]);
      state(definitions_[stated_]);
    }
  }

  void quotient(TermId value, TermId dividend, TermId divisor) {
    factWhere(store_.notEqual(divisor, number(0)), equal(times(value, divisor), dividend));
  }

  void squareRoot(TermId value, TermId x) {
    roots_.emplace(value, x);
    if (store_.isNumber(x) && store_[x].number.sign() >= 0) {
      const RootBounds bounds = rootBounds(store_[x].number);
      fact(within(number(bounds.low), value, number(bounds.high)));
    }
    factWhere(atMost(number(0), x), store_.logicalAnd(atMost(number(0), value), equal(times(value, value), x)));
  }

  void sine(TermId value, TermId angle) {
    fact(within(-1, value, 1));
    pythagorean(value, store_.apply(Function::Cos, angle));
    if (store_.isNumber(angle))
      return enclose(value, store_[angle].number);
    signWithin(angle, 0, 180, atMost(number(0), value));
    signWithin(angle, 180, 360, atMost(value, number(0)));
    signWithin(angle, -180, 0, atMost(value, number(0)));
  }

  void cosine(TermId value, TermId angle) {
    fact(within(-1, value, 1));
    pythagorean(value, store_.apply(Function::Sin, angle));
    if (store_.isNumber(angle))
      return enclose(value, store_[angle].number + 90);
    signWithin(angle, -90, 90, atMost(number(0), value));
    signWithin(angle, 90, 270, atMost(value, number(0)));
    signWithin(angle, 270, 360, atMost(number(0), value));
  }

  void tangent(TermId value, TermId angle) {
    const TermId cos = store_.apply(Function::Cos, angle);
    factWhere(store_.notEqual(cos, number(0)), equal(times(value, cos), store_.apply(Function::Sin, angle)));
  }

  void pythagorean(TermId value, TermId other) {
    fact(equal(store_.add(times(value, value), times(other, other)), number(1)));
  }

  void enclose(TermId value, const Number &angle) {
    const Enclosure bounds = encloseSine(angle);
    fact(within(number(bounds.low), value, number(bounds.high)));
  }

  void signWithin(TermId angle, int low, int high, TermId sign) { factWhere(within(low, angle, high), sign); }

  void arcSine(TermId value, TermId x) {
    const TermId defined = within(-1, x, 1);
    factWhere(defined, store_.logicalAnd(within(-90, value, 90), equal(store_.apply(Function::Sin, value), x)));
    factWhere(defined, atMost(number(0), store_.apply(Function::Cos, value)));
  }

  void arcCosine(TermId value, TermId x) {
    const TermId defined = within(-1, x, 1);
    factWhere(defined, store_.logicalAnd(within(0, value, 180), equal(store_.apply(Function::Cos, value), x)));
    factWhere(defined, atMost(number(0), store_.apply(Function::Sin, value)));
  }

  void direction(TermId value, TermId y, TermId x) {
    const TermId zero = number(0);
    const TermId defined = store_.logicalOr(store_.notEqual(x, zero), store_.notEqual(y, zero));
    factWhere(defined, store_.logicalAnd(less(number(-180), value), atMost(value, number(180))));
    factWhere(store_.logicalAnd(defined, atMost(zero, y)), atMost(zero, value));
    factWhere(less(y, zero), less(value, zero));
    factWhere(less(zero, x), store_.logicalAnd(less(number(-90), value), less(value, number(90))));
    const TermId radius = store_.apply(Function::Sqrt, store_.add(times(x, x), times(y, y)));
    factWhere(defined, store_.logicalAnd(equal(y, times(radius, store_.apply(Function::Sin, value))),
                                         equal(x, times(radius, store_.apply(Function::Cos, value)))));
  }

  void logarithm(TermId value, TermId x) {
    factWhere(less(number(0), x), atMost(value, store_.subtract(x, number(1))));
    factWhere(less(number(1), x), less(number(0), value));
    factWhere(store_.logicalAnd(less(number(0), x), less(x, number(1))), less(value, number(0)));
  }

  void exponential(TermId value, TermId x) {
    fact(store_.logicalAnd(less(number(0), value), atMost(store_.add(x, number(1)), value)));
    factWhere(less(x, number(0)), less(value, number(1)));
  }

  TermStore &store_;
  Substitution done_;
  std::map<TermId, TermId> variables_; ///< by application over pure arguments
  std::vector<TermId> squares_;
  std::vector<Definition> definitions_;
  std::size_t stated_ = 0; ///< so many of them
  std::vector<TermId> facts_;
  std::optional<Bounds> bounds_;     ///< of what is pure
  std::map<TermId, TermId> rounded_; ///< variables of nearest(), with what they are rounded from
  std::map<TermId, TermId> roots_;   ///< variables of square roots, with the arguments
};

} // namespace

Purified purify(TermStore &store, std::span<const TermId> formulas, Hold holds) {
  return Purifier(store).run(formulas, holds);
}

std::optional<std::vector<TermId>> withoutRounding(TermStore &store, std::span<const TermId> formulas) {
  return Purifier(store).unrounded(formulas);
}

} // namespace feedhold::smt
