// What holds of abstract numbers and values: they form a lattice, lose no member, and their chains end.
#include "inference/domain/code_set.h"
#include "inference/domain/value.h"
#include "laws/domain_samples.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>

namespace feedhold::laws {
namespace {

RC_GTEST_PROP(AbstractNumbers, HoldEveryResultOfTheirMembers, ()) { expectSound(anySample()); }

RC_GTEST_PROP(AbstractNumbers, AreBelowTheirJoin, ()) {
  const Sample left = anySample();
  const Sample right = anySample();
  const AbstractNumber both = join(left.number, right.number);
  RC_ASSERT(leq(left.number, left.number));
  RC_ASSERT(leq(left.number, both));
  RC_ASSERT(leq(right.number, both));
  RC_ASSERT(both == join(right.number, left.number));
  RC_ASSERT(leq(both, AbstractNumber::any()));
}

RC_GTEST_PROP(AbstractNumbers, KeepInTheirMeetWhatIsInBoth, ()) {
  const Sample left = anySample();
  const Sample right = between(0, 2) == 0 ? anySample() : joined(left, simpleSample());
  const auto common = meet(left.number, right.number);
  for (const double value : left.computed)
    RC_ASSERT((!right.number.contains(value) || (common && common->contains(value))));
  for (const Rational &value : left.real) {
    const bool isInBoth = left.number.containsExactly(value) && right.number.containsExactly(value);
    RC_ASSERT((!isInBoth || (common && common->containsExactly(value))));
  }
  if (common) {
    RC_ASSERT(leq(common->interval(), left.number.interval()));
    RC_ASSERT(leq(common->interval(), right.number.interval()));
  }
}

RC_GTEST_PROP(AbstractNumbers, StayTheSameWhenReducedAgain, ()) {
  const AbstractNumber number = anySample().number;
  const auto again = AbstractNumber::of(number.interval(), number.grid(), number.set(),
                                        number.isExact() ? Exactness::Exact : Exactness::Rounded);
  RC_ASSERT(again.has_value());
  RC_ASSERT(leq(*again, number));
}

RC_GTEST_PROP(AbstractNumbers, CompareAsTheirMembersDo, ()) {
  const Sample left = anySample();
  const Sample right = between(0, 2) == 0 ? left : anySample();
  const auto expectHolds = [](Truth truth, bool seen) { RC_ASSERT((seen ? mayBeTrue(truth) : mayBeFalse(truth))); };
  for (const double a : left.computed) {
    for (const double b : right.computed) {
      expectHolds(isEqual(left.number, right.number), a == b);
      expectHolds(isLess(left.number, right.number), a < b);
      expectHolds(isAtMost(left.number, right.number), a <= b);
    }
  }
  for (const Rational &a : left.real) {
    for (const Rational &b : right.real) {
      expectHolds(isEqual(left.number, right.number), a == b);
      expectHolds(isLess(left.number, right.number), a < b);
      expectHolds(isAtMost(left.number, right.number), a <= b);
    }
  }
}

RC_GTEST_PROP(AbstractNumbers, EndTheirWideningChains, ()) {
  const std::vector<double> thresholds{-10, -1, 0, 0.5, 1, 7, 8, 10, 100};
  AbstractNumber number = simpleSample().number;
  const Sample step = simpleSample();
  int rounds = 0;
  for (int calm = 0; calm < 5;) {
    const AbstractNumber next = between(0, 3) == 0 ? simpleSample().number : add(number, step.number);
    const AbstractNumber widened = widen(number, next, thresholds);
    RC_ASSERT(leq(number, widened));
    RC_ASSERT(leq(next, widened));
    calm = widened == number ? calm + 1 : 0;
    number = widened;
    // Two bounds over ten thresholds each, a grid of three levels, a set of four.
    RC_ASSERT(++rounds < 200);
  }
}

RC_GTEST_PROP(AbstractNumbers, KeepTheSmallerWhenNarrowed, ()) {
  const Sample next = anySample();
  const AbstractNumber old = widen(next.number, anySample().number, {});
  const AbstractNumber narrowed = narrow(old, next.number);
  expectSound({narrowed, next.computed, next.real});
  RC_ASSERT(leq(narrowed.interval(), old.interval()));
}

AbstractValue anyValue() {
  const AbstractNumber number = anySample().number;
  switch (between(0, 4)) {
  case 0: return AbstractValue::vacant();
  case 1: return AbstractValue::vacantOr(number);
  default: return AbstractValue::number(number);
  }
}

RC_GTEST_PROP(AbstractValues, FormALattice, ()) {
  const AbstractValue left = anyValue();
  const AbstractValue right = anyValue();
  const AbstractValue both = join(left, right);
  RC_ASSERT(leq(left, left));
  RC_ASSERT(leq(left, both));
  RC_ASSERT(leq(right, both));
  const AbstractValue widened = widen(left, right, {});
  RC_ASSERT(leq(left, widened));
  RC_ASSERT(leq(right, widened));
  const auto common = meet(left, both);
  RC_ASSERT(common.has_value());
  RC_ASSERT(common->mayBeVacant() == left.mayBeVacant());
  RC_ASSERT(common->mayBeNumber() == left.mayBeNumber());
}

TEST(AbstractValues, KeepAnOriginThatBothHave) {
  const Origin origin{7, Rational(1)};
  const AbstractValue one = AbstractValue::number(AbstractNumber::constant(1.0)).withOrigin(origin);
  const AbstractValue two = AbstractValue::number(AbstractNumber::constant(2.0)).withOrigin(origin);
  EXPECT_EQ(join(one, two).origin(), origin);
  EXPECT_EQ(join(one, two.withOrigin(Origin{7, Rational(2)})).origin(), std::nullopt);
  EXPECT_FALSE(meet(one, two).has_value());
}

CodeSet anyCodes() {
  CodeSet codes = between(0, 3) == 0 ? CodeSet::atEntry() : CodeSet::of(static_cast<std::size_t>(between(0, 64)));
  for (int i = between(0, 4); i > 0; --i)
    codes = join(codes, CodeSet::of(static_cast<std::size_t>(between(0, 64))));
  return codes;
}

RC_GTEST_PROP(CodeSets, FormALattice, ()) {
  const CodeSet left = anyCodes();
  const CodeSet right = anyCodes();
  RC_ASSERT(leq(left, join(left, right)));
  RC_ASSERT(leq(right, join(left, right)));
  RC_ASSERT(((leq(left, right) && leq(right, left)) == (left == right)));
  RC_ASSERT(leq(left, right) == (join(left, right) == right));
}

TEST(AbstractNumbers, AreSmall) { EXPECT_LE(sizeof(AbstractNumber), 160U); }

} // namespace
} // namespace feedhold::laws
