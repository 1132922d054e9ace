// incremental-drift: `G91X#3` a thousand times, where #3 is 10/3: each word is rounded, and the errors add up.
#include "rules/flow/loop_count.h"
#include "rules/motion/motion_view.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <map>

namespace feedhold::rules::incremental_drift {
namespace {

/// A word that moves its axis by a distance, again in each iteration of a loop.
struct RepeatedWord {
  NodeId node;
  const Word *word;
  const LoopFlow *loop;
  Decimal increment;
};

/// What one iteration moves.
struct Move {
  Rational meant;
  Rational rounded;
};

struct Drift {
  Move move;
  std::optional<std::int64_t> iterations;
  std::string given;
};

std::optional<Move> moveOf(const Rational &meant, const Decimal &increment) {
  const auto step = Rational::fromDecimal(increment);
  const auto half = Rational::make(1, 2);
  const auto count = step && half ? divide(meant, *step) : std::nullopt;
  const auto raised = count ? add(*count, *half) : std::nullopt;
  const auto rounded = raised ? multiply(Rational(floor(*raised)), *step) : std::nullopt;
  return rounded ? std::optional(Move{meant, *rounded}) : std::nullopt;
}

/// One error may be seen on no machine; many are.
bool isWorthTelling(const Move &move, const std::optional<std::int64_t> &iterations, const Decimal &increment) {
  const double error = std::abs(move.rounded.toDouble() - move.meant.toDouble());
  constexpr double kNearest = 1e-9;
  return error > kNearest &&
         (!iterations || static_cast<double>(*iterations) * error >= increment.toDouble() - kNearest);
}

class IncrementalDrift final : public FlowRule {
public:
  IncrementalDrift(ProgramId program, const FileContext &context) : view_(program, context) {}

  void after(NodeId node, const AbstractState &state) override {
    if (!view_.context().dialect.behaviour.roundsWords || isHavocked(state) || !movesFreely(state) ||
        !view_.surely(state, ModalKind::Distance, {CodeAction::Incremental}))
      return;
    for (const Word *word : view_.modalMotionWords(node))
      if (word->form() == WordForm::Expression)
        words_[node] = view_.surely(state, ModalKind::Units, {CodeAction::Inch});
  }

  void report(const FlowFacts &facts, const FileContext &context, const Reporter &reporter) override {
    for (const auto &[node, isInch] : words_) {
      const LoopFlow *loop = innermost(facts, node);
      if (!loop || !passesAlways(facts, *loop, node) || hasCalls(facts, *loop))
        continue;
      for (const Word *word : view_.modalMotionWords(node))
        if (word->form() == WordForm::Expression && isOnlyWord(*loop, *word) && !isRounded(*word))
          check({node, word, loop, incrementOf(*word, isInch)}, facts, context, reporter);
    }
  }

private:
  /// Not in a cycle: its depth is no distance that adds up.
  bool movesFreely(const AbstractState &state) const {
    return view_.surely(
        state, ModalKind::Motion,
        {CodeAction::Rapid, CodeAction::Linear, CodeAction::ArcClockwise, CodeAction::ArcCounterclockwise});
  }
  static const LoopFlow *innermost(const FlowFacts &facts, NodeId node) {
    const LoopFlow *found = nullptr;
    for (const LoopFlow &loop : loopsOf(facts))
      if (std::ranges::binary_search(loop.nodes, node) && (!found || loop.nodes.size() < found->nodes.size()))
        found = &loop;
    return found;
  }
  static bool hasCalls(const FlowFacts &facts, const LoopFlow &loop) {
    return std::ranges::any_of(loop.nodes, [&](NodeId node) {
      const Instruction &instruction = facts.node(node).instruction;
      return std::holds_alternative<CallProgram>(instruction) || std::holds_alternative<Havoc>(instruction);
    });
  }
  /// No other word of the loop moves the axis, back or to a place.
  bool isOnlyWord(const LoopFlow &loop, const Word &word) const {
    return std::ranges::none_of(loop.nodes, [&](NodeId node) {
      const auto words = view_.wordsOf(node);
      return std::ranges::any_of(words, [&](const Word *other) {
        return (other->address() == word.address() && other != &word) || movesElsewhere(*other);
      });
    });
  }
  bool movesElsewhere(const Word &word) const {
    const Code *code = word.isCode() ? codeOf(word, view_.context().dialect) : nullptr;
    return code && (code->role == CodeRole::ReferenceReturn || code->role == CodeRole::MachinePosition ||
                    code->role == CodeRole::CoordinateShift || code->action == CodeAction::Absolute);
  }
  bool isRounded(const Word &word) const {
    const SyntaxTree &tree = view_.context().tree;
    return std::ranges::any_of(subexpressions(tree, word.expression()), [&](ExpressionId id) {
      const auto *call = as<FunctionCall>(tree, id);
      return call && call->function == FunctionKind::Round;
    });
  }
  Decimal incrementOf(const Word &word, bool isInch) const {
    const LeastIncrements increments = leastIncrementsOf(view_.context().dialect);
    const bool isAngle = word.address() == 'A' || word.address() == 'B' || word.address() == 'C';
    return isInch && !isAngle ? increments.inch : increments.metric;
  }

