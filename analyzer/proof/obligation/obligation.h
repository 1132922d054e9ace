// Obligation: something that must hold of a program for every input its contract allows, and the verdict on it.
#pragma once

#include "proof/obligation/verdict.h"

#include <optional>
#include <string>
#include <string_view>

namespace feedhold::prove {

enum class ObligationKind : std::uint8_t {
#define OBLIGATION(kind, name) kind,
#include "proof/obligation/obligation_kinds.def"
};
std::string_view nameOf(ObligationKind kind);

struct Obligation {
  ObligationKind kind;
  std::string id; // `O9100.loop-ends.N20`, the same from run to run
  Place place;
  Span span;
  std::string claim;                   // what is claimed, in words for the machinist
  std::optional<AlarmKind> alarm = {}; // of NoControlAlarm
  Verdict verdict = {};
  std::uint64_t effort = 0;             // units spent on it, of all kinds together
  std::optional<double> tolerance = {}; // of a claim about space: how far the tool may pass what it says
  /// Missing programs that are taken to return (MissingPrograms::Return), of a verdict that holds if they do.
  std::vector<std::string> returning = {};
  /// Programs that are taken to do what their contracts say, of a verdict that holds if they do.
  std::vector<std::string> promising = {};
  bool unchanged = false;      // of a verdict that holds if those programs change nothing, too
  bool takesFewPasses = false; // of a verdict that holds if no loop makes more than kMostPasses
  bool offsetIsOfTool = false; // of a verdict that holds if the offsets of D are the radius of `@TOOL`
};

/// Of one program, from different stages of its proof.
inline bool isSameClaim(const Obligation &a, const Obligation &b) {
  return a.kind == b.kind && a.place == b.place && a.span == b.span && a.claim == b.claim;
}

} // namespace feedhold::prove
