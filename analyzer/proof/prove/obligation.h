// Obligation: something that must hold of a program for every input its contract allows, and the verdict on it.
#pragma once

#include "meaning/machine/machine.h"
#include "proof/prove/discharge.h"
#include "proof/prove/guard.h"

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace feedhold::prove {

enum class ObligationKind : std::uint8_t {
#define OBLIGATION(kind, name) kind,
#include "proof/prove/obligation_kinds.def"
};
std::string_view nameOf(ObligationKind kind);

enum class Verdict : std::uint8_t {
  Proved,      // for all inputs
  Refuted,     // a run on the witness shows it
  Unknown,     // neither; the reason says what is missing
  Unreachable, // no run comes to the place
};
std::string_view nameOf(Verdict verdict);
std::string_view nameOf(Grade grade);

/// Where a run breaks a claim about space most.
struct GougeAt {
  Place place;              // of the block that moves
  std::array<double, 3> at; // the point of the tool: X, Y, Z in the space of the start (geometry/shapes.h)
  double depth;             // by how much it is wrong there
  friend bool operator==(const GougeAt &, const GougeAt &) = default;
};

/// Inputs on which the machine was seen to break the claim.
struct Witness {
  GivenVariables variables; // all others are vacant
  RunEnd end;
  std::string happened;               // in shop words: what the run came to
  std::optional<GougeAt> gouge = {};  // of a claim about space
};

struct Obligation {
  ObligationKind kind;
  std::string id; // `O9100.loop-ends.N20`, the same from run to run
  Place place;
  Span span;
  std::string claim;                          // what is claimed, in shop words
  std::optional<AlarmKind> alarm = {};        // of NoControlAlarm
  Verdict verdict = Verdict::Unknown;
  std::optional<Grade> grade = {};     // of Proved and Unreachable
  std::string method = {};             // of the same: how, for instance `linear`
  std::string reason = {};             // of Unknown: what was missing; of Proved: why it holds, in shop words
  bool exactOnly = false;              // of Proved: no longer so when sums are off by what doubles round
  std::string bound = {};              // of LoopEnds: the passes at most, `FUP[#21/#22]`; empty: not known
  std::optional<Witness> witness = {}; // of Refuted
  std::optional<double> margin = {};   // of KeepIn and KeepOut that are proved: how far the tool keeps away at least
  std::uint64_t effort = 0;
  std::vector<Outcome> evidence = {}; // of Proved: each part of the proof
  std::optional<Guard> guard = {};    // of Refuted and Unknown: with what it is proved
};

/// Of one program, found in one way or another.
inline bool isSameClaim(const Obligation &a, const Obligation &b) {
  return a.kind == b.kind && a.place == b.place && a.span == b.span && a.claim == b.claim;
}
inline bool holds(Verdict verdict) { return verdict == Verdict::Proved || verdict == Verdict::Unreachable; }

} // namespace feedhold::prove
