// The order of attack: folding, certificate, Z3, cvc5.  What each answer is worth is decided here alone.
#include "proof/decide/discharge.h"

#include "base/support/check.h"
#include "base/support/match.h"
#include "proof/check/certificate.h"
#include "proof/decide/cancel.h"
#include "proof/decide/discharge_eliminate.h"
#include "proof/decide/discharge_memo.h"
#include "proof/decide/discharge_parts.h"
#include "proof/smt/purify.h"
#include "proof/smt/solver.h"
#include "proof/smt/steps.h"
#include "proof/smt/unit_resolution.h"

#include <algorithm>

namespace feedhold::prove {
namespace {

using smt::TermId;

// Measured: a unit of Z3 takes two to three microseconds in questions with products.
constexpr std::uint64_t kStepsOfZ3 = 3 * kStepsOfWork;
constexpr std::uint64_t kStepsOfCvc5 = 50 * kStepsOfWork;
/// cvc5 does not tell what it has used.  When it answers it has mostly used a small part, and else all.
constexpr std::uint64_t kShareOfAnswer = 20;

thread_local CertificateLog *openLog = nullptr;

/// Absent when the certificate does not hold: the search is not to be believed.
std::optional<Proved> certified(const check::UnsatProblem &claim, const check::Certificate &certificate) {
  if (check::verify(claim, certificate))
    return std::nullopt;
  CertificateEvidence evidence{check::writeClaim(claim), check::writeCertificate(claim, certificate)};
  constexpr std::uint64_t kStepsOfByte = 2;
  smt::spend(kStepsOfByte * (evidence.claim.size() + evidence.certificate.size()));
  if (openLog)
    openLog->add(evidence);
  return Proved{Grade::Certified, std::move(evidence)};
}

/// Of formulas that are plainly false.
Outcome byFolding() {
  const check::UnsatProblem claim{{}, {{{check::constant(-1), check::Relation::NonNegative}}, {}}};
  const check::Certificate certificate{check::Combination{{{check::Number(1), {0}, {}}}, {}}, {}};
  std::optional<Proved> proved = certified(claim, certificate);
  FEEDHOLD_CHECK(proved.has_value(), "-1 >= 0 is no contradiction");
  return {std::move(*proved), "folding", 0};
}

/// All that must not hold together.
std::vector<TermId> refutable(smt::TermStore &store, const Query &query) {
  std::vector<TermId> formulas = query.assumptions;
  formulas.push_back(store.logicalNot(query.goal));
  const TermId whole = store.logicalAnd(formulas);
  if (store[whole].kind == smt::TermKind::And)
    return store[whole].arguments;
  return {whole};
}

smt::Model modelOf(const smt::TermStore &store, const check::UnsatProblem &claim,
                   const std::vector<check::Number> &values) {
  smt::Model model;
  for (std::size_t index = 0; index < values.size(); ++index) {
    const std::string &name = claim.variables[index].name;
    if (name.starts_with('!'))
      continue;
    const bool isBool = store.sort(store.variableNamed(name)) == smt::Sort::Bool;
    model.emplace(name, isBool ? smt::Value(!values[index].isZero()) : smt::Value(values[index]));
  }
  return model;
}

bool hasRounding(const smt::TermStore &store, std::span<const TermId> formulas) {
  return std::ranges::any_of(formulas, [&](TermId formula) { return store.shape(formula).hasRounding; });
}

class Discharge {
public:
  Discharge(smt::TermStore &store, const Query &query, const Budget &budget)
      : store_(store), budget_(budget), formulas_(refutable(store, query)),
        variables_(smt::variablesOf(store, formulas_)) {}

