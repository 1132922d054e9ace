// Cfg: the control-flow graph of one file: what is executed, and what may come next.
//
// A node is one instruction; a block of the program becomes one or a few of them.  Instructions point into the syntax
// tree, so that there is one copy of every expression.  The graph of all programs of a file is one graph with an entry
// for each program; jumps never lead from one program into another, calls do (program_set.h).
#pragma once

#include "language/dialect/dialect.h"
#include "language/model/model.h"

#include <array>
#include <optional>
#include <span>
#include <string>
#include <variant>
#include <vector>

namespace feedhold {

using NodeId = Id<struct NodeTag>;
using CounterId = Id<struct CounterTag>;

/// Nothing happens: the entry of a program, a GOTO, an END that leads back, a statement that changes nothing followed
/// here (DPRNT, SETVN).
struct Pass {};

/// A `/` or `/n`: the operator's switch decides, at any time.  Next: the block is executed.
struct BlockSkip {
  std::uint8_t level;
  NodeId skipped;
};

/// Which words of the block: all but those that the other choices name.
enum class WordChoice : std::uint8_t {
  Always,         // not under a condition, not behind a `/` in mid-block
  WithSkipped,    // Always and those behind a `/` in mid-block
  UnderCondition, // the words of `IF [..] THEN S900`, `[..] M99`
};
/// Which addresses and codes the words of a node may have, one bit for several of them: most questions of a rule about
/// a block of a tool path are answered by no without a look at its words.
class WordTraits {
public:
  void add(const Word &word, const Code *code) {
    letters_ |= bitOf(word.address());
    if (code)
      actions_[halfOf(code->action)] |= bitOf(code->action);
  }
  bool mayHave(char address) const { return (letters_ & bitOf(address)) != 0; }
  bool mayDo(CodeAction action) const { return (actions_[halfOf(action)] & bitOf(action)) != 0; }

private:
  static constexpr std::uint32_t bitOf(char address) { return std::uint32_t{1} << (address & 31); }
  static constexpr std::uint32_t bitOf(CodeAction action) {
    return std::uint32_t{1} << (static_cast<unsigned>(action) & 31);
  }
  static constexpr std::size_t halfOf(CodeAction action) { return static_cast<std::size_t>(action) >> 5 & 1; }

  std::uint32_t letters_ = 0;
  std::array<std::uint32_t, 2> actions_{};
};

/// The NC words of the block that BlockWords (block_words.h) gives to the choice: modal codes, offsets, motion, dwell,
/// spindle.
struct ExecuteWords {
  WordChoice which;
  bool isWholeBlock = false; // all words of the block are among them
  WordTraits traits = {};
};

/// `#1=2`; several in one block only where the control reads the whole line first (all read the old values).
struct Assign {
  StatementId first; // `count` statements from here that are assignments
  std::uint32_t count;
};

/// Goes to `taken` when the condition holds, else to next.  Without condition (it did not parse): either.
struct Test {
  std::optional<ExpressionId> condition;
  NodeId taken;
  bool passesContour = false; // a control takes this way; only analyses of the text look at the contour as well
};

/// GOTO to a computed number: searches the program.  Targets: labelsOf(.., block of the node).
struct JumpTo {
  ExpressionId target;
};

/// The DO of loop `number` is executed.  Only where some jump leads into the loop from outside.
struct EnterLoop {
  std::uint8_t number;
};
/// A jump leads into loop `number` past its DO.
struct JumpIntoLoop {
  std::uint8_t number;
};
/// The END of a loop that a jump may have entered: an alarm unless its DO has been executed (MissingDo).
struct RequireLoop {
  std::uint8_t number;
};

/// `repeat [n]`: sets the counter, rounded as the control does.
struct StartCount {
  CounterId counter;
  ExpressionId times;
};
/// Goes to `taken` and counts one down while the counter is above zero, else to next.
struct CountDown {
  CounterId counter;
  NodeId taken;
};

/// A call; next is where its return leads.  What is called: ProgramSet::callee.
struct CallProgram {
  CallId call;
};

/// M99, `endsub`, `return`.
struct ReturnFromProgram {
  std::optional<WordId> target;      // P of `M99 P100`: a sequence number of the caller
  std::optional<ExpressionId> value; // of `o100 return [..]`
};

/// A return of a definition that the program passes: LinuxCNC evaluates its value all the same (read_o of its
/// interp_read.cc).
struct PassedReturn {
  std::optional<ExpressionId> value;
};

enum class ProgramEnd : std::uint8_t { M02, M30, EndOfFile };
struct EndProgram {
  ProgramEnd end;
};

/// The control stops here with an alarm, whatever the values.
struct StopWithAlarm {
  AlarmKind alarm;
};

/// Anything may happen to variables, modal state and position here; `reason` says why, in shop words.
struct Havoc {
  std::string_view reason;
};

/// The same for what names no code and no axis: no reading of it changes modal state or position.  Proofs treat it as a
/// Havoc.
struct HavocVariables {
  std::string_view reason;
};

using Instruction = std::variant<Pass, BlockSkip, ExecuteWords, Assign, Test, JumpTo, EnterLoop, JumpIntoLoop,
                                 RequireLoop, StartCount, CountDown, CallProgram, ReturnFromProgram, PassedReturn,
                                 EndProgram, StopWithAlarm, Havoc, HavocVariables>;

inline bool isCallOrReturn(const Instruction &instruction) {
  return std::holds_alternative<CallProgram>(instruction) || std::holds_alternative<ReturnFromProgram>(instruction);
}

struct Node {
  BlockId block;
  NodeId next; // itself when nothing follows (EndProgram, ReturnFromProgram, StopWithAlarm, JumpTo)
  Instruction instruction;
};
static_assert(sizeof(Node) <= 32, "a program of a million blocks has a million nodes");

/// Where a jump to a sequence number arrives.
struct LabelNode {
  std::uint32_t number;
  NodeId node;
};

/// The way to a label for jumps that lead into a loop from outside: a JumpIntoLoop node.  The gates of one label stand
/// together, outer loops first, each leading to the next and the last one to the label.
struct LoopGate {
  BlockId label;
  NodeId node;
  BlockId doBlock;
  BlockId endBlock;
  /// A jump from there does not enter the loop: it is inside.
  bool holds(BlockId block) const { return doBlock < block && block <= endBlock; }
};

class Cfg {
public:
  Store<Node, NodeId> nodes;
  std::vector<NodeId> entries;   // by ProgramId
  std::vector<NodeId> blockNode; // by BlockId: the first node of the block, or of the next one that has a node
  std::vector<LoopGate> gates;   // by label
  std::size_t counters = 0;

