// Parser: recursive descent over the tokens of one file, LLVM in manner.  One file for each part of the grammar:
// parse.cpp (the file and its tape marks), blocks.cpp (blocks and words), statements.cpp, o_word.cpp, expressions.cpp.
//
// Recovery: the first thing in a block that cannot be read is an issue; the rest of the block becomes a
// BrokenStatement without further issues, and reading goes on with the next block.
#pragma once

#include "language/dialect/dialect.h"
#include "language/lex/lexer.h"
#include "language/parse/parse.h"
#include "language/syntax/tree.h"

#include <array>
#include <optional>
#include <utility>

namespace feedhold {

class Parser {
public:
  Parser(std::string_view text, const Dialect &dialect);
  SyntaxTree run();
  /// The text from `begin` to its end as one expression, added to `tree`.
  ExpressionId runExpression(SyntaxTree &tree, std::uint32_t begin, FindReserved reserved);

private:
  /// Brackets, functions and signs inside one another; a control takes five.  Bounds the recursion.
  static constexpr int kDeepestNesting = 100;
  /// Operators in one block: `1+1+..` makes a tree as deep as it is long, and later stages walk it by recursion.
  static constexpr int kMostOperators = 1000;
  /// Words, statements and signs in one block; controls take some hundreds of characters.  Bounds what a rule meets
  /// when it compares the words of a block with one another.
  static constexpr int kMostItems = 2000;
  /// How far recovery looks for a closing sign, so that a line of megabytes is read in linear time.
  static constexpr std::size_t kRecoveryWindow = 512;

  // parse.cpp
  void reserve();
  void readLeader();
  void readRawLine(std::uint32_t begin, int flags);
  void readTapeMark();
  bool atTitle() const;
  bool readDumpLine();
  bool readDirective();
  bool isEncryptedTextClosed(std::uint32_t from) const;
  bool beginsNextProgram() const;

  // blocks.cpp
  void readBlock();
  void openBlock(std::uint32_t begin);
  void closeBlock();
  void readItem();
  void readWord();
  void readWordValue(char address, std::uint32_t begin, std::uint8_t wordFlags);
  void addNumberWord(char address, std::uint32_t begin, std::uint8_t wordFlags, bool negative);
  bool wordGoesOn() const;
  void readUnbracketedRest(char address, std::uint32_t begin, std::uint8_t wordFlags, ExpressionId left);
  void readCommaWord();
  void readBlockSkip();
  void readComment();
  std::optional<std::uint32_t> endOfNesting(Span comment) const;
  void readStrayCloseParenthesis();
  void skipBrokenRest();
  void noteBlockCodes();
  void markArguments();

  // statements.cpp
  void readStatement();
  void addTopStatement(StatementId statement);
  StatementId variableStatement();
  ExpressionId assignedValue(std::uint32_t begin);
  StatementId controlStatement();
  StatementId ifStatement();
  std::optional<StatementId> ifAction(If &statement, const Token &keyword);
  StatementId whileStatement();
  StatementId loopStatement();
  StatementId gotoStatement();
  StatementId nameVariablesStatement();
  StatementId printStatement();
  StatementId keywordOnly(decltype(Statement::node) node);
  std::optional<ExpressionId> condition(const Token &keyword, SyntaxIssueKind whenMissing);
  std::optional<ExpressionId> loopNumber();
  void readPrintedVariables(Span format);
  StatementId addStatement(std::uint32_t begin, decltype(Statement::node) node);

  // o_word.cpp
  bool atOWord() const;
  StatementId oWordStatement();
  void readOWordArguments(OWord &oWord, const Token &keyword);

  // expressions.cpp
  ExpressionId expression();
  ExpressionId binary(int lowestPrecedence);
  ExpressionId binaryRest(ExpressionId left, int lowestPrecedence);
  bool slashCanDivide() const;
  bool atWithin(OperatorKind relation) const;
  ExpressionId within(const BinaryOperation &relation);
  std::optional<OperatorKind> peekOperator() const;
  OperatorKind takeOperator(OperatorKind op);
  OperatorKind takeSymbolicComparison();
  ExpressionId operand();
  ExpressionId operandInside();
  ExpressionId unknownOperand();
  ExpressionId number();
  ExpressionId variable();
  ExpressionId bracketed();
  ExpressionId namedVariable(std::uint32_t begin, std::uint32_t nameBegin);
  bool expressionInParentheses();
  bool startsName(std::uint32_t offset) const;
  ExpressionId functionCall();
  ExpressionId brokenOperand();
  ExpressionId expressionTooDeep();
  void closeBracket(const Token &open);
  bool startsOperand(const Token &token) const;
  ExpressionId addExpression(std::uint32_t begin, decltype(Expression::node) node);
  Span spanOf(ExpressionId id) const { return tree_.expressions[id].span; }

  // tokens and issues
  void advance();
  void advanceToValue();
  void takeCommentsAsBlanks();
  bool at(TokenKind kind) const { return token_.kind == kind; }
  bool at(ControlWord word) const { return token_.kind == TokenKind::ControlWord && token_.controlWord() == word; }
  bool atEnd() const { return at(TokenKind::EndOfBlock) || at(TokenKind::EndOfFile); }
  Token peek() const;
  void moveTo(std::uint32_t offset);
  Span since(std::uint32_t begin) const { return {begin, lastEnd_}; }
  /// Reports unless the block is broken already; `Broken::Yes` gives up the rest of the block.
  enum class Broken { No, Yes };
  void issue(SyntaxIssueKind kind, Span span, Span other, Broken broken);
  void takeStrayCloseBrackets(Broken broken);
  std::optional<Decimal> numberHere();

  std::string_view text_;
  const Dialect &dialect_;
  const Grammar &grammar_;
  Lexer lexer_;
  SyntaxTree tree_;
  Token token_;
  std::uint32_t lastEnd_ = 0; // end of the token before token_
  std::array<std::uint8_t, 16> precedence_{};

  Block block_{0, 0, WordId(0), StatementId(0), CommentId(0)};
  bool broken_ = false;        // the rest of this block is not read
  bool quiet_ = false;         // text that the control does not read: no issues
  std::uint8_t wordFlags_ = 0; // kAfterThen, kAfterSkip of the words that come
  bool headOfBlock_ = true;    // only block skips and N have been read
  std::optional<Span> statementInBlock_;
  std::optional<Span> lowerCase_;
  bool commentsAreBlanks_ = false; // inside a macro statement, and between an address and its value
  bool dataBlocks_ = false;        // between G10 L50/L52 and G11
  bool symbolicAllowed_ = false;   // inside brackets or a condition: `=` can only mean a comparison
  FindReserved reserved_ = nullptr;
  bool inContract_ = false; // expressions beside the program: `EQ .. WITHIN`
  int depth_ = 0;
  int operatorsInBlock_ = 0;
  int itemsInBlock_ = 0;
  enum class Tape { Unmarked, Open, Closed } tape_ = Tape::Unmarked;
  bool isEncryptedTextOpen_ = false;
  bool contentSinceMark_ = false; // before the first `%`, a title is none
};

} // namespace feedhold
