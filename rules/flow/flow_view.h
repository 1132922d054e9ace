// How rules look at what a program does with its variables: who reads them, how, who sets them, and how it is started.
#pragma once

#include "findings/rule/flow_path.h"
#include "rules/expressions/expression_view.h"

#include <optional>
#include <vector>

namespace feedhold::rules {

/// What becomes of the value of a variable that is read.
enum class ReadUse : std::uint8_t {
  Equality, // an operand of EQ or NE: vacant is told from 0
  Ordering, // an operand of GT, GE, LT, LE: vacant counts as 0
  Computed, // an operand of arithmetic or a function: vacant counts as 0
  Copied,   // the whole right side of an assignment: vacancy is copied
  Word,     // the whole value of a word: with a vacant variable the word counts as not written
  Argument, // the whole value of an argument of a call: a vacant one is not passed
  Other,    // the number of a jump or loop, an index, what is printed
};

struct Read {
  ExpressionId expression; // NumberedVariable, IndirectVariable or NamedVariable
  std::optional<std::uint32_t> number;
  ReadUse use;
  BlockId block;
};

/// What the block reads, its statements first.
std::vector<Read> readsOf(const ProgramFile &file, BlockId block);
/// What a program reads, in order of the text.
std::vector<Read> readsOf(const ProgramFile &file, ProgramId program);
/// Of its program.
const std::vector<Read> &readsOf(const FlowFacts &facts);
/// What an expression reads.
std::vector<Read> readsIn(const ProgramFile &file, ExpressionId root, BlockId block);

bool isLocal(const ProgramFile &file, std::uint32_t variable);
/// The letter that passes a local variable by argument assignment I.
std::optional<char> letterOfArgument(const Dialect &dialect, std::uint32_t variable);
/// It can be passed by a call of the program: it has a letter, or is a parameter of a subroutine of o-words.
bool isParameter(const FlowFacts &facts, std::uint32_t variable);
/// "`#18` (R)", or "`#30`" for one without a letter.
std::string describeVariable(const Dialect &dialect, std::uint32_t variable);

/// What to write at the head of a macro whose argument must not be 0.
std::string adviceToCheck(const Dialect &dialect, std::uint32_t argument);

/// A program that the operator starts, and that starts with vacant local variables: no M99 in it, nobody calls it, and
/// it comes to M02 or M30.
bool isMainProgram(const FlowFacts &facts);
/// Some M98 reaches the program: it works on the local variables of its callers.
bool isCalledAsSubprogram(const FlowFacts &facts);
/// Some caller by M98 sets the local variable, or asks for its value.
bool mayHoldCallersValue(const FlowFacts &facts, std::uint32_t variable);

/// The contract of the program says what the common variable holds on entry.
bool isPromised(const FlowFacts &facts, const FileContext &context, std::uint32_t variable);

/// Some call in the checked programs, and all of them pass the argument.
bool isAlwaysPassed(const FlowFacts &facts, std::uint32_t variable);

/// Some assignment in the text of the program may set the variable, or some subprogram that shares its local variables
/// may.  Where that cannot be told: true.
bool maySet(const FlowFacts &facts, std::uint32_t variable);
/// Some program of the run may set the common variable.
bool isWrittenInAny(const FlowFacts &facts, std::uint32_t variable);
/// A read of a computed number, `#[..]`, that may name a local variable: where its index says nothing else.
bool mayReadLocal(const ProgramFile &file, const VariableUse &use);

/// Some read in a condition of the program.
bool isTested(const ProgramFile &file, ProgramId program, std::uint32_t variable);
/// Some EQ or NE in the program.
bool isTestedForVacancy(const ProgramFile &file, ProgramId program, std::uint32_t variable);

/// A local variable that is vacant wherever this program reads it, since nothing ever sets it.
bool isNeverSet(const FlowFacts &facts, std::uint32_t variable);
/// The argument that a local variable holds, by the text: nothing in the program sets it, or its only assignment copies
/// such a variable.
std::optional<std::uint32_t> argumentBehind(const FlowFacts &facts, std::uint32_t variable);

/// All expressions of a block with their parts.
std::vector<ExpressionId> expressionsOf(const ProgramFile &file, BlockId block);
/// The first expression in the block that covers exactly the span.
std::optional<ExpressionId> expressionAt(const FlowFacts &facts, BlockId block, Span span);
/// A larger graph than any that a person wrote: rules that search paths for each variable leave it alone.
bool isTooLarge(const FlowFacts &facts);
/// The blocks of the program.
std::vector<BlockId> blocksOf(const ProgramFile &file, ProgramId program);

/// The variable that an expression names, by its number or by a name; absent for computed ones and for other
/// expressions.
std::optional<std::uint32_t> variableOf(const FlowFacts &facts, ExpressionId id);
/// What a node assigns: targets with the values.
std::vector<Assignment> assignmentsOf(const FlowFacts &facts, NodeId node);
/// The node that evaluates an expression of the block; absent when it is not reached.
std::optional<NodeId> nodeOf(const FlowFacts &facts, BlockId block, ExpressionId expression);

/// The block raises an alarm, or the one behind it where the block is a lone label.
bool raisesAlarmAt(const ProgramFile &file, BlockId block);
/// The condition of the block leads to an alarm.
bool leadsToAlarm(const FlowFacts &facts, BlockId block);
/// The outcome of the test with which an alarm is raised: where it jumps to, or behind it.  Absent: with none.
std::optional<bool> alarmWhenTrue(const FlowFacts &facts, NodeId test);

/// A block of nothing but a sequence number.
bool isLoneNumber(const FlowFacts &facts, NodeId node);
/// The block that a jump leads to, or the one behind the lone sequence numbers at which it arrives.
std::optional<BlockId> blockBehind(const FlowFacts &facts, const Jump &jump);

/// Where a local variable may still be as it was when the program was started.  Where a subprogram or an assignment to
/// a computed number may set it, it counts as set.  A loop is taken to run at least once.
class UnsetPaths {
public:
  UnsetPaths(const FlowFacts &facts, std::uint32_t variable);

  bool reach(NodeId node) const { return reached_[node.index() - facts_.entry().index()]; }
  /// Only where it reaches the node: no path on which it is set leads there that has not passed the node before.
  bool isFirstUse(NodeId node) const;
  bool sets(NodeId node) const { return sets_[node.index() - facts_.entry().index()]; }

private:
  void walk();
  template <typename Visit> void forEachNext(NodeId node, Visit &&visit) const;

  const FlowFacts &facts_;
  std::vector<bool> sets_;
  std::vector<bool> reached_;
};

} // namespace feedhold::rules
