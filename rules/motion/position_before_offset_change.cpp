// position-before-offset-change: `#<start>=#<_z>`, `G49`, `G90 G1 Z#<start>`.
#include "rules/flow/definitions.h"
#include "rules/motion/motion_view.h"

#include "base/support/text.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string>
#include <string_view>
#include <vector>

namespace feedhold::rules::position_before_offset_change {
namespace {

/// What a code does to coordinates; a second code of a kind may take back what the first one did.
enum class Kind : std::uint8_t { Length, Shift, System, Unit };

struct Change {
  NodeId node;
  const Word *word;
  Kind kind;
};
struct Use {
  NodeId node;
  const Word *word;
};

/// The axis of `#<_z>`, `#5422`, in LinuxCNC; 0: the text is another one.
char axisOfPosition(std::string_view text) {
  constexpr std::array<std::pair<std::string_view, char>, 6> kPositions = {
      {{"#<_X>", 'X'}, {"#<_Y>", 'Y'}, {"#<_Z>", 'Z'}, {"#5420", 'X'}, {"#5421", 'Y'}, {"#5422", 'Z'}}};
  const std::string upper = toUpper(text);
  const auto found = std::ranges::find(kPositions, upper, &std::pair<std::string_view, char>::first);
  return found == kPositions.end() ? '\0' : found->second;
}

class PositionBeforeOffsetChange final : public FlowRule {
public:
  PositionBeforeOffsetChange(ProgramId program, const FileContext &context)
      : view_(program, context), context_(context) {}

  void after(NodeId node, const AbstractState &state) override {
    noteChange(node, {CodeAction::LengthPlus, CodeAction::LengthGiven, CodeAction::LengthOff}, Kind::Length);
    noteChange(node, {CodeAction::CoordinateSet, CodeAction::CoordinateSetOff, CodeAction::CoordinateSetSuspend},
               Kind::Shift);
    noteChange(node, {CodeAction::WorkOffset}, Kind::System);
    noteChange(node, {CodeAction::Inch, CodeAction::Metric}, Kind::Unit);
    noteZero(node);
    if (!view_.surely(state, ModalKind::Distance, {CodeAction::Absolute}) ||
        view_.findAction(node, {CodeAction::MachineMove}))
      return;
    for (const Word *word : view_.modalMotionWords(node))
      if (word->form() == WordForm::Expression)
        uses_.push_back({node, word});
  }

  void report(const FlowFacts &facts, const FileContext &context, const Reporter &reporter) override {
    std::vector<ExpressionId> told; // one finding for what was saved
    for (const Use &use : uses_) {
      const auto saved = savedBehind(facts, use);
      if (!saved || std::ranges::find(told, saved->value) != told.end())
        continue;
      const Change *change = onlyChange(facts, *saved, use);
      if (!change)
        continue;
      told.push_back(saved->value);
      reporter.report(
          {.message = fmt::format("{} moves to a position that was saved before {}", context.quoted(use.word->span()),
                                  context.quoted(change->word->span())),
           .span = use.word->span(),
           .labels = {{context.tree.expressions[saved->value].span, "saved here"},
                      {change->word->span(), change->kind == Kind::Unit
                                                 ? "coordinates are in another unit from here"
                                                 : "coordinates count from another zero from here"}},
           .notes = {
               "where that changes coordinates, the number that was saved is another place: the tool may go into the "
               "part",
               fmt::format("save the position behind {}", context.quoted(change->word->span()))}});
    }
  }

private:
  struct Saved {
    std::uint32_t variable;
    NodeId node;
    ExpressionId value;
  };

  void noteChange(NodeId node, std::initializer_list<CodeAction> actions, Kind kind) {
    const Word *word = view_.mayDo(node, actions) ? view_.findAction(node, actions) : nullptr;
    if (word && std::ranges::find(changes_, word, &Change::word) == changes_.end())
      changes_.push_back({node, word, kind});
  }

