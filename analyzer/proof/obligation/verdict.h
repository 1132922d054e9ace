// Verdict: the result for an obligation.  Each alternative has exactly the data that it can have.
#pragma once

#include "meaning/machine/machine.h"
#include "proof/decide/discharge.h"
#include "proof/obligation/guard.h"

#include <array>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace feedhold::prove {

std::string_view nameOf(Grade grade);

/// Where a run violates a claim about space most.
struct GougeAt {
  Place place;              // of the block that moves
  std::array<double, 3> at; // the point of the tool: X, Y, Z in the space of the start (geometry/shapes.h)
  double depth;             // of the violation
  friend bool operator==(const GougeAt &, const GougeAt &) = default;
};

/// Inputs on which the machine was seen to break the claim.
struct Witness {
  GivenVariables variables; // all others are vacant
  RunEnd end;
  std::string happened;                    // what the run did, in words for the machinist
  std::optional<GougeAt> gouge = {};       // of a claim about space
  std::vector<std::string> returning = {}; // missing programs that the run takes to return and to change nothing
};

/// How `happened` ends where the claim holds in exact numbers.
inline constexpr std::string_view kByRounding = ", because the control rounds; in exact numbers it would not";

/// The parts of a proof, one after another.
struct Proof {
  Grade grade = Grade::Certified; // of the weakest part
  std::string method = {};        // of all parts: `linear, products`
  std::vector<Outcome> evidence = {};

  void add(Outcome outcome);
};

namespace verdict {

/// For all inputs.
struct Proved {
  Proof proof = {};
  std::string why = {};              // in words for the machinist; empty: none
  std::string bound = {};            // of a loop: the iterations at most, `FUP[#21/#22]`; empty: unknown
  std::optional<double> margin = {}; // of KeepIn and KeepOut: the distance that the tool keeps at least
  bool exactOnly = false;            // not if sums are off by the rounding of doubles
};

/// By a run on the witness; or, for ContractSatisfiable, by a proof that there is no run.
struct Refuted {
  struct NoCall {
    std::string reason;
  };
  std::variant<Witness, NoCall> shownBy = NoCall{};
  std::optional<Guard> guard = {}; // under which the claim is proved
};

/// Neither proved nor refuted.
struct Unknown {
  std::string reason = {};         // what was missing
  std::optional<Place> at = {};    // where the proof gave up; absent: at no single place
  std::optional<Guard> guard = {}; // under which the claim is proved
};

/// No run reaches the place.
struct Unreachable {
  std::string method = {}; // how all runs were covered; empty: no path reaches it
};

} // namespace verdict

class Verdict {
public:
  enum Kind : std::uint8_t { Proved, Refuted, Unknown, Unreachable };

  Verdict() : what_(verdict::Unknown{}) {}
  Verdict(verdict::Proved what) : what_(std::move(what)) {}
  Verdict(verdict::Refuted what) : what_(std::move(what)) {}
  Verdict(verdict::Unknown what) : what_(std::move(what)) {}
  Verdict(verdict::Unreachable what) : what_(std::move(what)) {}
  Verdict(Witness witness) : what_(verdict::Refuted{.shownBy = std::move(witness)}) {}
  static Verdict unknown(std::string reason, std::optional<Place> at = {}) {
    return verdict::Unknown{.reason = std::move(reason), .at = at};
  }

  template <typename Visit> void visit(Visit visit) const { std::visit(visit, what_); }

  Kind kind() const { return static_cast<Kind>(what_.index()); }
  friend bool operator==(const Verdict &verdict, Kind kind) { return verdict.kind() == kind; }
  /// No run breaks the claim.
  bool holds() const { return kind() == Proved || kind() == Unreachable; }

  const verdict::Proved *proved() const { return std::get_if<verdict::Proved>(&what_); }
  verdict::Proved *proved() { return std::get_if<verdict::Proved>(&what_); }
  const verdict::Refuted *refuted() const { return std::get_if<verdict::Refuted>(&what_); }
  const verdict::Unknown *unknown() const { return std::get_if<verdict::Unknown>(&what_); }
  const verdict::Unreachable *unreachable() const { return std::get_if<verdict::Unreachable>(&what_); }

  // ---- for outputs: absent or empty if the verdict has no such member ----
  std::optional<Grade> grade() const;
  std::string_view method() const;
  std::string_view reason() const;
  std::string_view bound() const { return proved() ? std::string_view(proved()->bound) : ""; }
  bool exactOnly() const { return proved() && proved()->exactOnly; }
  std::optional<double> margin() const { return proved() ? proved()->margin : std::nullopt; }
  const Witness *witness() const { return refuted() ? std::get_if<Witness>(&refuted()->shownBy) : nullptr; }
  const Guard *guard() const;
  void setGuard(Guard guard);
  /// Of a witness.
  void setReturning(const std::set<std::string> &programs);

private:
  std::variant<verdict::Proved, verdict::Refuted, verdict::Unknown, verdict::Unreachable> what_;
};

std::string_view nameOf(Verdict::Kind kind);
inline std::string_view nameOf(const Verdict &verdict) { return nameOf(verdict.kind()); }
inline bool holds(const Verdict &verdict) { return verdict.holds(); }

} // namespace feedhold::prove
