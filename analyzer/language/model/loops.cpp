// DO and END, paired number by number: an END belongs to the last DO of its number that is still open, whatever loops
// of other numbers lie between.
#include "language/model/internal.h"

#include <unordered_map>

namespace feedhold {

namespace {

std::optional<std::uint32_t> numberOf(const SyntaxTree &tree, const std::optional<ExpressionId> &expression) {
  const std::optional<Decimal> value = expression ? literalValue(tree, *expression) : std::nullopt;
  const std::optional<std::int64_t> number = value ? value->asInteger() : std::nullopt;
  return number && *number >= 0 && *number <= 0xffff ? std::optional(static_cast<std::uint32_t>(*number))
                                                     : std::nullopt;
}

/// The number of a DO (of `WHILE .. DO` too); nothing for other statements.
std::optional<std::optional<std::uint32_t>> doNumber(const SyntaxTree &tree, const Statement &statement) {
  if (const auto *loop = std::get_if<While>(&statement.node); loop && loop->number)
    return numberOf(tree, loop->number);
  if (const auto *loop = std::get_if<Do>(&statement.node))
    return numberOf(tree, loop->number);
  return std::nullopt;
}

/// The loops of one program that have no END yet, by number.
class OpenLoops {
public:
  void open(std::uint32_t number, std::size_t loop) { open_[number].push_back(loop); }
  /// The last one begun with the number, taken out.
  std::optional<std::size_t> close(std::uint32_t number) {
    std::vector<std::size_t> &loops = open_[number];
    if (loops.empty())
      return std::nullopt;
    const std::size_t loop = loops.back();
    loops.pop_back();
    return loop;
  }

private:
  std::unordered_map<std::uint32_t, std::vector<std::size_t>> open_;
};

} // namespace

void findLoops(const ResolveContext &context, ProgramModel &model) {
  const SyntaxTree &tree = context.tree;
  OpenLoops open;
  std::optional<ProgramId> current;
  for (std::size_t i = 0; i < tree.blockCount(); ++i) {
    const BlockId block(i);
    if (tree.blocks[block].has(Block::kAfterEnd))
      continue;
    for (const Statement &statement : tree.statementsOf(block)) {
      const auto number = doNumber(tree, statement);
      const auto *end = std::get_if<End>(&statement.node);
      if (!number && !end)
        continue;
      if (const ProgramId program = model.programOf(block); program != current) {
        open = OpenLoops();
        current = program;
      }
      if (number) {
        if (*number)
          open.open(**number, model.loops.size());
        model.loops.push_back({*current, *number, block, tree.idOf(statement), std::nullopt, std::nullopt});
        continue;
      }
      const std::optional<std::uint32_t> endNumber = numberOf(tree, end->number);
      const std::optional<std::size_t> loop = endNumber ? open.close(*endNumber) : std::nullopt;
      if (!loop) {
        model.loneEnds.push_back({*current, endNumber, block, tree.idOf(statement)});
        continue;
      }
      model.loops[*loop].endBlock = block;
      model.loops[*loop].endStatement = tree.idOf(statement);
    }
  }
}

} // namespace feedhold
