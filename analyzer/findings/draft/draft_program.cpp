// Drafts the contract of one program: collects clauses, proves with them, and keeps those that are of use.
#include "findings/draft/conditions.h"
#include "findings/draft/draft.h"
#include "findings/draft/entry_clauses.h"
#include "findings/draft/guard_promises.h"
#include "findings/draft/modal_needs.h"
#include "findings/draft/promises.h"
#include "findings/draft/space_suggestions.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>

namespace feedhold::draft {

namespace {

constexpr std::size_t kMostGuesses = 4;

std::vector<std::string> linesOf(const DraftClauses &clauses) {
  std::vector<std::string> lines;
  for (const DraftClause &clause : clauses)
    if (clause.ground != Ground::Hint)
      lines.push_back(clause.text);
  return lines;
}

std::vector<std::string> with(std::vector<std::string> lines, std::string more) {
  lines.push_back(std::move(more));
  return lines;
}

class ProgramDrafter {
public:
  ProgramDrafter(const Project &project, ProgramId program, const std::string &kept, const prove::ProveOptions &options)
      : project_(project), program_(program), trial_(project, program, kept, options) {}

  ProgramDraft run() {
    const FileContracts contracts = trial_.contractsWith({});
    const FlowFacts facts = collectFacts(*project_.set, FileId(0), program_, {}, &contracts);
    draft_.before = scoreBesidePromises(trial_.prove({}));
    GuardTable table = guardTableOf(facts);
    leaveOutRefuted(table);
    if (isStarted(facts))
      addAlarms(table);
    addEntry(entryClauses(project_, facts, table));
    addEntry(modalNeeds(facts, contracts));
    std::vector<DraftClauses> promises = promisesOf(facts);
    prove::ProgramProof proof = proveWith(promises, prove::InferGuards::Yes);
    if (isContradictory(proof)) {
      std::erase_if(draft_.clauses, [](const DraftClause &each) { return each.ground == Ground::Guard; });
      promises = promisesOf(facts);
      proof = proveWith(promises, prove::InferGuards::Yes);
    }
    if (trySuggested(promises, scoreOf(proof))) {
      promises = promisesOf(facts);
      proof = proveWith(promises, prove::InferGuards::Yes);
    }
    addGuesses(proof);
    keepPromises(promises, draft_.guesses == 0 ? proof : proveWith(promises, prove::InferGuards::No));
    draft_.after = scoreBesidePromises(trial_.prove(linesOf(draft_.clauses)));
    addSpace(spaceSuggestions(project_, facts, trial_.contractsWith(linesOf(draft_.clauses))));
    return std::move(draft_);
  }

private:
  /// No call satisfies the contract: every call is refused.
  static bool isContradictory(const prove::ProgramProof &proof) {
    return std::ranges::any_of(proof.obligations, [](const prove::Obligation &claim) {
      return claim.kind == prove::ObligationKind::ContractSatisfiable && claim.verdict == prove::Verdict::Refuted;
    });
  }

  /// The operator starts it, and nothing in the folder calls it: nobody keeps a contract towards it.
  bool isStarted(const FlowFacts &facts) const {
    return !comesBack(facts) && !project_.callGraph.isCalled({FileId(0), program_});
  }

  /// Guards that some run gets past, though it should not.
  void leaveOutRefuted(GuardTable &table) const {
    std::vector<std::optional<std::string>> refusals;
    for (const Guard &guard : table.guards)
      refusals.push_back(refusalOf(table, guard));
    std::set<std::string> lines;
    for (const auto &refusal : refusals)
      if (refusal)
        lines.insert(*refusal);
    if (lines.empty())
      return;
    std::set<std::string> refuted;
    for (const prove::Obligation &claim :
         trial_.prove({lines.begin(), lines.end()}, {prove::ObligationKind::AlarmIff}).obligations)
      if (claim.verdict == prove::Verdict::Refuted)
        refuted.insert(claim.claim);
    std::vector<Guard> kept;
    for (std::size_t i = 0; i < table.guards.size(); ++i)
      if (!refusals[i] || !refuted.contains(*refusals[i]))
        kept.push_back(std::move(table.guards[i]));
    table.guards = std::move(kept);
  }

