// Propagation: one iteration of states over a program, in weak topological order.
#pragma once

#include "inference/absint/engine.h"
#include "inference/absint/refine.h"

namespace feedhold {

class Propagation {
public:
  enum class Phase : std::uint8_t {
    Ascend,  // heads grow until nothing changes
    Collect, // heads stay; what arrives at them is kept apart, for narrowing and checking
    Walk,    // heads stay; the visitor is told
  };

  Propagation(Engine &engine, const ProgramFacts &facts, Summary &summary, Phase phase);
  void run();
  /// What has arrived at the heads, of Collect.
  const std::map<std::uint32_t, Partitions> &arrived() const { return arrived_; }

private:
  struct Work {
    NodeId node;
    AbstractState state;
  };

  AbstractContext contextAt(NodeId node, AbstractState &state);
  const Node &nodeAt(NodeId node) const { return facts_.file->cfg.nodes[node]; }
  Place placeOf(NodeId node) const { return {facts_.entry.file, node}; }
  std::uint32_t positionOf(NodeId node) const;
  bool isHead(std::uint32_t position) const;
  bool isCut(NodeId node) const;

  const LoopCounters &countersOf(std::uint32_t head);

  void restart();
  void process(std::uint32_t position, Partitions states);
  // A state is large, even to be moved: it is taken where it stands.
  void follow(NodeId node, AbstractState &&state);
  void followOne(NodeId node, AbstractState &state);
  void deliver(NodeId node, AbstractState &&state);
  void go(NodeId node, AbstractState &&state);

  /// Each leaves in `state` what goes on to the next node; false when nothing does.
  bool execute(NodeId node, AbstractState &state);
  bool straight(NodeId node, AbstractState &state);
  bool test(NodeId node, const Test &test, AbstractState &state);
  bool jump(NodeId node, const JumpTo &jump, AbstractState &state);
  bool count(NodeId node, const CountDown &count, AbstractState &state);
  bool call(NodeId node, const CallProgram &call, AbstractState &state);
  bool leave(NodeId node, const ReturnFromProgram &from, AbstractState &state);
  bool end(NodeId node, const EndProgram &ending, AbstractState &state);

  bool modalCalls(NodeId node, AbstractState &state);
  std::optional<AbstractState> enter(NodeId node, const CallRequest<AbstractInterpretation> &request,
                                     AbstractState state);
  std::optional<AbstractState> enterUnmodelled(NodeId node, const CallRequest<AbstractInterpretation> &request,
                                               AbstractState state);
  void nestingAlarms(NodeId node, const CallRequest<AbstractInterpretation> &request, AbstractState &state);
  std::optional<AbstractState> repeated(NodeId node, const CallRequest<AbstractInterpretation> &request,
                                        const AbstractState &before);
  std::optional<AbstractState> calledAgain(NodeId node, Frame<AbstractInterpretation> &frame, AbstractState left,
                                           std::optional<double> times);
  std::optional<AbstractState> once(NodeId node, const Frame<AbstractInterpretation> &frame, AbstractState state);
  void addTo(std::optional<AbstractState> &all, AbstractState state);
  void walkInto(NodeId node, const Frame<AbstractInterpretation> &frame, Summary &summary);
  void searchAlarms(NodeId node, const AbstractValue &number);
  void returnTo(NodeId node, const AbstractValue &target, const AbstractState &state);
  void startAgainAt(NodeId node, const AbstractValue &target, const AbstractState &state);
  void addExit(std::optional<AbstractValue> target, AbstractState state);
  void missingCall(NodeId node, const CallRequest<AbstractInterpretation> &request, AbstractState &state);
  void unknownCall(NodeId node, const CallRequest<AbstractInterpretation> &request, AbstractState &state,
                   std::string_view reason);
  void refineByAlarms(NodeId node, AbstractState &state);

  Engine &engine_;
  const ProgramFacts &facts_;
  Summary &summary_;
  Phase phase_;
  AbstractInterpretation &interpretation_;
  const ModalTable &modes_;
  ExecutedWords<AbstractInterpretation> words_;
  std::map<std::uint32_t, Partitions> pending_; // by position
  std::map<std::uint32_t, Partitions> arrived_;
  std::map<std::uint32_t, int> visits_;            // of heads
  std::map<std::uint32_t, LoopCounters> counters_; // by position of the head
  std::optional<std::size_t> modal_;               // the modal call that is being entered
  std::set<std::uint32_t> passed_;                 // heads that have been visited in this iteration
  std::vector<Work> work_;
  bool startAgain_ = false; // a new head has been found: what has passed it was not kept
};

} // namespace feedhold
