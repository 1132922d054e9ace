#include "proof/decide/discharge.h"

#include "proof/check/certificate.h"
#include "proof/decide/discharge_parts.h"
#include "proof/smt/smtlib.h"

#include <gtest/gtest.h>

namespace feedhold::prove {
namespace {

using smt::Function;
using smt::Number;
using smt::Sort;
using smt::TermId;

class DischargeTest : public testing::Test {
protected:
  TermId number(int value) { return store.number(Number(value)); }
  TermId real(const std::string &name) { return store.variable(name, Sort::Real); }
  TermId within(int low, TermId term, int high) {
    return store.logicalAnd(store.lessOrEqual(number(low), term), store.lessOrEqual(term, number(high)));
  }

  /// Proved, with evidence that reads back and verifies.
  void expectCertified(const Query &query) {
    const Outcome outcome = discharge(store, query);
    ASSERT_TRUE(outcome.proved());
    const Proved &proved = std::get<Proved>(outcome.answer);
    ASSERT_EQ(proved.grade, Grade::Certified);
    const auto &evidence = std::get<CertificateEvidence>(proved.evidence);
    Result<check::UnsatProblem> claim = check::readClaim(evidence.claim);
    ASSERT_TRUE(claim.ok()) << claim.error().message;
    Result<check::Certificate> certificate = check::readCertificate(claim.value(), evidence.certificate);
    ASSERT_TRUE(certificate.ok()) << certificate.error().message;
    const std::optional<Error> wrong = check::verify(claim.value(), certificate.value());
    EXPECT_FALSE(wrong.has_value()) << wrong->message;
  }

  /// Refuted by values under which the assumptions hold and the goal does not, where they can be told exactly.
  void expectRefuted(const Query &query) {
    const Outcome outcome = discharge(store, query);
    const smt::Model *model = outcome.counterexample();
    ASSERT_NE(model, nullptr);
    for (TermId assumption : query.assumptions)
      EXPECT_NE(smt::evaluate(store, assumption, *model), smt::Value(false));
    EXPECT_NE(smt::evaluate(store, query.goal, *model), smt::Value(true));
  }

