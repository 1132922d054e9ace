#include "proof/prove/judge.h"

#include <algorithm>
#include <functional>

namespace feedhold::prove {

namespace {

using Runs = std::vector<WitnessSearch::Sample>;

/// The first run that denies the claim.
std::optional<Witness> denied(const WitnessSearch &witnesses, const Runs &runs, const Violation &violation) {
  for (const WitnessSearch::Sample &run : runs)
    if (auto witness = witnesses.shown(run, violation))
      return witness;
  return std::nullopt;
}

/// Claims that are looked up by following a run exactly were asked of the samples before they were proved; to follow
/// all of them again would cost more than the proofs.
std::optional<Witness> denied(const WitnessSearch &witnesses, const Violation &violation) {
  auto witness = denied(witnesses, witnesses.replays(), violation);
  if (witness || violation.breaksExactly)
    return witness;
  for (const std::size_t i : witnesses.mayBreak(violation))
    if (auto found = witnesses.shown(witnesses.samples()[i], violation))
      return found;
  return std::nullopt;
}

} // namespace

void refuteByRounding(const ProofContext &context, const std::vector<Denial> &denials, std::vector<Obligation> &rows) {
  for (const Denial &denial : denials) {
    const auto row = std::ranges::find_if(
        rows, [&](const Obligation &each) { return each.verdict.holds() && isSameClaim(each, denial.row); });
    if (row == rows.end())
      continue;
    const Violation violation = denial.violation(context);
    for (const WitnessSearch::Sample &run : context.witnesses.samples())
      if (auto witness = context.witnesses.shownByRounding(run, violation)) {
        row->verdict = *std::move(witness);
        break;
      }
  }
}

namespace {

void refuteWith(const ProofContext &context, Witness witness, Obligation &row) {
  row.returning.clear();
  row.promising.clear();
  row.unchanged = false;
  const std::set<std::string> skipped = context.witnesses.runOf(witness.variables).skipped;
  row.verdict = std::move(witness);
  row.verdict.setReturning(skipped);
}

using FindRun = std::function<std::optional<Witness>(const Violation &)>;

std::vector<Contradiction> contradictions(const ProofContext &context, const std::vector<Denial> &denials,
                                          std::vector<Obligation> &rows, const FindRun &denyingRun) {
  std::vector<Contradiction> found;
  for (const Denial &denial : denials) {
    const auto row = std::ranges::find_if(
        rows, [&](const Obligation &each) { return each.verdict.holds() && isSameClaim(each, denial.row); });
    if (row == rows.end())
      continue;
    if (auto witness = denyingRun(denial.violation(context))) {
      if (!row->promising.empty()) { // a called program does not what the proof took it to do
        refuteWith(context, *std::move(witness), *row);
        continue;
      }
      found.push_back({row->id, std::string(nameOf(row->verdict)), *std::move(witness)});
      row->verdict = Verdict::unknown("a run contradicts the proof: this is a bug in Feedhold");
    }
  }
  return found;
}

} // namespace

std::vector<Contradiction> judge(const ProofContext &context, const std::vector<Denial> &denials,
                                 std::vector<Obligation> &rows) {
  return contradictions(context, denials, rows,
                        [&](const Violation &violation) { return denied(context.witnesses, violation); });
}

std::vector<Contradiction> judgeRun(const ProofContext &context, const std::vector<Denial> &denials,
                                    const WitnessSearch::Sample &run, std::vector<Obligation> &rows) {
  return contradictions(context, denials, rows,
                        [&](const Violation &violation) { return context.witnesses.shown(run, violation); });
}

void refute(const ProofContext &context, const std::vector<Denial> &denials, const WitnessSearch::Sample &run,
            std::vector<Obligation> &rows) {
  for (const Denial &denial : denials)
    for (Obligation &row : rows)
      if (row.verdict == Verdict::Unknown && isSameClaim(row, denial.row))
        if (auto witness = context.witnesses.shown(run, denial.violation(context)))
          row.verdict = denial.located ? denial.located(context, *std::move(witness)) : *std::move(witness);
}

} // namespace feedhold::prove
