#include "proof/check/certificate.h"

#include <gtest/gtest.h>

namespace feedhold::check {
namespace {

const Polynomial kX = variable(0), kY = variable(1);

Polynomial sum(const Polynomial &left, const Polynomial &right, const Number &factor = 1) {
  Polynomial result = left;
  addTo(result, right, factor);
  return result;
}

/// x >= 1, y >= x, 2 - y > 0 ... and x*y < 1: contradictory by x*(y - x) + (x - 1)*(x - 1) + 2*(x - 1) + (1 - x*y) = 0.
UnsatProblem productClaim() {
  const Polynomial one = constant(1);
  return {{{"x", Range::Real}, {"y", Range::Real}},
          {{{sum(kX, one, -1), Relation::NonNegative},
            {sum(kY, kX, -1), Relation::NonNegative},
            {sum(one, multiply(kX, kY), -1), Relation::Positive}},
           {}}};
}

/// (x-1)(y-x) + (y-x) + (x-1)(x-1) + 2(x-1) + (1-xy) = 0 with a strict part
Certificate productCertificate() {
  return {Combination{{{1, {0, 1}, {}}, {1, {1}, {}}, {1, {0, 0}, {}}, {2, {0}, {}}, {1, {2}, {}}}, {}}, {}};
}

TEST(Checker, AcceptsAProductCertificate) {
  const std::optional<Error> wrong = verify(productClaim(), productCertificate());
  EXPECT_FALSE(wrong.has_value()) << wrong->message;
}

TEST(Checker, RefusesEveryChangedMultiplier) {
  const std::size_t products = std::get<Combination>(productCertificate().step).products.size();
  for (std::size_t index = 0; index < products; ++index) {
    for (const Number &change : {Number(1), Number(-1), Number(1) / 1000, Number(-3)}) {
      Certificate tampered = productCertificate();
      std::get<Combination>(tampered.step).products[index].multiplier += change;
      EXPECT_TRUE(verify(productClaim(), tampered).has_value());
    }
  }
}

TEST(Checker, RefusesWhatIsNotThere) {
  Certificate beyond = productCertificate();
  std::get<Combination>(beyond.step).products[0].hypotheses = {7};
  EXPECT_TRUE(verify(productClaim(), beyond).has_value());
  EXPECT_TRUE(verify(productClaim(), {Combination{}, {}}).has_value());
  EXPECT_TRUE(verify(productClaim(), {ClauseSplit{0}, {}}).has_value());
  EXPECT_TRUE(verify(productClaim(), {SignSplit{kX}, {productCertificate()}}).has_value());
  EXPECT_TRUE(verify(productClaim(), {Tighten{0}, {productCertificate()}}).has_value()) << "x is no integer";
  EXPECT_TRUE(verify(productClaim(), {IntegerSplit{kX, 0}, {productCertificate(), productCertificate()}}).has_value());
}

TEST(Checker, MultipliersAreNotNegative) {
  const Polynomial above = sum(kX, constant(1));
  const UnsatProblem claim{{{"x", Range::Real}}, {{{kX, Relation::NonNegative}, {above, Relation::NonNegative}}, {}}};
  EXPECT_TRUE(verify(claim, {Combination{{{1, {0}, {}}, {-1, {1}, {}}}, {}}, {}}).has_value());
}

TEST(Checker, SquaresAreNotStrict) {
  // -x*x >= 0 holds at x = 0.
  const Constraint flat{scaled(multiply(kX, kX), -1), Relation::NonNegative};
  const UnsatProblem claim{{{"x", Range::Real}}, {{flat}, {}}};
  EXPECT_TRUE(verify(claim, {Combination{{{1, {}, {kX}}, {1, {0}, {}}}, {}}, {}}).has_value());
  const UnsatProblem below{{{"x", Range::Real}}, {{{flat.polynomial, Relation::Positive}}, {}}};
  EXPECT_FALSE(verify(below, {Combination{{{1, {}, {kX}}, {1, {0}, {}}}, {}}, {}}).has_value());
}

TEST(Checker, WeakHypothesesGiveNoStrictContradiction) {
  const UnsatProblem claim{{{"x", Range::Real}},
                           {{{kX, Relation::NonNegative}, {scaled(kX, -1), Relation::NonNegative}}, {}}};
  EXPECT_TRUE(verify(claim, {Combination{{{1, {0}, {}}, {1, {1}, {}}}, {}}, {}}).has_value()) << "x = 0 satisfies it";
}

TEST(Checker, EqualitiesStandInNoProduct) {
  // x = 0 as a product with multiplier 1, -1 - x >= 0 is false at 0, yet x - 1 = 0 used with a sign would hide it.
  const UnsatProblem claim{{{"x", Range::Real}},
                           {{{kX, Relation::Zero}, {sum(scaled(kX, -1), constant(-1)), Relation::Zero}}, {}}};
  EXPECT_TRUE(verify(claim, {Combination{{{1, {0}, {}}, {1, {1}, {}}}, {}}, {}}).has_value());
  const Certificate right{Combination{{}, {{constant(1), 0}, {constant(1), 1}}}, {}};
  EXPECT_FALSE(verify(claim, right).has_value());
  const UnsatProblem weak{{{"x", Range::Real}},
                          {{{kX, Relation::NonNegative}, {sum(kX, constant(1)), Relation::NonNegative}}, {}}};
  const Certificate free{Combination{{}, {{constant(1), 0}, {constant(-1), 1}}}, {}};
  EXPECT_TRUE(verify(weak, free).has_value()) << "free multipliers are for equalities";
}

TEST(Checker, IntegersAreTightenedAndSplit) {
  // 2n = 1 has no integer solution.
  const UnsatProblem odd{{{"n", Range::Integer}}, {{{sum(scaled(kX, 2), constant(-1)), Relation::Zero}}, {}}};
  const Certificate tighten{Tighten{0}, {{Combination{{{1, {1}, {}}}, {{constant(Number(-1) / 2), 0}}}, {}}}};
  const std::optional<Error> wrong = verify(odd, tighten);
  EXPECT_FALSE(wrong.has_value()) << wrong->message;
  const UnsatProblem half{{{"n", Range::Real}}, odd.conjunction};
  EXPECT_TRUE(verify(half, tighten).has_value()) << "a real may be 1/2";
  const Certificate split{
      IntegerSplit{kX, 0},
      {{Combination{{{2, {1}, {}}}, {{constant(1), 0}}}, {}}, {Combination{{{2, {1}, {}}}, {{constant(-1), 0}}}, {}}}};
  EXPECT_FALSE(verify(odd, split).has_value());
  EXPECT_TRUE(verify(half, split).has_value());
}

TEST(Checker, EveryAlternativeNeedsItsBranch) {
  // x > 0, and x <= 0 or x <= -1
  const Constraint positive{kX, Relation::Positive};
  const Clause clause{{{{{scaled(kX, -1), Relation::NonNegative}}, {}},
                       {{{sum(scaled(kX, -1), constant(-1)), Relation::NonNegative}}, {}}}};
  const UnsatProblem claim{{{"x", Range::Real}}, {{positive}, {clause}}};
  const Certificate branch{Combination{{{1, {0}, {}}, {1, {1}, {}}}, {}}, {}};
  EXPECT_FALSE(verify(claim, {ClauseSplit{0}, {branch, branch}}).has_value());
  EXPECT_TRUE(verify(claim, {ClauseSplit{0}, {branch}}).has_value());
  EXPECT_TRUE(verify(claim, {ClauseSplit{0}, {branch, branch, branch}}).has_value());
}

TEST(CheckerText, ComesBack) {
  const Clause clause{
      {{{{kX, Relation::Zero}}, {}}, {{{kY, Relation::Positive}}, {{{{{{kX, Relation::NonNegative}}, {}}}}}}}};
  UnsatProblem claim = productClaim();
  claim.variables[0].name = "#500 (A)";
  claim.conjunction.clauses.push_back(clause);
  claim.conjunction.clauses.push_back(Clause{{clause.alternatives.front()}});
  const Conjunction nested{{{{}, Relation::Zero}}, {clause, Clause{}}};
  claim.conjunction.clauses.push_back(Clause{{Conjunction{}, nested}});
  Result<UnsatProblem> read = readClaim(writeClaim(claim));
  ASSERT_TRUE(read.ok()) << read.error().message;
  EXPECT_EQ(read.value(), claim);

  const Certificate certificate{
      SignSplit{sum(kX, constant(Number(1) / 3))},
      {{IntegerSplit{kY, 4}, {productCertificate(), {Tighten{2}, {productCertificate()}}}},
       {ClauseSplit{0}, {{Combination{{{1, {0}, {kX, kY}}}, {{multiply(kX, kY), 0}}}, {}}, productCertificate()}}}};
  Result<Certificate> again = readCertificate(claim, writeCertificate(claim, certificate));
  ASSERT_TRUE(again.ok()) << again.error().message;
  EXPECT_EQ(again.value(), certificate);
}

TEST(CheckerText, RefusesDamage) {
  const UnsatProblem claim = productClaim();
  const auto refuses = [](const std::string &middle) {
    return !readClaim("(set-logic QF_LRA)" + middle + "(check-sat)").ok();
  };
  EXPECT_FALSE(refuses("(declare-const x Real)(assert (> x 0.0))"));
  EXPECT_TRUE(refuses("(declare-const x Real)(declare-const x Real)"));
  EXPECT_TRUE(refuses("(declare-const x Bool)"));
  EXPECT_TRUE(refuses("(declare-const |1| Real)(assert (> |1| 0.0))"));
  EXPECT_TRUE(refuses("(assert (> z 0.0))"));
  EXPECT_TRUE(refuses("(declare-const x Real)(assert (> x 1.0))"));
  EXPECT_TRUE(refuses("(declare-const x Real)(assert (not (> x 0.0)))"));
  EXPECT_TRUE(refuses("(declare-const x Real)(assert (> (/ x 2.0) 0.0))"));
  EXPECT_TRUE(refuses("(declare-const x Real)(assert (> (/ 2.0 0.0) 0.0))"));
  EXPECT_TRUE(refuses("(declare-const x Real)(assert (> x 0.0)"));
  EXPECT_FALSE(readClaim("(declare-const x Real)(assert (> x 0.0))").ok());
  EXPECT_FALSE(readCertificate(claim, "(guess)").ok());
  EXPECT_FALSE(readCertificate(claim, "(combination (product one 0))").ok());
  EXPECT_FALSE(readCertificate(claim, "(tighten -1)").ok());
  EXPECT_FALSE(readCertificate(claim, "(sign)").ok());
}

} // namespace
} // namespace feedhold::check
