// FlowFacts: what the analysis of one program has found, over all its states: what rules and reports ask.
#pragma once

#include "inference/absint/analysis.h"
#include "meaning/cfg/program_set.h"

#include <map>
#include <memory>
#include <optional>
#include <set>
#include <typeindex>
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
  CallRequest<AbstractInterpretation> request;
};

/// A called program reads a local variable that holds nothing, in all runs through this call.
struct VacantReadInCall {
  NodeId call; // of this program
  Place read;
  ExpressionId expression;
  std::uint32_t variable;
};

/// A program that a call enters raises an alarm of its own, in some of the runs through this call.
struct AlarmInCall {
  NodeId call; // of this program
  Place raised;
  Span place;
};

struct UnmodelledFact {
  NodeId node;
  std::string_view reason;
};

/// From where a search has come to the nodes of a program.  One search after the other uses the same memory: a program
/// of a million blocks is searched from each of its tool changes, mostly a few blocks far.
class SearchTrail {
public:
  void start(std::size_t nodes) {
    places_.resize(nodes);
    ++search_;
  }
  bool isKnown(std::size_t node) const { return places_[node].search == search_; }
  std::uint32_t before(std::size_t node) const { return places_[node].before; }
  void put(std::size_t node, std::uint32_t before) { places_[node] = {before, search_}; }

private:
  struct Place {
    std::uint32_t before;
    std::uint32_t search; // that has put it
  };
  std::vector<Place> places_;
  std::uint32_t search_ = 0;
};

/// Values of expressions, joined over all their evaluations.  The expressions of a program stand together in its file:
/// its own are a list, those of programs inside or around it are looked up.
class ExpressionValues {
public:
  /// `first` to, not including, `last`: of the program.
  ExpressionValues(std::size_t first, std::size_t last) : first_(first), own_(last - first) {}

  void add(ExpressionId expression, const AbstractValue &value) {
    std::optional<AbstractValue> &known =
        isOwn(expression) ? own_[expression.index() - first_] : others_[expression.index()];
    known = known ? join(*known, value) : value;
  }
  const AbstractValue *find(ExpressionId expression) const {
    if (isOwn(expression))
      return pointerTo(own_[expression.index() - first_]);
    const auto found = others_.find(expression.index());
    return found == others_.end() ? nullptr : pointerTo(found->second);
  }

private:
  bool isOwn(ExpressionId expression) const { return expression.index() - first_ < own_.size(); }
  static const AbstractValue *pointerTo(const std::optional<AbstractValue> &value) { return value ? &*value : nullptr; }

  std::size_t first_;
  std::vector<std::optional<AbstractValue>> own_;
  std::unordered_map<std::uint32_t, std::optional<AbstractValue>> others_;
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
  const std::vector<AlarmInCall> &alarmsInCalls() const { return alarmsInCalls_; } // the first ones of each call
  const std::vector<UnmodelledFact> &unmodelled() const { return unmodelled_; }

  /// What several rules derive from these facts: make() for the first of them.
  template <typename Derived, typename Make> const Derived &derived(Make &&make) const {
    auto &known = derived_[typeid(Derived)];
    if (!known)
      known = std::make_shared<const Derived>(make());
    return *static_cast<const Derived *>(known.get());
  }
  /// Of searches through the graph: one at a time.
  SearchTrail &trail() const { return trail_; }

private:
  friend class FactCollector;
  friend FlowFacts collectFacts(const ProgramSet &, FileId, ProgramId, std::span<FlowWatch *const>,
                                const FileContracts *);

  std::size_t first_;
  std::vector<bool> reached_;
  std::array<CodeSet, kModalGroups> entryCodes_{};
  std::unordered_map<std::uint32_t, Truth> truths_; // by node
  ExpressionValues values_;
  std::vector<AlarmFact> alarms_;
  std::vector<UserAlarmFact> userAlarms_;
  std::vector<ExitFact> exits_;
  std::vector<CallFact> calls_;
  std::vector<VacantReadInCall> vacantReads_;
  std::vector<AlarmInCall> alarmsInCalls_;
  std::vector<UnmodelledFact> unmodelled_;
  mutable SearchTrail trail_;
  mutable std::map<std::type_index, std::shared_ptr<const void>> derived_;
  bool complete_ = true;
};

/// Looks on while a program is walked through, not into those that it calls.
class FlowWatch {
public:
  virtual ~FlowWatch() = default;
  virtual void before(NodeId, const AbstractState &) {}
  virtual void after(NodeId, const AbstractState &) {} // of instructions with one successor
  virtual void move(NodeId, MoveKind) {}
  virtual void ended(NodeId, PathEnd, const AbstractState &) {}
};

/// Analyses a program that is started with nothing known, or, with the contracts of its file, as its contract allows.
/// The watches look on.
FlowFacts collectFacts(const ProgramSet &programs, FileId file, ProgramId program, std::span<FlowWatch *const> watches,
                       const FileContracts *contracts = nullptr);

} // namespace feedhold
