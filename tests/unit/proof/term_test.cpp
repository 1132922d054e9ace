#include "proof/smt/model.h"
#include "proof/smt/smtlib.h"
#include "proof/smt/term.h"

#include <gtest/gtest.h>

namespace feedhold::smt {
namespace {

class Terms : public testing::Test {
protected:
  TermId number(int value) { return store.number(Number(value)); }

  TermStore store;
  TermId x = store.variable("#1", Sort::Real);
  TermId y = store.variable("#2", Sort::Real);
  TermId n = store.variable("n", Sort::Int);
};

TEST(NumberTest, ReadsExactly) {
  EXPECT_EQ(Number::parse("0.25"), Number(1) / 4);
  EXPECT_EQ(Number::parse("-6/4"), Number(-3) / 2);
  EXPECT_EQ(Number::parse("1/0"), std::nullopt);
  EXPECT_EQ(Number::parse("1."), std::nullopt);
  EXPECT_EQ(Number::parse(""), std::nullopt);
  EXPECT_EQ(floor(Number(-1) / 2), Number(-1));
  EXPECT_EQ(ceiling(Number(-1) / 2), Number(0));
  EXPECT_EQ(exactSquareRoot(Number(9) / 4), Number(3) / 2);
  EXPECT_EQ(exactSquareRoot(Number(2)), std::nullopt);
}

TEST(NumberTest, GoesToTheNearestDouble) {
  for (const double value : {0.1, -0.1, 0.11, 0.7, 12.3, 1e-300, 1e300, 0.0, 5e-324})
    EXPECT_EQ(Number::fromTyped(value).toDouble(), value);
  EXPECT_EQ((Number(2) / 3).toDouble(), 2.0 / 3);
}

TEST_F(Terms, SumsHaveOneForm) {
  EXPECT_EQ(store.add(x, y), store.add(y, x));
  EXPECT_EQ(store.subtract(store.add(x, y), y), x);
  EXPECT_EQ(store.subtract(x, x), number(0));
  EXPECT_EQ(store.scale(Number(1) / 2, store.add(x, x)), x);
  EXPECT_EQ(store.multiply(number(3), store.add(x, number(2))), store.add(store.scale(3, x), number(6)));
}

TEST_F(Terms, ComparisonsFold) {
  EXPECT_EQ(store.less(x, store.add(x, number(1))), store.yes());
  EXPECT_EQ(store.lessOrEqual(store.scale(2, x), number(4)), store.lessOrEqual(x, number(2)));
  EXPECT_EQ(store.logicalNot(store.less(x, y)), store.lessOrEqual(y, x));
  EXPECT_EQ(store.less(n, number(3)), store.lessOrEqual(n, number(2)));
  EXPECT_EQ(store.equal(store.scale(2, n), number(5)), store.no());
  EXPECT_EQ(store.logicalAnd(store.less(x, y), store.lessOrEqual(y, x)), store.no());
}

TEST_F(Terms, ConditionsFold) {
  const TermId condition = store.less(x, y);
  EXPECT_EQ(store.ite(condition, x, x), x);
  EXPECT_EQ(store.ite(store.yes(), x, y), x);
  EXPECT_EQ(store.ite(condition, store.ite(condition, x, y), y), store.ite(condition, x, y));
}

TEST_F(Terms, FunctionsFoldWhereTheyAreExact) {
  EXPECT_EQ(store.apply(Function::Sin, number(30)), store.number(Number(1) / 2));
  EXPECT_EQ(store.apply(Function::Cos, number(-180)), number(-1));
  EXPECT_EQ(store[store.apply(Function::Sin, number(60))].kind, TermKind::Apply);
  EXPECT_EQ(store.apply(Function::Sqrt, number(9)), number(3));
  EXPECT_EQ(store[store.apply(Function::Sqrt, number(-1))].kind, TermKind::Apply);
  EXPECT_EQ(store.floor(store.add(x, number(2))), store.add(store.floor(x), number(2)));
  EXPECT_EQ(store.floor(n), n);
  EXPECT_EQ(store[store.divide(x, number(0))].kind, TermKind::Divide);
}

TEST_F(Terms, RootsOfNumbersMultiply) {
  const auto root = [&](int of) { return store.apply(Function::Sqrt, number(of)); };
  EXPECT_EQ(store.multiply(root(2), root(8)), number(4));
  EXPECT_EQ(store.multiply(root(2), root(3)), root(6));
  EXPECT_EQ(store.multiply(store.multiply(x, root(2)), root(2)), store.scale(Number(2), x));
  EXPECT_EQ(store.multiply(store.add(x, root(2)), root(2)), store.add(store.multiply(x, root(2)), number(2)));
  EXPECT_EQ(store[store.multiply(root(-1), root(-1))].kind, TermKind::Multiply); // which no real numbers are
}

TEST_F(Terms, SubstitutionFoldsAgain) {
  const TermId formula = store.less(store.multiply(x, y), number(10));
  EXPECT_EQ(substitute(store, formula, {{x, number(2)}, {y, number(5)}}), store.no());
  EXPECT_EQ(substitute(store, formula, {{x, number(2)}}), store.less(y, number(5)));
}

TEST_F(Terms, EvaluatesOnlyWhatDecides) {
  const TermId formula = store.logicalOr(store.less(number(0), x), store.less(y, number(0)));
  EXPECT_EQ(evaluate(store, formula, {{"#1", Number(1)}}), Value(true));
  EXPECT_EQ(evaluate(store, formula, {{"#1", Number(-1)}}), std::nullopt);
  EXPECT_EQ(evaluate(store, store.divide(number(1), x), {{"#1", Number(0)}}), std::nullopt);
}

TEST_F(Terms, SmtLibComesBack) {
  const TermId product = store.multiply(x, y);
  const TermId both = store.add(product, store.scale(Number(-3) / 4, n));
  const std::vector<TermId> formulas{
      store.lessOrEqual(both, store.ite(store.less(x, y), both, store.divide(x, y))), store.notEqual(store.floor(x), n),
      store.logicalOr(store.less(store.apply(Function::Sin, x), number(0)), store.variable("b", Sort::Bool))};
  Result<std::vector<TermId>> read = readSmtLib(store, writeSmtLib(store, formulas));
  ASSERT_TRUE(read.ok()) << read.error().message;
  EXPECT_EQ(read.value(), formulas);
}

TEST_F(Terms, SmtLibRefusesWhatItDoesNotKnow) {
  EXPECT_FALSE(readSmtLib(store, "(assert (forall ((z Real)) (< z 0)))").ok());
  EXPECT_FALSE(readSmtLib(store, "(assert (< unknown 0))").ok());
  EXPECT_FALSE(readSmtLib(store, "(assert (< 0 1)").ok());
}

TEST_F(Terms, SharedTermsArePrintedOnce) {
  TermId power = x;
  for (int i = 0; i < 40; ++i)
    power = store.multiply(store.add(power, number(1)), store.add(power, number(2)));
  const TermId formula = store.less(power, number(0));
  EXPECT_LT(writeSmtLib(store, std::vector{formula}).size(), 20'000u);
}

} // namespace
} // namespace feedhold::smt
