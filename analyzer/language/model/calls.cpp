// Calls and the arguments they pass.
#include "base/support/text.h"
#include "language/model/block_facts.h"
#include "language/model/internal.h"

#include <algorithm>
#include <array>

namespace feedhold {

namespace {

std::optional<CallKind> kindOf(const Word &word, const Dialect &dialect) {
  const Code *code = codeOf(word, dialect);
  if (!code)
    return std::nullopt;
  switch (code->role) {
  case CodeRole::MacroCall: return CallKind::Macro;
  case CodeRole::ModalCall: return CallKind::Modal;
  case CodeRole::ModalCallEach: return CallKind::ModalEach;
  case CodeRole::ModalCallCancel: return CallKind::ModalCancel;
  case CodeRole::SubprogramCall: return CallKind::Subprogram;
  case CodeRole::LocalCall: return CallKind::Local;
  case CodeRole::ExternalCall: return CallKind::External;
  case CodeRole::Plain:
  case CodeRole::Motion:
  case CodeRole::Arc:
  case CodeRole::CannedCycle:
  case CodeRole::OwnWords:
  case CodeRole::Dwell:
  case CodeRole::DataSetting:
  case CodeRole::DataSettingEnd:
  case CodeRole::MachinePosition:
  case CodeRole::CoordinateShift:
  case CodeRole::ReferenceReturn:
  case CodeRole::Skip:
  case CodeRole::SkipOrAlarm:
  case CodeRole::Contour:
  case CodeRole::Return:
  case CodeRole::ProgramEnd:
  case CodeRole::ProgramStop:
  case CodeRole::JumpOnInput: return std::nullopt;
  }
  return std::nullopt;
}

bool passesArguments(CallKind kind) {
  return kind == CallKind::Macro || kind == CallKind::Modal || kind == CallKind::ModalEach || kind == CallKind::Code;
}

constexpr std::uint32_t kPack = 10'000; // four digits for the program

/// `P9010`, `<NAME>`; packed `P 68003` of M98 (repeats before the last four digits) where programs have four digits, or
/// may have.
void readCallee(const ResolveContext &context, const Word &word, Call &call) {
  call.programWord = context.tree.idOf(word);
  if (word.form() == WordForm::Name) {
    const std::string_view text = context.source.text(word.span());
    call.callee.text = text.substr(1, text.size() - 2);
    return;
  }
  const std::optional<std::uint32_t> number = word.integer();
  if (!number)
    return;
  call.callee.number = number;
  if (call.kind != CallKind::Subprogram || !context.dialect.limits.packsRepeats || *number < kPack)
    return;
  const PackedCall packed{*number % kPack, *number / kPack};
  if (context.dialect.limits.lastProgramNumber >= kPack) {
    call.packed = packed;
    return;
  }
  call.callee.number = packed.program;
  call.repeats = packed.repeats;
}

/// `G65 H01 P#100 Q..`: the operation stands first, and P is the variable for its result; from H80 on P is the target
/// of a jump or the number of an alarm.  `G65 H5. P9100` passes an argument.
bool isMacroA(const SyntaxTree &tree, BlockId block, const Word &code, const Word &program) {
  const Word *operation = findWord(tree, block, 'H');
  if (!operation || tree.idOf(*operation) != tree.idOf(code).next() || operation->has(Word::kPoint))
    return false;
  const std::uint32_t number = operation->integer().value_or(100);
  return number < 100 && (number >= 80 || program.form() == WordForm::Expression);
}

Call readCall(const ResolveContext &context, const ProgramModel &model, BlockId block, const Word &code,
              CallKind kind) {
  const SyntaxTree &tree = context.tree;
  Call call{kind, model.programOf(block), block, tree.idOf(code), std::nullopt, {}, std::nullopt, {}};
  const Word *program = findWord(tree, block, 'P');
  if (!program)
    program = findWord(tree, block, '<');
  if (kind == CallKind::Macro && !program && findWord(tree, block, 'H')) {
    call.kind = CallKind::MacroA;
    return call;
  }
  if (kind == CallKind::Macro && program && isMacroA(tree, block, code, *program))
    call.kind = CallKind::MacroA;
  if (call.kind == CallKind::MacroA)
    return call;
  if (context.dialect.grammar.callStartsAtSequence && kind == CallKind::Subprogram && findWord(tree, block, 'H'))
    call.kind = kind = CallKind::External; // not followed, as a program on another device
  if (program && kind != CallKind::ModalCancel && kind != CallKind::Local)
    readCallee(context, *program, call);
  if (kind == CallKind::Local && program)
    call.programWord = tree.idOf(*program);
  if (const Word *repeats = findWord(tree, block, 'L'); repeats && repeats->integer())
    call.repeats = repeats->integer();
  if (passesArguments(kind))
    call.arguments = assignArguments(context, block, call);
  return call;
}

Call readOWordCall(const ResolveContext &context, const ProgramModel &model, BlockId block, const OWord &oWord,
                   Span span) {
  Call call{CallKind::OWord, model.programOf(block),
            block,           context.tree.blocks[block.next()].firstWord,
            std::nullopt,    {},
            std::nullopt,    {}};
  if (!oWord.computed)
    call.callee = {std::nullopt, labelText(oWord, context.source), true};
  const auto values = context.tree.argumentsOf(oWord);
  call.values.assign(values.begin(), values.end());
  call.span = span;
  return call;
}

} // namespace

void findCalls(const ResolveContext &context, ProgramModel &model) {
  const SyntaxTree &tree = context.tree;
  for (std::size_t i = 0; i < tree.blockCount(); ++i) {
    const BlockId block(i);
    const Block &head = tree.blocks[block];
    if (head.has(Block::kData) || head.has(Block::kLeader) || head.has(Block::kAfterEnd))
      continue;
    for (const Statement &statement : tree.statementsOf(block))
      if (const auto *oWord = std::get_if<OWord>(&statement.node); oWord && oWord->kind == OWordKind::Call)
        model.calls.add(readOWordCall(context, model, block, *oWord, statement.span));
    for (const Word &word : tree.wordsOf(block)) {
      if (!word.isCode() && (word.address() != 'T' || word.has(Word::kArgument)))
        continue;
      if (const std::optional<CallKind> kind = kindOf(word, context.dialect)) {
        model.calls.add(readCall(context, model, block, word, *kind));
        continue;
      }
      const std::optional<std::uint16_t> tenths = word.tenths();
      const CodeCall *codeCall = tenths ? findCodeCall(context.dialect, word.address(), *tenths) : nullptr;
      if (!codeCall)
        continue;
      Call call{CallKind::Code, model.programOf(block),  block,        tree.idOf(word),
                std::nullopt,   {codeCall->program, ""}, std::nullopt, {}};
      if (codeCall->isMacro)
        call.arguments = assignArguments(context, block, call);
      model.calls.add(std::move(call));
    }
  }
}

namespace {

/// Where I, J and K go: sets of three, a new one when a letter comes again or out of order.
class IjkSets {
public:
  /// The variable for the next word of `letter`, and its set, counted from 0.
  std::pair<int, int> place(char letter) {
    const int column = letter - 'I';
    if (column <= lastColumn_)
      ++set_;
    lastColumn_ = column;
    return {4 + 3 * set_ + column, set_};
  }

private:
  int set_ = 0;
  int lastColumn_ = -1;
};

bool isArgumentless(char address) {
  return address == 'N' || address == 'P' || address == 'L' || address == 'O' || address == '<';
}

} // namespace

std::vector<Argument> assignArguments(const ResolveContext &context, BlockId block, const Call &call) {
  const SyntaxTree &tree = context.tree;
  std::vector<Argument> arguments;
  IjkSets sets;
  const bool onlyFirst = context.dialect.switches.ijk == Switch::On;
  const auto words = tree.wordsOf(block);
  for (std::size_t i = 0; i < words.size(); ++i) {
    const Word &word = words[i];
    const WordId id = tree.idOf(word);
    if (id <= call.code || word.has(Word::kComma)) // the words before the call are not its arguments
      continue;
    const char letter = word.address();
    const bool setLetter = letter == 'I' || letter == 'J' || letter == 'K';
    if (setLetter && !onlyFirst) {
      const auto [variable, set] = sets.place(letter);
      const bool fits = set < context.dialect.limits.ijkSets;
      arguments.push_back({id, static_cast<std::uint8_t>(fits ? variable : 0),
                           fits ? ArgumentRole::Passed : ArgumentRole::BeyondSets, set > 0});
      continue;
    }
    const std::uint8_t variable = argumentVariable(context.dialect, letter);
    if (variable != 0)
      arguments.push_back({id, variable, ArgumentRole::Passed, false});
    else if (!isArgumentless(letter) || letter == 'O' || letter == 'N')
      arguments.push_back({id, 0, ArgumentRole::Forbidden, false});
  }
  std::array<bool, 256> setLater{};
  for (auto argument = arguments.rbegin(); argument != arguments.rend(); ++argument) {
    if (argument->variable == 0)
      continue;
    if (setLater[argument->variable])
      argument->role = ArgumentRole::Overridden;
    setLater[argument->variable] = true;
  }
  return arguments;
}

namespace {

Span spanOf(const SyntaxTree &tree, const Call &call) {
  if (call.kind == CallKind::OWord)
    return call.span;
  const Span code = tree.words[call.code].span();
  return call.programWord && *call.programWord > call.code ? cover(code, tree.words[*call.programWord].span()) : code;
}

/// A block in which nothing happens but the end of the program, or nothing at all.
bool onlyEnds(const ResolveContext &context, BlockId block) {
  if (context.tree.blocks[block].has(Block::kPercent) || context.tree.blocks[block].has(Block::kAfterEnd))
    return true;
  const auto words = context.tree.wordsOf(block);
  return context.tree.statementsOf(block).empty() && std::all_of(words.begin(), words.end(), [&](const Word &word) {
           const Code *code = codeOf(word, context.dialect);
           return word.address() == 'N' ||
                  (code && (code->role == CodeRole::ProgramEnd || code->role == CodeRole::Return));
         });
}

/// The last block of the program that does more than end it.
BlockId lastWorkingBlock(const ResolveContext &context, const Program &program) {
  BlockId block(program.last.index() - 1);
  while (block > program.first && onlyEnds(context, block))
    block = BlockId(block.index() - 1);
  return block;
}

} // namespace

void placeCalls(const ResolveContext &context, ProgramModel &model) {
  std::optional<ProgramId> program;
  BlockId last(0);
  for (std::size_t i = 0; i < model.calls.size(); ++i) {
    Call &call = model.calls[CallId(i)];
    if (call.caller != program)
      last = lastWorkingBlock(context, model.programs[call.caller]);
    program = call.caller;
    call.span = spanOf(context.tree, call);
    call.isLast = call.block == last;
  }
}

} // namespace feedhold
