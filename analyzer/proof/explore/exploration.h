// Exploration: what symbolic execution of all paths finds, before anything is proved.
#pragma once

#include "meaning/semantics/tip_direction.h"
#include "meaning/semantics/tool_point.h"
#include "proof/explore/called_contract.h"
#include "proof/explore/path.h"
#include "proof/geometry/tool_path.h"

#include <functional>
#include <map>
#include <set>
#include <string_view>

namespace feedhold::prove {

/// One path to a place: the run stops there when `conditions` and `stops` hold.
struct StopInstance {
  std::vector<smt::TermId> conditions;
  smt::TermId stops;
  SymbolicValue number; // of `#3000=`
  smt::TermId moved;    // whether an axis has moved before
};

/// A place where a run may stop with an alarm.
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

/// A loop as one of the paths reaches it.  `variables` stand for the state before an arbitrary iteration, `iterations`
/// for the number of iterations before it.
struct LoopInstance {
  Place head;
  std::vector<Place> calls; // that led there
  smt::TermId iterations;
  std::size_t mark;                        // terms below it were made before the loop was reached
  std::vector<smt::TermId> arrival;        // conditions of the path that reached it
  std::vector<smt::TermId> variables = {}; // of the parts of the state of which no closed form is known
  std::vector<smt::TermId> facts = {};     // that hold before each iteration
  /// Of `variables` and `iterations`: those on which it depends whether an iteration is made, directly or through what
  /// iterations make of others.  The rest has no part in why the loop ends.
  std::set<smt::TermId> deciding = {};
  std::vector<Transition> transitions = {};
  smt::Substitution first = {};               // from `iterations` and all that goes with them to what the arrival found
  std::vector<smt::TermId> rankingHints = {}; // ranking functions that the contract suggests (@VARIANT)
  /// Of the variables of programs: their numbers at the arrival, and those before any iteration.
  struct Value {
    std::uint32_t variable;
    smt::TermId arrival;
    smt::TermId generic;
  };
  std::vector<Value> values = {};
  bool isRecorded = false; // false: met only in a trial
  /// One that an iteration may make, and that need not return: its index in Exploration::unmodelledCalls.
  std::optional<std::size_t> unmodelledCall = {};

