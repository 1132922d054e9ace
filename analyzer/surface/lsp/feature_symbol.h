// ProgramSymbol: what the text at a place of a program names.
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
struct HeaderSymbol {
  ProgramId program;
};
/// An N word.
struct LabelSymbol {
  LabelRef label;
};
/// A GOTO, the P of M99 and M97, the Q of M98: the index of the jump in its model.
struct JumpSymbol {
  std::size_t jump;
};
/// The code of a call, or the word that names its program.
struct CallSymbol {
  CallId call;
};
/// A word that a call passes.
struct ArgumentSymbol {
  CallId call;
  Argument argument;
};
struct VariableSymbol {
  VariableUse use;
};
/// WHILE, DO and END: the index of the loop in its model.
struct LoopSymbol {
  std::size_t loop;
};
/// `o100 if`, `o100 endif` ..
struct OWordSymbol {
  OWordId oWord;
};
/// A G or M word that is no call.
struct CodeSymbol {
  WordId word;
};
/// A word with an axis or another address.
struct WordSymbol {
  WordId word;
};
struct ClauseSymbol {
  ClauseId clause;
};

using ProgramSymbol = std::variant<HeaderSymbol, LabelSymbol, JumpSymbol, CallSymbol, ArgumentSymbol, VariableSymbol,
                                   LoopSymbol, OWordSymbol, CodeSymbol, WordSymbol, ClauseSymbol>;
struct SymbolAt {
  Span span;
  BlockId block;
  ProgramSymbol symbol;
};

/// The smallest symbol at an offset of the document; the one that ends there when none goes on.
std::optional<SymbolAt> symbolAt(const Project &programs, std::uint32_t offset);

/// Where a jump with a literal target looks: in its program, in the program that it calls, or in all that call it.
std::vector<LabelRef> labelsOf(const Project &programs, FileId file, const Jump &jump);
/// Absent: computed, or a name without a meaning.
std::optional<VariableRef> variableOf(const Project &programs, FileId file, const VariableUse &use);
VariableRef variableOf(const Project &programs, ProgramRef program, std::uint32_t number);

} // namespace feedhold::lsp
