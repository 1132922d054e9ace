// Engine: the fixpoint of one program after another, and the summaries of those that are called.
#pragma once

#include "inference/absint/analysis.h"
#include "inference/absint/contract_entry.h"
#include "inference/absint/partitions.h"
#include "meaning/cfg/wto.h"
#include "meaning/semantics/frames.h"

#include <map>
#include <optional>
#include <set>

namespace feedhold {

/// What the engine needs to know of a program, whatever the state: made once.
struct ProgramFacts {
  Callee entry;
  const ProgramFile *file;
  Wto wto;
  std::vector<bool> isJoin; // by position: several ways lead here
  PartitionBy by;
  std::vector<double> thresholds; // constants of the program, ascending
};

/// A state in which a program is left.
struct Exit {
  std::optional<AbstractValue> target; // P of M99
  AbstractState state;
};

/// One analysis of a program in one entry state.
struct Summary {
  AbstractState entry;
  std::map<std::uint32_t, Partitions> heads; // by position
  std::set<std::uint32_t> forcedHeads;       // reached by an `M99 P` from elsewhere
  std::vector<Exit> exits;                   // one without target, the others by target
  /// Only modal calls below this one are made inside: this is one itself.  Absent: all.
  std::optional<std::size_t> modalLimit = {};
  std::set<std::pair<CallDepth, std::vector<Place>>> walkedAt = {}; // alarms of nesting differ by depth; calls
};

class Engine {
public:
  Engine(const ProgramSet &programs, AnalysisOptions options);

  AbstractInterpretation &interpretation() { return interpretation_; }
  /// What a program that is started may find; polar coordinates are not in force.  `contracts`: of its file, to be
  /// assumed; null: none.
  AbstractState entryStateOf(Callee entry, const FileContracts *contracts);
  void walk(Callee entry, const AbstractState &state, AnalysisVisitor &visitor);
  std::optional<std::string_view> gaveUp() const { return gaveUp_; }

private:
  friend class Propagation;

  const ModalTable &modesOf(FileId file);
  const ProgramFacts &factsOf(Callee entry);
  /// The summary of a call in this state: an old one that covers it, or a new one.
  Summary &summaryOf(Callee entry, const AbstractState &state, std::optional<std::size_t> modalLimit);
  /// Programs that are entered in ways that are not followed: each is gone through with nothing known.
  void walkWithNothingKnown(AnalysisVisitor &visitor);
  void solve(const ProgramFacts &facts, Summary &summary);
  void descend(const ProgramFacts &facts, Summary &summary);
  bool isOpen(Callee entry) const;
  bool isStraight(const ProgramFacts &facts) const;
  /// False when the budget is used up.
  bool spend(std::uint64_t cost = 1);

  static constexpr std::size_t kMostContexts = 12;
  static constexpr std::uint64_t kCostOfJump = 4;    // a search through the program, and a copy of the state
  static constexpr std::ptrdiff_t kMostLoops = 5000; // a state takes some 20 KiB

  const ProgramSet &programs_;
  AnalysisOptions options_;
  AbstractInterpretation interpretation_;
  std::map<std::size_t, std::unique_ptr<ModalTable>> modes_; // by file, of those that have been asked for
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::unique_ptr<ProgramFacts>> facts_;
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::vector<std::unique_ptr<Summary>>> summaries_;
  std::vector<Callee> open_; // programs whose analysis has not come to its end: the chain of calls
  AnalysisVisitor *visitor_ = nullptr;
  std::vector<Place> calls_; // of the walk
  CallDepth depth_;          // of the walk
  int walkedAgain_ = 0;      // programs, for calls that find the same
  bool depthKnown_ = true;
  std::set<Callee> unmodelledEntries_; // entered somehow
  std::uint64_t spent_ = 0;
  std::optional<std::string_view> gaveUp_;
};

/// The state in a caller when a summary has been made for a state that covers its own: symbols get their names there.
AbstractState translated(const AbstractInterpretation &interpretation, AbstractState exit, AbstractState summaryEntry,
                         AbstractState entry);

} // namespace feedhold
