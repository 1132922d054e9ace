// resolve: the steps in their order, and the uses of variables.
#include "language/model/internal.h"
#include "language/model/model.h"

#include <algorithm>
#include <numeric>

namespace feedhold {

namespace {

/// Indices of the sequence numbers sorted by number, then by place.  CAM programs number upwards, so that most are
/// sorted already.
std::vector<std::uint32_t> sortedByNumber(const std::vector<SequenceNumber> &numbers) {
  std::vector<std::uint32_t> order(numbers.size());
  std::iota(order.begin(), order.end(), 0u);
  const auto less = [&](std::uint32_t a, std::uint32_t b) { return numbers[a].number < numbers[b].number; };
  if (!std::is_sorted(order.begin(), order.end(), less))
    std::stable_sort(order.begin(), order.end(), less);
  return order;
}

/// Expressions of a block lie together in the store: those from its first up to the first of the next block.  The
/// variables that an assignment writes are marked by their ids.
class VariableUses {
public:
  VariableUses(const ResolveContext &context, ProgramModel &model) : tree_(context.tree), model_(model) {}

  void run() {
    model_.variables.reserve(tree_.expressions.size() / 2); // more than that are rarely variables
    for (std::size_t i = 0; i < tree_.blockCount(); ++i) {
      const BlockId block(i);
      const bool read = !tree_.blocks[block].has(Block::kAfterEnd);
      for (const Statement &statement : tree_.statementsOf(block))
        if (const auto *assignment = std::get_if<Assignment>(&statement.node))
          targets_.push_back(unwrapped(tree_, assignment->target).index());
      const std::uint32_t end = endOf(block);
      for (; next_ < tree_.expressions.size() && tree_.expressions[ExpressionId(next_)].span.begin < end; ++next_)
        if (read)
          add(ExpressionId(next_), block);
      targets_.clear();
    }
  }

private:
  std::uint32_t endOf(BlockId block) const { return tree_.blocks[block.next()].begin; }

  void add(ExpressionId id, BlockId block) {
    const auto &node = tree_.expressions[id].node;
    if (const auto *call = std::get_if<FunctionCall>(&node); call && call->function == FunctionKind::Exists)
      dropArgument(*call);
    const bool isVariable = std::holds_alternative<NumberedVariable>(node) ||
                            std::holds_alternative<IndirectVariable>(node) ||
                            std::holds_alternative<NamedVariable>(node);
    if (!isVariable)
      return;
    const bool written = std::find(targets_.begin(), targets_.end(), id.index()) != targets_.end();
    model_.variables.push_back({id, variableNumber(tree_, id), block, written});
  }

  /// `EXISTS[#<x>]` asks for the name, and does not read the variable; its operand stands just before it.
  void dropArgument(const FunctionCall &call) {
    const ExpressionId argument = unwrapped(tree_, call.arguments().front());
    if (!model_.variables.empty() && model_.variables.back().expression == argument)
      model_.variables.pop_back();
  }

  const SyntaxTree &tree_;
  ProgramModel &model_;
  std::vector<std::uint32_t> targets_;
  std::size_t next_ = 0;
};

} // namespace

void findVariableUses(const ResolveContext &context, ProgramModel &model) { VariableUses(context, model).run(); }

ProgramModel resolve(const SourceFile &source, const SyntaxTree &tree, const Dialect &dialect) {
  const ResolveContext context{source, tree, dialect};
  ProgramModel model;
  if (dialect.grammar.oWords)
    findOWords(context, model);
  findPrograms(context, model);
  findSequenceNumbers(context, model);
  model.byNumber = sortedByNumber(model.sequenceNumbers);
  findLoops(context, model);
  findCalls(context, model);
  placeCalls(context, model);
  findJumps(context, model);
  findVariableUses(context, model);
  return model;
}

} // namespace feedhold
