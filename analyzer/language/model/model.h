// ProgramModel: what the names of one file mean: programs, sequence numbers, jumps, loops, calls, variables, codes.
#pragma once

#include "language/dialect/dialect.h"
#include "language/syntax/tree.h"

#include <optional>
#include <set>
#include <span>
#include <string>
#include <variant>
#include <vector>

namespace feedhold {

using ProgramId = Id<struct ProgramTag>;
using CallId = Id<struct CallTag>;
using OWordId = Id<struct OWordTag>;
using ConstructId = Id<struct ConstructTag>;

/// `O1000`, `<NAME>` where programs have names, or the label of `o<name> sub`; none for a file that starts without one.
struct ProgramName {
  std::optional<std::uint32_t> number;
  std::string text;          // of `<NAME>`; the label of a subroutine (labelText)
  bool isSubroutine = false; // called by o-words, not by `M98 P`
  bool empty() const { return !number && text.empty(); }
  friend bool operator==(const ProgramName &, const ProgramName &) = default;
};
std::string toString(const ProgramName &name);

struct Program {
  ProgramName name;
  Span header;          // the O word, or the first block's span
  BlockId first;        // blocks from here ..
  BlockId last;         // .. up to, not including, this one
  bool returns = false; // an M99 stands in it, or it is a subroutine of o-words
  /// Of a subroutine from `o100 sub` up to its `endsub`: the program in whose text it stands, and which passes over it.
  std::optional<ProgramId> within = {};
  std::string folder = {};  // of the control's memory, in the dump of which it stands
  bool isEncrypted = false; // what it does is not known
  bool contains(BlockId block) const { return first <= block && block < last; }
};

/// An `N` that a jump can find: not a parameter number of a G10 block.
struct SequenceNumber {
  std::uint32_t number;
  BlockId block;
  WordId word;
};

enum class JumpKind : std::uint8_t {
  Goto,        // GOTO n
  ReturnTo,    // M99 P n: in the caller, or in the program itself when it is a main program
  LocalCall,   // M97 P n
  CallAt,      // M98 P.. Q n
  ContourFrom, // P of a contour cycle (G70-G73)
  ContourTo,   // Q of a contour cycle
};
struct Jump {
  JumpKind kind;
  ProgramId program;
  BlockId block;
  Span span;                            // the whole statement or word
  Span targetSpan;                      // the number
  std::optional<Decimal> number;        // absent when computed
  std::optional<ExpressionId> computed; // the expression when it is
  std::optional<BlockId> target;        // forward search, then from the top; absent when missing or elsewhere
  bool conditional = false;             // under an IF or a block skip
};

/// A DO and its END: the one that closes the last open DO of that number, whatever loops of other numbers lie between.
struct Loop {
  ProgramId program;
  std::optional<std::uint32_t> number; // absent: missing or not a number
  BlockId doBlock;
  StatementId doStatement;
  std::optional<BlockId> endBlock;
  std::optional<StatementId> endStatement;
};
/// An END that no DO before it leads to.
struct LoneEnd {
  ProgramId program;
  std::optional<std::uint32_t> number;
  BlockId block;
  StatementId statement;
};

/// An o-word statement.
struct OWordUse {
  OWordKind kind;
  ProgramId program; // `sub` and `endsub` belong to their subroutine
  BlockId block;
  StatementId statement;
  std::string label; // labelText; empty when computed
  /// Of if .. endif, while, do, repeat, sub: the construct of which it is a part.  Of `break`, `continue`: the loop; of
  /// `return`: the subroutine.  Absent for `call`, and for a statement that finds no partner.
  std::optional<ConstructId> construct;
};
/// The o-words of one label that belong together: `if` with its `elseif`, `else` and `endif`; `while` and `endwhile`;
/// `do` and `while`; `repeat` and `endrepeat`; `sub` and `endsub`.
struct Construct {
  OWordKind kind;             // If, While, Do, Repeat, Sub
  std::vector<OWordId> parts; // in order of the text, the head first
  bool closed = false;        // the last part is its end
};

enum class CallKind : std::uint8_t {
  Macro,       // G65
  Modal,       // G66
  ModalEach,   // G66.1
  ModalCancel, // G67
  MacroA,      // G65 H..: an operation of Macro A, no call
  Subprogram,  // M98
  Local,       // M97
  External,    // M198
  Code,        // a G, M or T code of the machine's tables
  OWord,       // o100 call [1] [2]
};
enum class ArgumentRole : std::uint8_t { Passed, Overridden, Forbidden, BeyondSets };
struct Argument {
  WordId word;
  std::uint8_t variable; // local variable that it sets; 0 when none
  ArgumentRole role;
  bool fromSet = false; // by argument assignment II (second and later I, J, K)
};
/// `M98 P30100` where it may mean O0100, three times.
struct PackedCall {
  std::uint32_t program;
  std::uint32_t repeats;
};
struct Call {
  CallKind kind;
  ProgramId caller;
  BlockId block;
  WordId code;                           // the G65, M98 .. word; of an o-word call, the first word behind the block
  std::optional<WordId> programWord;     // P, or the <NAME>
  ProgramName callee;                    // empty when computed or missing
  std::optional<std::uint32_t> repeats;  // L, when a literal
  std::vector<Argument> arguments;       // word by word, as written
  Span span = {};                        // the code and the program that it names
  bool isLast = false;                   // behind it only the end of the calling program
  std::vector<ExpressionId> values = {}; // of an o-word call: #1, #2 ..
  /// What is called where no program has the number `callee`: see CallGraph::isPacked().
  std::optional<PackedCall> packed = {};
};

struct VariableUse {
  ExpressionId expression;
  std::optional<std::uint32_t> number; // absent: computed or named
  BlockId block;
  bool write = false;
};

class ProgramModel {
public:
  Store<Program, ProgramId> programs;
  std::vector<SequenceNumber> sequenceNumbers; // in order of the text
  std::vector<Jump> jumps;
  std::vector<Loop> loops; // by place of the DO
  std::vector<LoneEnd> loneEnds;
  Store<OWordUse, OWordId> oWords;          // in order of the text
  Store<Construct, ConstructId> constructs; // by place of their heads
  Store<Call, CallId> calls;
  std::vector<VariableUse> variables;
  /// Indices into sequenceNumbers, by number and then by place.
  std::vector<std::uint32_t> byNumber;