  /// The variable stands for a value from before the loop or from the start of the run: no iteration changes it.
  bool isFixed(const SymbolicInterpretation &interpretation, smt::TermId variable) const {
    return variable.index() < mark || interpretation.isFromEntry(variable);
  }
  /// No iteration changes the value of the term.
  bool isConstant(const SymbolicInterpretation &interpretation, const smt::TermStore &store, smt::TermId term) const;
  /// The term is over the state before an iteration alone: fixed values, and those that the iterations change.
  bool isOfState(const SymbolicInterpretation &interpretation, const smt::TermStore &store, smt::TermId term) const;
  /// Of the transitions as they are now.
  void findDeciding(const smt::TermStore &store);
};

enum class ExitKind : std::uint8_t { Returns, Ends };

/// A path on which the run ends without an alarm.
struct PathExit {
  ExitKind kind;
  Place place;
  std::vector<smt::TermId> conditions;
  SymbolicState state;
  smt::TermId moved;
};

/// One path to the entry of a called program; each repetition and each call by a modal call counts.
struct CallInstance {
  Place own;     // the block of the started program that calls it, or that called whoever does
  Callee callee; // which begins in `state`
  std::vector<smt::TermId> conditions;
  SymbolicState state;
  smt::TermId modalCall; // a modal call is active, which the movements of the program make
};

/// The same of a program that is in none of the files, and of which a contract is at hand.
struct PromisedEntry {
  Place own;
  std::shared_ptr<CalledContract> contract;
  std::vector<smt::TermId> conditions;
  SymbolicState state;
};

/// One path to a write of a variable that other programs can see, or to a possible one.
struct WriteInstance {
  Place place;
  std::vector<smt::TermId> conditions;
  smt::TermId isKept;                    // the variable holds the same as before
  std::optional<std::uint32_t> variable; // absent: its number is not known
};

/// Under cutter compensation the tool makes other moves than the programmed ones (cutter_path.h).
enum class MovePath : std::uint8_t {
  Both,       // there is none, or its moves are not known
  Programmed, // the tool makes others
  Centre      // of the tool, in place of the programmed one
};

/// One path to a movement.
struct MoveInstance {
  Place place; // of the block
  Place own;   // the same, or the block of the started program that called it
  std::vector<smt::TermId> conditions;
  Move<SymbolicValue> move;
  std::optional<geometry::ArcRadius> radius; // of an arc that is given by R, unmapped
  ToolPoint<SymbolicInterpretation> point;
  SymbolicValue spindleSpeed;
  smt::TermId column; // of WithColumn: before it, Z down to which the tool has cut at this X and Y (path_memory.h)
  MovePath path = MovePath::Both;
  std::string_view whyBeside = {}; // why it is not known where the tool goes under cutter compensation; empty: it is
};

/// One path on which the control does not stop for the cutter compensation that began at a place.
struct CutterClaim {
  Place began;
  std::vector<smt::TermId> conditions = {};
  smt::TermId goal;
  std::optional<AlarmKind> alarm = {}; // with which it would stop
  std::string why = {};                // the path is not followed for this reason, so that it may stop
};

/// Something that is not modelled: it may do anything.
struct Unmodelled {
  std::string_view reason;
  Place place;
  Span span;
};

/// A call that is not modelled: the run may stop in it with any alarm, after any move, or never return; or it is taken
/// to return (MissingPrograms::Return) or to keep to a contract, after any move.
struct UnmodelledCall {
  Place own;                           // of the block of the started program
  std::vector<smt::TermId> conditions; // of the path to it
  std::vector<std::size_t> loops;      // that the call is in: their instances
  std::string why;                     // `O9723 was not supplied`
  std::string returning = {};          // the name of the program that is taken to return; empty: it need not
  /// The name of the program that is taken to do what its contract says, and to come to its end; empty: it need not.
  std::string promising = {};
  bool tellsWrites = false; // of such a program: its contract says what it writes (Exploration::writes)

  /// It need not return, and nothing is promised of it.
  bool mayNotReturn() const { return returning.empty() && promising.empty(); }
};

/// One symbolic iteration from an inductive invariant stands for all iterations of a loop; or the loop is unrolled,
/// which ends only where the number of iterations is known, or where a path returns to an earlier state.
enum class LoopTreatment : std::uint8_t { AnyIteration, EachIteration };

/// Whether paths that meet continue as one (merging.h): fewer paths, and less precise ones.
enum class PathMerging : std::uint8_t {
  No,
  Yes,
  Forget, // what they do not have in common is forgotten where it grows: one path for each place
};

struct Exploration {
  std::vector<StopSite> stopSites;
  std::vector<LoopInstance> loops;
  std::vector<PathExit> exits;
  std::vector<CallInstance> calls;       // for which the started program has to answer
  std::vector<PromisedEntry> promised;   // the same
  std::vector<MoveInstance> moves;       // of ExploreOptions::moves
  std::vector<CutterClaim> cutterClaims; // of ExploreOptions::cutterOffset
  std::vector<WriteInstance> writes;     // of ExploreOptions::keepWrites
  LoopTreatment treatment = LoopTreatment::AnyIteration;
  std::vector<Place> repeats; // of EachIteration: heads to which a path returned in the same state
  std::set<Place> heads;      // of EachIteration: those that were reached
  std::vector<Unmodelled> unmodelled;
  std::vector<UnmodelledCall> unmodelledCalls;
  std::vector<smt::TermId> facts;        // about all variables
  std::set<Place> inexact;               // results that were taken as exact, and may be too large for that
  std::set<IndexPlace> unbounded;        // indices that may be outside of the range that is told for them
  std::optional<std::string> incomplete; // why paths are missing; then nothing is proved
  bool isTooLarge = false;               // there were too many paths; merged, they may be few enough
  /// Merged paths have forgotten conditions (PathMerging::Forget): they stand for all runs, and for others that are
  /// none.
  bool forgets = false;
  PathMerging merging = PathMerging::No; // of its paths
  std::size_t paths = 0;
  std::size_t steps = 0;
  std::uint64_t work = 0; // of all questions on paths

