// Claims about space: where the tool may go (docs/geometry.md).
#include "proof/prove/plain_space.h"
#include "proof/prove/prover.h"
#include "proof/prove/space_claims.h"

#include <algorithm>
#include <fmt/format.h>

namespace feedhold::prove {

using geometry::SpaceClaim;
using smt::TermId;

namespace {

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

Violation Prover::gouges(const SpaceRule &rule, Place own) const {
  return {[this, &rule, own](const RunResult &run, const GivenVariables &given) -> std::optional<std::string> {
    const auto gouge = gougeIn(rule, own, run, given);
    if (!gouge)
      return std::nullopt;
    const auto &[x, y, z] = gouge->at;
    return fmt::format("{} at X{:.4g} Y{:.4g} Z{:.4g}", howFar(rule, gouge->depth), x + 0.0, y + 0.0, z + 0.0);
  }};
}

void Prover::spaces() {
  if (!contract() || !hasSpaceClause(*contract()) || isSingleRun_)
    return;
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
  if (obligation.witness && obligation.verdict == Verdict::Refuted) {
    RunOptions options = witnesses_->runOptions(obligation.witness->variables);
    options.fuel = WitnessSearch::kFuel;
    obligation.witness->gouge =
        gougeIn(rule, own, feedhold::run(programs_, program_, options), obligation.witness->variables);
  }
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
      return unknown("a program that is called here is not followed, and may move the tool");
  if (const Outcome sound = discharge(store_, onPath(demands_, rule.isSound), options_.budget); !sound.proved())
    return unknown("the tool or the region may be empty or turned inside out (a radius below 0, a range from high to "
                   "low): `@REQUIRE` has to exclude it");
  obligation.verdict = Verdict::Proved;
  for (const MoveInstance *move : moves) {
    if (const auto reason = space_->whyNotTold(*move))
      return unknown(*reason);
    for (const auto &[premise, reason] : space_->premises(rule, *move))
      if (!isProvedFor(obligation, move->conditions, {{{{}, premise}}}))
        return unknown(reason);
  }
  obligation.grade = Grade::Certified;
  for (const MoveInstance *move : moves)
    for (const SpaceQuestion &question : space_->questions(rule, *move)) {
      std::optional<smt::Model> model;
      if (isProvedFor(obligation, move->conditions, question, &model))
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

/// By one of its ways.  The model is that of the last one.
bool Prover::isProvedFor(Obligation &obligation, const std::vector<TermId> &conditions, const SpaceQuestion &question,
                         std::optional<smt::Model> *model) {
  for (const SpaceQuestion::Way &way : question.ways) {
    if (way.goal == store_.yes()) {
      if (obligation.method.empty())
        obligation.method = "folding";
      return true;
    }
    std::vector<TermId> all = conditions;
    all.insert(all.end(), way.conditions.begin(), way.conditions.end());
    const bool isLast = &way == &question.ways.back();
    Budget budget = budget_;
    if (!isLast) // where corners will do, they do so at once
      budget = {.search = 60'000, .z3 = 0, .cvc5 = 0};
    Outcome outcome = discharge(store_, onPath(all, way.goal), budget);
    if (outcome.proved()) {
      takeProof(obligation, std::move(outcome));
      return true;
    }
    obligation.effort += outcome.effort;
    if (isLast && model != nullptr && outcome.counterexample() != nullptr)
      *model = *outcome.counterexample();
  }
  return false;
}

/// What the start leaves open, if the claim speaks of it.
std::string Prover::whyOpen(const std::vector<TermId> &conditions, const SpaceQuestion &question) {
  const Query query = onPath(conditions, question.ways.back().goal);
  std::set<TermId> variables;
  for (const TermId term : {query.goal})
    for (const TermId variable : smt::variablesOf(store_, term))
      variables.insert(variable);
  std::string axes;
  for (const Axis axis : {Axis::X, Axis::Y, Axis::Z})
    if (variables.contains(entry_.at(axis).number))
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
  return "no proof was found, and no call that breaks it";
}

void Prover::limits() {
  if (!wanted(ObligationKind::Limit))
    return;
  for (const WordLimit &limit : contract()->limits) {
    const SpaceRule rule{.kind = ObligationKind::Limit, .clause = limit.clause};
    std::map<Place, std::vector<Query>> queries;
    for (const MoveInstance &move : found_.moves)
      if (space_->concerns(rule, move))
        queries[move.own].push_back(onPath(
            move.conditions, move.move.kind == MoveKind::Unfollowed ? store_.no() : space_->keepsLimit(limit, move)));
    for (const UnfollowedCall &call : found_.unfollowedCalls)
      queries[call.own].push_back(onPath(call.conditions, store_.no()));
    for (const auto &[own, parts] : queries) {
      Obligation &obligation = add(ObligationKind::Limit, own, file().tree->blocks[programs_.node(own).block].span(),
                                   contracts_->clauses[limit.clause].text);
      obligation.id.insert(obligation.id.rfind('.'), fmt::format(".{}", limit.address));
      const auto cuts = [own = own, address = limit.address](const RunResult &run) -> std::optional<std::string> {
        const bool isMet =
            std::any_of(run.moves.begin(), run.moves.end(), [&](const RecordedMove &move) { return move.own == own; });
        return isMet ? std::optional(fmt::format("{} in force here is not within its limit", address)) : std::nullopt;
      };
      settle(obligation, parts,
             {cuts, [this, kind = obligation.kind, claim = obligation.claim, own = own](const GivenVariables &given) {
                return breaksExactly(given, kind, claim, own);
              }});
    }
  }
}

} // namespace feedhold::prove
