// Claims as SMT-LIB 2, so that any solver can be asked of them: an `assert` for each constraint, then for each clause.
// Of SMT-LIB only what is written here is read back.
#include "proof/check/problem.h"
#include "proof/check/variable_names.h"

#include <algorithm>
#include <array>

namespace feedhold::check {
namespace {

using smt::SExpression;

struct RelationName {
  Relation relation;
  std::string_view name;
};
constexpr std::array<RelationName, 3> kRelations{
    {{Relation::NonNegative, ">="}, {Relation::Positive, ">"}, {Relation::Zero, "="}}};

// ---- writing ----

/// What is true of one constraint, or of one within the clauses.
template <typename Wanted> bool anyConstraint(const Conjunction &conjunction, const Wanted &wanted) {
  return std::any_of(conjunction.constraints.begin(), conjunction.constraints.end(), wanted) ||
         std::any_of(conjunction.clauses.begin(), conjunction.clauses.end(), [&](const Clause &clause) {
           return std::any_of(clause.alternatives.begin(), clause.alternatives.end(),
                              [&](const Conjunction &alternative) { return anyConstraint(alternative, wanted); });
         });
}

std::string logicOf(const UnsatProblem &claim) {
  const bool hasProducts =
      anyConstraint(claim.conjunction, [](const Constraint &constraint) { return degree(constraint.polynomial) > 1; });
  const bool hasIntegers = std::any_of(claim.variables.begin(), claim.variables.end(),
                                       [](const ClaimVariable &v) { return v.range == Range::Integer; });
  return std::string("QF_") + (hasProducts ? "N" : "L") + (hasIntegers ? "I" : "") + "RA";
}

/// `3.0`, `(- (/ 3.0 4.0))`
std::string text(const Number &value) {
  const Number magnitude = abs(value);
  std::string result = magnitude.numerator().toString() + ".0";
  if (!magnitude.isInteger())
    result = "(/ " + result + " " + magnitude.denominator().toString() + ".0)";
  return value.sign() < 0 ? "(- " + result + ")" : result;
}

class Writer {
public:
  explicit Writer(const UnsatProblem &claim) : claim_(claim) {}

  std::string write() const {
    std::string result = "(set-logic " + logicOf(claim_) + ")\n";
    for (const ClaimVariable &variable : claim_.variables)
      result += "(declare-const " + smt::quotedSymbol(variable.name) +
                (variable.range == Range::Integer ? " Int)\n" : " Real)\n");
    for (const std::string &formula : formulas(claim_.conjunction))
      result += "(assert " + formula + ")\n";
    return result + "(check-sat)\n";
  }

private:
  std::string variable(std::uint32_t index) const {
    const ClaimVariable &variable = claim_.variables[index];
    const std::string symbol = smt::quotedSymbol(variable.name);
    return variable.range == Range::Integer ? "(to_real " + symbol + ")" : symbol;
  }
  std::string term(const Monomial &monomial, const Number &coefficient) const {
    if (monomial.empty())
      return text(coefficient);
    const bool isPlain = coefficient == Number(1);
    if (isPlain && monomial.size() == 1)
      return variable(monomial.front());
    std::string result = isPlain ? "(*" : "(* " + text(coefficient);
    for (const std::uint32_t index : monomial)
      result += " " + variable(index);
    return result + ")";
  }
  std::string sum(const Polynomial &polynomial) const {
    if (polynomial.empty())
      return text(Number(0));
    std::string terms;
    for (const auto &[monomial, coefficient] : polynomial)
      terms += " " + term(monomial, coefficient);
    return polynomial.size() == 1 ? terms.substr(1) : "(+" + terms + ")";
  }
  std::string formula(const Constraint &constraint) const {
    const auto known = std::find_if(kRelations.begin(), kRelations.end(),
                                    [&](const RelationName &row) { return row.relation == constraint.relation; });
    return "(" + std::string(known->name) + " " + sum(constraint.polynomial) + " 0.0)";
  }
  /// An `or` of SMT-LIB has two operands at least; `false` is no alternative.
  std::string formula(const Clause &clause) const {
    std::string result = "(or";
    for (const Conjunction &alternative : clause.alternatives)
      result += " " + formula(alternative);
    for (std::size_t count = clause.alternatives.size(); count < 2; ++count)
      result += " false";
    return result + ")";
  }
  std::string formula(const Conjunction &conjunction) const {
    const std::vector<std::string> all = formulas(conjunction);
    if (all.empty())
      return "true";
    if (all.size() == 1)
      return all.front();
    std::string result = "(and";
    for (const std::string &each : all)
      result += " " + each;
    return result + ")";
  }
  std::vector<std::string> formulas(const Conjunction &conjunction) const {
    std::vector<std::string> result;
    for (const Constraint &constraint : conjunction.constraints)
      result.push_back(formula(constraint));
    for (const Clause &clause : conjunction.clauses)
      result.push_back(formula(clause));
    return result;
  }