  /// Sequence numbers behind the closing `%`, which no jump finds; sorted.
  std::vector<std::uint32_t> numbersBehindEnd;

  /// The innermost one.
  ProgramId programOf(BlockId block) const;
  bool isBehindEnd(std::uint32_t number) const;
  // What lies in the blocks from `first` up to, not including, `last`, in order of the text.
  std::span<const SequenceNumber> sequenceNumbersIn(BlockId first, BlockId last) const;
  std::span<const Jump> jumpsIn(BlockId first, BlockId last) const;
  std::span<const Loop> loopsIn(BlockId first, BlockId last) const; // by their DO
  std::span<const LoneEnd> loneEndsIn(BlockId first, BlockId last) const;
  std::span<const OWordUse> oWordsIn(BlockId first, BlockId last) const;
  std::span<const Call> callsIn(BlockId first, BlockId last) const;
  std::span<const VariableUse> variablesIn(BlockId first, BlockId last) const;
  // The same for the blocks of one program, those of the subroutines in its text included.
  std::span<const SequenceNumber> sequenceNumbersOf(ProgramId program) const;
  std::span<const Jump> jumpsOf(ProgramId program) const;
  /// The blocks of the program to which its jumps lead: control may come to them on more than one way.
  std::set<BlockId> jumpTargetsOf(ProgramId program) const;
  std::span<const Loop> loopsOf(ProgramId program) const;
  std::span<const LoneEnd> loneEndsOf(ProgramId program) const;
  std::span<const Call> callsOf(ProgramId program) const;
  std::span<const VariableUse> variablesOf(ProgramId program) const;
  /// All sequence numbers of one value in a program, in order of the text.
  std::vector<SequenceNumber> find(ProgramId program, std::uint32_t number) const;
  /// In byNumber: the first entry that is not before (number, block).
  std::vector<std::uint32_t>::const_iterator firstAtOrBehind(std::uint32_t number, BlockId block) const;
};

/// The sequence number that a jump with a literal target looks for: the control rounds to the nearest.  Absent when it
/// is computed, negative, or beyond 32 bits.
std::optional<std::uint32_t> targetNumber(const Jump &jump);

ProgramModel resolve(const SourceFile &source, const SyntaxTree &tree, const Dialect &dialect);

/// Where a search for `N number` from `from` ends: forward to the end of the program, then from its top.
std::optional<BlockId> findSequence(const ProgramModel &model, ProgramId program, std::uint32_t number, BlockId from);

std::string dump(const ProgramModel &model, const SyntaxTree &tree, const SourceFile &source);

} // namespace feedhold
