#include "proof/termination/termination_explanation.h"

#include "proof/decide/entails.h"
#include "proof/smt/steps.h"
#include "proof/symbolic/shop_terms.h"

#include <fmt/format.h>

#include <algorithm>

namespace feedhold::prove {

using smt::Number;
using smt::TermId;

namespace {

constexpr int kMostUsefulBound = 1'000'000; // iterations

class Explainer {
public:
  Explainer(SymbolicInterpretation &interpretation, const ProgramSet &programs, const LoopInstance &loop)
      : interpretation_(interpretation), store_(interpretation.store()), programs_(programs), loop_(loop) {
    for (const auto &[variable, value] : interpretation.entryValues())
      atCall_.emplace(value.number, programs.nameOfVariable(variable));
    for (const LoopInstance::Value &value : loop.values)
      if (value.generic != value.arrival && !store_.isNumber(value.generic))
        beforeIteration_.emplace(value.generic, programs.nameOfVariable(value.variable));
  }

  TerminationExplanation of(const Termination &end) {
    if (end.awaited)
      return {"without end, it would read a value at last that ends it (`@EVENTUALLY`)", ""};
    if (end.rankings.empty())
      return {loop_.transitions.empty() ? "no iteration leads back to the head of the loop"
                                        : "no path through the loop is taken twice",
              ""};
    if (std::any_of(end.rankings.begin(), end.rankings.end(),
                    [](const RankingFunction &ranking) { return ranking.isLate; }))
      return {late(end), ""};
    if (end.rankings.size() > 1)
      return {inTurn(end), ""};
    const RankingFunction &ranking = end.rankings.front();
    const bool isSteady =
        !ranking.isFollowed && isConstant(ranking.decrease) &&
        std::all_of(loop_.transitions.begin(), loop_.transitions.end(), [&](const Transition &iteration) {
          return store_.subtract(ranking.value, smt::substitute(store_, ranking.value, iteration.next)) ==
                 ranking.decrease;
        });
    return isSteady ? TerminationExplanation{steady(ranking), bound(ranking)}
                    : TerminationExplanation{unsteady(ranking), ""};
  }

private:
  /// Iterations are made while the ranking function is not negative; or positive, where that is so before each of them.
  std::string bound(const RankingFunction &ranking) {
    const TermId quotient = inSteps(smt::substitute(store_, ranking.value, loop_.first), ranking.decrease);
    const TermId one = store_.number(Number(1));
    TermId most = isPositive(ranking) ? store_.ceiling(quotient) : store_.add(store_.floor(quotient), one);
    if (!testsFirst()) {
      most = store_.add(most, one); // what comes back to the start begins one iteration more
      if (!isMetWith(store_.lessOrEqual(one, most)))
        return ""; // such a loop has one iteration at least, however small the number is
    }
    if (Number(kMostUsefulBound) < store_.linear(most).constant)
      return ""; // true, and of no use to anybody
    return roundedText(most).value_or("");
  }
  /// It holds whenever the loop is met.
  bool isMetWith(TermId goal) {
    return discharge(store_, relevantQuery(store_, interpretation_.facts(), loop_.arrival, goal), Budget::quick())
        .proved();
  }
  /// FUP and FIX go by the sign of what they round: whole numbers beside it come into its brackets, where the sum is
  /// not negative if there are iterations.
  std::optional<std::string> roundedText(TermId most) {
    smt::LinearSum sum = store_.linear(most);
    const auto isRounded = [&](const auto &part) {
      const smt::Term &term = store_[part.first];
      return term.kind == smt::TermKind::Apply && term.function == smt::Function::Floor;
    };
    const auto rounded = std::find_if(sum.terms.begin(), sum.terms.end(), isRounded);
    if (rounded == sum.terms.end())
      return shopText(store_, most, atCall_);
    const auto [floor, factor] = *rounded;
    sum.terms.erase(rounded);
    const bool isWhole = sum.constant.isInteger() && std::all_of(sum.terms.begin(), sum.terms.end(), [&](auto &part) {
                           return part.second.isInteger() && store_.sort(part.first) == smt::Sort::Int;
                         });
    if (!isWhole || abs(factor) != Number(1) || std::any_of(sum.terms.begin(), sum.terms.end(), isRounded))
      return std::nullopt;
    const TermId inside = store_.add(store_.fromLinear(sum), store_.scale(factor, store_[floor].arguments[0]));
    const auto text = shopText(store_, inside, atCall_);
    return text ? std::optional(fmt::format("{}[{}]", factor.sign() > 0 ? "FIX" : "FUP", *text)) : std::nullopt;
  }
  bool isPositive(const RankingFunction &ranking) {
    const TermId goal = store_.less(store_.number(Number(0)), ranking.value);
    return std::all_of(loop_.transitions.begin(), loop_.transitions.end(), [&](const Transition &iteration) {
      return discharge(store_, relevantQuery(store_, interpretation_.facts(), iteration.conditions, goal),
                       Budget::quick())
          .proved();
    });
  }
  bool testsFirst() const { return std::holds_alternative<Test>(programs_.node(loop_.head).instruction); }
  /// distance / step, with whole steps taken out of it.
  TermId inSteps(TermId distance, TermId step) {
    const smt::LinearSum unit = store_.linear(step);
    if (unit.terms.size() != 1 || !unit.constant.isZero())
      return store_.divide(distance, step);
    smt::LinearSum rest = store_.linear(distance);
    Number steps;
    std::erase_if(rest.terms, [&](const auto &term) {
      const bool isStep = term.first == unit.terms[0].first;
      if (isStep)
        steps = term.second / unit.terms[0].second;
      return isStep;
    });
    return store_.add(store_.divide(store_.fromLinear(rest), step), store_.number(steps));
  }

