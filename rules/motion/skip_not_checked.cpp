// skip-not-checked: `#100=#5061` behind G31, and nothing asks whether the probe has touched anything.
#include "rules/flow/system_variables.h"
#include "rules/motion/motion_view.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>

namespace feedhold::rules::skip_not_checked {
namespace {

/// What holds before a node on some path on which no condition has looked at the result of a skip move yet.
struct Unchecked {
  bool skipPosition = false; // #5061..: of such a move
  bool position = false;     // the axes are where it has ended
  std::uint32_t fresh = ~0U; // the axes whose touches no condition has followed, as bits
  std::uint32_t touched = 0;
  std::set<std::uint32_t> variables; // that were computed from where it has ended
  bool isReached = false;

  bool join(const Unchecked &other) {
    const Unchecked old = *this;
    skipPosition |= other.skipPosition;
    position |= other.position;
    fresh = isReached ? fresh | other.fresh : other.fresh;
    touched |= other.touched;
    variables.insert(other.variables.begin(), other.variables.end());
    isReached = true;
    return !old.isReached || old.skipPosition != skipPosition || old.position != position || old.fresh != fresh ||
           old.touched != touched || old.variables.size() != variables.size();
  }
};

struct Use {
  NodeId node;
  Span span;
  bool isOffset;
};

class Skips {
public:
  Skips(const FlowFacts &facts, const FileContext &context)
      : facts_(facts), context_(context), view_(facts.program, context) {
    findSkips();
    if (skips_.empty())
      return;
    findMeasured();
    propagate();
    for (NodeId node = facts.entry(); node < facts.end(); node = node.next())
      if (stateOf(node).isReached)
        findUses(node);
  }
  const std::vector<Use> &uses() const { return uses_; }
  /// The last one in the text before the place: none of them is far.
  NodeId skipBefore(NodeId node) const {
    NodeId found = skips_.front();
    for (const NodeId skip : skips_)
      if (skip < node)
        found = skip;
    return found;
  }
  Span spanOf(NodeId node) const { return view_.blockSpan(node); }
  /// Some condition looks at a position, perhaps behind the assignment that takes it.
  bool areChecked() const {
    for (NodeId node = facts_.entry(); node < facts_.end(); node = node.next())
      if (isCheck(node) && std::holds_alternative<Test>(facts_.node(node).instruction))
        return true;
    return false;
  }

private:
  Unchecked &stateOf(NodeId node) { return states_[node.index() - facts_.entry().index()]; }

  void findSkips() {
    for (NodeId node = facts_.entry(); node < facts_.end(); node = node.next())
      for (const Word *word : view_.mayDo(node, {CodeAction::Skip}) ? view_.wordsOf(node) : std::vector<const Word *>{})
        if (const Code *code = word->address() == 'G' ? codeOf(*word, context_.dialect) : nullptr;
            code && isSkip(code->role) && facts_.isReached(node))
          (code->role == CodeRole::Skip ? skips_ : sureSkips_).push_back(node);
  }
  /// Everything that may be computed from a position: a condition that reads it may be the check.
  void findMeasured() {
    for (bool grows = true; grows;) {
      grows = false;
      for (NodeId node = facts_.entry(); node < facts_.end(); node = node.next())
        for (const Assignment &assignment : assignmentsOf(facts_, node)) {
          const auto target = variableOf(facts_, assignment.target);
          const auto reads = readsIn(facts_.file, assignment.value, facts_.node(node).block);
          const bool isMeasured = std::ranges::any_of(reads, [&](const Read &read) {
            const auto number = variableOf(facts_, read.expression);
            return !number || measured_.contains(*number) || isPosition(roleOf(context_, *number));
          });
          grows |= target && isMeasured && measured_.insert(*target).second;
        }
    }
  }
  /// Looks at a position, at something computed from one, or at a signal of the machine.
  bool isCheck(NodeId node) const {
    const Instruction &instruction = facts_.node(node).instruction;
    if (std::holds_alternative<Havoc>(instruction) || std::holds_alternative<CallProgram>(instruction) ||
        std::holds_alternative<JumpTo>(instruction))
      return true;
    const auto *test = std::get_if<Test>(&instruction);
    if (!test || !test->condition)
      return test != nullptr;
    const auto reads = readsIn(facts_.file, *test->condition, facts_.node(node).block);
    return std::ranges::any_of(reads, [&](const Read &read) {
      const auto number = variableOf(facts_, read.expression);
      return !number || measured_.contains(*number) || roleOf(context_, *number) != VariableRole::Plain;
    });
  }
  std::uint32_t axesOf(NodeId node) const {
    std::uint32_t axes = 0;
    for (const Word *word : view_.axisWords(node))
      axes |= 1U << (word->address() - 'A');
    return axes == 0 ? ~0U : axes;
  }
  bool isUnsure(NodeId node) const { return std::ranges::binary_search(skips_, node); }
  bool moves(NodeId node) const { return !view_.axisWords(node).empty(); }