  Outcome run() {
    if (formulas_.size() == 1 && formulas_[0] == store_.no())
      return byFolding();
    eliminated_ = eliminate(store_, formulas_);
    if (eliminated_.formulas == std::vector{store_.no()})
      return byFolding();
    bool isRounded = false;
    if (hasRounding(store_, eliminated_.formulas)) {
      eliminated_.formulas = smt::resolveUnits(store_, std::move(eliminated_.formulas));
      if (auto unrounded = smt::withoutRounding(store_, eliminated_.formulas)) {
        isRounded = true;
        if (std::optional<Outcome> outcome = butForRounding(std::move(*unrounded)))
          return std::move(*outcome);
      }
    }
    take(smt::purify(store_, eliminated_.formulas, smt::Hold::Together));
    if (!isRounded)
      return decide();
    std::optional<Outcome> outcome = byCertificate(budget_.search / 2);
    return outcome ? std::move(*outcome) : Outcome{Unknown{reason_}, "linear", effort_};
  }

private:
  void take(smt::Purified purified) {
    pure_ = std::move(purified.formulas);
    pure_.insert(pure_.end(), purified.facts.begin(), purified.facts.end());
  }

  Outcome decide() {
    if (budget_.z3 == 0) {
      std::optional<Outcome> outcome = byCertificate(budget_.search);
      return outcome ? std::move(*outcome) : Outcome{Unknown{reason_}, "linear", effort_};
    }
    if (std::optional<Outcome> outcome = byPart(budget_.search / 10))
      return std::move(*outcome);
    // Much of what a short search does not prove is not so: a model that Z3 finds soon is cheaper than a long search.
    if (std::optional<Outcome> outcome = byCertificate(budget_.search / 10))
      return std::move(*outcome);
    text_ = smt::writeSmtLib(store_, pure_);
    if (std::optional<Outcome> outcome = byModel(budget_.z3 / 40))
      return std::move(*outcome);
    if (std::optional<Outcome> outcome = byCertificate(budget_.search))
      return std::move(*outcome);
    return bySolvers();
  }

  /// What holds with a margin holds for exact numbers that are almost the same, which is mostly easier to see.
  std::optional<Outcome> butForRounding(std::vector<TermId> unrounded) {
    const TermId all = store_.logicalAnd(unrounded);
    if (all == store_.no())
      return byFolding();
    unrounded = store_[all].kind == smt::TermKind::And ? store_[all].arguments : std::vector{all};
    take(smt::purify(store_, smt::resolveUnits(store_, std::move(unrounded)), smt::Hold::Together));
    Outcome outcome = decide();
    const bool isDecided = outcome.proved() || isCounterexample(outcome.counterexample());
    return isDecided ? std::optional(std::move(outcome)) : std::nullopt;
  }

  /// Of the rounded numbers, too.  Where functions have no value that is known, a short search takes it for one.
  bool isCounterexample(const smt::Model *model) const {
    if (!model)
      return false;
    bool isKnown = true;
    for (const TermId formula : formulas_) {
      const auto value = smt::evaluate(store_, formula, *model);
      if (value && !std::get<bool>(*value))
        return false;
      isKnown = isKnown && value.has_value();
    }
    return isKnown || budget_.z3 == 0;
  }

  /// Where some formulas have nothing to do with the others, and a search is not led astray by those.
  std::optional<Outcome> byPart(std::uint64_t work) {
    if (smt::arithmeticOf(store_, pure_) == smt::Arithmetic::Linear)
      return std::nullopt; // one search sees it all
    const std::vector<std::vector<TermId>> parts = independentParts(store_, pure_);
    if (parts.size() < 2)
      return std::nullopt;
    for (const std::vector<TermId> &part : parts)
      if (std::optional<Outcome> outcome = byCertificate(part, work); outcome && outcome->proved())
        return outcome;
    return std::nullopt;
  }

  std::optional<Outcome> byCertificate(std::uint64_t work) { return byCertificate(pure_, work); }