  /// The ranking function is a variable over or under a limit, mostly.
  std::string steady(const RankingFunction &ranking) {
    for (const LoopInstance::Value &value : loop_.values)
      if (const auto ratio = ratioOf(value.generic, ranking.value))
        if (std::string text = steady(value, *ratio, ranking); !text.empty())
          return text;
    const auto step = shown(ranking.decrease);
    const auto text = shopText(store_, ranking.value, namesBeforeIteration());
    return step && text
               ? fmt::format("`{}` falls by `{}` at every iteration and is never negative before one", *text, *step)
               : "";
  }
  /// value = ratio * ranking function + a limit.  What a loop tests at its end is the value behind the iteration.
  std::string steady(const LoopInstance::Value &value, const Number &ratio, const RankingFunction &ranking) {
    const TermId step = store_.scale(ratio.sign() < 0 ? -ratio : ratio, ranking.decrease);
    const TermId tested =
        testsFirst() ? value.generic : store_.subtract(value.generic, store_.scale(ratio, ranking.decrease));
    TermId limit = store_.subtract(tested, store_.scale(ratio, ranking.value));
    bool isReached = isPositive(ranking);
    if (!isReached && store_.sort(ranking.value) == smt::Sort::Int) { // not negative: above -1
      limit = store_.subtract(limit, store_.number(ratio));
      isReached = true;
    }
    const auto stepText = shown(step);
    const auto limitText = isConstant(limit) ? shown(limit) : std::nullopt;
    if (!stepText || !limitText)
      return "";
    const bool falls = ratio.sign() > 0;
    const std::string_view where = isReached ? "at" : falls ? "below" : "above";
    return fmt::format("`{}` {} by `{}` at every iteration, and the loop stops {} `{}`",
                       programs_.nameOfVariable(value.variable), falls ? "falls" : "rises", *stepText, where,
                       *limitText);
  }
  /// How much of the ranking function a value holds, when no iteration changes the rest of it.
  std::optional<Number> ratioOf(TermId value, TermId ranking) {
    const smt::LinearSum whole = store_.linear(value);
    for (const auto &[term, factor] : store_.linear(ranking).terms) {
      if (isConstant(term))
        continue;
      for (const auto &[other, times] : whole.terms)
        if (other == term)
          return times / factor;
      return std::nullopt;
    }
    return std::nullopt;
  }
  std::string unsteady(const RankingFunction &ranking) {
    const auto text = shopText(store_, ranking.value, namesBeforeIteration());
    const bool isPartial = ranking.iterations.size() < loop_.transitions.size();
    return text ? fmt::format("`{}` falls at every iteration{} and is never negative before one{}", *text,
                              ranking.isFollowed ? " that another one follows" : "",
                              isPartial ? ", but for paths that are not taken twice in a row" : "")
                : "";
  }
  /// Of a loop with phases: what ends the last one.
  std::string late(const Termination &end) {
    const auto text = shopText(store_, end.rankings.back().value, namesBeforeIteration());
    return text ? fmt::format("from some iteration on, `{}` falls every time and is never negative before one", *text)
                : "";
  }
  std::string inTurn(const Termination &end) {
    std::string text;
    for (const RankingFunction &ranking : end.rankings) {
      const auto name = shopText(store_, ranking.value, namesBeforeIteration());
      if (!name)
        return "";
      text += fmt::format("{}`{}`", text.empty() ? "every iteration lowers " : ", or leaves it unchanged and lowers ",
                          *name);
    }
    return text + "; none is negative before an iteration that lowers it";
  }

  /// With the values at the call where nothing has written them since.
  TermNames namesBeforeIteration() const {
    TermNames names = beforeIteration_;
    for (const LoopInstance::Value &value : loop_.values)
      if (value.generic == value.arrival && atCall_.contains(value.arrival))
        names.emplace(value.arrival, programs_.nameOfVariable(value.variable));
    return names;
  }
  /// A value that no iteration changes: from the values at the call, or by the variable that holds it.
  std::optional<std::string> shown(TermId term) {
    if (auto text = shopText(store_, term, atCall_))
      return text;
    TermNames names;
    for (const LoopInstance::Value &value : loop_.values)
      if (value.generic == value.arrival && !store_.isNumber(value.arrival))
        names.emplace(value.arrival, programs_.nameOfVariable(value.variable));
    return shopText(store_, term, names);
  }

  bool isConstant(TermId term) const { return loop_.isConstant(interpretation_, store_, term); }

  SymbolicInterpretation &interpretation_;
  smt::TermStore &store_;
  const ProgramSet &programs_;
  const LoopInstance &loop_;
  TermNames atCall_;
  TermNames beforeIteration_;
};

} // namespace

TerminationExplanation explain(SymbolicInterpretation &interpretation, const ProgramSet &programs,
                               const LoopInstance &loop, const Termination &end) {
  constexpr std::uint64_t kStepsOfExplanation = 200'000'000;
  return smt::within(kStepsOfExplanation, [&] { return Explainer(interpretation, programs, loop).of(end); })
      .value_or(TerminationExplanation());
}

} // namespace feedhold::prove
