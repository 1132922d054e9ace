// The nodes of the syntax tree of one file.  Each lives in a store of SyntaxTree and is named by its id.
#pragma once

#include "base/source/span.h"
#include "base/support/decimal.h"
#include "language/dialect/words.h"

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <variant>

namespace feedhold {

using BlockId = Id<struct BlockTag>;
using WordId = Id<struct WordTag>;
using CommentId = Id<struct CommentTag>;
using StatementId = Id<struct StatementTag>;
using ExpressionId = Id<struct ExpressionTag>;

// ---- words -------------------------------------------------------------------------------------------------------

enum class WordForm : std::uint8_t {
  Number,     // X12.5 X-3
  Expression, // X#1 X-[#2+1]
  Name,       // <NAME> after M98, G65; O<name>
  Missing,    // X alone
  Broken,     // X1.2.3: the text says more than a number
};

/// `X12.5`: an address and its value.  24 bytes, since CAM programs are made of them.
class Word {
public:
  enum Flag : std::uint8_t {
    kPoint = 1,      // the number is written with a decimal point
    kComma = 2,      // `,R5.`
    kAfterThen = 4,  // belongs to the action of an IF
    kSigned = 8,     // a sign is written
    kAfterSkip = 16, // stands after a `/` in mid-block
    kArgument = 32,  // sets a variable of the program that the block calls: M of `G65 P1 M30.` is no code
  };

  Word(char address, WordForm form, Span span, std::uint8_t flags)
      : payload_(0), begin_(span.begin), end_(span.end), address_(address), form_(form), scale_(0), flags_(flags) {}
  static Word number(char address, Decimal value, Span span, std::uint8_t flags) {
    Word word(address, WordForm::Number, span, flags);
    word.payload_ = value.mantissa();
    word.scale_ = value.scale();
    return word;
  }
  static Word expression(char address, ExpressionId value, Span span, std::uint8_t flags) {
    Word word(address, WordForm::Expression, span, flags);
    word.payload_ = value.index();
    return word;
  }

  char address() const { return address_; }
  WordForm form() const { return form_; }
  Span span() const { return {begin_, end_}; }
  bool has(Flag flag) const { return (flags_ & flag) != 0; }
  void mark(Flag flag) { flags_ = static_cast<std::uint8_t>(flags_ | flag); }
  /// A G or M word that is executed, or would be if the control had the code.
  bool isCode() const { return (address_ == 'G' || address_ == 'M') && !has(kArgument); }
  bool isNumber() const { return form_ == WordForm::Number; }
  /// Only of a Number.
  Decimal number() const { return Decimal(payload_, scale_); }
  /// Only of an Expression.
  ExpressionId expression() const { return ExpressionId(static_cast<std::size_t>(payload_)); }
  /// Ten times the value, when the word is a number with at most one decimal: how codes are looked up (G54.1 -> 541).
  std::optional<std::uint16_t> tenths() const;
  /// The value of a non-negative integer Number.
  std::optional<std::uint32_t> integer() const;

private:
  std::int64_t payload_;
  std::uint32_t begin_;
  std::uint32_t end_;
  char address_;
  WordForm form_;
  std::uint8_t scale_;
  std::uint8_t flags_;
};
static_assert(sizeof(Word) == 24);

// ---- expressions -------------------------------------------------------------------------------------------------

struct NumberLiteral {
  Decimal value;
};
/// `#101`; the number is a Decimal because some controls have `#30057.21`.
struct NumberedVariable {
  Decimal number;
};
/// `#[#1+1]`, and `##1` as some controls read it; where others do not, it is reported.
struct IndirectVariable {
  ExpressionId index;
};
/// `[#_ALM]`, `[#WIDTH]`, `#<depth>`; `name` is the text without `#` and brackets.
struct NamedVariable {
  Span name;
};
struct Negation {
  ExpressionId operand;
};
/// A written `+` sign.
struct Identity {
  ExpressionId operand;
};
struct Bracketed {
  ExpressionId inner;
};
struct BinaryOperation {
  OperatorKind op;
  ExpressionId left;
  ExpressionId right;
  Span opSpan;
};
/// `SQRT[a]`, `ATAN[a]/[b]`, `POW[a,b]`, `PRM[n,b]/[x]`.
class FunctionCall {
public:
  explicit FunctionCall(FunctionKind function_) : function(function_) {}
  void add(ExpressionId argument) { arguments_[count_++] = argument; }
  std::span<const ExpressionId> arguments() const { return std::span(arguments_).first(count_); }
  bool takesMore() const { return count_ < arguments_.size(); }

