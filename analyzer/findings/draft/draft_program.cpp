// Drafts the contract of one program: collects clauses, proves with them, and keeps those that are of use.
#include "findings/draft/draft.h"
#include "findings/draft/entry_clauses.h"
#include "findings/draft/modal_needs.h"
#include "findings/draft/promises.h"

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
    addEntry(entryClauses(project_, facts, guardTableOf(facts)));
    addEntry(modalNeeds(facts, contracts));
    std::vector<DraftClauses> promises = promisesOf(facts);
    prove::ProgramProof proof = proveWith(promises, prove::InferGuards::Yes);
    if (isContradictory(proof)) {
      std::erase_if(draft_.clauses, [](const DraftClause &each) { return each.ground == Ground::Guard; });
      promises = promisesOf(facts);
      proof = proveWith(promises, prove::InferGuards::Yes);
    }
    if (trySuggested(promises, scoreOf(proof)))
      proof = proveWith(promises, prove::InferGuards::Yes);
    addGuesses(proof);
    keepPromises(promises, draft_.guesses == 0 ? proof : proveWith(promises, prove::InferGuards::No));
    draft_.after = scoreBesidePromises(trial_.prove(linesOf(draft_.clauses)));
    return std::move(draft_);
  }

private:
  /// No call satisfies the contract: every call is refused.
  static bool isContradictory(const prove::ProgramProof &proof) {
    return std::ranges::any_of(proof.obligations, [](const prove::Obligation &claim) {
      return claim.kind == prove::ObligationKind::ContractSatisfiable && claim.verdict == prove::Verdict::Refuted;
    });
  }

  /// Clauses that can be read beside those that are there, and that no run shows to be wrong.
  void addEntry(DraftClauses clauses) {
    const std::set<std::string> refuted = refutedOf(clauses);
    for (DraftClause &clause : clauses) {
      const bool isWrong =
          std::ranges::any_of(clause.shownBy, [&](const std::string &promise) { return refuted.contains(promise); });
      if (isWrong || (clause.ground != Ground::Hint && !trial_.areSound(with(linesOf(draft_.clauses), clause.text))))
        continue;
      draft_.clauses.push_back(std::move(clause));
    }
  }
  std::set<std::string> refutedOf(const DraftClauses &clauses) const {
    std::set<std::string> promises;
    for (const DraftClause &clause : clauses)
      promises.insert(clause.shownBy.begin(), clause.shownBy.end());
    std::set<std::string> refuted;
    if (promises.empty())
      return refuted;
    const prove::ProgramProof proof =
        trial_.prove({promises.begin(), promises.end()}, {prove::ObligationKind::AlarmIff});
    for (const prove::Obligation &claim : proof.obligations)
      if (claim.verdict == prove::Verdict::Refuted)
        refuted.insert(claim.claim);
    return refuted;
  }

  std::vector<DraftClauses> promisesOf(const FlowFacts &facts) const {
    std::vector<DraftClauses> groups = promiseGroups(project_, facts);
    if (std::ranges::any_of(draft_.clauses, [](const DraftClause &each) { return each.ground == Ground::Guard; }))
      groups.push_back({{"@GUARDED", "any other call raises an alarm before an axis moves", Ground::Promise}});
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

  /// The first of each group that is proved.
  void keepPromises(const std::vector<DraftClauses> &promises, const prove::ProgramProof &proof) {
    const auto isProved = [&](const DraftClause &clause) {
      const auto claim = std::ranges::find(proof.obligations, clause.text, &prove::Obligation::claim);
      return claim != proof.obligations.end() && claim->verdict.holds() && !claim->verdict.exactOnly();
    };
    for (const DraftClauses &group : promises)
      if (const auto best = std::ranges::find_if(group, isProved); best != group.end()) {
        draft_.clauses.push_back(*best);
        ++draft_.promises;
      }
  }

  /// A mode that is only suggested becomes a clause where more is proved with it.
  bool trySuggested(const std::vector<DraftClauses> &promises, const Score &score) {
    bool isBetter = false;
    for (DraftClause &clause : draft_.clauses) {
      if (clause.ground != Ground::Hint)
        continue;
      clause.ground = Ground::Guess;
      const bool helps = trial_.areSound(linesOf(draft_.clauses)) &&
                         scoreOf(proveWith(promises, prove::InferGuards::No)).holds > score.holds;
      clause.ground = helps ? Ground::Guess : Ground::Hint;
      isBetter = isBetter || helps;
    }
    return isBetter;
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
