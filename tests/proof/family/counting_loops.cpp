// Loops that count: every guard, both directions, both orders of operands, each form of a loop.
#include "proof/family/draft.h"

#include <fmt/format.h>

#include <array>

namespace feedhold::proof_tests {

namespace {

enum class Form : std::uint8_t { While, ExitAtHead, EnterAtHead, TestAtTail };
constexpr std::array kForms = {Form::While, Form::ExitAtHead, Form::EnterAtHead, Form::TestAtTail};

/// A relation under which a loop goes on.
struct Relation {
  std::string_view name;
  std::string_view opposite;
  std::string_view reversed; // with its operands in the other order
};
constexpr Relation kLess{"LT", "GE", "GT"};
constexpr Relation kLessOrEqual{"LE", "GT", "GE"};
constexpr Relation kGreater{"GT", "LE", "LT"};
constexpr Relation kGreaterOrEqual{"GE", "LT", "LE"};
constexpr Relation kUnequal{"NE", "EQ", "NE"};

enum class Order : std::uint8_t { Plain, Reversed };

std::string condition(std::string_view left, const Relation &relation, std::string_view right, Order order) {
  return order == Order::Plain ? fmt::format("[{}{}{}]", left, relation.name, right)
                               : fmt::format("[{}{}{}]", right, relation.reversed, left);
}
Relation negation(const Relation &relation) {
  for (const Relation &other : {kLess, kLessOrEqual, kGreater, kGreaterOrEqual})
    if (other.name == relation.opposite)
      return other;
  return {"EQ", "NE", "EQ"};
}

/// The loop has its head at N20 and goes on while the relation holds.
void addLoop(Draft &draft, Form form, const Relation &relation, Order order, std::string_view left,
             std::string_view right, std::string_view pass) {
  const std::string goesOn = condition(left, relation, right, order);
  const std::string stops = condition(left, negation(relation), right, order);
  switch (form) {
  case Form::While: draft.lines({"N20WHILE" + goesOn + "DO1", pass, "END1"}); return;
  case Form::ExitAtHead: draft.lines({"N20IF" + stops + "GOTO40", pass, "GOTO20", "N40"}); return;
  case Form::EnterAtHead:
    draft.lines({"N20IF" + goesOn + "GOTO30", "GOTO40", fmt::format("N30{}", pass), "GOTO20", "N40"});
    return;
  case Form::TestAtTail: draft.lines({fmt::format("N20{}", pass), "IF" + goesOn + "GOTO20"}); return;
  }
}

/// From a number to an argument that is promised to be whole and at least 1.
void addUpTo(Family &family, Draw &draw) {
  for (const Relation &relation : {kLess, kLessOrEqual, kUnequal})
    for (const Form form : kForms)
      for (const double step : {1., .25, 2., .75}) {
        const Order order = draw.of({Order::Plain, Order::Reversed});
        Draft draft(fmt::format("up to an argument, {} {} by {}", relation.name, static_cast<int>(form), step));
        draft.promised({501, 1, draw.of({20., 50., 300.}), ArgumentKind::Whole}).line("#1=0");
        addLoop(draft, form, relation, order, "#1", "#501", fmt::format("#1=#1+{}", step));
        draft.lines({fmt::format("IF[#1GT#501+{}]GOTO91", step), "IF[#1GT#501]GOTO92", "GOTO99", "N91#3000=1(FAR)",
                     "N92#3000=2(PAST)", "N99"});
        const bool meets = step < .5 || step == 1;
        if (relation.name == "NE" && !meets) {
          draft.refuted("loop-ends.N20", {{501, 1}}).refuted("program-ends", {{501, 1}});
        } else {
          draft.proved("loop-ends.N20").proved("program-ends").proved("alarm-unreachable.N91");
          if (relation.name == "LE" || !meets)
            draft.refuted("alarm-unreachable.N92", {{501, 1}});
          else
            draft.proved("alarm-unreachable.N92");
        }
        family.push_back(draft.done());
      }
}

/// From whatever the operator typed, made whole, down to a number; nothing is promised.
void addDownFrom(Family &family, Draw &draw) {
  for (const Relation &relation : {kGreater, kGreaterOrEqual})
    for (const std::string_view function : {"FIX", "FUP", "ROUND"})
      for (const Form form : kForms) {
        const int limit = static_cast<int>(draw.below(12)) - 4;
        const int step = 1 + static_cast<int>(draw.below(3));
        Draft draft(fmt::format("down from {}, {} {}", function, relation.name, static_cast<int>(form)));
        draft.free(501).line(fmt::format("#1={}[#501]", function));
        addLoop(draft, form, relation, draw.of({Order::Plain, Order::Reversed}), "#1", fmt::format("{}", limit),
                fmt::format("#1=#1-{}", step));
        draft.lines({fmt::format("IF[#1GT{}]GOTO91", limit), "GOTO99", "N91#3000=1(NOT DONE)", "N99"});
        draft.proved("loop-ends.N20").proved("program-ends").proved("alarm-unreachable.N91");
        family.push_back(draft.done());
      }
}

/// The counter goes away from the end, or does not move.
void addWrongWay(Family &family, Draw &draw) {
  for (const Relation &relation : {kLess, kLessOrEqual, kGreater, kGreaterOrEqual})
    for (const std::string_view move : {"-", "", "*"}) {
      const Form form = kForms[draw.below(4)];
      const bool isUp = relation.name[0] == 'L';
      const int limit = static_cast<int>(draw.below(20)) + 1;
      const double step = draw.of({1., .5, 3.});
      const std::string pass = move.empty()  ? "#2=#2+1"
                               : move == "*" ? "#1=#1*2"
                               : isUp        ? fmt::format("#1=#1-{}", step)
                                             : fmt::format("#1=#1+{}", step);
      const double start = isUp ? (move == "*" ? -1. : limit - 1.) : limit + 30.;
      Draft draft(fmt::format("wrong way, {} {} {}", relation.name, move, static_cast<int>(form)));
      draft.free(501).lines({"#1=FIX[#501]", "#2=0"});
      addLoop(draft, form, relation, draw.of({Order::Plain, Order::Reversed}), "#1", fmt::format("{}", limit), pass);
      draft.refuted("loop-ends.N20", {{501, start}}).refuted("program-ends", {{501, start}});
      family.push_back(draft.done());
    }
}

/// Two conditions in one guard.
void addTwoConditions(Family &family, Draw &draw) {
  for (const bool both : {true, false})
    for (const bool secondMoves : {true, false})
      for (const bool asGoto : {true, false}) {
        const int limit = 5 + static_cast<int>(draw.below(40));
        Draft draft(fmt::format("two conditions, {} {} {}", both, secondMoves, asGoto));
        draft.promised({501, 0, 100}).promised({502, -5, 20}).lines({"#1=#501", "#2=#502"});
        const std::string_view joint = both ? "AND" : "OR";
        const std::string guard = fmt::format("[[#1LT{}]{}[#2GT0]]", limit, joint);
        const std::string opposite = fmt::format("[[#1GE{}]{}[#2LE0]]", limit, both ? "OR" : "AND");
        draft.line(asGoto ? "N20IF" + opposite + "GOTO40" : "N20WHILE" + guard + "DO1")
            .line("#1=#1+.5")
            .line(secondMoves ? "#2=#2-1" : "#3=#2")
            .line(asGoto ? "GOTO20" : "END1")
            .line("N40");
        if (both || secondMoves)
          draft.proved("loop-ends.N20").proved("program-ends");
        else
          draft.refuted("loop-ends.N20", {{501, 0}, {502, 1}}).refuted("program-ends", {{501, 0}, {502, 1}});
        family.push_back(draft.done());
      }
}

} // namespace

void addCountingLoops(Family &family) {
  Draw draw(1);
  addUpTo(family, draw);
  addDownFrom(family, draw);
  addWrongWay(family, draw);
  addTwoConditions(family, draw);
}

} // namespace feedhold::proof_tests
