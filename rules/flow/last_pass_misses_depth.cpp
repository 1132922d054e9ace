// last-pass-misses-depth: `WHILE[#1LT10]DO1`, `G01Z-#1`, `#1=#1+3`: the last pass cuts at 9.
#include "rules/flow/loop_count.h"
#include "rules/motion/motion_view.h"

#include <algorithm>
#include <fmt/format.h>

namespace feedhold::rules::last_pass_misses_depth {
namespace {

/// A `Z` of the loop whose whole value is the counter, with either sign.
struct DepthWord {
  NodeId node;
  const Word *word;
  bool isNegated;
};

class Loop {
public:
  Loop(const FlowFacts &facts, const FileContext &context, const LoopFlow &flow)
      : facts_(facts), context_(context), view_(facts.program, context), flow_(flow) {}

  /// Absent where another Z of the loop may cut the rest.
  std::optional<DepthWord> depthWord(std::uint32_t counter) const {
    std::optional<DepthWord> found;
    for (const NodeId node : flow_.nodes)
      for (const Word *word : view_.modalMotionWords(node)) {
        if (word->address() != 'Z')
          continue;
        if (isHelix(node))
          return std::nullopt;
        const auto terms =
            word->form() == WordForm::Expression ? termsOf(context_.tree, word->expression()) : std::vector<SumTerm>{};
        if (terms.size() == 1 && variableOf(facts_, terms.front().value) == counter && !found)
          found = DepthWord{node, word, terms.front().isMinus};
        else if (!isRetract(*word))
          return std::nullopt;
      }
    return found;
  }

  /// On the way from the head to the word, the counter has made its step.
  bool isAfter(NodeId step, NodeId word) const {
    return !findPath(facts_, flow_.head, word, [&](NodeId node) { return node == step; });
  }

  /// Behind the loop, or before it, some Z has the value of the limit: a pass of its own.
  bool hasPassOfItsOwn(ExpressionId limit) const {
    const auto reads = readsIn(facts_.file, limit, facts_.node(flow_.head).block);
    const auto number = literalValue(context_.tree, limit);
    for (NodeId node = facts_.entry(); node < facts_.end(); node = node.next()) {
      for (const Word *word : view_.axisWords(node)) {
        if (word->address() != 'Z')
          continue;
        if (number && word->isNumber() && (word->number() == *number || word->number() == number->negated()))
          return true;
        if (word->form() == WordForm::Expression)
          for (const Read &read : readsIn(facts_.file, word->expression(), facts_.node(node).block))
            if (std::ranges::find(reads, read.number, &Read::number) != reads.end())
              return true;
      }
      if (!facts_.file.model->callsIn(facts_.node(node).block, facts_.node(node).block.next()).empty())
        return true; // may cut anything
    }
    return false;
  }

private:
  /// Of a thread, whose step is its pitch.
  bool isHelix(NodeId node) const {
    return view_.findAction(node, {CodeAction::ArcClockwise, CodeAction::ArcCounterclockwise}) ||
           view_.mayHave(node, 'I') || view_.mayHave(node, 'J') || view_.mayHave(node, 'R');
  }
  /// To a level that is no depth.
  static bool isRetract(const Word &word) { return word.isNumber() && !word.number().isNegative(); }

