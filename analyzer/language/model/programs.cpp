// Programs and sequence numbers.
#include "base/support/text.h"
#include "language/model/block_facts.h"
#include "language/model/internal.h"

#include <algorithm>

namespace feedhold {

std::string toString(const ProgramName &name) {
  if (name.number)
    return "O" + std::to_string(*name.number);
  if (name.isSubroutine)
    return std::all_of(name.text.begin(), name.text.end(), isDigit) ? "o" + name.text : "o<" + name.text + ">";
  return name.text.empty() ? "" : "<" + name.text + ">";
}

const Word *headerOf(const ResolveContext &context, BlockId block) {
  const auto words = context.tree.wordsOf(block);
  if (words.empty())
    return nullptr;
  const Word &first = words.front();
  const auto statements = context.tree.statementsOf(block);
  const bool atHead = statements.empty() || first.span().begin < statements.front().span.begin;
  const bool lone = first.address() == '<' && !context.dialect.grammar.oWords;
  const bool names = (first.address() == 'O' || lone) && !first.has(Word::kComma);
  return atHead && names ? &first : nullptr;
}

namespace {

ProgramName nameFrom(const ResolveContext &context, const Word &word) {
  if (word.form() == WordForm::Name) {
    const std::string_view text = context.source.text(word.span());
    const std::size_t open = text.find('<') + 1;
    return {std::nullopt, std::string(text.substr(open, text.size() - open - 1))};
  }
  return {word.integer(), ""};
}

/// Blocks that the control does not read belong to no program; it begins with the first one that says something.
bool isRead(const Block &block) { return !block.has(Block::kLeader) && !block.has(Block::kAfterEnd); }

/// A comment and text behind its `)`, which is reported: no program begins with it.
bool isBrokenComment(const SyntaxTree &tree, BlockId block) {
  const auto statements = tree.statementsOf(block);
  return tree.wordsOf(block).empty() && !tree.commentsOf(block).empty() &&
         std::all_of(statements.begin(), statements.end(), [](const Statement &statement) {
           return std::holds_alternative<BrokenStatement>(statement.node);
         });
}

} // namespace

namespace {

/// The programs of a file one after another, and the subroutines in their text.
class ProgramFinder {
public:
  ProgramFinder(const ResolveContext &context, ProgramModel &model) : context_(context), model_(model) {}

  void run() {
    const SyntaxTree &tree = context_.tree;
    for (std::size_t i = 0; i < tree.blockCount(); ++i) {
      const BlockId id(i);
      const Block &block = tree.blocks[id];
      if (block.has(Block::kFolder))
        enterFolder(block.span(), id);
      const Word *header = isRead(block) ? headerOf(context_, id) : nullptr;
      const bool hasOWord = next_ < model_.oWords.size() && model_.oWords[OWordId(next_)].block == id;
      const bool says = hasOWord || (!block.has(Block::kPercent) && !isEmpty(tree, id) && !isBrokenComment(tree, id));
      const bool nameless = !outer_ && isRead(block) && says;
      if (header || nameless)
        addProgram(header ? nameFrom(context_, *header) : ProgramName{}, header ? header->span() : block.span(), id);
      if (block.has(Block::kEncrypted) && outer_)
        model_.programs[*outer_].isEncrypted = true;
      while (next_ < model_.oWords.size() && model_.oWords[OWordId(next_)].block == id)
        place(model_.oWords[OWordId(next_++)], id);
    }
    if (model_.programs.empty())
      model_.programs.add({{}, {0, 0}, BlockId(0), BlockId(tree.blockCount())});
  }

private:
  /// `&F=/USER/PATH1/`: what follows up to the next such line lies in this folder.
  void enterFolder(Span line, BlockId block) {
    endPrograms(block);
    outer_.reset();
    folder_ = trimmed(context_.source.text(line).substr(std::string_view("&F=").size()));
  }

  void endPrograms(BlockId last) {
    for (const auto open : {outer_, subroutine_})
      if (open)
        model_.programs[*open].last = last;
    subroutine_.reset();
  }

  void addProgram(ProgramName name, Span header, BlockId first) {
    endPrograms(first);
    outer_ = model_.programs.add({std::move(name), header, first, BlockId(context_.tree.blockCount())});
    model_.programs[*outer_].folder = folder_;
  }

