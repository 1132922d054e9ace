// Claims about space: where the tool may go (docs/geometry.md).
#include "proof/prove/plain_space.h"
#include "proof/prove/prover.h"
#include "proof/prove/space_claims.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace feedhold::prove {

using geometry::SpaceClaim;
using smt::TermId;

namespace {

constexpr std::uint64_t kCorners = 40'000; // effort to prove a claim in one of its simple ways

/// Less than this is the rounding of the machine's numbers, not a gouge.
constexpr double kLeastDepth = 1e-6;

SpaceClaim plainClaim(ObligationKind kind) {
  if (kind == ObligationKind::KeepIn)
    return SpaceClaim::KeepIn;
  if (kind == ObligationKind::KeepOut)
    return SpaceClaim::KeepOut;
  return kind == ObligationKind::Clearance ? SpaceClaim::Clearance : SpaceClaim::Travel;
}

std::string howFar(const SpaceRule &rule, double depth) {
  const std::string distance = fmt::format("{:.4g}", depth);
  if (rule.kind == ObligationKind::KeepIn)
    return fmt::format("the tool is {} outside of {}", distance, rule.name);
  if (rule.kind == ObligationKind::KeepOut)
    return fmt::format("the tool is {} inside of {}", distance, rule.name);
  if (rule.kind == ObligationKind::Clearance)
    return fmt::format("a rapid move goes {} below the clearance", distance);
  return fmt::format("the tool is {} outside of the travel", distance);
}

std::string textOf(const SpaceRule &rule, const GougeAt &gouge) {
  const auto &[x, y, z] = gouge.at;
  return fmt::format("{} at X{:.4g} Y{:.4g} Z{:.4g}", howFar(rule, gouge.depth), x + 0.0, y + 0.0, z + 0.0);
}

} // namespace

std::optional<GougeAt> Prover::gougeIn(const SpaceRule &rule, Place own, const RunResult &run,
                                       const GivenVariables &given) const {
  const geometry::PlainSpace space = plainSpace(programs_, program_, *contracts_, witnesses_->runOptions(given));
  const auto gouge = geometry::deepestGouge(space, plainClaim(rule.kind), rule.region, run.moves,
                                            [&](const RecordedMove &move) { return move.own == own; });
  if (!gouge || gouge->depth < kLeastDepth)
    return std::nullopt;
  return GougeAt{run.moves[gouge->move].place, gouge->at, gouge->depth};
}

/// Proofs take words as they are written: what only their rounding to the least increment makes is no witness.
Violation Prover::gouges(const SpaceRule &rule, Place own) const {
  const auto happened = [this, &rule, own](const RunResult &run, const GivenVariables &given) {
    const auto gouge = gougeIn(rule, own, run, given);
    return gouge ? std::optional(textOf(rule, *gouge)) : std::nullopt;
  };
  return {happened, [this, &rule, own](const GivenVariables &given) {
            RunOptions options = witnesses_->runOptions(given);
            options.fuel = WitnessSearch::kFuel;
            options.words = WordRounding::None;
            const RunResult run = feedhold::run(programs_, program_, options);
            return gougeIn(rule, own, run, given) && witnesses_->agreesExactly(given, run) != Agreement::Different;
          }};
}

/// How far the sampled runs keep away, if that can be proved; 0 where one comes as near as it may.
void Prover::findMargin(Obligation &obligation, const SpaceRule &rule, const std::vector<const MoveInstance *> &moves) {
  constexpr std::uint64_t kCheap = 100'000; // effort of the proof
  constexpr double kNone = 1e-6;
  if (!rule.spacesFor || obligation.effort > kCheap)
    return;
  std::optional<double> nearest;
  for (const WitnessSearch::Sample &sample : witnesses_->samples()) {
    const auto space = plainSpace(programs_, program_, *contracts_, witnesses_->runOptions(sample.given));
    const auto margin =
        geometry::smallestMargin(space, plainClaim(rule.kind), rule.region, sample.result.moves,
                                 [&](const RecordedMove &move) { return move.own == obligation.place; });
    if (margin && (!nearest || *margin < *nearest))
      nearest = margin;
    if (nearest && *nearest < kNone) {
      obligation.margin = 0;
      return;
    }
  }
  for (const double part : {1.0, 0.5, 0.1}) {
    if (!nearest)
      return;
    const double size = std::pow(10, std::floor(std::log10(*nearest * part)) - 1);
    const double margin = std::floor(*nearest * part / size + kNone) * size; // two digits
    if (keepsAway(obligation, space_->withMargin(rule, margin), moves)) {
      obligation.margin = margin;
      return;
    }
  }
}

