// Verdicts as numbers: how many of each kind have which verdict, which methods found them, and at what cost.
#include "surface/sink/prove_shown.h"

#include <fmt/format.h>

#include <map>

namespace feedhold {

using prove::Obligation;
using prove::Verdict;

namespace {

struct Cost {
  std::size_t obligations = 0;
  std::uint64_t effort = 0;
};

struct Row {
  std::array<std::size_t, 4> byVerdict{};
  std::uint64_t effort = 0;
};

std::string_view methodOf(const Obligation &obligation) {
  if (!obligation.verdict.method().empty())
    return obligation.verdict.method();
  return obligation.verdict == Verdict::Refuted ? "a run" : "none";
}

} // namespace

std::string proveStatistics(const ProveReport &report) {
  std::map<prove::ObligationKind, Row> kinds;
  std::map<std::string_view, Cost> methods;
  for (const ProvedFile &file : report.result.files)
    for (const ProvedProgram &program : file.programs)
      for (const Obligation &obligation : program.proof.obligations) {
        Row &row = kinds[obligation.kind];
        ++row.byVerdict[static_cast<std::size_t>(obligation.verdict.kind())];
        row.effort += obligation.effort;
        Cost &cost = methods[methodOf(obligation)];
        ++cost.obligations;
        cost.effort += obligation.effort;
      }
  std::string text = fmt::format("{:<20} {:>8} {:>8} {:>8} {:>11} {:>12}\n", "kind", "proved", "refuted", "unknown",
                                 "unreachable", "effort");
  for (const auto &[kind, counts] : kinds) {
    const Row &row = counts;
    const auto of = [&](Verdict::Kind verdict) { return row.byVerdict[static_cast<std::size_t>(verdict)]; };
    text += fmt::format("{:<20} {:>8} {:>8} {:>8} {:>11} {:>12}\n", prove::nameOf(kind), of(Verdict::Proved),
                        of(Verdict::Refuted), of(Verdict::Unknown), of(Verdict::Unreachable), row.effort);
  }
  text += fmt::format("\n{:<20} {:>11} {:>12}\n", "method", "obligations", "effort");
  for (const auto &[method, cost] : methods)
    text += fmt::format("{:<20} {:>11} {:>12}\n", method, cost.obligations, cost.effort);
  return text;
}

} // namespace feedhold
