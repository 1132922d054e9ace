// What the outputs of proofs have in common: counts, places, witnesses as calls.  Internal to sink/.
#pragma once

#include "surface/sink/prove_sink.h"

#include <array>
#include <optional>
#include <utility>
#include <vector>

namespace feedhold {

/// How many obligations have each verdict.
struct VerdictCounts {
  std::array<std::size_t, 4> byVerdict{};

  void add(const prove::ProgramProof &proof);
  std::size_t of(prove::Verdict::Kind verdict) const { return byVerdict[static_cast<std::size_t>(verdict)]; }
  std::size_t all() const { return byVerdict[0] + byVerdict[1] + byVerdict[2] + byVerdict[3]; }
};
/// `5 proved, 1 refuted, 1 unknown`; verdicts that nothing has are left out.
std::string textOf(const VerdictCounts &counts);

/// `O9100`; `a program without a number`
std::string programName(const ProvedFile &file, const ProvedProgram &program);

/// As a shell takes it for one word.
std::string quotedWord(const std::string &word);

/// Settings of the machine by their names.
std::vector<std::pair<std::string, bool>> settingsOf(const GivenStart &start);

/// What is in force at a start in place of power-on's: `G18`, `T5`.
std::vector<std::string> modalWords(const GivenStart &start, const Dialect &dialect);

/// A witness as a machinist types it.
struct TypedWitness {
  std::optional<std::string> call;                                   // `G65 P9100 D6. U12.`; absent: it has no number
  std::vector<std::pair<std::string, std::string>> others;           // `#500`, `-3.5`: what no letter of the call sets
  std::vector<std::pair<std::string, double>> variables;             // the same, by name without `#`
  std::vector<std::pair<std::string, std::vector<double>>> readings; // what the reads of inputs give, likewise
  std::vector<std::string> modal;                                    // `G18`, `T5`: in force at the start
  std::vector<std::pair<char, double>> place;                        // at the start: axis and coordinate
  std::vector<std::pair<std::string, bool>> settings;                // of the machine: `bare_cycle_stops` is on
  std::string options;                                               // of a command that runs the program on it
  std::string run() const { return "feedhold run " + options; }
  std::string plot() const { return "feedhold plot " + options; }
};
TypedWitness typed(const prove::Witness &witness, const ProvedFile &file, const ProvedProgram &program,
                   const ProveReport &report);

/// `G65 P9100 D6. with #500=3`
std::string textOf(const TypedWitness &witness);

/// Of Verdict::exactOnly.
inline constexpr std::string_view kExactOnly = "holds in exact arithmetic only: rounding on the control may break it";

/// What is claimed: `this loop ends`
std::string claimOf(const prove::Obligation &obligation, const Dialect &dialect);
/// What the run of the witness came to: `stops with PS0112 (divided by zero)`
std::string happenedIn(const prove::Witness &witness, const prove::Obligation &obligation, const Dialect &dialect);
/// Under which assumptions of its own a verdict holds: `if O9832 returns, which is not in the files`.
std::vector<std::string> assumedIn(const prove::Obligation &obligation);
/// With what a claim would be proved: ``with the clause `@REQUIRE #22 GT 0` in the contract, this is proved``
std::string remedyOf(const prove::Guard &guard);
/// Of what is not proved: what was seen, in one sentence: `this alarm can be raised`.
std::string messageOf(const prove::Obligation &obligation, const Dialect &dialect);

} // namespace feedhold