  /// What an alarm clause says of a program that is started, no entry clause has to say.
  void addAlarms(GuardTable &table) {
    const ProjectFile &file = project_.file(FileId(0));
    for (const AlarmClauses &alarm : alarmClauses(table, file.source, file.tree))
      for (const DraftClause &clause : alarm.alternatives) {
        if (!trial_.areSound(with(linesOf(draft_.clauses), clause.text)) ||
            !isProved(clause,
                      trial_.prove(with(linesOf(draft_.clauses), clause.text), {prove::ObligationKind::AlarmIff})))
          continue;
        draft_.clauses.push_back(clause);
        ++draft_.promises;
        std::erase_if(table.guards, [&](const Guard &guard) { return guard.alarm == alarm.alarm; });
        break;
      }
  }

  /// Clauses that can be read beside those that are there.
  void addEntry(DraftClauses clauses) {
    for (DraftClause &clause : clauses)
      if (clause.ground == Ground::Hint || trial_.areSound(with(linesOf(draft_.clauses), clause.text)))
        draft_.clauses.push_back(std::move(clause));
  }
  /// A region is read only behind its tool.
  void addSpace(DraftClauses clauses) {
    std::vector<std::string> lines = linesOf(draft_.clauses);
    for (const DraftClause &clause : clauses)
      lines.push_back(clause.text);
    if (trial_.areSound(lines))
      std::ranges::move(clauses, std::back_inserter(draft_.clauses));
  }

  /// Guards hardly ever ask for the mode.
  DraftClause guardedClause() const {
    const bool hasModes = std::ranges::any_of(draft_.clauses, [](const DraftClause &each) {
      return each.ground != Ground::Hint && each.text.starts_with("@MODAL");
    });
    if (hasModes)
      return {"@GUARDED EXCEPT MODAL", "any other call in these modes raises an alarm before an axis moves",
              Ground::Promise};
    return {"@GUARDED", "any other call raises an alarm before an axis moves", Ground::Promise};
  }

  std::vector<DraftClauses> promisesOf(const FlowFacts &facts) const {
    std::vector<DraftClauses> groups = promiseGroups(facts);
    if (std::ranges::any_of(draft_.clauses, [](const DraftClause &each) { return each.ground == Ground::Guard; }))
      groups.push_back({guardedClause()});
    for (DraftClauses &group : groups)
      std::erase_if(
          group, [&](const DraftClause &each) { return !trial_.areSound(with(linesOf(draft_.clauses), each.text)); });
    return groups;
  }

  prove::ProgramProof proveWith(const std::vector<DraftClauses> &promises, prove::InferGuards guards) const {
    std::vector<std::string> lines = linesOf(draft_.clauses);
    for (const DraftClauses &group : promises)
      for (const DraftClause &each : group)
        lines.push_back(each.text);
    return trial_.prove(lines, {}, guards);
  }

  static bool isProved(const DraftClause &clause, const prove::ProgramProof &proof) {
    const auto claim = std::ranges::find(proof.obligations, clause.text, &prove::Obligation::claim);
    return claim != proof.obligations.end() && claim->verdict == prove::Verdict::Proved && !claim->verdict.exactOnly();
  }
  /// Any promise would hold on a return that never comes.
  static bool neverReturns(const prove::ProgramProof &proof) {
    return std::ranges::any_of(proof.obligations, [](const prove::Obligation &claim) {
      return (claim.kind == prove::ObligationKind::Ensures || claim.kind == prove::ObligationKind::ModalPreserved) &&
             claim.verdict == prove::Verdict::Unreachable;
    });
  }

  /// The first of each group that is proved.
  void keepPromises(const std::vector<DraftClauses> &promises, const prove::ProgramProof &proof) {
    if (neverReturns(proof))
      return;
    for (const DraftClauses &group : promises)
      if (const auto best = std::ranges::find_if(group, [&](const DraftClause &each) { return isProved(each, proof); });
          best != group.end()) {
        draft_.clauses.push_back(*best);
        ++draft_.promises;
      }
  }

  // ---- which of them are needed ----