  std::optional<Outcome> byCertificate(const std::vector<TermId> &formulas, std::uint64_t work) {
    Result<check::UnsatProblem> claim = check::claimOf(store_, formulas);
    if (!claim) {
      reason_ = claim.error().message;
      return std::nullopt;
    }
    const SearchResult search = searchOnce(claim.value(), work);
    effort_ += search.work;
    const bool isLinear = search.reasoning == SearchResult::Reasoning::Linear;
    const std::string method = isLinear ? "linear" : "products";
    return match(
        search.answer,
        [&](const Found &found) -> std::optional<Outcome> {
          if (std::optional<Proved> proved = certified(claim.value(), found.certificate))
            return Outcome{std::move(*proved), method, effort_};
          reason_ = "the certificate found was rejected by the checker";
          return std::nullopt;
        },
        [&](const Satisfied &point) -> std::optional<Outcome> {
          return Outcome{Counterexample{completed(modelOf(store_, claim.value(), point.values))}, method, effort_};
        },
        [&](const NotFound &failure) -> std::optional<Outcome> {
          reason_ = failure.reason;
          return std::nullopt;
        });
  }

  /// The variables of the query, none missing and no other.
  smt::Model completed(const smt::Model &found) const {
    smt::Model all = found;
    const auto addRest = [&](std::span<const TermId> terms) {
      for (TermId variable : smt::variablesOf(store_, terms))
        if (!eliminated_.defines(variable))
          all.emplace(store_[variable].name, anyOf(variable));
    };
    addRest(variables_);
    addRest(eliminated_.formulas);
    for (const auto &definition : eliminated_.definitions)
      addRest(std::span(&definition.second, 1));
    complete(store_, eliminated_, all);
    smt::Model model;
    for (TermId variable : variables_) {
      const auto known = all.find(store_[variable].name);
      model.emplace(store_[variable].name, known == all.end() ? anyOf(variable) : known->second);
    }
    return model;
  }
  smt::Value anyOf(TermId variable) const {
    return store_[variable].sort == smt::Sort::Bool ? smt::Value(false) : smt::Value(smt::Number(0));
  }

  /// Values by Z3; its `unsat` is remembered.
  std::optional<Outcome> byModel(std::uint64_t work) {
    z3_ = askZ3Once(text_, smt::arithmeticOf(store_, pure_), work);
    smt::spend(kStepsOfZ3 * z3_.effort);
    effort_ += z3_.effort;
    if (const auto *sat = std::get_if<smt::Sat>(&z3_.result))
      return Outcome{Counterexample{completed(sat->model)}, "z3", effort_};
    return std::nullopt;
  }

  Outcome bySolvers() {
    if (!z3_.isUnsat())
      if (std::optional<Outcome> outcome = byModel(budget_.z3))
        return std::move(*outcome);
    const smt::Answer &z3 = z3_;
    if (budget_.cvc5 == 0)
      return {Unknown{z3.isUnsat() ? "Z3 found a proof that cvc5 was not asked to confirm" : reason_}, "z3", effort_};
    if (!z3.isUnsat())
      return {Unknown{reason_ + "; " + std::get<smt::NoAnswer>(z3.result).reason}, "z3", effort_};
    const smt::Answer cvc5 = askCvc5Once(text_, budget_.cvc5);
    const bool isAnswer = !std::holds_alternative<smt::NoAnswer>(cvc5.result);
    smt::spend(kStepsOfCvc5 * cvc5.effort / (isAnswer ? kShareOfAnswer : 1));
    effort_ += cvc5.effort;
    if (const auto *none = std::get_if<smt::NoAnswer>(&cvc5.result))
      return {Unknown{"Z3 found a proof that cvc5 did not confirm: " + none->reason}, "z3+cvc5", effort_};
    if (!cvc5.isUnsat())
      return {Unknown{"Z3 and cvc5 disagree"}, "z3+cvc5", effort_};
    const SolverEvidence evidence{text_, {smt::z3Version().value_or("z3"), smt::cvc5Version().value_or("cvc5")}};
    return {Proved{Grade::TwoSolvers, evidence}, "z3+cvc5", effort_};
  }

