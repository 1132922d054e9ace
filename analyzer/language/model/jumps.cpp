// Jumps: GOTO, and the words that name a sequence number.
#include "language/model/block_facts.h"
#include "language/model/internal.h"

namespace feedhold {

namespace {

class JumpFinder {
public:
  JumpFinder(const ResolveContext &context, ProgramModel &model) : context_(context), model_(model) {}

  void run() {
    for (std::size_t i = 0; i < context_.tree.blockCount(); ++i) {
      const BlockId block(i);
      const Block &head = context_.tree.blocks[block];
      if (head.has(Block::kAfterEnd) || head.has(Block::kLeader))
        continue;
      for (const Statement &statement : context_.tree.statementsOf(block))
        if (const auto *jump = std::get_if<Goto>(&statement.node); jump && jump->target)
          addGoto(block, statement, *jump->target);
      for (const Word &word : context_.tree.wordsOf(block))
        if (const Code *code = codeOf(word, context_.dialect))
          readCode(block, word, code->role);
    }
  }

private:
  void addGoto(BlockId block, const Statement &statement, ExpressionId target) {
    Jump jump = start(JumpKind::Goto, block, statement.span, context_.tree.expressions[target].span);
    jump.conditional = jump.conditional || statement.nested;
    jump.number = literalValue(context_.tree, target);
    if (!jump.number)
      jump.computed = target;
    add(jump);
  }

  void readCode(BlockId block, const Word &code, CodeRole role) {
    if (role == CodeRole::Return) {
      model_.programs[model_.programOf(block)].returns = true;
      addWord(JumpKind::ReturnTo, block, code, 'P');
    } else if (role == CodeRole::LocalCall)
      addWord(JumpKind::LocalCall, block, code, 'P');
    else if (role == CodeRole::SubprogramCall && context_.dialect.switches.sqc != Switch::Off)
      addWord(JumpKind::CallAt, block, code, 'Q');
    else if (role == CodeRole::Contour && findWord(context_.tree, block, 'P') && findWord(context_.tree, block, 'Q')) {
      addWord(JumpKind::ContourFrom, block, code, 'P');
      addWord(JumpKind::ContourTo, block, code, 'Q');
    }
  }

  void addWord(JumpKind kind, BlockId block, const Word &code, char address) {
    const Word *word = findWord(context_.tree, block, address);
    if (!word || (word->form() != WordForm::Number && word->form() != WordForm::Expression))
      return;
    Jump jump = start(kind, block, cover(code.span(), word->span()), word->span());
    jump.conditional = jump.conditional || code.has(Word::kAfterThen) || code.has(Word::kAfterSkip);
    if (word->isNumber())
      jump.number = word->number();
    else
      jump.computed = word->expression();
    add(jump);
  }

  Jump start(JumpKind kind, BlockId block, Span span, Span target) const {
    Jump jump{kind, model_.programOf(block), block, span, target, std::nullopt, std::nullopt, std::nullopt};
    jump.conditional = context_.tree.blocks[block].has(Block::kSkip);
    return jump;
  }

  void add(Jump jump) {
    const std::optional<std::uint32_t> number = targetNumber(jump);
    // The target of a CallAt is in another program.
    if (number && jump.kind != JumpKind::CallAt)
      jump.target = findSequence(model_, jump.program, *number, jump.block);
    model_.jumps.push_back(jump);
  }

  const ResolveContext &context_;
  ProgramModel &model_;
};

} // namespace

std::optional<std::uint32_t> targetNumber(const Jump &jump) {
  if (!jump.number || jump.number->isNegative())
    return std::nullopt;
  std::int64_t tenths = jump.number->mantissa();
  std::uint8_t scale = jump.number->scale();
  for (; scale > 1; --scale)
    tenths /= 10;
  const std::int64_t rounded = scale == 0 ? tenths : (tenths + 5) / 10;
  return rounded <= 0xffffffffLL ? std::optional(static_cast<std::uint32_t>(rounded)) : std::nullopt;
}

void findJumps(const ResolveContext &context, ProgramModel &model) { JumpFinder(context, model).run(); }

} // namespace feedhold
