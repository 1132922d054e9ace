// Which words of a block are executed.
#include "meaning/cfg/block_words.h"

#include "base/support/check.h"
#include "language/model/block_facts.h"

#include <algorithm>

namespace feedhold {

namespace {

bool namesPlace(const Word &word) { return word.address() == 'N' || word.address() == 'O' || word.address() == '<'; }

bool isOfSubprogramCall(char address) { return address == 'P' || address == 'L' || address == 'Q'; }

} // namespace

BlockWords::BlockWords(const SyntaxTree &tree, const ProgramModel &model, const Dialect &dialect, BlockId block)
    : tree_(tree), dialect_(dialect), data_(tree.blocks[block].has(Block::kData)) {
  if (!model.calls.empty())
    calls_ = model.callsIn(block, block.next());
  for (const Word &word : tree.wordsOf(block)) {
    if (word.address() != 'M' || ending_)
      continue;
    const Code *code = codeOf(word, dialect);
    if (!code || (code->role != CodeRole::Return && code->role != CodeRole::ProgramEnd))
      continue;
    ending_ = &word;
    returns_ = code->role == CodeRole::Return;
  }
}

bool BlockWords::isExecuted(const Word &word) const {
  if (data_)
    return true;
  if (!word.has(Word::kComma) && namesPlace(word))
    return false;
  if (ending_ == &word)
    return false;
  if (returns_ && !word.has(Word::kComma) && (word.address() == 'P' || word.address() == 'L'))
    return false;
  return std::none_of(calls_.begin(), calls_.end(), [&](const Call &call) { return isOwnTo(call, word); });
}

bool BlockWords::belongsTo(const Word &word, WordChoice which) const {
  if (!isExecuted(word))
    return false;
  switch (which) {
  case WordChoice::Always: return !word.has(Word::kAfterThen) && !word.has(Word::kAfterSkip);
  case WordChoice::WithSkipped: return !word.has(Word::kAfterThen);
  case WordChoice::UnderCondition: return word.has(Word::kAfterThen);
  }
  FEEDHOLD_UNREACHABLE("the switch names every choice");
}

bool BlockWords::isOwnTo(const Call &call, const Word &word) const {
  const WordId id = tree_.idOf(word);
  if (id == call.code || id == call.programWord)
    return true;
  if (word.has(Word::kComma))
    return false;
  if (takesArguments(call, tree_, dialect_))
    return id > call.code;
  const bool namesProgram =
      call.kind == CallKind::Subprogram || call.kind == CallKind::Local || call.kind == CallKind::External;
  return namesProgram && isOfSubprogramCall(word.address());
}

bool takesArguments(const Call &call, const SyntaxTree &tree, const Dialect &dialect) {
  switch (call.kind) {
  case CallKind::Macro:
  case CallKind::Modal:
  case CallKind::ModalEach:
  case CallKind::MacroA: return true;
  case CallKind::ModalCancel:
  case CallKind::Subprogram:
  case CallKind::Local:
  case CallKind::External:
  case CallKind::OWord: return false;
  case CallKind::Code: {
    const Word &code = tree.words[call.code];
    const CodeCall *row = findCodeCall(dialect, code.address(), code.tenths().value_or(0));
    return row && row->isMacro;
  }
  }
  FEEDHOLD_UNREACHABLE("the switch names every kind");
}

} // namespace feedhold