  /// A subroutine without its `endsub` runs to the end of the program around it.
  void place(OWordUse &use, BlockId block) {
    if (use.kind == OWordKind::Sub && use.construct) {
      endSubroutine(block);
      Program program{{std::nullopt, use.label, true},
                      context_.tree.statements[use.statement].span,
                      block,
                      BlockId(context_.tree.blockCount()),
                      true,
                      outer_};
      subroutine_ = model_.programs.add(std::move(program));
    }
    use.program = subroutine_ ? *subroutine_ : *outer_;
    if (use.kind == OWordKind::EndSub)
      endSubroutine(block.next());
  }

  void endSubroutine(BlockId last) {
    if (subroutine_)
      model_.programs[*subroutine_].last = last;
    subroutine_.reset();
  }

  const ResolveContext &context_;
  ProgramModel &model_;
  std::size_t next_ = 0; // in model_.oWords
  std::optional<ProgramId> outer_;
  std::optional<ProgramId> subroutine_;
  std::string folder_; // of the dump
};

} // namespace

void findPrograms(const ResolveContext &context, ProgramModel &model) { ProgramFinder(context, model).run(); }

void findSequenceNumbers(const ResolveContext &context, ProgramModel &model) {
  const SyntaxTree &tree = context.tree;
  for (std::size_t i = 0; i < tree.blockCount(); ++i) {
    const Block &block = tree.blocks[BlockId(i)];
    if (block.has(Block::kData) || block.has(Block::kLeader))
      continue;
    for (const Word &word : tree.wordsOf(BlockId(i))) {
      if (word.address() != 'N' || word.has(Word::kComma))
        continue;
      const std::optional<std::uint32_t> number = word.integer();
      if (number && block.has(Block::kAfterEnd))
        model.numbersBehindEnd.push_back(*number);
      else if (number)
        model.sequenceNumbers.push_back({*number, BlockId(i), tree.idOf(word)});
      break;
    }
  }
  std::sort(model.numbersBehindEnd.begin(), model.numbersBehindEnd.end());
}

bool ProgramModel::isBehindEnd(std::uint32_t number) const {
  return std::binary_search(numbersBehindEnd.begin(), numbersBehindEnd.end(), number);
}

ProgramId ProgramModel::programOf(BlockId block) const {
  const auto behind = std::upper_bound(programs.begin(), programs.end(), block,
                                       [](BlockId at, const Program &program) { return at < program.first; });
  const auto index = static_cast<std::size_t>(behind - programs.begin());
  const ProgramId found(index == 0 ? 0 : index - 1);
  const Program &program = programs[found];
  return program.within && block >= program.last ? *program.within : found;
}

std::vector<std::uint32_t>::const_iterator ProgramModel::firstAtOrBehind(std::uint32_t number, BlockId block) const {
  const auto before = [&](std::uint32_t index, std::pair<std::uint32_t, BlockId> wanted) {
    return std::pair(sequenceNumbers[index].number, sequenceNumbers[index].block) < wanted;
  };
  return std::lower_bound(byNumber.begin(), byNumber.end(), std::pair(number, block), before);
}

std::vector<SequenceNumber> ProgramModel::find(ProgramId program, std::uint32_t number) const {
  std::vector<SequenceNumber> found;
  for (auto at = firstAtOrBehind(number, programs[program].first);
       at != byNumber.end() && sequenceNumbers[*at].number == number &&
       programs[program].contains(sequenceNumbers[*at].block);
       ++at)
    found.push_back(sequenceNumbers[*at]);
  return found;
}

std::optional<BlockId> findSequence(const ProgramModel &model, ProgramId program, std::uint32_t number, BlockId from) {
  for (const BlockId start : {from.next(), model.programs[program].first}) {
    const auto at = model.firstAtOrBehind(number, start);
    if (at == model.byNumber.end())
      continue;
    const SequenceNumber &found = model.sequenceNumbers[*at];
    if (found.number == number && model.programs[program].contains(found.block))
      return found.block;
  }
  return std::nullopt;
}

} // namespace feedhold