  const UnsatProblem &claim_;
};

// ---- reading ----

class ClaimReader {
public:
  UnsatProblem claim(std::span<const SExpression> items) {
    if (items.size() < 2 || !items.front().isCall("set-logic") || !items.back().isCall("check-sat"))
      throw Malformed{"the text is no claim: it does not go from `set-logic` to `check-sat`"};
    UnsatProblem claim;
    for (const SExpression &item : items.subspan(1, items.size() - 2))
      if (item.isCall("declare-const"))
        claim.variables.push_back(declared(item));
      else if (item.isCall("assert") && item.items.size() == 2)
        add(claim.conjunction, item.items[1]);
      else
        throw Malformed{"neither `declare-const` nor `assert`"};
    return claim;
  }

private:
  ClaimVariable declared(const SExpression &item) {
    if (item.items.size() != 3 || !item.items[1].isAtom())
      throw Malformed{"a variable without a name"};
    const bool isInteger = item.items[2].isAtom("Int");
    if (!isInteger && !item.items[2].isAtom("Real"))
      throw Malformed{"a variable that is no number"};
    if (Number::parse(item.items[1].atom))
      throw Malformed{"a variable named like a number"};
    names_.add(item.items[1].atom);
    return {item.items[1].atom, isInteger ? Range::Integer : Range::Real};
  }

  void add(Conjunction &conjunction, const SExpression &item) const {
    if (!item.isCall("or")) {
      conjunction.constraints.push_back(constraint(item));
      return;
    }
    Clause clause;
    for (const SExpression &alternative : rest(item))
      if (!alternative.isAtom("false"))
        clause.alternatives.push_back(conjunctionOf(alternative));
    conjunction.clauses.push_back(std::move(clause));
  }
  Conjunction conjunctionOf(const SExpression &item) const {
    Conjunction result;
    if (item.isCall("and"))
      for (const SExpression &part : rest(item))
        add(result, part);
    else if (!item.isAtom("true"))
      add(result, item);
    return result;
  }
  Constraint constraint(const SExpression &item) const {
    for (const auto &[relation, name] : kRelations)
      if (item.isCall(name) && item.items.size() == 3 && item.items[2].isAtom("0.0"))
        return {sum(item.items[1]), relation};
    throw Malformed{"an unknown relation"};
  }
  Polynomial sum(const SExpression &item) const {
    if (!item.isCall("+"))
      return product(item);
    Polynomial result;
    for (const SExpression &term : rest(item))
      addTo(result, product(term));
    return result;
  }
  Polynomial product(const SExpression &item) const {
    if (!item.isCall("*"))
      return factor(item);
    Polynomial result = constant(Number(1));
    for (const SExpression &each : rest(item))
      result = multiply(result, factor(each));
    return result;
  }
  Polynomial factor(const SExpression &item) const {
    if (const std::optional<Number> value = number(item))
      return constant(*value);
    return names_[item.isCall("to_real") && item.items.size() == 2 ? item.items[1] : item];
  }
  /// Absent when it is none.
  static std::optional<Number> number(const SExpression &item) {
    if (item.isAtom())
      return Number::parse(item.atom);
    if (item.isCall("-") && item.items.size() == 2) {
      const std::optional<Number> value = number(item.items[1]);
      return value ? std::optional(-*value) : std::nullopt;
    }
    if (!item.isCall("/") || item.items.size() != 3)
      return std::nullopt;
    const std::optional<Number> dividend = number(item.items[1]);
    const std::optional<Number> divisor = number(item.items[2]);
    return dividend && divisor && !divisor->isZero() ? std::optional(*dividend / *divisor) : std::nullopt;
  }

  VariableNames names_;
};

} // namespace

std::string writeClaim(const UnsatProblem &claim) { return Writer(claim).write(); }

Result<UnsatProblem> readClaim(std::string_view text) {
  const Result<std::vector<SExpression>> items = smt::readSExpressions(text);
  if (!items)
    return items.error();
  try {
    return ClaimReader().claim(items.value());
  } catch (const Malformed &malformed) {
    return Error{malformed.reason};
  }
}

} // namespace feedhold::check
