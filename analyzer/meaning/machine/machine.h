// The concrete machine: runs a program on given values and records the tool path, or why the control stopped.
#pragma once

#include "meaning/machine/recorded_move.h"
#include "meaning/semantics/cutter_offset.h"
#include "meaning/semantics/frames.h"

#include <functional>
#include <set>
#include <string>
#include <vector>

namespace feedhold {

/// What a run looks like just before an instruction.
struct RunMoment {
  Place place;
  const MachineState<ConcreteInterpretation> &state;
  std::size_t depth; // calls that are open
  std::size_t moves; // recorded so far
};

/// Whether the path of the tool's centre is computed under cutter compensation; else its moves are not of the tool.
enum class CutterCompensation : std::uint8_t { NotFollowed, Followed };

/// Movements are recorded, or only counted: where nobody asks for the path.
enum class RecordMoves : std::uint8_t { No, Yes };

/// The operator's switch: blocks with a `/` are executed or passed over.
enum class BlockSkipSwitch : std::uint8_t { Off, On };

/// What `#<name>` gives comes from outside, by a script: a pin, a value of the control that is not followed, what a
/// program that is in none of the files returns.
bool isReadByName(const ProgramSet &programs, const Dialect &dialect, std::uint32_t variable);

struct RunOptions {
  GivenVariables variables = {}; // arguments are the local variables; not listed: vacant
  std::array<double, kAxisCount> start{};
  std::vector<std::pair<std::uint8_t, std::uint8_t>> codes = {}; // group and code in force, in place of power-on's
  /// What the run finds in place of the codes, words and shifts of power-on; then `start` is not looked at.
  std::optional<MachineState<ConcreteInterpretation>> state = std::nullopt;
  std::uint64_t fuel = 10'000'000;      // instructions
  std::size_t mostMoves = 1'000'000;    // behind them the run ends as without fuel
  RecordMoves moves = RecordMoves::Yes; // No: nor is cutter compensation followed
  BlockSkipSwitch blockSkip = BlockSkipSwitch::Off;
  WordRounding words = WordRounding::Increment;
  NumberModel numbers = NumberModel::Binary64; // in which expressions are computed; Either: doubles
  CutterCompensation cutter = CutterCompensation::NotFollowed;
  /// The offset of a D, or of the T of a lathe, that nothing else gives, in this run; null, or absent: such a path is
  /// not followed.
  std::function<std::optional<CutterOffset<double>>(const RunOptions &, double number)> cutterRadius = nullptr;
  AxisSet fixed = {};                              // of `@FIXED`: RecordedMove::isOfTool
  MissingPrograms missing = MissingPrograms::Stop; // DoAnything: as Stop
  /// What the read of an input in an instruction gives, in place of `variables.readings`; null: those.
  std::function<double(Place, std::uint32_t variable)> inputs = nullptr;
  /// Called before each instruction; null: nobody looks on.
  std::function<void(const RunMoment &)> trace = nullptr;
};

enum class RunEnd : std::uint8_t {
  M02,
  M30,
  Returned,   // M99 of the program that was started
  EndOfFile,  // no M02, M30 or M99 came, on a control that takes this for an end
  Alarm,      // of the control
  UserAlarm,  // `#3000=`
  Fuel,       // still running
  Repeats,    // a state came back: it would run for ever
  Unmodelled, // something came that the machine does not follow and cannot go on behind
};
std::string_view nameOf(RunEnd end);

/// A call that was open when the run ended.
struct OpenCall {
  Place place; // of the call
  Callee callee;
};

struct RunResult {
  RunEnd end = RunEnd::Fuel;
  Place place{FileId(0), NodeId(0)}; // where it ended
  AlarmKind alarm{};                 // of Alarm
  double alarmNumber = 0;            // of UserAlarm
  std::string alarmText;             // of UserAlarm: the comment
  Span alarmSpan;                    // of both: the words that it comes from
  std::optional<Place> compensation; // of Alarm: the block with the G41 or G42 that it comes from
  bool offsetIsAssumed = false;      // of a D, by `cutterRadius`
  std::vector<OpenCall> calls;       // the innermost last
  std::vector<Place> cycle;          // of Repeats: the places of the started program that repeat; empty: unknown
  std::uint64_t steps = 0;           // instructions executed
  std::uint64_t skips = 0;           // moves to a signal (G31, G38.2)
  MachineState<ConcreteInterpretation> state;
  std::vector<RecordedMove> moves; // RecordMoves::No: none
  std::vector<RunNote> notes;      // what was not followed, each once for a place
  bool isLost = false;             // where X, Y or Z is at the end is not known: the state says one of many places
  bool passedUnmodelled = false;   // what is noted may have changed anything: another run may go on otherwise
  /// Names of missing programs that were called, and of codes that call them, and that were taken to return.
  std::set<std::string> skipped;
};

/// Starts at `entry` as if called with the given local variables.
RunResult run(const ProgramSet &programs, Callee entry, const RunOptions &options);

} // namespace feedhold
