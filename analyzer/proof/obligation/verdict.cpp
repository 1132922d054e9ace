#include "proof/obligation/verdict.h"

#include "base/support/match.h"

#include <algorithm>

namespace feedhold::prove {

std::string_view nameOf(Grade grade) { return grade == Grade::Certified ? "certified" : "two-solvers"; }

std::string_view nameOf(Verdict::Kind kind) {
  switch (kind) {
  case Verdict::Proved: return "proved";
  case Verdict::Refuted: return "refuted";
  case Verdict::Unknown: return "unknown";
  case Verdict::Unreachable: return "unreachable";
  }
  FEEDHOLD_UNREACHABLE("the switch names every verdict");
}

void Proof::add(Outcome outcome) {
  grade = std::max(grade, std::get<prove::Proved>(outcome.answer).grade);
  if (method.find(outcome.method) == std::string::npos)
    method += (method.empty() ? "" : ", ") + outcome.method;
  evidence.push_back(std::move(outcome));
}

/// What no path comes to is certified by the paths alone.
std::optional<Grade> Verdict::grade() const {
  if (unreachable())
    return Grade::Certified;
  return proved() ? std::optional(proved()->proof.grade) : std::nullopt;
}

std::string_view Verdict::method() const {
  if (unreachable())
    return unreachable()->method;
  return proved() ? std::string_view(proved()->proof.method) : "";
}

std::string_view Verdict::reason() const {
  return match(
      what_, [](const verdict::Proved &proved) { return std::string_view(proved.why); },
      [](const verdict::Refuted &refuted) {
        const auto *noCall = std::get_if<verdict::Refuted::NoCall>(&refuted.shownBy);
        return noCall ? std::string_view(noCall->reason) : std::string_view();
      },
      [](const verdict::Unknown &unknown) { return std::string_view(unknown.reason); },
      [](const verdict::Unreachable &) { return std::string_view(); });
}

const Guard *Verdict::guard() const {
  const auto at = [](const std::optional<Guard> &guard) { return guard ? &*guard : nullptr; };
  if (unknown())
    return at(unknown()->guard);
  return refuted() ? at(refuted()->guard) : nullptr;
}

void Verdict::setReturning(const std::set<std::string> &programs) {
  if (auto *refuted = std::get_if<verdict::Refuted>(&what_))
    if (auto *witness = std::get_if<Witness>(&refuted->shownBy))
      witness->returning.assign(programs.begin(), programs.end());
}

void Verdict::setGuard(Guard guard) {
  if (auto *refuted = std::get_if<verdict::Refuted>(&what_))
    refuted->guard = std::move(guard);
  else if (auto *unknown = std::get_if<verdict::Unknown>(&what_))
    unknown->guard = std::move(guard);
}

} // namespace feedhold::prove
