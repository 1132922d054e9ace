// Termination: every loop ends, and so does the program.
#include "meaning/cfg/wto.h"
#include "proof/families/awaited_reads.h"
#include "proof/families/families.h"
#include "proof/families/loop_ends.h"
#include "proof/termination/termination_explanation.h"

#include <algorithm>
#include <fmt/format.h>

namespace feedhold::prove {

namespace {

constexpr std::string_view kUnrolled = "loop unrolling";
constexpr std::string_view kMayRepeat = "a path may return to an earlier state and repeat for ever";

bool isInside(const Wto &wto, Place head, Place at) {
  const std::uint32_t position = at.file == head.file ? wto.positionOf(at.node) : Wto::kUnreachable;
  return wto.positionOf(head.node) <= position && position < wto.endOf(head.node);
}

/// All paths have been followed to their end.
Verdict endsByIterations(const ProofContext &context, const Obligation &obligation) {
  if (!context.found.repeats.empty())
    return Verdict::unknown(std::string(kMayRepeat), context.found.repeats.front());
  const bool isMet = obligation.kind != ObligationKind::LoopEnds || context.found.heads.contains(obligation.place);
  if (!isMet)
    return verdict::Unreachable{.method = std::string(kUnrolled)};
  return verdict::Proved{.proof = {.method = std::string(kUnrolled)}};
}

std::string mayNotReturn(const UnmodelledCall &call) {
  return fmt::format("{}; whether the call returns is unknown", call.why);
}

using Instances = std::vector<const LoopInstance *>;

/// Each of them ends.
Verdict endOfAll(const ProofContext &context, const Instances &instances, std::uint64_t &effort) {
  if (instances.empty())
    return verdict::Unreachable{};
  Proof proof;
  std::optional<Verdict> open;
  for (const LoopInstance *instance : instances) {
    const UnmodelledCall *call =
        instance->unmodelledCall ? &context.found.unmodelledCalls[*instance->unmodelledCall] : nullptr;
    if (call && call->mayNotReturn()) {
      open = Verdict::unknown(mayNotReturn(*call), instance->head);
      continue;
    }
    const Termination &end = endOf(context, *instance);
    if (end.endless)
      return *end.endless;
    for (const Outcome &outcome : end.evidence)
      if (end.proved) {
        effort += outcome.effort;
        proof.add(outcome);
      }
    if (!end.proved)
      open = Verdict::unknown(end.reason, instance->head);
  }
  return open ? *std::move(open) : Verdict(verdict::Proved{.proof = std::move(proof)});
}

void settleLoop(const ProofContext &context, Obligation &obligation, const Instances &instances,
                const Violation &violation) {
  if (auto decided = decidedBefore(context, violation))
    obligation.verdict = *std::move(decided);
  else if (context.found.treatment == LoopTreatment::EachIteration)
    obligation.verdict = endsByIterations(context, obligation);
  else
    obligation.verdict = endOfAll(context, instances, obligation.effort);
}

/// When all that lead to the loop say the same.
void explainEnd(const ProofContext &context, verdict::Proved &proved, const Instances &instances) {
  std::optional<TerminationExplanation> explanation;
  for (const LoopInstance *instance : instances) {
    const auto end = context.ends.find(instance);
    if (end == context.ends.end())
      continue;
    TerminationExplanation next =
        explain(context.start.interpretation(), context.subject.programs, *instance, end->second);
    if (explanation && explanation->why != next.why)
      return;
    if (explanation && explanation->bound != next.bound)
      next.bound.clear();
    explanation = std::move(next);
  }
  if (explanation) {
    proved.why = explanation->why;
    proved.bound = explanation->bound;
  }
}

/// `@CYCLIC`: the program repeats as a whole, in an outermost loop.
bool isMeantToGoOn(const ProofSubject &subject, const Wto &wto, NodeId head) {
  if (!subject.contract() || !subject.contract()->cyclic)
    return false;
  return std::none_of(wto.order().begin(), wto.order().end(), [&](NodeId other) {
    return other != head && wto.isHead(other) && wto.positionOf(other) < wto.positionOf(head) &&
           wto.positionOf(head) < wto.endOf(other);
  });
}

constexpr std::string_view kRepeats = "the run returns to an earlier state and repeats for ever";

std::optional<std::string> comesBack(const RunResult &run) {
  return run.end == RunEnd::Repeats ? std::optional(std::string(kRepeats)) : std::nullopt;
}

/// Nothing denies an end for which the program waits.
Violation unlessAwaited(const ProofContext &context, Violation violation) {
  return readsAwaited(context) ? Violation([](const RunResult &) { return std::optional<std::string>(); })
                               : std::move(violation);
}

Violation staysInside(std::shared_ptr<const Wto> wto, Place place) {
  return [wto = std::move(wto), place](const RunResult &run) -> std::optional<std::string> {
    const bool stays = !run.cycle.empty() && std::all_of(run.cycle.begin(), run.cycle.end(),
                                                         [&](Place at) { return isInside(*wto, place, at); });
    return stays ? comesBack(run) : std::nullopt;
  };
}

Obligation rowOfLoop(const ProofContext &context, const std::shared_ptr<const Wto> &wto, Place place) {
  Instances instances;
  Instances within; // an iteration that stays in one of these for ever does not end
  for (const LoopInstance &loop : context.found.loops) {
    if (loop.head == place)
      instances.push_back(&loop);
    if (isInside(*wto, place, loop.calls.empty() ? loop.head : loop.calls.front()))
      within.push_back(&loop);
  }
  Obligation row =
      context.subject.obligation(ObligationKind::LoopEnds, place, context.subject.spanOf(place), "this loop ends");
  if (const Obligation *known = context.decidedAs(row))
    return *known;
  settleLoop(context, row, within, unlessAwaited(context, staysInside(wto, place)));
  if (verdict::Proved *proved = row.verdict.proved())
    explainEnd(context, *proved, instances);
  return row;
}

std::shared_ptr<const Wto> loopsOf(const ProofSubject &subject) {
  return std::make_shared<const Wto>(subject.file().cfg, *subject.file().model, subject.program.entry);
}

} // namespace

void settleLoops(const ProofContext &context, SettledRows &into) {
  if (!context.subject.wants(ObligationKind::LoopEnds))
    return;
  const auto wto = loopsOf(context.subject);
  for (const NodeId head : wto->order()) {
    if (!wto->isHead(head) || isMeantToGoOn(context.subject, *wto, head))
      continue;
    const Place place{context.subject.program.file, head};
    into.rows.push_back(rowOfLoop(context, wto, place));
    into.denials.push_back({into.rows.back(), [stays = staysInside(wto, place)](const ProofContext &run) {
                              return unlessAwaited(run, stays);
                            }});
  }
}

Obligation loopRow(const ProofContext &context, Place head) {
  return rowOfLoop(context, loopsOf(context.subject), head);
}

void settleEnd(const ProofContext &context, SettledRows &into) {
  auto row = programEndRow(context);
  if (!row)
    return;
  into.denials.push_back({*row, [](const ProofContext &run) { return unlessAwaited(run, Violation(comesBack)); }});
  into.rows.push_back(*std::move(row));
}

std::optional<Obligation> programEndRow(const ProofContext &context) {
  const ProofSubject &subject = context.subject;
  if (!subject.wants(ObligationKind::ProgramEnds) || (subject.contract() && subject.contract()->cyclic))
    return std::nullopt;
  Instances instances;
  for (const LoopInstance &loop : context.found.loops)
    instances.push_back(&loop);
  Obligation row = subject.obligation(ObligationKind::ProgramEnds, "the program comes to an end");
  row.id = fmt::format("{}.program-ends", subject.name());
  if (const Obligation *known = context.decidedAs(row))
    return *known;
  settleLoop(context, row, instances, unlessAwaited(context, comesBack));
  if (const auto *call = context.found.callWithoutReturn(); call && row.verdict.kind() != Verdict::Refuted)
    row.verdict = Verdict::unknown(mayNotReturn(*call), call->own);
  else if (row.verdict == Verdict::Unreachable)
    row.verdict = verdict::Proved{.proof = {.method = "no loops"}};
  return row;
}

void requireEnds(const ProofContext &context, Obligation &obligation) {
  if (!obligation.verdict.holds())
    return;
  if (!context.found.repeats.empty()) {
    obligation.verdict = Verdict::unknown(std::string(kMayRepeat), context.found.repeats.front());
    return;
  }
  if (context.found.treatment == LoopTreatment::EachIteration)
    return;
  for (const LoopInstance &loop : context.found.loops)
    if (!(endOfAll(context, {&loop}, obligation.effort) == Verdict::Proved)) {
      obligation.verdict = Verdict::unknown("a loop was not proved to end", loop.head);
      return;
    }
}

} // namespace feedhold::prove