  bool reads(ExpressionId value, NodeId node, const Unchecked &state) const {
    const auto all = readsIn(facts_.file, value, facts_.node(node).block);
    return std::ranges::any_of(all, [&](const Read &read) {
      if (read.use == ReadUse::Other && !as<NumberedVariable>(context_.tree, read.expression))
        return false;
      const auto number = tableNumber(context_, read.expression);
      const auto variable = number ? number : variableOf(facts_, read.expression);
      if (!variable)
        return false;
      const VariableRole role = roleOf(context_, *variable);
      return role == VariableRole::SkipPosition ? state.skipPosition
             : isPosition(role)                 ? state.position
                                                : state.variables.contains(*variable);
    });
  }
  Unchecked after(NodeId node, Unchecked state) const {
    if (isCheck(node)) {
      state.skipPosition = state.position = false;
      state.variables.clear();
      state.fresh &= ~state.touched;
    } else if (isUnsure(node)) {
      const std::uint32_t axes = axesOf(node);
      state.skipPosition = state.position = (state.fresh & axes) != 0;
      state.touched |= axes;
    } else if (moves(node)) {
      state.position = false;
      state.skipPosition = state.skipPosition && !std::ranges::binary_search(sureSkips_, node);
    }
    for (const Assignment &assignment : assignmentsOf(facts_, node))
      if (const auto target = variableOf(facts_, assignment.target)) {
        if (reads(assignment.value, node, state))
          state.variables.insert(*target);
        else
          state.variables.erase(*target);
      }
    return state;
  }
  void propagate() {
    states_.resize(facts_.end().index() - facts_.entry().index());
    stateOf(facts_.entry()).isReached = true;
    std::vector<NodeId> open{facts_.entry()};
    while (!open.empty()) {
      const NodeId node = open.back();
      open.pop_back();
      const Unchecked left = after(node, stateOf(node));
      forEachSuccessor(facts_.file.cfg, *facts_.file.model, node, ProgramUse::Called, [&](NodeId next) {
        if (next >= facts_.entry() && next < facts_.end() && facts_.isReached(next) && stateOf(next).join(left))
          open.push_back(next);
      });
    }
  }
  void findUses(NodeId node) {
    const Unchecked &state = stateOf(node);
    for (const Assignment &assignment : assignmentsOf(facts_, node))
      if (reads(assignment.value, node, state)) {
        const auto target = tableNumber(context_, assignment.target);
        uses_.push_back(
            {node, context_.tree.expressions[assignment.target].span, target && isOffset(context_, *target)});
      }
    const auto words = view_.wordsOf(node);
    const auto does = [&](CodeRole role) {
      return std::ranges::any_of(words, [&](const Word *word) {
        const Code *code = word->address() == 'G' ? codeOf(*word, context_.dialect) : nullptr;
        return code && code->role == role;
      });
    };
    if (!does(CodeRole::DataSetting) && !view_.findAction(node, {CodeAction::CoordinateSet}))
      return;
    const bool readsIt = std::ranges::any_of(words, [&](const Word *word) {
      return word->form() == WordForm::Expression && reads(word->expression(), node, state);
    });
    if (readsIt || (state.position && setsHere(node)))
      uses_.push_back({node, view_.blockSpan(node), true});
  }
  /// The block gives the present position a value: G92, or G10 L20 of a control on which it counts from there.
  bool setsHere(NodeId node) const {
    if (view_.findAction(node, {CodeAction::CoordinateSet}))
      return true;
    const Word *kind = findWord(context_.tree, facts_.node(node).block, 'L');
    const auto number = kind && context_.dialect.grammar.oWords ? kind->integer() : std::nullopt;
    return number == 20U || number == 10U || number == 11U;
  }

  const FlowFacts &facts_;
  const FileContext &context_;
  MotionView view_;
  std::vector<NodeId> skips_;
  std::vector<NodeId> sureSkips_; // with an alarm where the signal does not come
  std::set<std::uint32_t> measured_;
  std::vector<Unchecked> states_;
  std::vector<Use> uses_;
};

std::string adviceFor(const Dialect &dialect) {
  return dialect.grammar.oWords
             ? "probe with `G38.2`, which stops with an error, or test `#5070`, which is 1 after a contact"
             : "compare the position with the programmed end point, and raise an alarm when they are equal";
}

void check(const FlowFacts &facts, const FileContext &context, const Reporter &reporter) {
  if (isTooLarge(facts))
    return;
  const Skips skips(facts, context);
  const auto &uses = skips.uses();
  const auto offset = std::ranges::find_if(uses, &Use::isOffset);
  if (uses.empty() || (offset == uses.end() && skips.areChecked()))
    return;
  const Use &use = offset == uses.end() ? uses.front() : *offset;
  const std::string seen = use.isOffset ? "takes the end of a skip move as the surface" : "is set from a skip position";
  Diagnostic diagnostic{
      .message = fmt::format("{} {}, but nothing checks whether the skip signal came", context.quoted(use.span), seen),
      .span = use.span,
      .labels = {{skips.spanOf(skips.skipBefore(use.node)), "without a signal this moves to its end point"}},
      .notes = {use.isOffset ? "if the probe touches nothing, the offset is set to the end point of the move"
                             : "if the probe touches nothing, the end point is taken as the surface",
                adviceFor(context.dialect)}};
  for (const Use &other : uses)
    if (use.isOffset && other.isOffset && other.node != use.node)
      diagnostic.labels.push_back({other.span, "this offset as well"});
  reporter.report(std::move(diagnostic), use.isOffset ? Severity::Warning : Severity::Info);
}

} // namespace

extern const Rule skipNotChecked;
const Rule skipNotChecked{
    .info = {"skip-not-checked", Category::Motion, Severity::Warning,
             "Reports an offset or a variable that is set from a skip move without a check whether the skip signal "
             "came."},
    .hooks = {.flow = check}};

} // namespace feedhold::rules::skip_not_checked
