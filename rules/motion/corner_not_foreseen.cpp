// corner-not-foreseen: `X60.`, then `M08`, `S500`, `Z-2.`, then `Y40.`, all under G41.
#include "rules/motion/motion_view.h"

#include <fmt/format.h>

#include <cmath>
#include <map>

namespace feedhold::rules::corner_not_foreseen {
namespace {

constexpr std::initializer_list<CodeAction> kCompensated = {CodeAction::CompensationLeft,
                                                            CodeAction::CompensationRight};

struct Way {
  double x;
  double y;
};

bool isCorner(Way a, Way b) {
  constexpr double kSmallTurn = 0.01; // radians: less is the rounding of what is one line
  return std::abs(std::atan2(a.x * b.y - a.y * b.x, a.x * b.x + a.y * b.y)) > kSmallTurn;
}

/// Follows lines in XY through blocks that stand one behind the other.
class CornerNotForeseen final : public FlowRule {
public:
  CornerNotForeseen(ProgramId program, const FileContext &context)
      : view_(program, context), read_(context.dialect.behaviour.cutterBlocks) {}

  void before(NodeId node, const AbstractState &state) override {
    if (isAsked())
      before_[node] = {coordinate(state, Axis::X), coordinate(state, Axis::Y)};
  }

  void after(NodeId node, const AbstractState &state) override {
    if (!isAsked())
      return;
    if (node != next_)
      last_.reset();
    next_ = node.next();
    if (!std::holds_alternative<ExecuteWords>(view_.node(node).instruction)) {
      if (!isComputation(node))
        last_.reset();
      return;
    }
    if (!isFollowed(state) || isOther(node))
      return last_.reset();
    const auto words = view_.modalMotionWords(node);
    const bool isInPlane =
        std::ranges::any_of(words, [](const Word *word) { return word->address() == 'X' || word->address() == 'Y'; });
    if (!isInPlane) {
      idle_ += last_ ? 1U : 0U;
      return;
    }
    moveIn(node, state);
  }

  void report(const FlowFacts &, const FileContext &, const Reporter &reporter) override {
    for (const auto &[corner, found] : found_) {
      const Word &word = *view_.modalMotionWords(corner).front();
      reporter.report({.message = fmt::format("the control does not foresee this corner under cutter compensation: {} "
                                              "blocks before it do not move in XY",
                                              found.idle),
                       .span = word.span(),
                       .labels = {{view_.modalMotionWords(found.last).front()->span(), "the last move in XY"}},
                       .notes = {fmt::format("it reads {} blocks at a time unless a parameter says more, and ends the "
                                             "last move square to it: the tool cuts into an inner corner",
                                             read_),
                                 "write these blocks where the contour goes straight on, or before G41 or G42"}});
    }
  }

private:
  struct Found {
    NodeId last;
    std::size_t idle;
  };

  bool isAsked() const { return read_ != 0 && view_.context().dialect.machine == MachineKind::Milling; }
  static std::optional<double> coordinate(const AbstractState &state, Axis axis) {
    const AbstractValue &value = state.at(axis);
    return value.isNumber() ? value.number().constantValue() : std::nullopt;
  }
  /// Statements that compute are not among the blocks that are read.
  bool isComputation(NodeId node) const {
    const Instruction &instruction = view_.node(node).instruction;
    return std::holds_alternative<Pass>(instruction) || std::holds_alternative<Assign>(instruction);
  }
  bool isFollowed(const AbstractState &state) const {
    return view_.wasSet(state, ModalKind::Compensation, kCompensated) &&
           view_.surely(state, ModalKind::Compensation, kCompensated) &&
           !view_.wasSet(state, ModalKind::Plane, {CodeAction::PlaneZX, CodeAction::PlaneYZ});
  }
  /// The axis words mean something else, or the block stops the reading by itself.
  bool isOther(NodeId node) const {
    return std::ranges::any_of(view_.wordsOf(node), [&](const Word *word) {
      const Code *code = word->isCode() ? codeOf(*word, view_.context().dialect) : nullptr;
      return word->isCode() &&
             (!code || code->role == CodeRole::ProgramStop || code->role == CodeRole::ReferenceReturn ||
              code->role == CodeRole::MachinePosition || isSkip(code->role));
    });
  }
  void moveIn(NodeId node, const AbstractState &state) {
    const auto &[x, y] = before_[node];
    const auto toX = coordinate(state, Axis::X), toY = coordinate(state, Axis::Y);
    const bool isLine = view_.surely(state, ModalKind::Motion, {CodeAction::Rapid, CodeAction::Linear});
    const bool isKnown = isLine && x && y && toX && toY && (*x != *toX || *y != *toY);
    const Way way = isKnown ? Way{*toX - *x, *toY - *y} : Way{};
    if (last_ && isKnown && idle_ > read_ - 2U && isCorner(way_, way))
      found_.emplace(node, Found{*last_, idle_});
    last_ = isKnown ? std::optional(node) : std::nullopt;
    way_ = way;
    idle_ = 0;
  }

  MotionView view_;
  std::size_t read_;
  std::map<NodeId, std::pair<std::optional<double>, std::optional<double>>> before_;
  std::optional<NodeId> next_;
  std::optional<NodeId> last_; // that moves in XY
  Way way_{};
  std::size_t idle_ = 0;
  std::map<NodeId, Found> found_;
};

std::unique_ptr<FlowRule> watch(ProgramId program, const FileContext &context) {
  return std::make_unique<CornerNotForeseen>(program, context);
}

} // namespace

extern const Rule cornerNotForeseen;
const Rule cornerNotForeseen{
    .info = {"corner-not-foreseen", Category::Motion, Severity::Warning,
             "Reports a corner under `G41` or `G42` behind more blocks without movement than the control reads over."},
    .hooks = {.watch = watch}};

} // namespace feedhold::rules::corner_not_foreseen
