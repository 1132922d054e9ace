// `@LIMIT`: the feed and the spindle speed of cutting moves stay within their limits.
#include "proof/families/families.h"
#include "proof/space/plain_space.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <iterator>
#include <map>
#include <set>

namespace feedhold::prove {

namespace {

/// The blocks in which a run cuts outside of a limit.  A run does not tell the S of its movements: that is asked of the
/// exact one alone.
std::vector<Place> brokenIn(const ProofSubject &subject, const WordLimit &limit, const RunResult &run,
                            const GivenVariables &given) {
  RunOptions options;
  options.variables = given;
  options = startedAsSaid(subject.programs, subject.program, *subject.contracts, std::move(options));
  const auto bound = [&](const std::optional<ExpressionId> &end, double without) {
    return end ? numberOf(subject.programs, subject.program, *subject.contracts, options, *end) : without;
  };
  const double low = bound(limit.range.low, -HUGE_VAL), high = bound(limit.range.high, HUGE_VAL);
  std::set<Place> blocks;
  for (const RecordedMove &recorded : run.moves) {
    const ConcreteValue &feed = recorded.move.feed;
    if (isCutting(recorded.move.kind) &&
        (limit.address != 'F' || feed.vacant || feed.number < low || feed.number > high))
      blocks.insert(recorded.own);
  }
  return {blocks.begin(), blocks.end()};
}

Violation::Happened cutsAt(const ProofSubject &subject, const WordLimit &limit, Place own) {
  return [&subject, &limit, own](const RunResult &run, const GivenVariables &given) -> std::optional<std::string> {
    const std::vector<Place> blocks = brokenIn(subject, limit, run, given);
    return std::ranges::binary_search(blocks, own)
               ? std::optional(fmt::format("a cutting move runs with {} outside its limit", limit.address))
               : std::nullopt;
  };
}

/// What an F means depends on the units and on what it is counted by, an S on whether it is a speed of cutting.
smt::TermId hasSameMeaning(ProofStart &start, const WordLimit &limit, const MoveInstance &move) {
  return limit.address == 'F' ? start.store().logicalAnd(move.point.sameUnits.term, move.point.sameFeedMode.term)
                              : move.point.sameSpindleMode.term;
}

class LimitQuestions {
public:
  LimitQuestions(const ExploredProgram &program, const WordLimit &limit)
      : subject_(program.subject), start_(program.start), found_(program.found), limit_(limit) {}

  Questions collect() {
    const SpaceRule rule{.kind = ObligationKind::Limit, .clause = limit_.clause};
    for (const MoveInstance &move : found_.moves)
      if (start_.space().concerns(rule, move))
        add(move);
    for (const UnmodelledCall &call : found_.unmodelledCalls)
      addUnmodelled(call.own, call.conditions);
    if (questions_.empty() && found_.incomplete)
      at(subject_.head());
    Questions all;
    for (auto &[own, question] : questions_)
      all.push_back(std::move(question));
    return all;
  }

private:
  void add(const MoveInstance &move) {
    if (move.move.kind == MoveKind::Unmodelled)
      return addUnmodelled(move.own, move.conditions);
    Question &question = at(move.own);
    question.goals.push_back({&move.conditions, start_.space().keepsLimit(limit_, move)});
    if (question.open.empty() && !isProved(move.conditions, hasSameMeaning(start_, limit_, move)))
      question.open = fmt::format(
          "the limit on {} is in the units of the start, which may have changed ({}); state them with `@MODAL`",
          limit_.address, limit_.address == 'F' ? "G20, G21, G93 to G95" : "G96, G97");
  }

  /// Whether an unmodelled block cuts, and how fast, is unknown.
  void addUnmodelled(Place own, const std::vector<smt::TermId> &conditions) {
    Question &question = at(own);
    question.goals.push_back({&conditions, start_.store().no()});
    if (question.open.empty() && !isProved(conditions, start_.store().no()))
      question.open = found_.unmodelledAt(own).value_or("a move here is not modelled and may cut");
  }

  bool isProved(const std::vector<smt::TermId> &conditions, smt::TermId goal) {
    return discharge(start_.store(), start_.onPath(conditions, goal), subject_.options.budget).proved();
  }

  Question &at(Place own) {
    const auto known = questions_.find(own);
    if (known != questions_.end())
      return known->second;
    Question question{
        .row = subject_.obligation(ObligationKind::Limit, own, subject_.spanOf(own), subject_.textOf(limit_.clause)),
        .goals = {},
        .broken = cutsAt(subject_, limit_, own),
        .isJudgedExactly = true};
    question.ofBlock = {{{ObligationKind::Limit, limit_.clause},
                         [&subject = subject_, &limit = limit_](const RunResult &run, const GivenVariables &given) {
                           return brokenIn(subject, limit, run, given);
                         }},
                        own};
    question.row.id.insert(question.row.id.rfind('.'), fmt::format(".{}", limit_.address));
    return questions_.emplace(own, std::move(question)).first->second;
  }

  const ProofSubject &subject_;
  ProofStart &start_;
  const Exploration &found_;
  const WordLimit &limit_;
  std::map<Place, Question> questions_; // by block
};

} // namespace

Questions limitQuestions(const ExploredProgram &program) {
  Questions all;
  if (!program.subject.wants(ObligationKind::Limit))
    return all;
  for (const WordLimit &limit : program.subject.contract()->limits)
    std::ranges::move(LimitQuestions(program, limit).collect(), std::back_inserter(all));
  return all;
}

} // namespace feedhold::prove