bool Prover::keepsAway(Obligation trial, const SpaceRule &rule, const std::vector<const MoveInstance *> &moves) {
  const Budget quick{.search = 30'000, .z3 = 0, .cvc5 = 0};
  return std::all_of(moves.begin(), moves.end(), [&](const MoveInstance *move) {
    const std::vector<SpaceQuestion> questions = space_->questions(rule, *move);
    return std::all_of(questions.begin(), questions.end(), [&](const SpaceQuestion &question) {
      return isProvedFor(trial, move->conditions, question, quick);
    });
  });
}

/// A proof over exact numbers, and a sampled run whose rounded words lead a little further.
void Prover::noteRounding(Obligation &obligation, const SpaceRule &rule) const {
  constexpr std::size_t kMostLooked = 20;
  const auto &samples = witnesses_->samples();
  for (std::size_t i = 0; i < samples.size() && i < kMostLooked; ++i)
    if (const auto gouge = gougeIn(rule, obligation.place, samples[i].result, samples[i].given)) {
      obligation.exactOnly = true;
      obligation.reason = fmt::format("words rounded to the least increment add up: {}", textOf(rule, *gouge));
      return;
    }
}

void Prover::spaces() {
  if (!contract() || !hasSpaceClause(*contract()) || isSingleRun_)
    return;
  learnSigns();
  for (const SpaceRule &rule : space_->rules()) {
    if (!wanted(rule.kind))
      continue;
    std::vector<std::pair<Place, std::vector<const MoveInstance *>>> groups;
    const auto groupOf = [&](Place own) -> std::vector<const MoveInstance *> & {
      const auto known =
          std::find_if(groups.begin(), groups.end(), [&](const auto &each) { return each.first == own; });
      return known != groups.end() ? known->second
                                   : groups.emplace_back(own, std::vector<const MoveInstance *>{}).second;
    };
    for (const MoveInstance &move : found_.moves)
      if (space_->concerns(rule, move))
        groupOf(move.own).push_back(&move);
    for (const UnfollowedCall &call : found_.unfollowedCalls)
      groupOf(call.own);
    if (groups.empty() && found_.incomplete)
      groupOf({program_.file, program_.entry});
    for (const auto &[own, moves] : groups)
      space(rule, own, moves);
  }
}

/// One block and what it calls.
void Prover::space(const SpaceRule &rule, Place own, const std::vector<const MoveInstance *> &moves) {
  const Span span = file().tree->blocks[programs_.node(own).block].span();
  Obligation &obligation = add(rule.kind, own, span, contracts_->clauses[rule.clause].text);
  if (!rule.name.empty())
    obligation.id.insert(obligation.id.rfind('.'), "." + rule.name);
  if (isOutOfFocus(obligation))
    return;
  const Violation violation = gouges(rule, own);
  if (!isDecided(obligation, violation))
    decideSpace(obligation, rule, moves, violation);
  if (obligation.verdict == Verdict::Proved) {
    noteRounding(obligation, rule);
    findMargin(obligation, rule, moves);
  }
  if (obligation.witness && obligation.verdict == Verdict::Refuted) {
    RunOptions options = witnesses_->runOptions(obligation.witness->variables);
    options.fuel = WitnessSearch::kFuel;
    obligation.witness->gouge =
        gougeIn(rule, own, feedhold::run(programs_, program_, options), obligation.witness->variables);
  }
}

/// What is not followed there, by its name.
std::optional<std::string> Prover::notFollowedAt(Place place) const {
  for (const Unfollowed &each : found_.unfollowed)
    if (each.place == place)
      return fmt::format("where this block leads is not known: \"{}\" is not followed", each.reason);
  return std::nullopt;
}

void Prover::decideSpace(Obligation &obligation, const SpaceRule &rule, const std::vector<const MoveInstance *> &moves,
                         const Violation &violation) {
  const auto unknown = [&](std::string reason) {
    obligation.verdict = Verdict::Unknown;
    obligation.reason = std::move(reason);
    dropProof(obligation);
  };
  if (file().dialect->machine == MachineKind::Turning)
    return unknown("regions are followed on machining centres alone");
  if (rule.missing)
    return unknown(*rule.missing);
  for (const UnfollowedCall &call : found_.unfollowedCalls)
    if (call.own == obligation.place)
      return unknown(notFollowedAt(call.own).value_or("a program that is called here is not followed, and may move the "
                                                      "tool"));
  if (const Outcome sound = discharge(store_, onPath(demands_, rule.isSound), options_.budget); !sound.proved())
    return unknown("the tool or the region may be empty or turned inside out (a radius below 0, a range from high to "
                   "low, a polygon whose sides cross): `@REQUIRE` has to exclude it");
  obligation.verdict = Verdict::Proved;
  for (const MoveInstance *move : moves) {
    if (const auto reason = space_->whyNotTold(*move))
      return unknown(notFollowedAt(move->place).value_or(*reason));
    for (const auto &[premise, reason] : space_->premises(rule, *move))
      if (!isProvedFor(obligation, move->conditions, {{{{}, premise}}}, budget_))
        return unknown(reason);
  }
  for (const MoveInstance *move : moves)
    for (const SpaceQuestion &question : space_->questions(rule, *move)) {
      std::optional<smt::Model> model;
      if (isProvedFor(obligation, move->conditions, question, budget_, &model))
        continue;
      if (model)
        if (auto witness = witnesses_->fromModel(*model, violation)) {
          obligation.verdict = Verdict::Refuted;
          obligation.witness = std::move(witness);
          return dropProof(obligation);
        }
      return unknown(whyOpen(move->conditions, question));
    }
}

/// Movements on one level ask the same of it.
const Outcome &Prover::answered(const Query &query, const Budget &budget) {
  std::vector<TermId> key = query.assumptions;
  key.push_back(query.goal);
  auto [known, isNew] = answers_.try_emplace({std::move(key), budget.search});
  if (isNew)
    known->second = discharge(store_, query, budget);
  return known->second;
}

/// By one of its ways: the model is that of the last one.
bool Prover::isProvedFor(Obligation &obligation, const std::vector<TermId> &conditions, const SpaceQuestion &question,
                         const Budget &budget, std::optional<smt::Model> *model) {
  for (const SpaceQuestion::Way &way : question.ways) {
    std::vector<TermId> all = conditions;
    all.insert(all.end(), way.conditions.begin(), way.conditions.end());
    all.insert(all.end(), signs_.begin(), signs_.end());
    const bool isLast = &way == &question.ways.back();
    const Budget quick{
        .search = std::min(budget.search, kCorners), .z3 = 0, .cvc5 = 0}; // where corners will do, they do so at once
    const std::vector<TermId> parts =
        store_[way.goal].kind == smt::TermKind::And ? store_[way.goal].arguments : std::vector{way.goal};
    std::vector<Outcome> proofs;
    const bool holds = std::all_of(parts.begin(), parts.end(), [&](TermId part) {
      Outcome outcome = answered(onPath(all, part), isLast ? budget : quick);
      obligation.effort += outcome.proved() ? 0 : outcome.effort;
      if (isLast && model != nullptr && outcome.counterexample() != nullptr)
        *model = *outcome.counterexample();
      proofs.push_back(std::move(outcome));
      return proofs.back().proved();
    });
    if (!holds)
      continue;
    for (Outcome &proof : proofs)
      takeProof(obligation, std::move(proof));
    return true;
  }
  return false;
}

bool Prover::isGivenAtStart(Axis axis) const {
  const auto &start = contract()->start;
  return start && std::any_of(start->axes.begin(), start->axes.end(),
                              [&](const AxisValue &value) { return value.axis == letterOf(axis); });
}

/// What the start leaves open, if the claim speaks of it.
std::string Prover::whyOpen(const std::vector<TermId> &conditions, const SpaceQuestion &question) {
  const Query query = onPath(conditions, question.ways.back().goal);
  std::set<TermId> variables;
  for (const TermId variable : smt::variablesOf(store_, query.goal))
    variables.insert(variable);
  std::string axes;
  for (const Axis axis : {Axis::X, Axis::Y, Axis::Z})
    if (variables.contains(entry_.at(axis).number) && !isGivenAtStart(axis))
      axes += fmt::format("{}{}..", axes.empty() ? "" : " ", letterOf(axis));
  if (!axes.empty())
    return fmt::format("where the tool stands at the start is not known: `@START {}` would say", axes);
  const ModalTable modes(*file().dialect);
  for (std::size_t group = 0; group < kModalGroups; ++group)
    if (variables.contains(entry_.codes[group].index) && !modes.group(group).codes.empty()) {
      const Code &code = *modes.group(group).codes.front();
      return fmt::format("the code of the group of G{:02} in force at the start is not known: `@MODAL` would say",
                         code.tenths / 10);
    }
  for (const auto &[variable, value] : reading_.entryValues())
    if (const VariableRange *range = findVariable(*file().dialect, variable);
        range && range->role == VariableRole::WorkOffset && variables.contains(value.number))
      return fmt::format("how far the zero point is moved is not known: `@GLOBAL #{} ..` says what the work offset is",
                         variable);
  return "no proof was found, and no call that breaks it";
}

/// A movement of a run that cuts.  A run does not tell the S of its movements: that is asked of the exact one alone.
bool Prover::breaksLimit(const WordLimit &limit, const RecordedMove &recorded, const GivenVariables &given) const {
  const Move<ConcreteValue> &move = recorded.move;
  const RunOptions options = witnesses_->runOptions(given);
  const auto bound = [&](ExpressionId end) { return numberOf(programs_, program_, *contracts_, options, end); };
  if (!isCutting(move.kind))
    return false;
  return limit.address != 'F' || move.feed.vacant || (limit.range.low && move.feed.number < bound(*limit.range.low)) ||
         (limit.range.high && move.feed.number > bound(*limit.range.high));
}

void Prover::limits() {
  if (!wanted(ObligationKind::Limit))
    return;
  for (const WordLimit &limit : contract()->limits) {
    const SpaceRule rule{.kind = ObligationKind::Limit, .clause = limit.clause};
    std::map<Place, std::vector<Query>> queries;
    std::set<Place> inOtherUnits;
    std::set<Place> unfollowed;
    const auto mayBeReached = [&](Place own, const std::vector<TermId> &conditions) {
      const Query never = onPath(conditions, store_.no());
      if (!answered(never, budget_).proved())
        unfollowed.insert(own);
      queries[own].push_back(never);
    };
    for (const MoveInstance &move : found_.moves) {
      if (!space_->concerns(rule, move))
        continue;
      if (move.move.kind == MoveKind::Unfollowed) {
        mayBeReached(move.own, move.conditions);
        continue;
      }
      queries[move.own].push_back(onPath(move.conditions, space_->keepsLimit(limit, move)));
      const TermId sameMeaning = limit.address == 'F'
                                     ? store_.logicalAnd(move.point.sameUnits.term, move.point.sameFeedMode.term)
                                     : move.point.sameSpindleMode.term;
      if (!answered(onPath(move.conditions, sameMeaning), budget_).proved())
        inOtherUnits.insert(move.own);
    }
    for (const UnfollowedCall &call : found_.unfollowedCalls)
      mayBeReached(call.own, call.conditions);
    if (queries.empty() && found_.incomplete)
      queries[{program_.file, program_.entry}];
    for (const auto &[own, parts] : queries) {
      Obligation &obligation = add(ObligationKind::Limit, own, file().tree->blocks[programs_.node(own).block].span(),
                                   contracts_->clauses[limit.clause].text);
      obligation.id.insert(obligation.id.rfind('.'), fmt::format(".{}", limit.address));
      if (inOtherUnits.contains(own)) {
        obligation.reason = fmt::format("{} may be in other units than at the start ({}), and those are the units of "
                                        "the limit",
                                        limit.address, limit.address == 'F' ? "G20, G21, G93 to G95" : "G96, G97");
        continue;
      }
      if (unfollowed.contains(own)) {
        obligation.reason = notFollowedAt(own).value_or("a movement here is not followed, and may cut");
        continue;
      }
      const auto cuts = [this, &limit, own = own](const RunResult &run, const GivenVariables &given) {
        const bool isMet = std::any_of(run.moves.begin(), run.moves.end(), [&](const RecordedMove &move) {
          return move.own == own && breaksLimit(limit, move, given);
        });
        return isMet ? std::optional(fmt::format("{} in force here is not within its limit", limit.address))
                     : std::nullopt;
      };
      settle(obligation, parts,
             {cuts, [this, kind = obligation.kind, claim = obligation.claim, own = own](const GivenVariables &given) {
                return breaksExactly(given, kind, claim, own);
              }});
    }
  }
}

} // namespace feedhold::prove
