// What the rules of this group ask of a program: what a node does with axes, and what is in force there.
#pragma once

#include "findings/rule/flow_path.h"
#include "findings/rule/rule.h"

#include <array>
#include <initializer_list>
#include <vector>

namespace feedhold::rules {

/// Who starts a program, as far as the run shows: one with M99, or that some program calls, has a caller.
enum class StartedBy : std::uint8_t { Operator, Caller };
StartedBy startedBy(const FileContext &context, ProgramId program);

/// By M02, M30 or M99: the text is no piece of a program.
bool comesToItsEnd(const FlowFacts &facts);
/// Only M97 leads to this return: those who call the program do not see it.
bool isOfLocalCall(const ExitFact &exit, const FlowFacts &facts);

class MotionView {
public:
  MotionView(ProgramId program, const FileContext &context);

  ProgramId program() const { return program_; }
  const FileContext &context() const { return context_; }
  const ModalTable &modes() const { return *modes_; }
  const Cfg &cfg() const { return cfg_; }
  const Node &node(NodeId node) const { return cfg_.nodes[node]; }

  /// The words that the node executes; none for what is no ExecuteWords.
  std::vector<const Word *> wordsOf(NodeId node) const;
  /// Those of them that name an end point: none where a code of the block takes the words for itself (G04, G10, G92
  /// ..).
  std::vector<const Word *> axisWords(NodeId node) const;
  /// As axisWords, where the node moves by G00, G01, G02, G03 or a cycle: not G28, G31, G53.
  std::vector<const Word *> modalMotionWords(NodeId node) const;
  /// The word of the node's block with a code that does one of the actions.
  const Word *findAction(NodeId node, std::initializer_list<CodeAction> actions) const;
  /// False: the words of the node do none of the actions, or have no such address.  Much faster than a look at them.
  bool mayDo(NodeId node, std::initializer_list<CodeAction> actions) const;
  bool mayHave(NodeId node, char address) const;
  /// The node executes a code of the group that holds the kind.
  bool sets(NodeId node, ModalKind kind) const;
  Span blockSpan(NodeId node) const;

  /// The kind's codes that may be in force; absent where the control has no such group.
  std::optional<CodeSet> inForce(const AbstractState &state, ModalKind kind) const;
  /// One of the actions was programmed on some path, in this run, or promised by the contract, and is in force.
  bool wasSet(const AbstractState &state, ModalKind kind, std::initializer_list<CodeAction> actions) const;
  /// One of the actions is in force in all runs.
  bool surely(const AbstractState &state, ModalKind kind, std::initializer_list<CodeAction> actions) const;
  bool mayBe(const AbstractState &state, ModalKind kind, std::initializer_list<CodeAction> actions) const;

  /// In force in all runs.
  std::optional<Plane> planeIn(const AbstractState &state) const;
  /// Since the control was switched on: G17 of a mill, G18 of a lathe.
  Plane usualPlane() const;
  /// The code of another was programmed, or may have been before the call.
  bool choseOtherPlane(const AbstractState &state) const;
  /// By a letter that no arc of the usual plane has.
  bool namesOtherPlane(NodeId node) const;
  /// The factor from a coordinate to a length: 0.5 for X of a lathe, which counts in diameters.
  double lengthOf(Axis axis) const;

private:
  std::array<CodeAction, 2> otherPlanes() const;
  bool callersChooseOtherPlane() const;

  const FileContext &context_;
  ProgramId program_;
  const Cfg &cfg_;
  std::shared_ptr<const ModalTable> modes_;
  mutable std::optional<bool> callersChooseOtherPlane_; // computed when it is first asked for
};

/// Something that the analysis does not follow has happened on some path: all is unknown behind it.
inline bool isHavocked(const AbstractState &state) { return state.codes[0] != CodeSet::atEntry(); }

/// A word in force that nothing in the program has written: as at entry, in all runs or in some.
inline bool isAsAtEntry(const AbstractState &state, char letter) {
  const AbstractValue &value = state.word(letter);
  return value.origin() &&
         value.origin()->symbol == kWordSymbols + static_cast<std::uint32_t>(indexOfModalWord(letter));
}

/// Remembers the first node, in order of the text, at which something was seen.
class FirstSeen {
public:
  void note(NodeId node) {
    if (!node_ || node < *node_)
      node_ = node;
  }
  const std::optional<NodeId> &node() const { return node_; }

private:
  std::optional<NodeId> node_;
};

} // namespace feedhold::rules