  smt::TermStore &store_;
  const Budget &budget_;
  std::vector<TermId> formulas_;
  std::vector<TermId> variables_;
  Eliminated eliminated_;
  std::vector<TermId> pure_;
  std::string text_; // SMT-LIB
  smt::Answer z3_ = {};
  std::string reason_;
  std::uint64_t effort_ = 0;
};

} // namespace

CertificateLog::CertificateLog() : outer_(openLog) { openLog = this; }
CertificateLog::~CertificateLog() { openLog = outer_; }

namespace {

/// The terms (variables, products, functions) whose sum a comparison is about.
std::vector<TermId> termsOf(const smt::TermStore &store, TermId formula) {
  std::vector<TermId> terms;
  const smt::Term &term = store[formula];
  if (term.kind == smt::TermKind::Less || term.kind == smt::TermKind::LessOrEqual)
    for (const TermId side : term.arguments)
      for (const auto &[each, factor] : store.linear(side).terms)
        terms.push_back(each);
  return terms;
}

/// What the goal speaks of; and what is compared with a term of it.
std::vector<TermId> spokenNear(const smt::TermStore &store, const Query &query) {
  const std::vector<TermId> ofGoal = termsOf(store, query.goal);
  std::vector<TermId> near{query.goal};
  for (const TermId assumption : query.assumptions) {
    const std::vector<TermId> terms = termsOf(store, assumption);
    if (std::ranges::any_of(terms, [&](TermId each) { return std::ranges::find(ofGoal, each) != ofGoal.end(); }))
      near.insert(near.end(), terms.begin(), terms.end());
  }
  return smt::variablesOf(store, near);
}

/// With the assumptions alone that speak of nothing but these variables.  Absent: these are all of them.
std::optional<Query> nearPart(const smt::TermStore &store, const Query &query, const std::vector<TermId> &spoken) {
  Query near{{}, query.goal};
  for (const TermId assumption : query.assumptions) {
    const std::vector<TermId> &variables = store.variablesOf(assumption);
    if (std::includes(spoken.begin(), spoken.end(), variables.begin(), variables.end()))
      near.assumptions.push_back(assumption);
  }
  const bool isLess = !spoken.empty() && near.assumptions.size() < query.assumptions.size();
  return isLess ? std::optional(std::move(near)) : std::nullopt;
}

/// Of all that is done for one question: several times what its budget for searching takes, because putting the
/// question and reading the certificate take steps, too.
std::uint64_t mostSteps(const Budget &budget) {
  constexpr std::uint64_t kToPutIt = 20'000'000;
  constexpr std::uint64_t kMargin = 3;
  return kToPutIt + kMargin * (kStepsOfWork * budget.search + 2 * kStepsOfZ3 * budget.z3 + kStepsOfCvc5 * budget.cvc5);
}

Outcome tryToDischarge(smt::TermStore &store, const Query &query, const Budget &budget) {
  constexpr std::uint64_t kShareOfNear = 8;
  std::uint64_t spent = 0;
  std::vector<TermId> tried;
  std::vector<std::vector<TermId>> attempts{store.variablesOf(query.goal)};
  if (hasRounding(store, query.assumptions))
    attempts.push_back(spokenNear(store, query));
  for (const std::vector<TermId> &spoken : attempts) {
    const auto near = nearPart(store, query, spoken);
    if (!near || near->assumptions == tried)
      continue;
    tried = near->assumptions;
    Outcome outcome = Discharge(store, *near, {.search = budget.search / kShareOfNear, .z3 = 0, .cvc5 = 0}).run();
    outcome.effort += spent;
    if (outcome.proved())
      return outcome;
    spent = outcome.effort;
  }
  Outcome outcome = Discharge(store, query, budget).run();
  outcome.effort += spent;
  return outcome;
}

} // namespace

Outcome discharge(smt::TermStore &store, const Query &query, const Budget &budget) {
  throwIfCancelled();
  const std::uint64_t most = mostSteps(budget);
  if (auto outcome = smt::within(most, [&] { return tryToDischarge(store, query, budget); })) {
    return std::move(*outcome);
  }
  const std::uint64_t effort = most / kStepsOfWork;
  if (smt::areStepsUsedUp())
    return {Unknown{std::string(kProgramStepsUsedUp)}, "", effort};
  return {Unknown{"gave up: the proof takes too many steps"}, "", effort};
}

} // namespace feedhold::prove