  smt::TermStore store;
  TermId x = real("#1"), y = real("#2"), z = real("#3");
};

TEST_F(DischargeTest, Folding) {
  expectCertified({{store.less(x, y)}, store.lessOrEqual(x, y)});
  expectCertified({{}, store.less(x, store.add(x, number(1)))});
}

TEST_F(DischargeTest, LinearChains) {
  expectCertified({{store.less(x, y), store.less(y, z)}, store.less(x, z)});
  expectRefuted({{store.less(x, y), store.less(x, z)}, store.less(y, z)});
}

TEST_F(DischargeTest, PassesOfADepth) {
  // n = FUP[#1/#2]: the depth of a iteration, #1/n, is never above #2.
  const TermId iterations = store.ceiling(store.divide(x, y));
  const std::vector<TermId> contract{store.less(number(0), x), store.lessOrEqual(x, number(200)),
                                     store.less(number(0), y), store.lessOrEqual(y, number(20))};
  expectCertified({contract, store.notEqual(iterations, number(0))});
  expectCertified({contract, store.lessOrEqual(store.divide(x, iterations), y)});
}

TEST_F(DischargeTest, RootsOfACircle) {
  const TermId inside = store.subtract(number(289), store.multiply(x, x));
  const TermId root = store.apply(Function::Sqrt, inside);
  expectCertified({{within(-17, x, 17)}, store.lessOrEqual(number(0), inside)});
  expectCertified({{within(-17, x, 17)}, store.lessOrEqual(root, number(17))});
  expectRefuted({{within(-18, x, 17)}, store.lessOrEqual(number(0), inside)});
}

TEST_F(DischargeTest, PointsOfABoltCircle) {
  const TermId cosine = store.apply(Function::Cos, y), sine = store.apply(Function::Sin, y);
  const TermId px = store.multiply(x, cosine), py = store.multiply(x, sine);
  expectCertified({{store.lessOrEqual(number(0), x)}, store.lessOrEqual(px, x)});
  expectCertified({{}, store.equal(store.add(store.multiply(px, px), store.multiply(py, py)), store.multiply(x, x))});
}

TEST_F(DischargeTest, IntegersDoNotMeetFractions) {
  const TermId k = store.variable("k", Sort::Int), q = store.variable("q", Sort::Int);
  expectCertified({{}, store.notEqual(store.scale(Number(3) / 10, k), number(10))});
  expectCertified({{store.equal(store.add(store.scale(6, k), store.scale(4, q)), x), store.less(number(0), x)},
                   store.lessOrEqual(number(2), x)});
}

TEST_F(DischargeTest, WhatIsUndefinedProvesNothing) {
  expectRefuted({{store.less(x, number(0))}, store.less(store.apply(Function::Sqrt, x), number(0))});
  expectRefuted({{store.equal(x, number(0))}, store.equal(store.multiply(x, store.divide(number(1), x)), number(1))});
  const TermId tangent = store.apply(Function::Tan, number(90));
  expectRefuted({{store.less(tangent, number(5))}, store.less(number(5), tangent)});
  // A root in the branch that is not taken.
  const TermId guarded = store.ite(store.less(x, number(0)), number(1), store.apply(Function::Sqrt, x));
  expectRefuted({{store.less(x, number(0))}, store.equal(guarded, number(2))});
}

TEST_F(DischargeTest, BoolsAndConditions) {
  const TermId vacant = store.variable("vacant", Sort::Bool);
  const TermId value = store.ite(vacant, number(0), x);
  expectCertified({{store.logicalNot(vacant), store.notEqual(x, number(0))}, store.notEqual(value, number(0))});
  expectRefuted({{store.notEqual(x, number(0))}, store.notEqual(value, number(0))});
}

TEST_F(DischargeTest, ContradictoryAssumptionsProveAnything) {
  expectCertified({{store.less(x, y), store.less(y, x)}, store.no()});
}

// Satisfiable: v = 0, v1 = 1, w = -1, m = 1/2.  Z3 4.8.12 answers `unsat`; nothing of ours may believe it.
TEST_F(DischargeTest, TwoRootsOfOneNumber) {
  const TermId v = real("v"), v1 = real("v1"), w = real("w"), m = real("m");
  auto square = [&](TermId term) { return store.multiply(term, term); };
  const Query query{{store.less(number(0), m), store.equal(square(v1), store.add(number(1), square(v))),
                     store.equal(square(w), store.add(number(1), square(v))),
                     store.equal(store.multiply(m, w), store.subtract(store.multiply(m, v1), number(1)))},
                    store.no()};
  EXPECT_FALSE(discharge(store, query).proved());
  EXPECT_FALSE(discharge(store, query, {.search = 0}).proved());
  EXPECT_FALSE(discharge(store, query, {.search = 1'000'000, .z3 = 0, .cvc5 = 0}).proved());
}

TEST_F(DischargeTest, SameWorkEveryTime) {
  const TermId inside = store.subtract(number(289), store.multiply(x, x));
  const Query query{{within(-17, x, 17)}, store.lessOrEqual(store.apply(Function::Sqrt, inside), number(17))};
  const Outcome first = discharge(store, query), second = discharge(store, query);
  EXPECT_EQ(first.effort, second.effort);
  EXPECT_EQ(std::get<CertificateEvidence>(std::get<Proved>(first.answer).evidence).certificate,
            std::get<CertificateEvidence>(std::get<Proved>(second.answer).evidence).certificate);
}

TEST_F(DischargeTest, NoBudgetIsUnknown) {
  const Query query{{within(-17, x, 17), store.less(y, store.multiply(x, z))}, store.less(y, store.multiply(z, x))};
  EXPECT_TRUE(discharge(store, query).proved()) << "folding needs no budget";
  const Query hard{{store.equal(store.multiply(x, store.multiply(x, x)), number(2))}, store.less(x, number(1))};
  EXPECT_TRUE(std::holds_alternative<Unknown>(discharge(store, hard, {.search = 10, .z3 = 0, .cvc5 = 0}).answer));
}

TEST_F(DischargeTest, FormulasAreParted) {
  const TermId ofX = store.less(x, number(3)), ofY = store.less(y, number(3)), ofBoth = store.less(y, z);
  const auto parts = independentParts(store, std::vector{ofY, ofX, ofBoth});
  ASSERT_EQ(parts.size(), 2U);
  EXPECT_EQ(parts[0], std::vector{ofX});
  EXPECT_EQ(parts[1], (std::vector{ofY, ofBoth}));
}

/// In a part of their own, whose search has no unknown at all, or a product that those of the other part do not share.
TEST_F(DischargeTest, PartsAreSearchedAlone) {
  const TermId squares = store.add(store.multiply(x, x), store.multiply(y, y));
  const TermId root = store.apply(Function::Sqrt, number(2));
  expectCertified(
      {{store.lessOrEqual(squares, number(4)), store.less(z, store.multiply(z, z))}, store.lessOrEqual(x, number(2))});
  expectCertified({{store.less(z, store.multiply(z, z))}, store.less(root, store.number(Number::fromDouble(1.5)))});
}

} // namespace
} // namespace feedhold::prove
