// Lowering of files and programs.
#include "meaning/cfg/lowering.h"

#include <algorithm>

namespace feedhold {

namespace {

/// The blocks of a program that the control reads: up to the closing `%` of the tape.
BlockId endOfRead(const SyntaxTree &tree, const Program &program) {
  BlockId block = program.first;
  while (block < program.last && !tree.blocks[block].has(Block::kAfterEnd))
    block = block.next();
  return block;
}

constexpr std::string_view kDefinesInside = "a subroutine that is defined within a branch, a loop or another one";

/// LinuxCNC stops at such a definition that it comes to twice, and at a call of one that it has not come to.
bool definesInside(const ProgramModel &model) {
  OWordId end(0);
  bool isOpen = false;
  for (const Construct &construct : model.constructs) { // by place of their heads
    const OWordId head = construct.parts.front();
    if (construct.kind == OWordKind::Sub) {
      if (isOpen || head < end)
        return true;
      isOpen = !construct.closed;
    }
    end = std::max(end, construct.parts.back());
  }
  return false;
}

} // namespace

Cfg Lowering::run() {
  definesInside_ = definesInside(model_);
  const std::size_t blocks = tree_.blocks.size();
  cfg_.nodes.reserve(blocks + blocks / 8 + 2 * model_.programs.size());
  cfg_.blockNode.assign(blocks, NodeId(0));
  cfg_.entries.reserve(model_.programs.size());
  loopNodes_.resize(model_.loops.size());
  constructNodes_.resize(model_.constructs.size());
  for (std::size_t i = 0; i < model_.programs.size(); ++i)
    program(ProgramId(i));
  return std::move(cfg_);
}

void Lowering::program(ProgramId id) {
  const Program &program = model_.programs[id];
  const std::vector<LoopEntrance> entrances = loopEntrances(model_, id, dialect_, returns_);
  for (const LoopEntrance &entrance : entrances)
    loopNodes_[entrance.loop].isEntered = true;
  sortEnds(id);
  nextCall_ = model_.callsIn(BlockId(0), program.first).size();
  nextJump_ = model_.jumpsIn(BlockId(0), program.first).size();
  block_ = program.first;
  cfg_.entries.push_back(emit(Pass{}));
  if (definesInside_)
    emit(Havoc{kDefinesInside});
  ProgramId inside = id.next();
  BlockId at = program.first;
  const BlockId endOfText = endOfRead(tree_, program);
  while (at < endOfText) {
    // A subroutine in the text is passed over: its blocks are those of its own program.
    if (inside.index() < model_.programs.size() && model_.programs[inside].first == at) {
      passDefinition(model_.programs[inside]);
      at = model_.programs[inside].last;
      inside = firstFrom(at, inside);
      continue;
    }
    block(at);
    at = at.next();
  }
  if (endOfText > program.first)
    block_ = BlockId(endOfText.index() - 1);
  closeOpenIfs();
  const NodeId last = emitLast(EndProgram{ProgramEnd::EndOfFile});
  for (; at < program.last; at = at.next())
    cfg_.blockNode[at.index()] = last;
  closeOpenConstructs(id);
  addGates(entrances);
  mendJumps(id, last);
}

/// The first program that does not begin before the block; programs are in order of the text.
ProgramId Lowering::firstFrom(BlockId block, ProgramId program) const {
  while (program.index() < model_.programs.size() && model_.programs[program].first < block)
    program = program.next();
  return program;
}

void Lowering::passDefinition(const Program &definition) {
  for (const OWordUse &use : model_.oWordsIn(definition.first, definition.last))
    if (use.kind == OWordKind::Return || use.kind == OWordKind::EndSub)
      emit(PassedReturn{valueOf(use.statement)});
}

void Lowering::addGates(const std::vector<LoopEntrance> &entrances) {
  for (std::size_t i = 0; i < entrances.size(); ++i) {
    const Loop &loop = model_.loops[entrances[i].loop];
    block_ = entrances[i].label;
    const NodeId gate = emit(JumpIntoLoop{static_cast<std::uint8_t>(*loop.number)});
    if (i + 1 == entrances.size() || entrances[i + 1].label != block_)
      setNext(gate, cfg_.nodeOf(block_));
    cfg_.gates.push_back({block_, gate, loop.doBlock, *loop.endBlock});
  }
}

void Lowering::mendJumps(ProgramId id, NodeId last) {
  for (const OpenJump &jump : openJumps_) {
    block_ = cfg_.nodes[jump.node].block;
    const NodeId target = jump.target < model_.programs[id].last ? arrival(cfg_, jump.target, block_) : last;
    if (jump.edge == Edge::Taken) {
      std::get<Test>(cfg_.nodes[jump.node].instruction).taken = target;
      continue;
    }
    setNext(jump.node, target);
    if (target == jump.node) { // `N10 GOTO 10`: a node that leads to itself would be an end
      setNext(jump.node, end());
      setNext(emit(Pass{}), jump.node);
    }
  }
  openJumps_.clear();
}

Cfg lower(const SourceFile &source, const SyntaxTree &tree, const ProgramModel &model, const Dialect &dialect,
          const ReturnTargets &returns) {
  return Lowering(source, tree, model, dialect, returns).run();
}

Cfg lower(const SourceFile &source, const SyntaxTree &tree, const ProgramModel &model, const Dialect &dialect) {
  const ProgramModel *const models[] = {&model};
  return lower(source, tree, model, dialect, returnTargets(models));
}

} // namespace feedhold
