// Explorer: explores the paths of a program through its graph and into the programs that it calls.
#pragma once

#include "meaning/cfg/wto.h"
#include "proof/decide/entails.h"
#include "proof/explore/exploration.h"
#include "proof/explore/loops.h"
#include "proof/explore/merging.h"
#include "proof/smt/ground_truth.h"

#include <memory>

namespace feedhold::prove {

class PathCutter;

class Explorer : public PathKnowledge {
public:
  Explorer(SymbolicInterpretation &interpretation, const ProgramSet &programs, const ExploreOptions &options,
           PathMerging merging, std::set<IndexPlace> unbounded = {});

  Exploration run(Callee entry, const SymbolicState &start);

  // ---- PathKnowledge ----
  bool says(smt::TermId condition) const override;
  bool proves(smt::TermId condition) override;
  bool mayRelyOn(IndexPlace index, smt::TermId condition) override;

private:
  friend class LoopSummarizer;

  /// Stops, iterations and exits are recorded only on the final paths; loops are tried before.
  enum class Purpose : std::uint8_t { Trial, Record };
  /// Of a trial: the loop whose iterations are looked for, the paths that come back to its head, and those that leave
  /// it.
  struct Trial {
    std::size_t instance;
    std::vector<Path> iterations = {};
    std::vector<Path> exits = {};
  };
  void follow(Path start, Purpose purpose, Trial *trial);
  void wait(Worklist &work, Path path);
  /// False: the path ends here; or others go on in its place, which wait.
  bool arrive(Path &path, Purpose purpose, Trial *trial, Worklist &work);
  /// False: the path has left the loop that is tried, and is kept there.
  bool closeLeftLoops(Path &path, Trial *trial);
  bool comesBack(Path &path);
  void recordIteration(const Path &path);

  // ---- one instruction: the paths that continue ----
  std::vector<Path> execute(Path path);
  std::vector<Path> executeInstruction(Path path);
  std::vector<Path> straight(Path path);
  std::vector<Path> branch(Path path, Condition condition, NodeId taken);
  std::vector<Path> follow(Path path, const BlockSkip &skip);
  std::vector<Path> follow(Path path, const Test &test);
  std::vector<Path> follow(Path path, const CountDown &count);
  std::vector<Path> follow(Path path, const JumpTo &jump);
  std::vector<Path> follow(Path path, const CallProgram &call);
  std::vector<Path> follow(Path path, const ReturnFromProgram &from);
  std::vector<Path> follow(Path path, const EndProgram &end);
  std::vector<Path> search(Path path, const SymbolicValue &number, BlockId from);

  // ---- calls ----
  std::vector<Path> enter(Path path, const CallRequest<SymbolicInterpretation> &request,
                          std::optional<std::size_t> modal);
  std::vector<Path> modalCall(Path path, Condition moves);
  std::vector<Path> unknownCall(Path path, const CallRequest<SymbolicInterpretation> &request,
                                std::optional<std::size_t> modal, std::string_view reason, std::string why);
  std::vector<Path> missingCall(Path path, const CallRequest<SymbolicInterpretation> &request,
                                std::optional<std::size_t> modal, const std::string &name);
  // ---- calls that a contract stands for (explorer_promises.cpp) ----
  std::optional<std::vector<Path>> promisedCall(const Path &path, const CallRequest<SymbolicInterpretation> &request,
                                                std::optional<std::size_t> modal);
  std::optional<std::vector<Path>> pathsBehind(const Path &path, const CallRequest<SymbolicInterpretation> &request,
                                               std::shared_ptr<CalledContract> contract);
  bool mayStandFor(const Path &path, const CallRequest<SymbolicInterpretation> &request);
  std::shared_ptr<CalledContract> contractFor(const Path &path, const CallRequest<SymbolicInterpretation> &request,
                                              std::optional<std::size_t> modal);
  SymbolicState enteredState(const Path &path, const CallRequest<SymbolicInterpretation> &request);
  SymbolicState returnedState(const Path &path, const CallRequest<SymbolicInterpretation> &request);
  void recordPromisedCall(const Path &path, CalledContract &contract, bool isMissing);
  std::vector<Path> enterOneOf(const Path &path, const CallRequest<SymbolicInterpretation> &request,
                               const std::map<std::uint32_t, Callee> &callees);
  void recordUnmodelledCall(const Path &path, UnmodelledCall call);
  /// Of the program that the block calls, or that the modal call does; empty where its number is computed.
  std::string nameOfCallee(const Path &path, std::optional<std::size_t> modal) const;
  bool mayReach(const CallRequest<SymbolicInterpretation> &request, const Callee &program) const;
  void recordEntry(const Path &path, std::size_t callerDepth, const SymbolicFrame &frame, const SymbolicState &state);
  void recordUnmodelledEntries(Path &path, CallRequest<SymbolicInterpretation> request,
                               std::optional<std::size_t> modal);
  std::vector<Path> leave(Path path, const std::optional<SymbolicValue> &target);

