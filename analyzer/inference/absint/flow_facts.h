// FlowFacts: what the analysis of one program has found, over all its states: what rules and reports ask.
#pragma once

#include "inference/absint/analysis.h"
#include "meaning/cfg/program_set.h"

#include <map>
#include <optional>
#include <set>
#include <unordered_map>
#include <vector>

namespace feedhold {

/// A place where the control stops by itself in some or in all of the runs that come there.
struct AlarmFact {
  AlarmKind kind;
  Span place;
  NodeId node;
  bool always;
};

/// `#3000=`
struct UserAlarmFact {
  Span place;
  NodeId node;
  AbstractValue number;
};

struct ExitFact {
  NodeId node;
  PathEnd end;
  AbstractState state; // over all runs that end there
};

/// A call with what it passes, over all runs.
struct CallFact {
  NodeId node;
  CallId call;
  CallRequest<AbstractReading> request;
};

/// A called program reads a local variable that holds nothing, in all runs through this call.
struct VacantReadInCall {
  NodeId call; // of this program
  Place read;
  ExpressionId expression;
  std::uint32_t variable;
};

struct NotModelledFact {
  NodeId node;
  std::string_view reason;
};

class FlowWatch;

class FlowFacts {
public:
  FlowFacts(const ProgramSet &set, FileId file_, ProgramId program_);

  const ProgramSet &programs;
  const ProgramFile &file;
  ProgramId program;
  ModalTable modes;

  /// False: the analysis gave up, and nothing below is to be relied on.
  bool isComplete() const { return complete_; }
  bool isReached(NodeId node) const { return reached_[node.index() - first_]; }
  const Node &node(NodeId node) const { return file.cfg.nodes[node]; }
  NodeId entry() const { return file.cfg.entryOf(program); }
  /// The nodes of the program: from entry() up to, not including, this one.
  NodeId end() const { return NodeId(first_ + reached_.size()); }

  /// The codes in force at entry, by group.
  const std::array<CodeSet, kModalGroups> &entryCodes() const { return entryCodes_; }
  /// Of a Test that is reached.
  std::optional<Truth> truthOf(NodeId test) const;
  /// Over all evaluations in this program; null when it is never evaluated.
  const AbstractValue *valueOf(ExpressionId expression) const;
  const std::vector<AlarmFact> &alarms() const { return alarms_; } // by place
  const std::vector<UserAlarmFact> &userAlarms() const { return userAlarms_; }
  const std::vector<ExitFact> &exits() const { return exits_; } // by node
  const std::vector<CallFact> &calls() const { return calls_; } // by node
  const std::vector<VacantReadInCall> &vacantReads() const { return vacantReads_; }
  const std::vector<NotModelledFact> &notModelled() const { return notModelled_; }

private:
  friend class FactCollector;
  friend FlowFacts collectFacts(const ProgramSet &, FileId, ProgramId, std::span<FlowWatch *const>,
                                const FileContracts *);

  std::size_t first_;
  std::vector<bool> reached_;
  std::array<CodeSet, kModalGroups> entryCodes_{};
  std::unordered_map<std::uint32_t, Truth> truths_;         // by node
  std::unordered_map<std::uint32_t, AbstractValue> values_; // by expression
  std::vector<AlarmFact> alarms_;
  std::vector<UserAlarmFact> userAlarms_;
  std::vector<ExitFact> exits_;
  std::vector<CallFact> calls_;
  std::vector<VacantReadInCall> vacantReads_;
  std::vector<NotModelledFact> notModelled_;
  bool complete_ = true;
};

/// Looks on while a program is walked through, not into those that it calls.
class FlowWatch {
public:
  virtual ~FlowWatch() = default;
  virtual void before(NodeId, const AbstractState &) {}
  virtual void after(NodeId, const AbstractState &) {} // of instructions with one successor
  virtual void move(NodeId, const Move<AbstractValue> &) {}
  virtual void ended(NodeId, PathEnd, const AbstractState &) {}
};

/// Analyses a program that is started with nothing known, or, with the contracts of its file, as its contract allows.
/// The watches look on.
FlowFacts collectFacts(const ProgramSet &programs, FileId file, ProgramId program, std::span<FlowWatch *const> watches,
                       const FileContracts *contracts = nullptr);

} // namespace feedhold