  /// The first call that need not return; null: there is none.
  const UnmodelledCall *callWithoutReturn() const;
  /// Some call is taken as the contract of its program says.
  bool reliesOnContracts() const;
  /// What is not modelled in a block, by its name.
  std::optional<std::string> unmodelledAt(Place place) const;
};

/// An offset of cutter compensation: a radius, under conditions on its own variables; of a lathe also the tip.
struct PathOffset {
  smt::TermId radius;
  std::vector<smt::TermId> conditions = {};
  bool isAssumed = false; // nothing says so but the tool of the contract
  TipDirection tip = {};
  std::string_view why = {}; // it is not known, for this reason; empty: it is
};
/// Of a D, or of the T of a lathe, on a path, whose conditions prove what is asked.  Absent: nothing gives it.
using OffsetOfCutter = std::function<std::optional<PathOffset>(const SymbolicValue &number,
                                                               const std::function<bool(smt::TermId)> &proves)>;

/// Whether movements are kept, and how deep the tool has cut where it stands.
enum class KeepMoves : std::uint8_t { No, Yes, WithColumn };

/// What a contract suggests for the loop at a place: terms over the state before an iteration.
using LoopHints = std::function<std::vector<smt::TermId>(Place head, const SymbolicState &state)>;

/// How widely invariants of loops are looked for.  A wide search takes several times as long: it is for programs of
/// which claims are open.
enum class InvariantSearch : std::uint8_t { Usual, Wide };

/// A control that makes a thousand passes a second is at this after 30 years, one that makes 100 000 after 115 days.
inline constexpr std::int64_t kMostPasses = 1'000'000'000'000;

struct ExploreOptions {
  std::vector<smt::TermId> assumptions = {}; // of the contract
  LoopTreatment loops = LoopTreatment::AnyIteration;
  /// However large they are; otherwise it is proved that they are small enough where results are rounded.
  bool wholeNumbersAreExact = false;
  /// Each loop is taken to make no more passes than kMostPasses before it is left.  Not for claims that loops end.
  bool takesFewPasses = false;
  /// Conditions without variables may be decided by enclosing them, without a certificate: for single runs, which make
  /// refutations alone.
  bool mayEnclose = false;
  LoopHints invariants = {}; // tried with those that are guessed
  /// Bounds of variables at heads of loops, tried as well where numbers may be too large for exact results.
  std::function<LoopHints(const std::set<Place> &heads)> boundsAt = {};
  InvariantSearch search = InvariantSearch::Usual;
  LoopHints rankingHints = {}; // kept for LoopInstance::rankingHints
  MissingPrograms missing = MissingPrograms::DoAnything;
  bool missingChangeNothing = false;                // those that return
  std::function<bool(const Callee &)> demands = {}; // has a contract that calls must satisfy; empty: calls are not kept
  CallContracts contracts = {};
  Reliance relyOn = Reliance::Nobody;
  /// Whether the program may have been called where it ends with `M99 P`, which then returns; a started one goes on at
  /// that number of its own.  False: for single runs of a started program.
  bool mayBeCalled = true;
  KeepMoves moves = KeepMoves::No;
  /// The offset of a D or of a T; empty: cutter compensation is not followed.  Moves are kept.
  OffsetOfCutter cutterOffset = {};
  AxisSet fixed = {}; // of `@FIXED`
  bool keepWrites = false;
  /// Some of the steps are left for the claims, and for runs that refute them, if there are too many paths.
  bool leavesSteps = false;
  /// The least: known to be needed from another exploration of the same program.
  PathMerging merging = PathMerging::No;
  std::size_t mostSteps = 100'000;
  std::size_t mostPaths = 5'000;
  std::uint64_t mostWork = 6'000'000;
  std::size_t mostTerms = 1'000'000; // of those that are made
};

/// Explores every path of the program.  Paths are merged if there are too many for a share of the budget, unless loops
/// are unrolled: programs that call large macros one after another are long, but have few paths.
Exploration explore(SymbolicInterpretation &interpretation, const ProgramSet &programs, Callee entry,
                    const SymbolicState &start, ExploreOptions options);

} // namespace feedhold::prove
