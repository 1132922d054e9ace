// Analysis: what holds before each instruction of a program, for all inputs: abstract interpretation over the graph,
// calls followed into the programs that they reach.
//
// States are kept only at the heads of loops; a walk goes through the program again from there, so that a program of a
// million blocks does not need a million states.
#pragma once

#include "inference/absint/abstract_state.h"

#include <memory>
#include <span>
#include <string_view>
#include <vector>

namespace feedhold {

struct AnalysisOptions {
  /// Instructions that may be followed in all; beyond it the analysis gives up, which AnalysisResult says.
  std::uint64_t budget = 20'000'000;
};

/// How a path through a program ends.
enum class PathEnd : std::uint8_t { Returns, Ends, Alarm };

/// Told of the states of a program, place by place; of one place several times when states are kept apart, or when it
/// is reached by several calls.
class AnalysisVisitor : public StepObserver {
public:
  /// Before each instruction.  `calls`: the calls that led here, outermost first.
  virtual void visit(Place, const AbstractState &, std::span<const Place> calls) = 0;
  /// Back at an instruction from the programs that it has called.
  virtual void resumed(Place, std::span<const Place> /*calls*/) {}
  /// After the instruction, where it has one successor.
  virtual void left(Place, const AbstractState &) {}
  virtual void branch(Place, Truth) {}
  virtual void ended(Place, PathEnd, const AbstractState &) {}
  virtual void called(Place, const CallRequest<AbstractInterpretation> &) {}
  /// A program is entered in a way that is not followed (too deep, by itself, by a computed number), and would be gone
  /// through with nothing known: not when the visitor has no use for it.
  virtual bool wantsUnmodelledEntry(const Callee &) { return true; }
  /// What is known of a program that is called from several places is told with the calls of each; else, where they
  /// find the same, with those of one.
  virtual bool tellsCallsApart() const { return false; }
  /// A call whose states are not told, since there are too many.
  virtual void leftOut(Place) {}
};

struct FileContracts;

class Analysis {
public:
  Analysis(const ProgramSet &programs, AnalysisOptions options = {});
  ~Analysis();
  Analysis(const Analysis &) = delete;
  Analysis &operator=(const Analysis &) = delete;

  /// What a program that is started may find: with the contracts of its file, in the calls that its contract allows.
  AbstractState entryState(Callee entry, const FileContracts *contracts = nullptr);
  /// Analyses a program that is started with nothing known, and walks through it.
  void walk(Callee entry, AnalysisVisitor &visitor);
  /// The same with a state of one's own; `interpretation` gives it symbols.
  void walk(Callee entry, const AbstractState &state, AnalysisVisitor &visitor);
  AbstractInterpretation &interpretation();

  /// Absent when the analysis went to its end; else why nothing of what it told is complete.
  std::optional<std::string_view> gaveUp() const;

private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

} // namespace feedhold
