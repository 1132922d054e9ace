// Lowering: builds the graph block by block, in order of the text.  A node leads to the next one unless told otherwise;
// jumps ahead are mended when the program is read.  One file for each part: lower.cpp (files and programs),
// lower_blocks.cpp (words, calls, returns), lower_statements.cpp, lower_loops.cpp, lower_o_words.cpp.
#pragma once

#include "language/model/contours.h"
#include "language/model/repeated_labels.h"
#include "meaning/cfg/block_words.h"
#include "meaning/cfg/cfg.h"
#include "meaning/cfg/loop_gates.h"

#include <utility>
#include <vector>

namespace feedhold {

class Lowering {
public:
  Lowering(const SourceFile &source, const SyntaxTree &tree, const ProgramModel &model, const Dialect &dialect,
           const ReturnTargets &returns)
      : source_(source), tree_(tree), model_(model), dialect_(dialect), returns_(returns) {}

  Cfg run();

private:
  // lower.cpp
  void program(ProgramId id);
  ProgramId firstFrom(BlockId block, ProgramId program) const;
  void passDefinition(const Program &definition);
  void addGates(const std::vector<LoopEntrance> &entrances);
  void mendJumps(ProgramId id, NodeId end);

  // lower_blocks.cpp
  void block(BlockId id);
  bool isPlain(BlockId id);
  void plainBlock(BlockId id);
  template <typename IsOwn> void executeWords(WordChoice which, IsOwn &&isOwn);
  void wholeBlock(BlockId id);
  void brokenBlock(const BlockWords &words);
  void words(const BlockWords &words);
  void calls(const BlockWords &words);
  void call(const Call &call);
  void operationOfMacroA(const Call &call);
  void jumpOnInput();
  Jump jumpTo(const Word &target) const;
  void mayGoTo(const Jump &jump);
  void contour();
  bool passes(const ContourBlocks &contour) const;
  void ending(const BlockWords &words);
  void leave(const BlockWords &words);
  void wordsUnderCondition(std::optional<ExpressionId> condition);
  std::optional<NodeId> openInnerSkip(Span part);
  void closeSkip(std::optional<NodeId> skip);
  Span innerSkip() const;
  std::uint8_t levelOf(Span slash) const;

  // lower_statements.cpp
  void statements();
  void flowStatements();
  void statement(StatementId id);
  void gotoStatement(const Statement &statement);
  const Jump *jumpOf(const Statement &statement) const;
  bool isStrayParenthesis(const Statement &statement) const;
  bool isUnread(BlockId id) const;
  void goTo(const Jump &jump);
  std::optional<AlarmKind> alarmOf(const Jump &jump) const;
  void ifStatement(const If &statement);
  void ifLines(const If &statement);
  void elseIfLine(const ElseIf &statement);
  void elseLine();
  void endIfLine();
  void closeOpenIfs();

  // lower_loops.cpp
  void whileStatement(StatementId id, const While &loop);
  void doStatement(StatementId id);
  void endStatement(StatementId id);
  std::optional<std::size_t> loopOfDo(StatementId id) const;
  std::optional<std::size_t> loopOfEnd(StatementId id) const;
  void sortEnds(ProgramId id);
  bool beginsLoop(std::optional<std::size_t> loop);
  void enter(std::size_t loop);
  void leaveOutDo(std::optional<NodeId> skip);

  // lower_o_words.cpp
  struct ConstructNodes;
  void oWordStatement(StatementId id, const OWord &oWord);
  std::optional<ExpressionId> valueOf(StatementId oWord) const;
  void headOfConstruct(ConstructId id);
  bool isLeftByReturn(const Construct &construct) const;
  void partOfConstruct(OWordKind kind, ConstructId id, std::optional<ExpressionId> value);
  void nextBranch(ConstructNodes &nodes, OWordKind kind, std::optional<ExpressionId> value);
  void startRepeat(ConstructNodes &nodes, std::optional<ExpressionId> times);
  void leaveBody(ConstructNodes &nodes, OWordKind kind, OWordKind loop);
  void closeConstruct(ConstructNodes &nodes);
  void resolve(std::vector<NodeId> &nodes);
  void closeOpenConstructs(ProgramId id);

  // nodes
  NodeId end() const { return NodeId(cfg_.nodes.size()); }
  NodeId emit(Instruction instruction) { return cfg_.nodes.add({block_, NodeId(cfg_.nodes.size() + 1), instruction}); }
  NodeId emitLast(Instruction instruction) { return cfg_.nodes.add({block_, end(), instruction}); }
  void setNext(NodeId node, NodeId next) { cfg_.nodes[node].next = next; }
  /// Goes on behind the node that comes next, or straight to what `emit` made behind that.
  NodeId emitTest(std::optional<ExpressionId> condition) { return emit(Test{condition, end().next()}); }
  void stop(AlarmKind alarm) { emitLast(StopWithAlarm{alarm}); }

  const SourceFile &source_;
  const SyntaxTree &tree_;
  const ProgramModel &model_;
  const Dialect &dialect_;
  const ReturnTargets &returns_;
  bool definesInside_ = false;
  Cfg cfg_;
  BlockId block_{0};
  std::size_t nextCall_ = 0; // in model_.calls: the first one that is not before the block
  std::size_t nextJump_ = 0; // likewise

  /// An edge to a block that has no node yet.
  enum class Edge : std::uint8_t { Next, Taken };
  struct OpenJump {
    NodeId node;
    Edge edge;
    BlockId target;
  };
  std::vector<OpenJump> openJumps_;

  struct LoopNodes {
    std::optional<NodeId> head; // to which END leads back
    std::optional<NodeId> test; // of WHILE: leads behind END when false
    bool isEntered = false;     // some jump leads into it from outside
  };
  std::vector<LoopNodes> loopNodes_;                          // by index in model_.loops
  std::vector<std::pair<StatementId, std::size_t>> loopEnds_; // of this program, sorted

  /// `IF [..] THEN` whose ENDIF has not come.
  struct OpenIf {
    std::optional<NodeId> test; // leads to the next branch when false
    std::vector<NodeId> ends;   // ends of branches, which lead behind ENDIF
    NodeId first;
  };
  std::vector<OpenIf> openIfs_;

  /// The same for the o-words of one label.
  struct ConstructNodes {
    std::optional<NodeId> head;      // of a loop: to which its end leads back
    std::optional<NodeId> whenFalse; // leads to the next branch, or behind the end
    std::vector<NodeId> ends;        // ends of branches, and breaks: lead behind the end
    std::vector<NodeId> continues;   // lead to the end
  };
  std::vector<ConstructNodes> constructNodes_; // by ConstructId
  std::map<ConstructId, LabelRepetition> repeatedLabels_ = repeatedLabels(model_);
};

} // namespace feedhold
