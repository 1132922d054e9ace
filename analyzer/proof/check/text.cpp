// Claims and certificates as text, and back.
#include "base/support/match.h"
#include "proof/check/certificate.h"
#include "proof/smt/s_expression.h"

#include <map>

namespace feedhold::check {
namespace {

using smt::SExpression;

std::string indented(std::size_t depth) { return "\n" + std::string(2 * depth, ' '); }

std::string_view nameOf(Relation relation) {
  switch (relation) {
  case Relation::NonNegative: return ">=0";
  case Relation::Positive: return ">0";
  case Relation::Zero: return "=0";
  }
  return "";
}

/// ` (3/4 x y) (-2)`: each monomial as its coefficient and its variables.
std::string terms(const Claim &claim, const Polynomial &polynomial) {
  std::string text;
  for (const auto &[monomial, coefficient] : polynomial) {
    text += " (" + coefficient.toString();
    for (std::uint32_t index : monomial)
      text += " " + smt::quotedSymbol(claim.variables[index].name);
    text += ")";
  }
  return text;
}

std::string write(const Claim &claim, const Conjunction &conjunction, std::size_t depth) {
  std::string text;
  for (const Constraint &constraint : conjunction.constraints)
    text +=
        indented(depth) + "(" + std::string(nameOf(constraint.relation)) + terms(claim, constraint.polynomial) + ")";
  for (const Clause &clause : conjunction.clauses) {
    text += indented(depth) + "(or";
    for (const Conjunction &alternative : clause.alternatives)
      text += indented(depth + 1) + "(and" + write(claim, alternative, depth + 2) + ")";
    text += ")";
  }
  return text;
}

std::string write(const Claim &claim, const Combination &use, std::size_t depth) {
  std::string text = "combination";
  for (const Product &product : use.products) {
    text += indented(depth) + "(product " + product.multiplier.toString();
    for (std::uint32_t index : product.hypotheses)
      text += " " + std::to_string(index);
    for (const Polynomial &square : product.squares)
      text += " (square" + terms(claim, square) + ")";
    text += ")";
  }
  for (const EqualityUse &use1 : use.equalities)
    text += indented(depth) + "(equality " + std::to_string(use1.hypothesis) + terms(claim, use1.multiplier) + ")";
  return text;
}

std::string write(const Claim &claim, const Certificate &certificate, std::size_t depth) {
  std::string text = "(";
  text += match(
      certificate.step, [&](const Combination &use) { return write(claim, use, depth + 1); },
      [&](const ClauseSplit &split) { return "clause " + std::to_string(split.clause); },
      [&](const IntegerSplit &split) {
        return "integer " + split.bound.toString() + " (" + terms(claim, split.polynomial) + ")";
      },
      [&](const SignSplit &split) { return "sign (" + terms(claim, split.polynomial) + ")"; },
      [&](const Tighten &use) { return "tighten " + std::to_string(use.hypothesis); });
  for (const Certificate &branch : certificate.branches)
    text += indented(depth + 1) + write(claim, branch, depth + 1);
  return text + ")";
}

/// Thrown and caught within this file.
struct Malformed {
  std::string reason;
};

class Reader {
public:
  explicit Reader(const std::vector<ClaimVariable> &variables) {
    for (const ClaimVariable &variable : variables)
      addVariable(variable.name);
  }
  void addVariable(const std::string &name) {
    if (!indexes_.emplace(name, static_cast<std::uint32_t>(indexes_.size())).second)
      throw Malformed{"two variables named `" + name + "`"};
  }

  Conjunction conjunction(std::span<const SExpression> items) const {
    Conjunction result;
    for (const SExpression &item : items) {
      if (item.isCall("or")) {
        Clause clause;
        for (const SExpression &alternative : rest(item)) {
          if (!alternative.isCall("and"))
            throw Malformed{"an alternative does not begin with `and`"};
          clause.alternatives.push_back(conjunction(rest(alternative)));
        }
        result.clauses.push_back(std::move(clause));
      } else {
        result.constraints.push_back({polynomial(rest(item)), relation(item)});
      }
    }
    return result;
  }

  Certificate certificate(const SExpression &item) const {
    if (item.isCall("combination"))
      return {combination(rest(item)), {}};
    if (item.isCall("clause"))
      return {ClauseSplit{index(part(item, 1))}, branches(item, 2)};
    if (item.isCall("integer"))
      return {IntegerSplit{polynomial(part(item, 2).items), number(part(item, 1))}, branches(item, 3)};
    if (item.isCall("sign"))
      return {SignSplit{polynomial(part(item, 1).items)}, branches(item, 2)};
    if (item.isCall("tighten"))
      return {Tighten{index(part(item, 1))}, branches(item, 2)};
    throw Malformed{"an unknown step"};
  }