  /// `G10 L20 P0 Z0`: of the system in force.
  void noteZero(NodeId node) {
    const Word *code = view_.mayHave(node, 'L')
                           ? findCode(context_.tree, view_.node(node).block, context_.dialect, CodeRole::DataSetting)
                           : nullptr;
    const auto numberIn = [&](char address) {
      const Word *word = findWord(context_.tree, view_.node(node).block, address);
      return word && word->isNumber() ? word->integer() : std::nullopt;
    };
    const auto list = code ? numberIn('L') : std::nullopt;
    if ((list == 2 || list == 20) && numberIn('P') == 0 &&
        std::ranges::find(changes_, code, &Change::word) == changes_.end())
      changes_.push_back({node, code, Kind::Shift});
  }

  /// The assignment of a position on the axis of the word, whose value it moves to, or to a distance from it.
  std::optional<Saved> savedBehind(const FlowFacts &facts, const Use &use) const {
    std::optional<std::uint32_t> variable;
    for (const SumTerm &term : termsOf(context_.tree, use.word->expression())) {
      if (isConstant(context_.tree, term.value))
        continue;
      if (variable || term.isMinus)
        return std::nullopt;
      variable = variableOf(facts, term.value);
      if (!variable)
        return std::nullopt;
    }
    const auto known = variable ? definitionsOf(facts, *variable, use.node) : std::nullopt;
    if (!known || known->fromEntry || known->nodes.size() != 1)
      return std::nullopt;
    const auto saving = assignmentTo(facts, known->nodes.front(), *variable);
    if (!saving)
      return std::nullopt;
    const ExpressionId value = unwrapped(context_.tree, saving->value);
    if (axisOfPosition(context_.text(context_.tree.expressions[value].span)) != use.word->address())
      return std::nullopt;
    return Saved{*variable, known->nodes.front(), value};
  }

  /// The change between the two, where there is only one of its kind.
  const Change *onlyChange(const FlowFacts &facts, const Saved &saved, const Use &use) const {
    const Change *found = nullptr;
    std::array<int, 4> counts{};
    for (const Change &change : changes_) {
      const auto there = definitionsOf(facts, saved.variable, change.node);
      if (change.node >= use.node || !there || !there->areOnly(saved.node) || !concerns(change, use.word->address()))
        continue;
      ++counts[static_cast<std::size_t>(change.kind)];
      if (!takesTool(change) && isPassedAlways(facts, change.node, use.node) && !found)
        found = &change;
    }
    return found && counts[static_cast<std::size_t>(found->kind)] == 1 ? found : nullptr;
  }
  /// A position for the tip of the tool that is changed to.
  bool takesTool(const Change &change) const {
    return change.kind == Kind::Length && codeOf(*change.word, context_.dialect)->action != CodeAction::LengthOff;
  }
  /// `G92 X0` leaves Z as it is, and a tool length that of X and Y.  G21 is mostly in force already, where the text has
  /// no G20.
  bool concerns(const Change &change, char axis) const {
    const Code *code = codeOf(*change.word, context_.dialect);
    if (change.kind == Kind::Length)
      return axis == 'Z';
    if (change.kind == Kind::Unit)
      return std::ranges::any_of(changes_, [&](const Change &other) {
        return other.kind == Kind::Unit && codeOf(*other.word, context_.dialect)->action != code->action;
      });
    return (code->action != CodeAction::CoordinateSet && code->role != CodeRole::DataSetting) ||
           findWord(context_.tree, context_.tree.blockAt(change.word->span().begin), axis) != nullptr;
  }

  MotionView view_;
  const FileContext &context_;
  std::vector<Change> changes_;
  std::vector<Use> uses_;
};

std::unique_ptr<FlowRule> watch(ProgramId program, const FileContext &context) {
  return std::make_unique<PositionBeforeOffsetChange>(program, context);
}

} // namespace

extern const Rule positionBeforeOffsetChange;
const Rule positionBeforeOffsetChange{
    .info = {"position-before-offset-change", Category::Motion, Severity::Warning,
             "Reports an absolute move to a position that LinuxCNC saved before the offset or the unit was changed."},
    .hooks = {.watch = watch}};

} // namespace feedhold::rules::position_before_offset_change
