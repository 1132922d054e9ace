// Exploration: what following all paths of a program brings to light, before anything is proved.
#pragma once

#include "meaning/semantics/tool_point.h"
#include "proof/explore/path.h"
#include "proof/geometry/tool_path.h"

#include <functional>
#include <map>
#include <set>
#include <string_view>

namespace feedhold::prove {

/// One way to a place: the run stops there when `conditions` and `stops` hold.
struct StopInstance {
  std::vector<smt::TermId> conditions;
  smt::TermId stops;
  SymbolicValue number; // of `#3000=`
  smt::TermId moved;    // whether an axis has moved before
};

/// A place where a run may stop by itself.
struct StopSite {
  Place place;
  Span span;
  std::optional<AlarmKind> alarm; // absent: `#3000=`
  std::vector<StopInstance> instances;
};

/// What one iteration of a loop does.
struct Transition {
  std::vector<smt::TermId> conditions; // of the iteration, those of the arrival included
  smt::Substitution next;              // from the loop's variables to their values after the iteration
};

/// A loop as one of the paths meets it.  `variables` stand for the state before any iteration; `iterations` counts
/// them.
struct LoopInstance {
  Place head;
  std::vector<Place> calls; // that led there
  smt::TermId iterations;
  std::size_t mark;                        // terms below it were made before the loop was met
  std::vector<smt::TermId> arrival;        // conditions of the path that met it
  std::vector<smt::TermId> variables = {}; // of the parts of the state of which no closed form is known
  std::vector<smt::TermId> facts = {};     // that hold before each iteration
  std::vector<Transition> transitions = {};
  smt::Substitution first = {};           // from `iterations` and all that goes with them to what the arrival found
  std::vector<smt::TermId> measures = {}; // that the contract suggests
  /// Of the variables of programs: their numbers at the arrival, and those before any iteration.
  struct Value {
    std::uint32_t variable;
    smt::TermId arrival;
    smt::TermId generic;
  };
  std::vector<Value> values = {};
  bool isRecorded = false;   // false: met only in a trial
  bool callsUnknown = false; // an iteration may stay in a program that is not followed

  /// What the variable stands for was there before the loop was met, or at the start of the run: no iteration changes
  /// it.
  bool isFixed(const SymbolicInterpretation &reading, smt::TermId variable) const {
    return variable.index() < mark || reading.isFromEntry(variable);
  }
  /// No iteration changes the value of the term.
  bool isConstant(const SymbolicInterpretation &reading, const smt::TermStore &store, smt::TermId term) const;
  /// The term speaks of nothing but the state before an iteration: of what is fixed, and of what the iterations change.
  bool isOfState(const SymbolicInterpretation &reading, const smt::TermStore &store, smt::TermId term) const;
};

enum class ExitKind : std::uint8_t { Returns, Ends };

/// A way on which the run comes to an end that is none of an alarm.
struct PathExit {
  ExitKind kind;
  Place place;
  std::vector<smt::TermId> conditions;
  SymbolicState state;
  smt::TermId moved;
};

/// One path to the entry of a called program: to each repetition, and to each call that a modal call makes.
struct CallInstance {
  Place own;     // the block of the started program that calls it, or that called whoever does
  Callee callee; // which begins in `state`
  std::vector<smt::TermId> conditions;
  SymbolicState state;
  smt::TermId modalCall; // a modal call is in force that the movements of the program make
};

/// One path to a write of a variable that other programs can see, or to what may be one.
struct WriteInstance {
  Place place;
  std::vector<smt::TermId> conditions;
  smt::TermId isKept;                    // the variable holds the same as before
  std::optional<std::uint32_t> variable; // absent: its number is not known
};

/// One way to a movement.
struct MoveInstance {
  Place place; // of the block
  Place own;   // the same, or the block of the started program that called it
  std::vector<smt::TermId> conditions;
  Move<SymbolicValue> move;
  std::optional<geometry::ArcRadius> radius; // of an arc that is given by R, unmapped
  ToolPoint<SymbolicInterpretation> point;
  SymbolicValue spindleSpeed;
  smt::TermId column; // of WithColumn: before it, Z down to which the tool has cut at this X and Y (path_memory.h)
};

/// Something was taken as anything at all.
struct Unfollowed {
  std::string_view reason;
  Place place;
  Span span;
};

/// A call that is not followed: the run may stop in it with any alarm, behind any movement, or never come back.
struct UnmodelledCall {
  Place own;                           // of the block of the started program
  std::vector<smt::TermId> conditions; // of the way there
  std::vector<std::size_t> loops;      // that the call is in: their instances
};

/// A loop is met once, in the midst of any of its iterations; or its iterations are followed one after the other, which
/// ends only where their number is known, or where a path comes back to a state in which it has been.
enum class LoopTreatment : std::uint8_t { AnyIteration, EachIteration };

struct Exploration {
  std::vector<StopSite> stopSites;
  std::vector<LoopInstance> loops;
  std::vector<PathExit> exits;
  std::vector<CallInstance> calls;   // for which the started program has to answer
  std::vector<MoveInstance> moves;   // of ExploreOptions::moves
  std::vector<WriteInstance> writes; // of ExploreOptions::keepWrites
  LoopTreatment treatment = LoopTreatment::AnyIteration;
  std::vector<Place> repeats; // of EachIteration: heads to which a path came back in the same state
  std::set<Place> heads;      // of EachIteration: those that were met
  std::vector<Unfollowed> unfollowed;
  std::vector<UnmodelledCall> unmodelledCalls;
  std::vector<smt::TermId> facts;             // about all variables
  std::optional<std::string_view> incomplete; // why paths are missing; then nothing is proved
  std::size_t paths = 0;
  std::size_t steps = 0;
  std::uint64_t work = 0; // of all questions on paths

