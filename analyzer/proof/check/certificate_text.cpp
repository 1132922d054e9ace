// Certificates as text, and back.
#include "base/support/match.h"
#include "proof/check/certificate.h"
#include "proof/check/variable_names.h"

namespace feedhold::check {
namespace {

using smt::SExpression;

std::string indented(std::size_t depth) { return "\n" + std::string(2 * depth, ' '); }

/// ` (3/4 x y) (-2)`: each monomial as its coefficient and its variables.
std::string terms(const UnsatProblem &claim, const Polynomial &polynomial) {
  std::string text;
  for (const auto &[monomial, coefficient] : polynomial) {
    text += " (" + coefficient.toString();
    for (std::uint32_t index : monomial)
      text += " " + smt::quotedSymbol(claim.variables[index].name);
    text += ")";
  }
  return text;
}

std::string write(const UnsatProblem &claim, const Combination &use, std::size_t depth) {
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

std::string write(const UnsatProblem &claim, const Certificate &certificate, std::size_t depth) {
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

class CertificateReader {
public:
  explicit CertificateReader(const UnsatProblem &claim) : names_(claim.variables) {}

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

  Polynomial polynomial(std::span<const SExpression> items) const {
    Polynomial result;
    for (const SExpression &item : items) {
      Polynomial term = constant(number(part(item, 0)));
      for (const SExpression &factor : rest(item))
        term = multiply(term, names_[factor]);
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

  VariableNames names_;
};

} // namespace

std::string writeCertificate(const UnsatProblem &claim, const Certificate &certificate) {
  return write(claim, certificate, 0) + "\n";
}

Result<Certificate> readCertificate(const UnsatProblem &claim, std::string_view text) {
  Result<std::vector<SExpression>> items = smt::readSExpressions(text);
  if (!items)
    return items.error();
  if (items.value().size() != 1)
    return Error{"the text is no certificate"};
  try {
    return CertificateReader(claim).certificate(items.value()[0]);
  } catch (const Malformed &malformed) {
    return Error{malformed.reason};
  }
}

} // namespace feedhold::check
