// `@LIMIT`: feed and speed of cutting movements.
#include "proof/prove/obligations.h"

#include <algorithm>
#include <fmt/format.h>
#include <set>

namespace feedhold::prove {

namespace {

/// A run that comes to a movement of the block may break the limit there.
Violation::Happened movesAt(Place own, char address) {
  return [own, address](const RunResult &run, const GivenVariables &) -> std::optional<std::string> {
    const bool isMet =
        std::any_of(run.moves.begin(), run.moves.end(), [&](const RecordedMove &move) { return move.own == own; });
    return isMet ? std::optional(fmt::format("{} in force here is not within its limit", address)) : std::nullopt;
  };
}

Question limitAt(const ProofSubject &subject, const WordLimit &limit, Place own) {
  Question question{
      .row = subject.obligation(ObligationKind::Limit, own, subject.spanOf(own), subject.textOf(limit.clause)),
      .goals = {},
      .broken = movesAt(own, limit.address),
      .isJudgedExactly = true};
  question.row.id.insert(question.row.id.rfind('.'), fmt::format(".{}", limit.address));
  return question;
}

bool isInSameUnits(ProofStart &start, const MoveInstance &move, const Budget &budget) {
  return discharge(start.store(), start.onPath(move.conditions, move.point.sameUnits.term), budget).proved();
}

/// By block.
std::map<Place, Question> questionsOf(const ExploredProgram &program, const WordLimit &limit) {
  const auto &[subject, start, found] = program;
  const SpaceRule rule{.kind = ObligationKind::Limit, .clause = limit.clause};
  std::map<Place, Question> questions;
  const auto at = [&, &subject = subject](Place own) -> Question & {
    const auto known = questions.find(own);
    return known != questions.end() ? known->second
                                    : questions.emplace(own, limitAt(subject, limit, own)).first->second;
  };
  smt::TermStore &store = start.store();
  for (const MoveInstance &move : found.moves) {
    if (!start.space().concerns(rule, move))
      continue;
    Question &question = at(move.own);
    const bool isFollowed = move.move.kind != MoveKind::Unfollowed;
    question.goals.push_back({&move.conditions, isFollowed ? start.space().keepsLimit(limit, move) : store.no()});
    if (limit.address == 'F' && !isInSameUnits(start, move, subject.options.budget))
      question.open = "F may be in other units than at the start (G20, G21), and those are the units of the limit";
  }
  for (const UnfollowedCall &call : found.unfollowedCalls)
    at(call.own).goals.push_back({&call.conditions, store.no()});
  if (questions.empty() && found.incomplete)
    at(subject.head());
  return questions;
}

} // namespace

Questions limitQuestions(const ExploredProgram &program) {
  Questions all;
  if (!program.subject.wants(ObligationKind::Limit))
    return all;
  for (const WordLimit &limit : program.subject.contract()->limits)
    for (auto &[own, question] : questionsOf(program, limit))
      all.push_back(std::move(question));
  return all;
}

} // namespace feedhold::prove
