#include "proof/symbolic/shop_terms.h"

#include <gtest/gtest.h>

namespace feedhold::prove {
namespace {

using smt::Function;
using smt::Number;
using smt::Sort;
using smt::TermId;
using smt::TermStore;

class ShopTerms : public ::testing::Test {
protected:
  ShopTerms() {
    for (const auto &[id, name] : {std::pair{a, "#1"}, std::pair{b, "#2"}, std::pair{c, "#3"}})
      names.emplace(id, name);
  }
  std::string text(TermId term) { return shopText(store, term, names).value_or("none"); }
  TermId number(int value) { return store.number(Number(value)); }
  TermId fraction(int above, int below) { return store.number(Number(above) / Number(below)); }

  TermStore store;
  TermId a = store.variable("a", Sort::Real);
  TermId b = store.variable("b", Sort::Real);
  TermId c = store.variable("c", Sort::Real);
  TermNames names;
};

TEST_F(ShopTerms, Numbers) {
  EXPECT_EQ(text(number(-12)), "-12");
  EXPECT_EQ(text(fraction(1, 40)), "0.025");
  EXPECT_EQ(text(fraction(-35, 10)), "-3.5");
  EXPECT_EQ(text(fraction(1, 3)), "1/3");
}

TEST_F(ShopTerms, SumsAndProductsKeepTheirOrderOfReading) {
  EXPECT_EQ(text(store.subtract(a, store.add(b, c))), "#1-#2-#3");
  EXPECT_EQ(text(store.subtract(number(5), a)), "-#1+5");
  EXPECT_EQ(text(store.multiply(a, store.add(b, number(1)))), "#1*[#2+1]");
  EXPECT_EQ(text(store.divide(store.add(a, b), store.multiply(b, c))), "[#1+#2]/[#2*#3]");
  EXPECT_EQ(text(store.scale(Number(2), a)), "2*#1");
  EXPECT_EQ(text(store.scale(Number(1) / Number(2), a)), "#1/2");
  EXPECT_EQ(text(store.negate(store.divide(a, b))), "-#1/#2");
}

TEST_F(ShopTerms, FunctionsThatAreChoices) {
  const TermId absolute = store.absolute(store.divide(a, b));
  EXPECT_EQ(text(absolute), "ABS[#1/#2]");
  EXPECT_EQ(text(store.ceiling(absolute)), "FUP[ABS[#1/#2]]");
  EXPECT_EQ(text(store.truncate(a)), "FIX[#1]");
  EXPECT_EQ(text(store.ite(store.lessOrEqual(number(0), a), store.ceiling(a), store.floor(a))), "FUP[#1]");
  EXPECT_EQ(text(store.apply(Function::Sqrt, store.add(a, number(1)))), "SQRT[#1+1]");
}

TEST_F(ShopTerms, WhatHasNoNameIsNotTold) {
  EXPECT_EQ(text(store.add(a, store.variable("any 3", Sort::Real))), "none");
  EXPECT_EQ(text(store.ite(store.less(a, b), a, c)), "none");
}

} // namespace
} // namespace feedhold::prove