  static std::optional<Drift> findDrift(Formulas &formulas, const RepeatedWord &repeated) {
    const auto distance = formulas.of(repeated.word->expression(), repeated.node);
    if (!distance || formulas.asInput(*distance))
      return std::nullopt;
    auto inputs = formulas.inputsOf(*distance);
    if (std::ranges::any_of(inputs, [&](FormulaInputId id) { return formulas.input(id).counter.has_value(); }))
      return std::nullopt;
    const bool hasOneExit = repeated.loop->exitsAreKnown && repeated.loop->exits.size() == 1;
    const auto end = hasOneExit ? endOf(formulas, *repeated.loop, repeated.loop->exits.front()) : std::nullopt;
    const auto guards = formulas.guardsOf(repeated.node);
    std::optional<Drift> drift;
    const auto setting = findSetting(formulas, inputs, [&](FormulaSetting &tried) {
      const auto value = formulas.value(*distance, tried);
      const auto move = value ? moveOf(value->exact, repeated.increment) : std::nullopt;
      constexpr std::int64_t kMostCounted = 20'000;
      const auto counted = move && end ? countIterations(formulas, *end, tried, kMostCounted) : std::nullopt;
      const auto iterations = counted ? std::optional(counted->computed.value_or(counted->exact)) : std::nullopt;
      if (!move || !isWorthTelling(*move, iterations, repeated.increment) || !formulas.pass(guards, tried))
        return false;
      drift = Drift{*move, iterations, {}};
      return true;
    });
    if (setting)
      drift->given = describeSetting(formulas, inputs, *setting);
    return setting ? drift : std::nullopt;
  }

  static void check(const RepeatedWord &repeated, const FlowFacts &facts, const FileContext &context,
                    const Reporter &reporter) {
    Formulas formulas(facts);
    const auto drift = findDrift(formulas, repeated);
    if (!drift)
      return;
    const std::string word = context.quoted(repeated.word->span());
    const std::string given = drift->given.empty() ? "" : drift->given + ", ";
    const auto times = [&](const Rational &value) {
      return fmt::format("{:.10g}", value.toDouble() * static_cast<double>(drift->iterations.value_or(1)));
    };
    reporter.report(
        {.message = fmt::format("{}rounding adds up: {} moves {}, not {}, in {}", given, word,
                                times(drift->move.rounded), times(drift->move.meant),
                                drift->iterations ? fmt::format("{} iterations", *drift->iterations)
                                                  : std::string("each iteration")),
         .span = repeated.word->span(),
         .flow = pathFromEntry(facts, repeated.node),
         .notes = {fmt::format("the control rounds each computed word to the least increment ({}), and under G91 the "
                               "errors stay",
                               repeated.increment.toString()),
                   fmt::format("use G90 and compute the position from the number of the iteration, such as "
                               "`{0}[#2*#3]`, or ROUND the step before the loop and adapt the number of iterations",
                               repeated.word->address())}},
        drift->given.empty() && drift->iterations ? Severity::Warning : Severity::Info);
  }

  MotionView view_;
  std::map<NodeId, bool> words_; // the units are surely inches
};

std::unique_ptr<FlowRule> watch(ProgramId program, const FileContext &context) {
  return std::make_unique<IncrementalDrift>(program, context);
}

} // namespace

extern const Rule incrementalDrift;
const Rule incrementalDrift{
    .info = {"incremental-drift", Category::Motion, Severity::Warning,
             "Reports an incremental word in a loop that is rounded in each iteration, so that the errors add up."},
    .hooks = {.watch = watch}};

} // namespace feedhold::rules::incremental_drift
