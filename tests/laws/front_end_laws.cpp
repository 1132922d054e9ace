// What holds of the front end for every text: nothing is lost, blanks and line ends mean nothing, blocks stand alone.
#include "dialects/registry.h"
#include "language/model/model.h"
#include "language/parse/parse.h"
#include "laws/program_generator.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

namespace feedhold::laws {
namespace {

const Dialect &anyDialect() {
  const auto dialects = allDialects().dialects;
  return *dialects[static_cast<std::size_t>(*rc::gen::inRange<int>(0, static_cast<int>(dialects.size())))];
}

/// One in which `;` ends a block, and not a comment that does.
const Dialect &anyDialectWithLineEndSign() {
  const Dialect &dialect = anyDialect();
  return dialect.grammar.semicolonComment ? *allDialects().dialects.front() : dialect;
}

SyntaxTree parsed(const std::string &text, const Dialect &dialect) {
  return parse(SourceFile::fromText("law.nc", text), dialect);
}

void expectNothingLost(const std::string &text, const Dialect &dialect) {
  const SourceFile source = SourceFile::fromText("law.nc", text);
  RC_ASSERT(print(parse(source, dialect), source) == text);
}

/// What the words say, without where they stand.
std::string meaningOf(const SyntaxTree &tree) {
  std::string text;
  for (const Word &word : tree.words) {
    text += word.address();
    text += word.isNumber() ? word.number().toString() : std::to_string(static_cast<int>(word.form()));
    text += ' ';
  }
  text += std::to_string(tree.statements.size()) + ' ' + std::to_string(tree.expressions.size());
  for (const SyntaxIssue &issue : tree.issues)
    text.append(" ").append(nameOf(issue.kind));
  return text;
}

std::size_t blocksWithContent(const SyntaxTree &tree) {
  std::size_t count = 0;
  for (std::size_t index = 0; index < tree.blockCount(); ++index)
    count += tree.blocks[BlockId(index)].span().empty() ? 0 : 1;
  return count;
}

RC_GTEST_PROP(FrontEnd, PrintsBackWhatAControlAccepts, ()) {
  const auto between = *rc::gen::element<std::string>("", " ", "  ", "\t");
  const auto endOfBlock = *rc::gen::element<std::string>("\n", "\r\n", ";\n", "\r\r\n", "\r");
  expectNothingLost(join(*programPieces(), between, endOfBlock), anyDialect());
}

RC_GTEST_PROP(FrontEnd, PrintsBackWhatIsBroken, ()) {
  expectNothingLost(*mutated(join(*programPieces(), "", "\n")), anyDialect());
}

RC_GTEST_PROP(FrontEnd, PrintsBackAnyBytes, (const std::string &bytes)) { expectNothingLost(bytes, anyDialect()); }

RC_GTEST_PROP(FrontEnd, ReadsTheSameWithAndWithoutBlanks, ()) {
  const ProgramPieces program = *programPieces();
  const Dialect &dialect = anyDialect();
  const std::string dense = join(program, "", "\n");
  const std::string wide = join(program, " ", "\n");
  RC_ASSERT(meaningOf(parsed(dense, dialect)) == meaningOf(parsed(wide, dialect)));
}

RC_GTEST_PROP(FrontEnd, ReadsTheSameWithAnyLineEnd, ()) {
  const ProgramPieces program = *programPieces();
  const Dialect &dialect = anyDialectWithLineEndSign();
  const std::string expected = meaningOf(parsed(join(program, "", "\n"), dialect));
  for (const std::string_view endOfBlock : {"\r\n", ";\n", "\r", "\r\r\n", ";"})
    RC_ASSERT(meaningOf(parsed(join(program, "", endOfBlock), dialect)) == expected);
}

RC_GTEST_PROP(FrontEnd, ReadsEachProgramOfAFileAsIfAlone, ()) {
  const Dialect &dialect = anyDialect();
  const std::string first = join(*programPieces(), "", "\n");
  const std::string second = join(*programPieces(), "", "\n");
  const SyntaxTree both = parsed(first + second, dialect);
  const SyntaxTree one = parsed(first, dialect);
  const SyntaxTree two = parsed(second, dialect);
  RC_ASSERT(blocksWithContent(both) == blocksWithContent(one) + blocksWithContent(two));
  RC_ASSERT(both.words.size() == one.words.size() + two.words.size());
  RC_ASSERT(both.issues.size() == one.issues.size() + two.issues.size());
}

RC_GTEST_PROP(FrontEnd, KeepsWordsInOrderAndInsideTheirBlock, ()) {
  const SyntaxTree tree = parsed(*mutated(join(*programPieces(), "", "\n")), anyDialect());
  std::uint32_t at = 0;
  for (std::size_t index = 0; index < tree.blockCount(); ++index) {
    const BlockId block(index);
    RC_ASSERT(tree.blocks[block].begin >= at);
    for (const Word &word : tree.wordsOf(block)) {
      RC_ASSERT(word.span().begin >= at);
      RC_ASSERT(tree.blocks[block].span().contains(word.span()));
      at = word.span().end;
    }
    at = tree.blocks[block].end;
  }
}

RC_GTEST_PROP(Model, PutsEveryBlockIntoAtMostOneProgram, ()) {
  const Dialect &dialect = anyDialect();
  const SourceFile source = SourceFile::fromText("law.nc", *mutated(join(*programPieces(), "", "\n")));
  const SyntaxTree tree = parse(source, dialect);
  const ProgramModel model = resolve(source, tree, dialect);
  BlockId at(0);
  for (const Program &program : model.programs) {
    RC_ASSERT(program.first >= at);
    RC_ASSERT(program.last >= program.first);
    at = program.last;
  }
  RC_ASSERT(at.index() <= tree.blockCount());
}

RC_GTEST_PROP(Model, LetsJumpsEndAtTheirNumber, ()) {
  const Dialect &dialect = anyDialect();
  const SourceFile source = SourceFile::fromText("law.nc", join(*programPieces(), "", "\n"));
  const SyntaxTree tree = parse(source, dialect);
  const ProgramModel model = resolve(source, tree, dialect);
  for (const Jump &jump : model.jumps) {
    if (jump.kind != JumpKind::Goto || !jump.number)
      continue;
    const auto value = jump.number->asInteger();
    const auto labels = model.find(jump.program, static_cast<std::uint32_t>(*value));
    RC_ASSERT(jump.target.has_value() == !labels.empty());
  }
}

// ---- o-words -----------------------------------------------------------------------------------------------------

const Dialect &oWordDialect() { return *findDialect(allDialects(), "linuxcnc"); }

RC_GTEST_PROP(OWords, PrintBack, ()) {
  const std::string text = join(*oWordPieces(), *rc::gen::element<std::string>("", " "), "\n");
  expectNothingLost(text, oWordDialect());
  expectNothingLost(*mutated(text), oWordDialect());
}

RC_GTEST_PROP(OWords, ReadTheSameWithAndWithoutBlanks, ()) {
  const ProgramPieces program = *oWordPieces();
  const std::string dense = meaningOf(parsed(join(program, "", "\n"), oWordDialect()));
  RC_ASSERT(meaningOf(parsed(join(program, " ", "\n"), oWordDialect())) == dense);
}

void expectConstructsInOrder(const ProgramModel &model) {
  for (const Construct &construct : model.constructs) {
    RC_ASSERT(model.oWords[construct.parts.front()].kind == construct.kind);
    for (std::size_t i = 1; i < construct.parts.size(); ++i) {
      RC_ASSERT(construct.parts[i - 1] < construct.parts[i]);
      RC_ASSERT(model.oWords[construct.parts[i]].label == model.oWords[construct.parts[0]].label);
      RC_ASSERT(model.oWords[construct.parts[i]].program == model.oWords[construct.parts[0]].program);
    }
  }
}

RC_GTEST_PROP(OWords, BelongToOneConstructAndOneProgram, ()) {
  const Dialect &dialect = oWordDialect();
  const SourceFile source = SourceFile::fromText("law.ngc", *mutated(join(*oWordPieces(), "", "\n")));
  const SyntaxTree tree = parse(source, dialect);
  const ProgramModel model = resolve(source, tree, dialect);
  expectConstructsInOrder(model);
  for (const OWordUse &use : model.oWords)
    RC_ASSERT(model.programOf(use.block) == use.program);
  for (const Program &program : model.programs)
    if (program.within) {
      RC_ASSERT(model.programs[*program.within].first <= program.first);
      RC_ASSERT(program.last <= model.programs[*program.within].last);
    }
}

} // namespace
} // namespace feedhold::laws