  /// Records where the step may stop; false if it always stops.
  bool takeStops(Path &path);
  bool isSeenToHold(const Path &path, const PossibleStop &stop, smt::TermId goesOn);
  /// Takes down where a result was taken as exact that may be too large for that.
  void checkExactResults(const Path &path);
  // ---- movements (explorer_moves.cpp) ----
  void takeMoves(Path &path);
  // ---- cutter compensation (explorer_cutter.cpp) ----
  PathCutter cutterOf(Path &path, CutterTrack &track, smt::TermId also);
  bool takeCutter(Path &path, const std::vector<MoveInstance> &moves, smt::TermId besidePath);
  bool settleCutter(Path &path, CutterTrack &track, std::size_t first, bool wasOff);
  std::optional<PathOffset> offsetOf(Path &path, const SymbolicValue &number);
  std::optional<PathOffset> writtenOffset(Path &path, const SymbolicValue &number);
  void giveCentre(const Path &path, MoveInstance &move);
  bool mayRestoreSide(Path &path);
  void decideVacancies(const Path &path, MoveInstance &instance);
  std::array<smt::TermId, 2> inCutterPlane(const Path &path, const std::array<SymbolicValue, kAxisCount> &point);
  bool isLathe(const Path &path) const;
  void stopInCutter(const Path &path, const CutterTrack &track);
  void leaveOpen(PathCutter &host, CutterTrack &track, std::string_view why);
  void loseCutter(Path &path, std::string_view reason);
  static void passCallInCutter(Path &path);
  void endCutter(Path &path, smt::TermId when);
  // ---- writes (explorer_writes.cpp) ----
  struct StepWrites {
    SymbolicState before;                   // the step
    std::vector<std::uint32_t> unkept = {}; // variables that it wrote, of which the state keeps nothing
  };
  /// Absent: writes are not asked for.
  std::optional<StepWrites> beginWrites(const Path &path) const;
  /// What a step that has not stopped has written.
  void takeWrites(const Path &path, const StepWrites &step);
  void takeRegionWrites(const Path &path, const SymbolicState &before);
  void waitBesidePath(Path &path);
  void leavePath(Path &path, const std::vector<Move<SymbolicValue>> &moves, ToolPoint<SymbolicInterpretation> &point);
  std::optional<geometry::ArcRadius> radiusOf(const Path &path, const Move<SymbolicValue> &move);
  smt::TermId columnBehind(const Path &path, const Move<SymbolicValue> &move, smt::TermId column, smt::TermId end);
  static std::uint64_t stepsOf(const Path &path);
  static Place ownPlace(const Path &path) { return path.frames.size() > 1 ? path.frames[1].call : path.at; }
  void stopsWhen(Path &path, Condition when, AlarmKind alarm);
  void exit(Path &path, ExitKind kind);
  void giveUp(std::string_view reason);
  /// Too many paths, or too long ones: says where they are.
  void giveUpOn(const Worklist &open, const Path &path);
  bool isTooMuch(std::size_t waiting);
  Worklist::Position positionOf(const Path &path);
  std::vector<Path> merged(std::vector<Path> paths, Trial *trial);
  bool isPossible(const Path &path, smt::TermId condition);
  std::optional<bool> byEnclosure(smt::TermId condition);

  StepContext<SymbolicInterpretation> contextOf(Path &path);
  const Node &nodeOf(const Path &path) const { return programs_.node(path.at); }
  const ProgramFile &fileOf(const Path &path) const { return programs_.file(path.at.file); }
  const Wto &wtoOf(const Callee &callee);
  const ModalTable &modesOf(FileId file);
  Path to(Path path, NodeId node) const;

  SymbolicInterpretation &interpretation_;
  smt::TermStore &store_;
  const ProgramSet &programs_;
  const ExploreOptions &options_;
  PathMerging merging_;
  std::size_t termsBefore_;
  Entailment entails_;
  smt::GroundTruth groundTruth_;
  const Path *path_ = nullptr; // on which the present step is made
  Purpose purpose_ = Purpose::Record;
  std::set<IndexPlace> relied_; // on their ranges, in trials
  Exploration result_;
  SymbolicState entry_;                                                          // as it was at the start
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::unique_ptr<Wto>> wtos_; // by file and entry
  std::map<std::uint32_t, std::unique_ptr<ModalTable>> modes_;
  ExecutedWords<SymbolicInterpretation> words_;
  std::vector<LoopShape> shapes_; // by Exploration::loops
  KnownLoops knownLoops_;
  std::map<Callee, bool> mayStandFor_; // their contracts, for their texts
};

/// Explores with the ranges that are told for indices, and again without those that were relied on and are not shown.
Exploration exploreWithRanges(SymbolicInterpretation &interpretation, const ProgramSet &programs, Callee entry,
                              const SymbolicState &start, const ExploreOptions &options, PathMerging merging);

} // namespace feedhold::prove
