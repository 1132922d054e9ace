// What a called program finds, and what its caller finds behind the call, for every interpretation.
#include "dialects/registry.h"
#include "inference/absint/abstract_state.h"
#include "language/parse/parse.h"
#include "meaning/machine/concrete_interpretation.h"
#include "meaning/semantics/frames.h"
#include "proof/symbolic/symbolic_interpretation.h"

#include <gtest/gtest.h>

namespace feedhold {
namespace {

using prove::SymbolicInterpretation;

const Dialect &dialect() { return *findDialect(allDialects(), "linuxcnc"); }

/// Each interpretation, and whether a value may be, and must be, a number.
struct Concrete {
  ConcreteInterpretation interpretation{dialect(), {}};
  static constexpr bool followsOne = true; // where a manual is silent
  bool mayBe(const ConcreteValue &value, double number) { return value == ConcreteValue::of(number); }
  bool isOnly(const ConcreteValue &value, double number) { return mayBe(value, number); }
};
struct Abstract {
  AbstractInterpretation interpretation{dialect()};
  static constexpr bool followsOne = false;
  bool mayBe(const AbstractValue &value, double number) {
    return value.mayBeNumber() && value.number().contains(number);
  }
  bool isOnly(const AbstractValue &value, double number) { return interpretation.constantOf(value) == number; }
};
struct Symbolic {
  smt::TermStore store;
  SymbolicInterpretation interpretation{store, dialect()};
  static constexpr bool followsOne = false;
  /// One of the cases of the value.
  bool mayBe(const prove::SymbolicValue &value, double number) {
    const smt::TermId wanted = interpretation.number(number).number;
    const auto &term = store[value.number];
    const bool isCase = term.kind == smt::TermKind::Ite && (term.arguments[1] == wanted || term.arguments[2] == wanted);
    return isOnly(value, number) || isCase;
  }
  bool isOnly(const prove::SymbolicValue &value, double number) {
    return value.vacant == store.no() && value.number == interpretation.number(number).number;
  }
};

template <typename Interpretation> class Frames : public ::testing::Test {
protected:
  using R = decltype(Interpretation::interpretation);
  using Value = typename R::Value;

  Frames() {
    state.locals.fill(number(1));
    state.variables.set(own, number(2));
    state.variables.set(shared, number(3));
    state.enteredLoops = {{1, interpretation.truth(false)}};
    state.counters = {number(4)};
    state.modalCallsUnknown = interpretation.truth(false);
    request.callee = callee;
    request.freshLocals = true;
    request.locals.fill(number(5));
  }
  Value number(double value) { return interpretation.number(value); }
  double of(std::uint32_t variable, double value) { return is.isOnly(*state.variables.find(variable), value); }
  Frame<R> enter(double repeats = 1, std::optional<std::size_t> modal = {}, std::optional<std::size_t> limit = {}) {
    return enterCall(programs, state, request, {place, modal, limit}, repeats, interpretation, count);
  }

  SourceFile source = SourceFile::fromText("t.ngc", "o1 sub\n#<own>=1\n#<_all>=1\no1 endsub\no1 call\nm2\n");
  SyntaxTree tree = parse(source, dialect());
  ProgramModel model = resolve(source, tree, dialect());
  ProgramSet programs{{{FileId(0), &source, &tree, &model, &dialect()}}, CallGraph({{FileId(0), "", "", &model}})};
  std::uint32_t own = *programs.variableNamed("own");
  std::uint32_t shared = *programs.variableNamed("_all");
  Callee callee{FileId(0), programs.file(FileId(0)).cfg.entryOf(ProgramId(1)), ProgramId(1)};
  Place place{FileId(0), NodeId(0)};
  Interpretation is;
  R &interpretation = is.interpretation;
  MachineState<R> state{};
  CallRequest<R> request;
  int entries = 0;
  std::function<void(const Frame<R> &, const MachineState<R> &)> count = [this](const Frame<R> &,
                                                                                const MachineState<R> &at) {
    ++entries;
    EXPECT_TRUE(at.counters.empty()); // told when the state is that of the program
  };
};
using Interpretations = ::testing::Types<Concrete, Abstract, Symbolic>;
TYPED_TEST_SUITE(Frames, Interpretations);

TYPED_TEST(Frames, ALevelBeginsWithItsArgumentsAlone) {
  const auto frame = this->enter();
  EXPECT_EQ(this->entries, 1);
  EXPECT_TRUE(this->is.isOnly(this->state.locals[1], 5));
  EXPECT_TRUE(this->state.enteredLoops.empty());
  EXPECT_TRUE(this->state.counters.empty());
  EXPECT_EQ(*this->state.variables.find(this->own), this->interpretation.vacant());
  EXPECT_TRUE(this->of(this->shared, 3));
}

TYPED_TEST(Frames, TheCallersLevelComesBack) {
  const auto frame = this->enter();
  this->state.locals.fill(this->number(6));
  this->state.variables.set(this->own, this->number(7));
  this->state.variables.set(this->shared, this->number(8));
  this->state.counters = {this->number(0), this->number(9)};
  this->state.enteredLoops = {{2, this->interpretation.truth(true)}};
  leaveCall(this->programs, this->state, frame);
  EXPECT_TRUE(this->is.isOnly(this->state.locals[1], 1));
  EXPECT_TRUE(this->of(this->own, 2));
  EXPECT_TRUE(this->of(this->shared, 8));
  ASSERT_EQ(this->state.counters.size(), 1U);
  EXPECT_TRUE(this->is.isOnly(this->state.counters[0], 4));
  ASSERT_EQ(this->state.enteredLoops.size(), 1U);
  EXPECT_EQ(this->state.enteredLoops[0].first, 1);
}

TYPED_TEST(Frames, NamesOfALevelEndWithIt) {
  this->state.variables.erase(this->own);
  const auto frame = this->enter();
  this->state.variables.set(this->own, this->number(7));
  leaveCall(this->programs, this->state, frame);
  EXPECT_EQ(this->state.variables.find(this->own), nullptr);
}

TYPED_TEST(Frames, ASubprogramSharesTheLocals) {
  this->request.freshLocals = false;
  auto frame = this->enter(2);
  EXPECT_TRUE(this->is.isOnly(this->state.locals[1], 1));
  this->state.locals.fill(this->number(6));
  repeatCall(this->programs, this->state, frame, this->interpretation, this->count);
  EXPECT_TRUE(this->is.isOnly(this->state.locals[1], 6));
  leaveCall(this->programs, this->state, frame);
  EXPECT_TRUE(this->is.isOnly(this->state.locals[1], 6));
}

TYPED_TEST(Frames, EachRepetitionIsAnEntry) {
  auto frame = this->enter(3);
  while (isCalledAgain(frame)) {
    this->state.counters = {this->number(9)};
    this->state.variables.set(this->own, this->number(7));
    repeatCall(this->programs, this->state, frame, this->interpretation, this->count);
    EXPECT_EQ(*this->state.variables.find(this->own), this->interpretation.vacant());
  }
  EXPECT_EQ(this->entries, 3);
}

/// Manuals say that a repetition finds what the last one left, or nothing.
TYPED_TEST(Frames, RepetitionsFindWhatWasLeftOrTheArguments) {
  auto frame = this->enter(2);
  this->state.locals.fill(this->number(6));
  repeatCall(this->programs, this->state, frame, this->interpretation, this->count);
  EXPECT_TRUE(this->is.mayBe(this->state.locals[1], 6));
  EXPECT_TRUE(TypeParam::followsOne || this->is.mayBe(this->state.locals[1], 5));
}

TYPED_TEST(Frames, AModalCallKeepsItsLocals) {
  this->state.modalCalls.push_back({0, 0, this->number(1), this->request.locals});
  this->state.modalCalls.push_back({0, 1, this->number(1), this->request.locals});
  EXPECT_EQ(modalCallOf(this->state, {}), 1U);
  const auto frame = this->enter(1, 1U);
  EXPECT_EQ(modalCallOf(this->state, frame.modalLimit), 0U); // not itself
  this->state.locals.fill(this->number(6));
  leaveCall(this->programs, this->state, frame);
  EXPECT_TRUE(this->is.isOnly(this->state.modalCalls[1].locals[1], 6));
  EXPECT_TRUE(this->is.isOnly(this->state.modalCalls[0].locals[1], 5));
  EXPECT_TRUE(this->is.isOnly(this->state.locals[1], 1));
}

TYPED_TEST(Frames, ProgramsCalledByAModalCallMakeNoMoreThanIt) {
  this->state.modalCalls.push_back({0, 0, this->number(1), this->request.locals});
  const auto outer = this->enter(1, 0U);
  const auto inner = this->enter(1, {}, outer.modalLimit);
  EXPECT_EQ(modalCallOf(this->state, inner.modalLimit), std::nullopt);
  EXPECT_EQ(mayCallModally(this->interpretation, this->state, inner.modalLimit), this->interpretation.truth(false));
  EXPECT_EQ(mayCallModally(this->interpretation, this->state, {}), this->interpretation.truth(true));
}

TEST(Nesting, TheLimitsOfTheDialect) {
  Limits limits;
  limits.macroCallDepth = 2;
  limits.subprogramDepth = 3;
  limits.totalCallDepth = 4;
  EXPECT_EQ(nestingAlarm(limits, {0, 0}, true), std::nullopt);
  EXPECT_EQ(nestingAlarm(limits, {2, 2}, true), AlarmKind::MacroNesting);
  EXPECT_EQ(nestingAlarm(limits, {2, 2}, false), std::nullopt);
  EXPECT_EQ(nestingAlarm(limits, {3, 0}, false), AlarmKind::SubprogramNesting);
  EXPECT_EQ(nestingAlarm(limits, {4, 1}, true), AlarmKind::SubprogramNesting);
  EXPECT_EQ((CallDepth{1, 0}.inside(true)), (CallDepth{2, 1}));
}

} // namespace
} // namespace feedhold
