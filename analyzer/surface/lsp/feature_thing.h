// Thing: what stands at a place of a program.
#pragma once

#include "findings/project/project.h"

#include <optional>
#include <variant>
#include <vector>

namespace feedhold::lsp {

/// The document among the files that are loaded with it.
inline constexpr FileId kDocument{0};

/// A sequence number where it is looked for.
struct LabelRef {
  ProgramRef program;
  std::uint32_t number;
  friend bool operator==(const LabelRef &, const LabelRef &) = default;
};
/// A variable by its number in the set.  `scope`: the program whose own it is; absent: all programs share it.
struct VariableRef {
  std::uint32_t number;
  std::optional<ProgramRef> scope;
  friend bool operator==(const VariableRef &, const VariableRef &) = default;
};

/// The O word of a program.
struct HeaderThing {
  ProgramId program;
};
/// An N word.
struct LabelThing {
  LabelRef label;
};
/// A GOTO, the P of M99 and M97, the Q of M98: the index of the jump in its model.
struct JumpThing {
  std::size_t jump;
};
/// The code of a call, or the word that names its program.
struct CallThing {
  CallId call;
};
/// A word that a call passes.
struct ArgumentThing {
  CallId call;
  Argument argument;
};
struct VariableThing {
  VariableUse use;
};
/// WHILE, DO and END: the index of the loop in its model.
struct LoopThing {
  std::size_t loop;
};
/// `o100 if`, `o100 endif` ..
struct OWordThing {
  OWordId oWord;
};
/// A G or M word that is no call.
struct CodeThing {
  WordId word;
};
/// A word with an axis or another address.
struct WordThing {
  WordId word;
};
struct ClauseThing {
  ClauseId clause;
};

using Thing = std::variant<HeaderThing, LabelThing, JumpThing, CallThing, ArgumentThing, VariableThing, LoopThing,
                           OWordThing, CodeThing, WordThing, ClauseThing>;
struct ThingAt {
  Span span;
  BlockId block;
  Thing thing;
};

/// The smallest thing at an offset of the document; the one that ends there when none goes on.
std::optional<ThingAt> thingAt(const Project &programs, std::uint32_t offset);

/// Where a jump with a literal target looks: in its program, in the program that it calls, or in all that call it.
std::vector<LabelRef> labelsOf(const Project &programs, FileId file, const Jump &jump);
/// Absent: computed, or a name without a meaning.
std::optional<VariableRef> variableOf(const Project &programs, FileId file, const VariableUse &use);
VariableRef variableOf(const Project &programs, ProgramRef program, std::uint32_t number);

} // namespace feedhold::lsp