  const FlowFacts &facts_;
  const FileContext &context_;
  MotionView view_;
  const LoopFlow &flow_;
};

struct LastPass {
  RoundedNumber depth;
  RoundedNumber limit;
};

/// What the counter holds at the word in the last pass; absent where it meets the limit.
std::optional<LastPass> lastPass(const Formulas &formulas, const LoopEnd &end, const FormulaSetting &given,
                                 bool afterStep) {
  const auto iterations = countIterations(formulas, end, given, 1000);
  const auto limit = formulas.value(end.countsOnLeft ? end.right : end.left, given);
  if (!iterations || iterations->exact < 2 || !limit || iterations->exact != iterations->computed)
    return std::nullopt;
  const FormulaInput::Counter &counter = *formulas.input(end.counter).counter;
  auto depth = formulas.value(counter.start, given);
  const std::int64_t steps = iterations->exact - (afterStep ? 0 : 1);
  for (std::int64_t i = 0; depth && i < steps; ++i)
    depth = formulas.stepped(counter, *depth, given);
  return depth && depth->exact != limit->exact ? std::optional(LastPass{*depth, *limit}) : std::nullopt;
}

/// One side of the comparison is the counter itself, before its step or behind it.
bool comparesCounter(const Formulas &formulas, const LoopEnd &end) {
  const ExpressionId counted = end.countsOnLeft ? end.relation->left : end.relation->right;
  return variableOf(formulas.facts(), counted) == formulas.input(end.counter).variable;
}

/// From the test, the loop goes back to its head at once.
bool leadsOnlyTo(const FlowFacts &facts, const LoopFlow &loop, NodeId test) {
  bool isBack = true;
  forEachSuccessor(facts.file.cfg, *facts.file.model, test, ProgramUse::Called, [&](NodeId next) {
    isBack = isBack && (next == loop.head || !std::ranges::binary_search(loop.nodes, next));
  });
  return isBack;
}

/// The test stands at the head, or at the end of each pass: `IF[#1LE#2]GOTO20`.
bool isTestedOncePerPass(const FlowFacts &facts, const LoopFlow &loop) {
  const NodeId test = loop.exits.front().test;
  return test == loop.head || (passesAlways(facts, loop, test) && leadsOnlyTo(facts, loop, test));
}

void checkLoop(const FlowFacts &facts, const LoopFlow &flow, const FileContext &context, const Reporter &reporter) {
  Formulas formulas(facts);
  const auto end = endOf(formulas, flow, flow.exits.front());
  if (!end || isEquality(*end) || !comparesCounter(formulas, *end))
    return;
  const Loop loop(facts, context, flow);
  const FormulaInput counter = formulas.input(end->counter); // a copy: the guards add inputs
  const ExpressionId limit = end->countsOnLeft ? end->relation->right : end->relation->left;
  const auto word = loop.depthWord(counter.variable);
  if (!word || !passesAlways(facts, flow, word->node) || loop.hasPassOfItsOwn(limit))
    return;
  const bool afterStep = loop.isAfter(counter.counter->step, word->node);
  const auto guards = formulas.guardsOf(flow.head);
  std::optional<LastPass> last;
  const auto setting = findSetting(formulas, end->inputs, [&](FormulaSetting &tried) {
    last = formulas.pass(guards, tried) ? lastPass(formulas, *end, tried, afterStep) : std::nullopt;
    return last.has_value();
  });
  if (!setting)
    return;
  const std::string given = describeSetting(formulas, end->inputs, *setting);
  const std::string variable = facts.programs.nameOfVariable(counter.variable);
  reporter.report(
      {.message = fmt::format("{}{}the last pass has `{}` = {}, not {}", given, given.empty() ? "" : ", ", variable,
                              exactText(last->depth.exact), exactText(last->limit.exact)),
       .span = word->word->span(),
       .labels = {{context.tree.expressions[flow.exits.front().condition].span, "ends the loop"}},
       .notes = {"the loop does not end with a pass at its limit: the last depth is not cut, or the tool cuts deeper",
                 "set the counter to the limit when a step would pass it, and go on until that pass is done"}},
      given.empty() ? Severity::Warning : Severity::Info);
}

void check(const FlowFacts &facts, const FileContext &context, const Reporter &reporter) {
  if (isTooLarge(facts) || context.dialect.machine != MachineKind::Milling)
    return;
  for (const LoopFlow &loop : loopsOf(facts))
    if (loop.exitsAreKnown && loop.exits.size() == 1 && isTestedOncePerPass(facts, loop) && !loop.changesUnseen)
      checkLoop(facts, loop, context, reporter);
}

} // namespace

extern const Rule lastPassMissesDepth;
const Rule lastPassMissesDepth{.info = {"last-pass-misses-depth", Category::Flow, Severity::Warning,
                                        "Reports a loop over depths whose last pass is not at the depth that ends it."},
                               .hooks = {.flow = check}};

} // namespace feedhold::rules::last_pass_misses_depth