  static std::span<const SExpression> rest(const SExpression &item, std::size_t from = 1) {
    if (item.items.size() < from)
      throw Malformed{"a list is too short"};
    return std::span(item.items).subspan(from);
  }

private:
  static const SExpression &part(const SExpression &item, std::size_t index) {
    if (item.items.size() <= index)
      throw Malformed{"a list is too short"};
    return item.items[index];
  }

  static Number number(const SExpression &item) {
    std::optional<Number> value = item.isAtom() ? Number::parse(item.atom) : std::nullopt;
    if (!value)
      throw Malformed{"`" + item.atom + "` is no number"};
    return *value;
  }

  static std::uint32_t index(const SExpression &item) {
    const Number value = number(item);
    if (!value.isInteger() || value.sign() < 0 || value > Number(1'000'000'000))
      throw Malformed{"`" + item.atom + "` is no index"};
    return static_cast<std::uint32_t>(value.toDouble());
  }

  static Relation relation(const SExpression &item) {
    for (Relation known : {Relation::NonNegative, Relation::Positive, Relation::Zero})
      if (item.isCall(nameOf(known)))
        return known;
    throw Malformed{"an unknown relation"};
  }

  Polynomial polynomial(std::span<const SExpression> items) const {
    Polynomial result;
    for (const SExpression &item : items) {
      Polynomial term = constant(number(part(item, 0)));
      for (const SExpression &factor : rest(item)) {
        auto found = factor.isAtom() ? indexes_.find(factor.atom) : indexes_.end();
        if (found == indexes_.end())
          throw Malformed{"an unknown variable `" + factor.atom + "`"};
        term = multiply(term, variable(found->second));
      }
      addTo(result, term);
    }
    return result;
  }

  Combination combination(std::span<const SExpression> items) const {
    Combination result;
    for (const SExpression &item : items) {
      if (item.isCall("equality")) {
        result.equalities.push_back({polynomial(rest(item, 2)), index(part(item, 1))});
        continue;
      }
      if (!item.isCall("product"))
        throw Malformed{"neither a product nor an equality"};
      Product product{number(part(item, 1)), {}, {}};
      for (const SExpression &factor : rest(item, 2)) {
        if (factor.isCall("square"))
          product.squares.push_back(polynomial(rest(factor)));
        else
          product.hypotheses.push_back(index(factor));
      }
      result.products.push_back(std::move(product));
    }
    return result;
  }

  std::vector<Certificate> branches(const SExpression &item, std::size_t from) const {
    std::vector<Certificate> result;
    for (const SExpression &branch : rest(item, from))
      result.push_back(certificate(branch));
    return result;
  }

  std::map<std::string, std::uint32_t, std::less<>> indexes_;
};

} // namespace

std::string writeClaim(const Claim &claim) {
  std::string text = "(claim";
  for (const ClaimVariable &variable : claim.variables)
    text += indented(1) + (variable.range == Range::Integer ? "(integer " : "(real ") +
            smt::quotedSymbol(variable.name) + ")";
  return text + write(claim, claim.conjunction, 1) + ")\n";
}

std::string writeCertificate(const Claim &claim, const Certificate &certificate) {
  return write(claim, certificate, 0) + "\n";
}

Result<Claim> readClaim(std::string_view text) {
  Result<std::vector<SExpression>> items = smt::readSExpressions(text);
  if (!items)
    return items.error();
  if (items.value().size() != 1 || !items.value()[0].isCall("claim"))
    return Error{"the text is no claim"};
  try {
    std::span<const SExpression> parts = Reader::rest(items.value()[0]);
    Claim claim;
    Reader reader(claim.variables);
    while (!parts.empty() && (parts[0].isCall("integer") || parts[0].isCall("real"))) {
      if (parts[0].items.size() != 2 || !parts[0].items[1].isAtom())
        return Error{"a variable without a name"};
      claim.variables.push_back({parts[0].items[1].atom, parts[0].isCall("integer") ? Range::Integer : Range::Real});
      reader.addVariable(claim.variables.back().name);
      parts = parts.subspan(1);
    }
    claim.conjunction = reader.conjunction(parts);
    return claim;
  } catch (const Malformed &malformed) {
    return Error{malformed.reason};
  }
}

Result<Certificate> readCertificate(const Claim &claim, std::string_view text) {
  Result<std::vector<SExpression>> items = smt::readSExpressions(text);
  if (!items)
    return items.error();
  if (items.value().size() != 1)
    return Error{"the text is no certificate"};
  try {
    return Reader(claim.variables).certificate(items.value()[0]);
  } catch (const Malformed &malformed) {
    return Error{malformed.reason};
  }
}

} // namespace feedhold::check