  std::size_t proofsWith(const std::vector<DraftClauses> &promises) const {
    return scoreOf(proveWith(promises, prove::InferGuards::No)).holds;
  }

  /// What is only suggested becomes a clause where more is proved with it: tried together, then each alone is left out.
  bool trySuggested(const std::vector<DraftClauses> &promises, const Score &score) {
    std::vector<DraftClause *> tried;
    for (DraftClause &clause : draft_.clauses)
      if (clause.ground == Ground::Hint) {
        clause.ground = Ground::Guess;
        if (trial_.areSound(linesOf(draft_.clauses)))
          tried.push_back(&clause);
        else
          clause.ground = Ground::Hint;
      }
    const std::size_t best = tried.empty() ? 0 : proofsWith(promises);
    if (best <= score.holds) {
      for (DraftClause *clause : tried)
        clause->ground = Ground::Hint;
      return false;
    }
    for (DraftClause *clause : tried)
      if (tried.size() > 1) {
        clause->ground = Ground::Hint;
        clause->ground = proofsWith(promises) < best ? Ground::Guess : Ground::Hint;
      }
    for (DraftClause *clause : tried)
      if (clause->ground == Ground::Guess && !clause->weaker.empty()) {
        std::swap(clause->text, clause->weaker);
        if (proofsWith(promises) < best)
          std::swap(clause->text, clause->weaker);
      }
    return true;
  }

  // ---- conditions that the prover asks for ----

  void addGuesses(const prove::ProgramProof &proof) {
    std::map<std::string, std::vector<std::string>> claims; // by clause
    for (const prove::Obligation &claim : proof.obligations)
      // What keeps an alarm of the program away is for its guards to say.
      if (const prove::Guard *guard = claim.verdict.guard();
          guard && claim.kind != prove::ObligationKind::AlarmUnreachable)
        claims[clauseOf(*guard)].push_back(toldOf(claim));
    std::vector<std::string> clauses;
    for (const auto &[clause, of] : claims)
      if (clause.find(" EQ ") == std::string::npos) // one single value is seldom what is meant
        clauses.push_back(clause);
    std::ranges::stable_sort(clauses, std::greater(), [&](const std::string &each) { return claims[each].size(); });
    if (clauses.empty())
      return;
    Score score = scoreOf(trial_.prove(linesOf(draft_.clauses)));
    for (const std::string &clause : clauses) {
      if (draft_.guesses == kMostGuesses || !trial_.areSound(with(linesOf(draft_.clauses), clause)))
        continue;
      const Score next = scoreOf(trial_.prove(with(linesOf(draft_.clauses), clause)));
      if (next.holds <= score.holds)
        continue;
      score = next;
      ++draft_.guesses;
      draft_.clauses.push_back({clause, fmt::format("without it {}", claims[clause].front()), Ground::Guess});
    }
  }
  /// A step above 0 may be too small to be added: then it is at least one increment.
  std::string clauseOf(const prove::Guard &guard) const {
    constexpr std::string_view kAboveZero = " GT 0";
    if (!guard.exactOnly || guard.conditions.size() != 1 || !guard.clause.ends_with(kAboveZero))
      return guard.clause;
    const Dialect &dialect = *project_.file(FileId(0)).dialect;
    return fmt::format("{} GE {}", guard.clause.substr(0, guard.clause.size() - kAboveZero.size()),
                       toleranceOf(Contract{}, dialect).toString());
  }
  std::string toldOf(const prove::Obligation &claim) const {
    const ProgramFile &file = project_.set->file(claim.place.file);
    const std::uint32_t line = file.source->lineOf(claim.span.begin);
    if (claim.kind == prove::ObligationKind::LoopEnds)
      return fmt::format("the loop of line {} may not end", line);
    if (claim.kind == prove::ObligationKind::ProgramEnds)
      return "the program may not end";
    return fmt::format("line {} may stop with an alarm", line);
  }

  const Project &project_;
  ProgramId program_;
  Trial trial_;
  ProgramDraft draft_;
};

} // namespace

ProgramDraft draftOf(const Project &project, ProgramId program, const std::string &kept,
                     const prove::ProveOptions &options) {
  return ProgramDrafter(project, program, kept, options).run();
}

} // namespace feedhold::draft
