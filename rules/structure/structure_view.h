// How rules look at the flow of one program by its text alone: dead blocks, jumps, loops, IF structures.
#pragma once

#include "findings/rule/dead_blocks.h"

#include <optional>
#include <span>
#include <string_view>
#include <vector>

namespace feedhold::rules {

/// The program has an O word or a `<NAME>`; without it the text may be a fragment of one.
bool isNamed(const Program &program);

/// `o100 sub` that no `o100 endsub` closes, and no `o100 return` leaves in a file of this name.
bool isSubWithoutEnd(const Construct &construct, const FileContext &context);

/// An o-word, a WHILE, DO or END of the program does not parse or finds no partner: what its blocks do is not what was
/// meant, and that is reported where it is wrong.
bool isStructureBroken(const FileContext &context, ProgramId program);

/// The last block with content of a program, when control can reach it and go on behind it.
std::optional<BlockId> openEnd(const FileContext &context, ProgramId program);

/// The text of a block, its comments apart, has one of the letters with a digit behind it: of a block that could not be
/// read, whether it may have been meant to hold such a code.
bool mayHoldCode(const FileContext &context, BlockId block, std::string_view letters);

/// The block is in the body of the loop, its END included; false for a loop without END.
bool isInside(const Loop &loop, BlockId block);

/// Which loops of a program a block is in, without looking at all of them.
class LoopNest {
public:
  explicit LoopNest(std::span<const Loop> loops);
  /// The loops whose body holds the block, the innermost first.
  std::vector<const Loop *> around(BlockId block) const;

private:
  static constexpr std::size_t kNone = static_cast<std::size_t>(-1);
  std::span<const Loop> loops_;
  std::vector<std::size_t> outer_; // for each loop the last one around its DO
};

/// Blocks between an `o100 if` and its `endif`, of one file.
class BranchBlocks {
public:
  explicit BranchBlocks(const ProgramModel &model);
  bool contains(BlockId block) const;

private:
  /// The head of each branch, and the farthest end of it and those before it.
  std::vector<std::pair<BlockId, BlockId>> reach_;
};

/// `GO1 X20.`: the letter O in a motion code, which the control reads as `GOTO 1`.
bool isMotionCodeWithLetter(const FileContext &context, BlockId block, Span jump);

/// A DO that follows a WHILE.
bool hasCondition(const FileContext &context, const Loop &loop);

/// The `ENDWHILE` of which the keyword at the span is a part: one word of other languages, and no END and WHILE.
std::optional<Span> endWhileAt(const FileContext &context, Span keyword);

/// `IF [..] THEN` at the end of a block, and the ELSE, ELSEIF and ENDIF that belong to it.
struct IfLines {
  StatementId head;
  std::vector<StatementId> parts; // in order of the text
  bool closed = false;            // the last part is an ENDIF
};
struct IfStructures {
  std::vector<IfLines> structures;
  std::vector<StatementId> strays; // ELSE, ELSEIF, ENDIF without an IF
};
IfStructures ifStructures(const FileContext &context, ProgramId program);

/// The blocks that P and Q of a contour cycle name, Q not before P.
struct Contour {
  const Jump *cycle; // its P
  BlockId first;
  BlockId last;
  bool contains(BlockId block) const { return first <= block && block <= last; }
  /// It is machined where it stands behind the cycle, and not gone through again as plain blocks.
  bool standsBehindCycle() const { return first > cycle->block; }
};
std::vector<Contour> contoursOf(ProgramId program, const FileContext &context);

/// The sequence numbers of a program sorted by value, those of one value in order of the text.
std::vector<SequenceNumber> sortedSequenceNumbers(const ProgramModel &model, ProgramId program);

} // namespace feedhold::rules