  FunctionKind function;
  bool slash = false; // the last argument was written after `/`

private:
  std::uint8_t count_ = 0;
  std::array<ExpressionId, 3> arguments_{ExpressionId(0), ExpressionId(0), ExpressionId(0)};
};
/// What did not parse: anything may happen.
struct BrokenExpression {};

struct Expression {
  Span span;
  std::variant<NumberLiteral, NumberedVariable, IndirectVariable, NamedVariable, Negation, Identity, Bracketed,
               BinaryOperation, FunctionCall, BrokenExpression>
      node;
};

// ---- statements --------------------------------------------------------------------------------------------------

struct Assignment {
  ExpressionId target;
  ExpressionId value;
};
/// `#510-[0-#6]`: an expression where a statement should stand.
struct LoneExpression {
  ExpressionId expression;
};
struct Goto {
  std::optional<ExpressionId> target;
};
enum class IfAction : std::uint8_t {
  Jump,      // IF [..] GOTO n (with or without THEN): `action` is the Goto
  Statement, // IF [..] THEN #1=2: `action` is the statement
  Words,     // IF [..] M99, IF [..] THEN S900: the words with flag kAfterThen
  Lines,     // IF [..] THEN at the end of the block: the following blocks up to ELSE or ENDIF, where the control has it
  Nothing,   // IF [..]
};
struct If {
  std::optional<ExpressionId> condition;
  IfAction action;
  std::optional<StatementId> statement; // of Jump and Statement
  bool hasThen = false;
};
struct Else {};
struct ElseIf {
  std::optional<ExpressionId> condition;
};
struct EndIf {};
/// `WHILE [..] DO1`; `number` absent when DO is missing.
struct While {
  std::optional<ExpressionId> condition;
  std::optional<ExpressionId> number;
};
struct Do {
  std::optional<ExpressionId> number;
};
struct End {
  std::optional<ExpressionId> number;
};
/// `SETVN 500[ABC,DEF]`
struct NameVariables {
  std::optional<ExpressionId> first;
  Span names;
};
/// `[#100 LT 10] M99 P10`: words under a condition, where the control has it.
struct ConditionalWords {
  ExpressionId condition;
};
/// POPEN, PCLOS, DPRNT[..], BPRNT[..]
struct Print {
  ControlWord keyword;
  Span format;                // between the outer brackets; empty for POPEN and PCLOS
  ExpressionId firstVariable; // the variables that the format prints are the expressions from here ..
  ExpressionId lastVariable;  // .. up to, not including, this one that are variables
};
/// `o100 sub`, `o<name> call [1] [2]`, `o100 if [..]`: a statement with a label that pairs it with others.
struct OWord {
  OWordKind kind;
  Span label;                           // `100`, `<name>`, `#1`; labelText() is what is compared
  std::optional<ExpressionId> computed; // of `#1`, `[..]`
  std::uint32_t firstArgument;          // condition, count, arguments, value: SyntaxTree::argumentsOf
  std::uint32_t argumentCount;
};
/// Of a block that is not broken: the tail of a comment.
struct BrokenStatement {};

struct Statement {
  Span span;
  bool nested = false; // the action of an IF; reached through it
  std::variant<Assignment, LoneExpression, Goto, If, Else, ElseIf, EndIf, While, Do, End, NameVariables,
               ConditionalWords, Print, OWord, BrokenStatement>
      node;
};

// ---- comments and blocks -----------------------------------------------------------------------------------------

struct Comment {
  Span span; // parentheses included
  bool closed = true;
};

/// One block: a line up to its end-of-block.  Its words, statements and comments are those from its first ones up to
/// the first ones of the next block (SyntaxTree::wordsOf ..).
struct Block {
  enum Flag : std::uint16_t {
    kSkip = 1,          // `/` or `/n` at its head
    kPercent = 2,       // `%`
    kLeader = 4,        // text before the program: not read by the control
    kAfterEnd = 8,      // text after the closing `%`: not read by the control
    kBroken = 16,       // something in it did not parse
    kSkipInside = 32,   // a `/` in mid-block: what follows may be skipped
    kData = 64,         // a line of G10 L50 / L52 data: N is a parameter number
    kFolder = 128,      // `&F=/USER/`: the next programs of a dump lie in this folder; a leader, too
    kEncrypted = 256,   // a line of an encrypted program; broken, too: it may do anything
    kCommentTail = 512, // text of a comment behind its `)`; what else stands in the block could be read
  };
  std::uint32_t begin;
  std::uint32_t end; // without the end-of-block
  WordId firstWord;
  StatementId firstStatement;
  CommentId firstComment;
  std::uint16_t flags = 0;
  std::uint8_t skipLevel = 0; // of kSkip: 1 for `/`

  Span span() const { return {begin, end}; }
  bool has(Flag flag) const { return (flags & flag) != 0; }
};

} // namespace feedhold
