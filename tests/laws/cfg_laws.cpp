// What holds of every control-flow graph, and of every weak topological order.
#include "dialects/registry.h"
#include "language/parse/parse.h"
#include "laws/program_generator.h"
#include "meaning/cfg/wto.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>

namespace feedhold::laws {
namespace {

/// Nodes with two successors each, which is as good as any number of them.
Cfg randomGraph(std::size_t size) {
  const auto anyNode = rc::gen::inRange<std::size_t>(0, size);
  Cfg cfg;
  for (std::size_t i = 0; i < size; ++i) {
    const bool ends = *rc::gen::inRange(0, 10) == 0;
    const Instruction instruction =
        ends ? Instruction(EndProgram{ProgramEnd::M30}) : Instruction(Test{std::nullopt, NodeId(*anyNode)});
    const bool goesOn = *rc::gen::inRange(0, 2) == 0;
    const std::size_t next = goesOn ? std::min(i + 1, size - 1) : *anyNode;
    cfg.nodes.add({BlockId(0), NodeId(ends ? i : next), instruction});
  }
  cfg.entries = {NodeId(0)};
  return cfg;
}

struct Graph {
  Cfg cfg;
  ProgramModel model;
  std::vector<NodeId> successors(NodeId node) const {
    std::vector<NodeId> found;
    forEachSuccessor(cfg, model, node, ProgramUse::Called, [&](NodeId to) { found.push_back(to); });
    return found;
  }
  /// In order of discovery; only nodes from which `inside` does not turn the search away.
  template <typename Inside> std::vector<NodeId> reached(NodeId from, Inside inside) const {
    std::vector<bool> seen(cfg.nodes.size(), false);
    std::vector<NodeId> found{from};
    seen[from.index()] = true;
    for (std::size_t i = 0; i < found.size(); ++i)
      for (const NodeId to : successors(found[i]))
        if (inside(to) && !seen[to.index()]) {
          seen[to.index()] = true;
          found.push_back(to);
        }
    return found;
  }
};

Graph anyGraph() {
  Graph graph{randomGraph(*rc::gen::inRange<std::size_t>(1, 40)), {}};
  graph.model.programs.add({{}, {0, 0}, BlockId(0), BlockId(1)});
  return graph;
}

bool inComponent(const Wto &wto, NodeId head, NodeId node) {
  return wto.isHead(head) && wto.positionOf(head) <= wto.positionOf(node) && wto.positionOf(node) < wto.endOf(head);
}

RC_GTEST_PROP(WtoLaws, OrdersWhatCanBeReached, ()) {
  const Graph graph = anyGraph();
  const Wto wto(graph.cfg, graph.model, NodeId(0));
  std::vector<NodeId> reached = graph.reached(NodeId(0), [](NodeId) { return true; });
  std::vector<NodeId> ordered = wto.order();
  for (std::size_t i = 0; i < ordered.size(); ++i)
    RC_ASSERT(wto.positionOf(ordered[i]) == i);
  std::sort(reached.begin(), reached.end());
  std::sort(ordered.begin(), ordered.end());
  RC_ASSERT(reached == ordered);
}

RC_GTEST_PROP(WtoLaws, LeadsBackOnlyToHeadsAround, ()) {
  const Graph graph = anyGraph();
  const Wto wto(graph.cfg, graph.model, NodeId(0));
  for (const NodeId from : wto.order())
    for (const NodeId to : graph.successors(from))
      RC_ASSERT(wto.positionOf(from) < wto.positionOf(to) || inComponent(wto, to, from));
}

RC_GTEST_PROP(WtoLaws, NestsComponents, ()) {
  const Graph graph = anyGraph();
  const Wto wto(graph.cfg, graph.model, NodeId(0));
  for (const NodeId node : wto.order()) {
    std::vector<NodeId> around;
    for (const NodeId head : wto.order())
      if (inComponent(wto, head, node)) {
        RC_ASSERT(wto.endOf(node) <= wto.endOf(head));
        around.push_back(head);
      }
    RC_ASSERT(wto.depthOf(node) == around.size());
    RC_ASSERT(wto.headOf(node) == (around.empty() ? node : around.back()));
    if (wto.isHead(node))
      around.pop_back();
    RC_ASSERT(wto.headAround(node) == (around.empty() ? std::nullopt : std::optional(around.back())));
  }
}

RC_GTEST_PROP(WtoLaws, HasComponentsInWhichAllReachesAll, ()) {
  const Graph graph = anyGraph();
  const Wto wto(graph.cfg, graph.model, NodeId(0));
  for (const NodeId head : wto.order()) {
    if (!wto.isHead(head))
      continue;
    const auto inside = [&](NodeId node) { return inComponent(wto, head, node); };
    const std::size_t size = wto.endOf(head) - wto.positionOf(head);
    for (std::uint32_t at = wto.positionOf(head); at < wto.endOf(head); ++at)
      RC_ASSERT(graph.reached(wto.order()[at], inside).size() == size);
  }
}

bool endsHere(const Instruction &instruction) {
  return std::holds_alternative<EndProgram>(instruction) || std::holds_alternative<ReturnFromProgram>(instruction) ||
         std::holds_alternative<StopWithAlarm>(instruction) || std::holds_alternative<JumpTo>(instruction);
}

RC_GTEST_PROP(CfgLaws, KeepsEdgesInsideTheProgram, ()) {
  const auto dialects = allDialects().dialects;
  const Dialect &dialect = *dialects[*rc::gen::inRange<std::size_t>(0, dialects.size())];
  const SourceFile source = SourceFile::fromText("law.nc", *mutated(join(*programPieces(), "", "\n")));
  const SyntaxTree tree = parse(source, dialect);
  const ProgramModel model = resolve(source, tree, dialect);
  const Cfg cfg = lower(source, tree, model, dialect);
  RC_ASSERT(cfg.blockNode.size() == tree.blocks.size());
  RC_ASSERT(cfg.entries.size() == model.programs.size());
  for (std::size_t i = 0; i < cfg.entries.size(); ++i) {
    const std::size_t end = i + 1 < cfg.entries.size() ? cfg.entries[i + 1].index() : cfg.nodes.size();
    for (std::size_t at = cfg.entries[i].index(); at < end; ++at) {
      const NodeId node(at);
      RC_ASSERT(endsHere(cfg.nodes[node].instruction) == (cfg.nodes[node].next == node));
      forEachSuccessor(cfg, model, node, ProgramUse::Started,
                       [&](NodeId to) { RC_ASSERT(to >= cfg.entries[i] && to.index() < end); });
    }
  }
}

} // namespace
} // namespace feedhold::laws
