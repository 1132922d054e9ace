#include "surface/lsp/feature_symbol.h"

#include "language/model/block_facts.h"

#include <algorithm>

namespace feedhold::lsp {

namespace {

class Finder {
public:
  Finder(const Project &programs, std::uint32_t offset)
      : file_(programs.file(kDocument)), offset_(offset), block_(file_.tree.blockAt(offset)) {}

  std::optional<SymbolAt> find() {
    if (file_.tree.blockCount() == 0)
      return std::nullopt;
    headers();
    names();
    loops();
    words();
    clauses();
    return best_;
  }

private:
  /// Equal spans: the first one stays.
  void offer(Span span, ProgramSymbol symbol) {
    if (offset_ < span.begin || offset_ > span.end || span.empty())
      return;
    const bool goesOn = offset_ < span.end;
    const bool bestGoesOn = best_ && offset_ < best_->span.end;
    if (!best_ || (goesOn && !bestGoesOn) || (goesOn == bestGoesOn && span.size() < best_->span.size()))
      best_ = SymbolAt{span, block_, std::move(symbol)};
  }
  Span span(WordId word) const { return file_.tree.words[word].span(); }

  void headers() {
    for (std::size_t i = 0; i < file_.model.programs.size(); ++i)
      if (const Program &program = file_.model.programs[ProgramId(i)]; !program.name.empty())
        offer(program.header, HeaderSymbol{ProgramId(i)});
  }
  void names() {
    const ProgramModel &model = file_.model;
    const BlockId next = block_.next();
    for (const SequenceNumber &each : model.sequenceNumbersIn(block_, next))
      offer(span(each.word), LabelSymbol{{{kDocument, model.programOf(block_)}, each.number}});
    for (const VariableUse &each : model.variablesIn(block_, next))
      offer(file_.tree.expressions[each.expression].span, VariableSymbol{each});
    for (const Jump &each : model.jumpsIn(block_, next)) {
      const JumpSymbol symbol{static_cast<std::size_t>(&each - model.jumps.data())};
      offer(each.targetSpan, symbol);
      if (each.kind == JumpKind::Goto)
        offer(each.span, symbol);
    }
    for (const Call &each : model.callsIn(block_, next))
      call(CallId(static_cast<std::size_t>(&each - &*model.calls.begin())), each);
  }
  void call(CallId id, const Call &call) {
    if (call.kind == CallKind::OWord)
      return offer(call.span, CallSymbol{id});
    offer(span(call.code), CallSymbol{id});
    if (call.programWord)
      offer(span(*call.programWord), CallSymbol{id});
    for (const Argument &argument : call.arguments)
      offer(span(argument.word), ArgumentSymbol{id, argument});
  }
  void loops() {
    for (std::size_t i = 0; i < file_.model.loops.size(); ++i) {
      const Loop &loop = file_.model.loops[i];
      if (loop.doBlock == block_)
        offer(file_.tree.statements[loop.doStatement].span, LoopSymbol{i});
      if (loop.endBlock == block_ && loop.endStatement)
        offer(file_.tree.statements[*loop.endStatement].span, LoopSymbol{i});
    }
    for (const OWordUse &each : file_.model.oWordsIn(block_, block_.next()))
      offer(file_.tree.statements[each.statement].span,
            OWordSymbol{OWordId(static_cast<std::size_t>(&each - &*file_.model.oWords.begin()))});
  }
  void words() {
    for (const Word &word : file_.tree.wordsOf(block_))
      if (word.isCode())
        offer(word.span(), CodeSymbol{file_.tree.idOf(word)});
      else
        offer(word.span(), WordSymbol{file_.tree.idOf(word)});
  }
  void clauses() {
    for (std::size_t i = 0; i < file_.contracts.clauses.size(); ++i)
      if (const Clause &clause = file_.contracts.clauses[ClauseId(i)]; clause.source == kProgramText)
        offer(clause.span, ClauseSymbol{ClauseId(i)});
  }

  const ProjectFile &file_;
  std::uint32_t offset_;
  BlockId block_;
  std::optional<SymbolAt> best_;
};

std::vector<LabelRef> returnLabels(const Project &programs, ProgramRef own, std::uint32_t number) {
  std::vector<LabelRef> labels;
  if (!programs.dialect().behaviour.returnTargetIsLocal)
    for (const CallGraph::Caller &caller : programs.set->callGraph().callers(own)) {
      const ProgramModel &model = programs.file(caller.file).model;
      const LabelRef label{{caller.file, model.calls[caller.call].caller}, number};
      if (std::find(labels.begin(), labels.end(), label) == labels.end())
        labels.push_back(label);
    }
  if (labels.empty())
    labels.push_back({own, number});
  return labels;
}

} // namespace

std::optional<SymbolAt> symbolAt(const Project &programs, std::uint32_t offset) {
  return Finder(programs, offset).find();
}

std::vector<LabelRef> labelsOf(const Project &programs, FileId file, const Jump &jump) {
  const std::optional<std::uint32_t> number = targetNumber(jump);
  if (!number)
    return {};
  const ProgramRef own{file, jump.program};
  switch (jump.kind) {
  case JumpKind::Goto:
  case JumpKind::LocalCall:
  case JumpKind::ContourFrom:
  case JumpKind::ContourTo: return {{own, *number}};
  case JumpKind::ReturnTo: return returnLabels(programs, own, *number);
  case JumpKind::CallAt: break;
  }
  for (const Call &call : programs.file(file).model.callsIn(jump.block, jump.block.next()))
    if (const auto callee = programs.set->callGraph().callee(file, call))
      return {{*callee, *number}};
  return {};
}

VariableRef variableOf(const Project &programs, ProgramRef program, std::uint32_t number) {
  const VariableRange *range = number < kFirstNamedVariable ? findVariable(programs.dialect(), number) : nullptr;
  const bool isLocal =
      number < kFirstNamedVariable ? range && range->kind == VariableKind::Local : !programs.set->isGlobalName(number);
  return {number, isLocal ? std::optional(program) : std::nullopt};
}

std::optional<VariableRef> variableOf(const Project &programs, FileId file, const VariableUse &use) {
  const ProjectFile &in = programs.file(file);
  std::optional<std::uint32_t> number = use.number;
  if (const auto *named = std::get_if<NamedVariable>(&in.tree.expressions[use.expression].node))
    number = programs.set->variableOf(file, named->name);
  if (!number)
    return std::nullopt;
  return variableOf(programs, {file, in.model.programOf(use.block)}, *number);
}

} // namespace feedhold::lsp