  /// What is not followed in a block, by its name.
  std::optional<std::string> notFollowedAt(Place place) const;
};

/// Whether paths that meet go on as one (merging.h): fewer of them, of which less can be told.
enum class PathMerging : std::uint8_t { No, Yes };

/// Sums that a loop accumulates are exact; or each may be off by so little as doubles are (a tentative model of what
/// rounding does: a proof that it breaks has no margin).
enum class Sums : std::uint8_t { Exact, Rounded };

/// Whether movements are kept, and how deep the tool has cut where it stands.
enum class KeepMoves : std::uint8_t { No, Yes, WithColumn };

/// What a contract suggests of the loop at a place: terms over the state before any iteration.
using LoopHints = std::function<std::vector<smt::TermId>(Place head, const SymbolicState &state)>;

struct ExploreOptions {
  std::vector<smt::TermId> assumptions = {}; // of the contract
  LoopTreatment loops = LoopTreatment::AnyIteration;
  Sums sums = Sums::Exact;
  /// Conditions without variables may be decided by enclosing them, without a certificate: for single runs, which make
  /// refutations alone.
  bool mayEnclose = false;
  LoopHints invariants = {};                        // tried with those that are guessed
  LoopHints measures = {};                          // kept for LoopInstance::measures
  std::function<bool(const Callee &)> demands = {}; // has a contract that calls must satisfy; empty: calls are not kept
  /// Whether the program may have been called where it ends with `M99 P`, which then returns; a started one goes on at
  /// that number of its own.  False: for single runs of a started program.
  bool mayBeCalled = true;
  KeepMoves moves = KeepMoves::No;
  bool keepWrites = false;
  std::size_t mostSteps = 100'000;
  std::size_t mostPaths = 5'000;
  std::uint64_t mostWork = 6'000'000;
  std::size_t mostTerms = 1'000'000; // of those that are made
};

/// Follows every path of the program.  Paths are merged where there are too many of them for a part of the work, unless
/// each iteration is followed: programs that call large macros one after another are long, but have few paths.
Exploration explore(SymbolicInterpretation &reading, const ProgramSet &programs, Callee entry,
                    const SymbolicState &start, const ExploreOptions &options);

} // namespace feedhold::prove
