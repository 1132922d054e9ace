// Labels of the graph: where jumps arrive.
#include "meaning/cfg/cfg.h"

#include <algorithm>

namespace feedhold {

NodeId arrival(const Cfg &cfg, BlockId label, BlockId from) {
  auto gate = std::lower_bound(cfg.gates.begin(), cfg.gates.end(), label,
                               [](const LoopGate &each, BlockId block) { return each.label < block; });
  for (; gate != cfg.gates.end() && gate->label == label; ++gate)
    if (!gate->holds(from))
      return gate->node;
  return cfg.nodeOf(label);
}

std::vector<LabelNode> labelsOf(const Cfg &cfg, const ProgramModel &model, BlockId from) {
  std::vector<LabelNode> labels;
  for (const SequenceNumber &label : model.sequenceNumbersOf(model.programOf(from)))
    labels.push_back({label.number, arrival(cfg, label.block, from)});
  return labels;
}

std::optional<NodeId> findLabel(const Cfg &cfg, const ProgramModel &model, ProgramId program, std::uint32_t number,
                                BlockId from) {
  const std::optional<BlockId> block = findSequence(model, program, number, from);
  return block ? std::optional(arrival(cfg, *block, from)) : std::nullopt;
}

std::vector<NodeId> returnsWithin(const Cfg &cfg, const ProgramModel &model, NodeId from) {
  const Node &node = cfg.nodes[from];
  const ProgramId program = model.programOf(node.block);
  if (!std::get<ReturnFromProgram>(node.instruction).target)
    return {cfg.entryOf(program)};
  std::vector<NodeId> targets;
  for (const Jump &jump : model.jumpsIn(node.block, node.block.next())) {
    if (jump.kind != JumpKind::ReturnTo)
      continue;
    if (jump.target)
      targets.push_back(arrival(cfg, *jump.target, node.block));
    else if (jump.computed)
      for (const LabelNode &label : labelsOf(cfg, model, node.block))
        targets.push_back(label.node);
  }
  return targets;
}

std::uint64_t computedEdges(const Cfg &cfg, const ProgramModel &model, ProgramId program) {
  const NodeId first = cfg.entryOf(program);
  const NodeId last =
      program.next().index() < cfg.entries.size() ? cfg.entryOf(program.next()) : NodeId(cfg.nodes.size());
  const std::span<const Node> own = cfg.nodes.slice(first, last);
  const auto computed = std::count_if(own.begin(), own.end(), [](const Node &node) {
    const auto *back = std::get_if<ReturnFromProgram>(&node.instruction);
    return (back && back->target) || std::holds_alternative<JumpTo>(node.instruction);
  });
  return static_cast<std::uint64_t>(computed) * model.sequenceNumbersOf(program).size();
}

ReturnTargets returnTargets(std::span<const ProgramModel *const> models) {
  ReturnTargets targets;
  for (const ProgramModel *model : models)
    for (const Jump &jump : model->jumps) {
      if (jump.kind != JumpKind::ReturnTo)
        continue;
      if (const std::optional<std::uint32_t> number = targetNumber(jump))
        targets.numbers.push_back(*number);
      else
        targets.any = true;
    }
  std::sort(targets.numbers.begin(), targets.numbers.end());
  targets.numbers.erase(std::unique(targets.numbers.begin(), targets.numbers.end()), targets.numbers.end());
  return targets;
}

} // namespace feedhold