  NodeId entryOf(ProgramId program) const { return entries[program.index()]; }
  NodeId nodeOf(BlockId block) const { return blockNode[block.index()]; }
};

/// A program that is called returns to its caller; one that the operator starts goes on at its head, or at the target
/// of its `M99 P`.
enum class ProgramUse : std::uint8_t { Called, Started };

/// Calls visit(NodeId) for each successor inside the graph, next first.  A JumpTo has all labels of its program; a call
/// has its return; the return of a called program has none (see ProgramSet).
template <typename Visit>
void forEachSuccessor(const Cfg &cfg, const ProgramModel &model, NodeId node, ProgramUse use, Visit &&visit);

/// Where a return of a started program leads.
std::vector<NodeId> returnsWithin(const Cfg &cfg, const ProgramModel &model, NodeId from);

/// Where a jump to the block arrives: at its node, or at the gate of a loop that the jump enters.
NodeId arrival(const Cfg &cfg, BlockId label, BlockId from);

/// The labels of the program in which `from` stands, in order of the text, as a jump from there finds them.  Of several
/// with one number the search decides: findLabel.
std::vector<LabelNode> labelsOf(const Cfg &cfg, const ProgramModel &model, BlockId from);

/// Where a search for N `number` from a block of the program arrives: forward, then from the top of the program.
std::optional<NodeId> findLabel(const Cfg &cfg, const ProgramModel &model, ProgramId program, std::uint32_t number,
                                BlockId from);

/// How many edges the computed jumps of a program have: each leads to every label.  Beyond kMostComputedEdges an
/// analysis of all paths says so and leaves the program alone.
std::uint64_t computedEdges(const Cfg &cfg, const ProgramModel &model, ProgramId program);
inline constexpr std::uint64_t kMostComputedEdges = 4'000'000;

/// The sequence numbers to which an `M99 P` of any program may return.
struct ReturnTargets {
  std::vector<std::uint32_t> numbers; // sorted
  bool any = false;                   // one of them is computed
};
ReturnTargets returnTargets(std::span<const ProgramModel *const> models);

/// Never fails: what did not parse is a Havoc.  `returns`: of all programs that the file may call.
Cfg lower(const SourceFile &source, const SyntaxTree &tree, const ProgramModel &model, const Dialect &dialect,
          const ReturnTargets &returns);
/// For a file that calls no other.
Cfg lower(const SourceFile &source, const SyntaxTree &tree, const ProgramModel &model, const Dialect &dialect);

/// One line for each node: what golden cases compare.
std::string dump(const Cfg &cfg, const SyntaxTree &tree, const SourceFile &source, const ProgramModel &model);

// ---- template -----------------------------------------------------------------------------------------------------

template <typename Visit>
void forEachSuccessor(const Cfg &cfg, const ProgramModel &model, NodeId id, ProgramUse use, Visit &&visit) {
  const Node &node = cfg.nodes[id];
  if (node.next != id)
    visit(node.next);
  if (const auto *skip = std::get_if<BlockSkip>(&node.instruction)) {
    visit(skip->skipped);
  } else if (const auto *test = std::get_if<Test>(&node.instruction)) {
    visit(test->taken);
  } else if (const auto *count = std::get_if<CountDown>(&node.instruction)) {
    visit(count->taken);
  } else if (std::holds_alternative<JumpTo>(node.instruction)) {
    for (const SequenceNumber &label : model.sequenceNumbersOf(model.programOf(node.block)))
      visit(arrival(cfg, label.block, node.block));
  } else if (use == ProgramUse::Started && std::holds_alternative<ReturnFromProgram>(node.instruction)) {
    for (const NodeId target : returnsWithin(cfg, model, id))
      visit(target);
  }
}

} // namespace feedhold
