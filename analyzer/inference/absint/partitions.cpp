#include "inference/absint/partitions.h"

#include <cstring>
#include <map>

namespace feedhold {

namespace {

/// The variable of a lone `#131`, and the literal that it is compared with.
std::optional<std::uint32_t> comparedVariable(const SyntaxTree &tree, const BinaryOperation &operation) {
  if (operation.op != OperatorKind::Equal)
    return std::nullopt;
  const auto number = variableNumber(tree, unwrapped(tree, operation.left));
  return number && literalValue(tree, operation.right) ? number : std::nullopt;
}

bool isSetToLiteral(const ProgramFile &file, const Assignment &assignment) {
  return literalValue(*file.tree, assignment.value).has_value() ||
         variableNumber(*file.tree, unwrapped(*file.tree, assignment.value)) == kVacantVariable;
}

std::uint64_t mixed(std::uint64_t hash, std::uint64_t value) {
  return (hash ^ value) * 0x9E3779B97F4A7C15ULL + 0x7F4A7C15ULL;
}

} // namespace

PartitionBy partitionBy(const ProgramFile &file, ProgramId program, const ModalTable &modes) {
  PartitionBy by;
  by.distanceGroup = modes.groupOf(ModalKind::Distance);
  const Program &range = file.model->programs[program];
  std::map<std::uint32_t, int> compared;
  std::map<std::uint32_t, bool> literalOnly;
  for (BlockId block = range.first; block < range.last; block = block.next())
    for (const Statement &statement : file.tree->statementsOf(block)) {
      if (const auto *test = std::get_if<If>(&statement.node); test && test->condition) {
        const auto &node = file.tree->expressions[unwrapped(*file.tree, *test->condition)].node;
        if (const auto *operation = std::get_if<BinaryOperation>(&node))
          if (const auto variable = comparedVariable(*file.tree, *operation))
            ++compared[*variable];
      } else if (const auto *jump = std::get_if<Goto>(&statement.node); jump && jump->target) {
        if (const auto variable = variableNumber(*file.tree, unwrapped(*file.tree, *jump->target)))
          compared[*variable] += 2;
      } else if (const auto *assignment = std::get_if<Assignment>(&statement.node)) {
        if (const auto variable = variableNumber(*file.tree, assignment->target)) {
          const auto [found, isNew] = literalOnly.emplace(*variable, true);
          found->second = found->second && isSetToLiteral(file, *assignment);
        }
      }
    }
  for (const auto &[variable, times] : compared) {
    const auto found = literalOnly.find(variable);
    if (times >= 2 && found != literalOnly.end() && found->second && by.variables.size() < PartitionBy::kMostVariables)
      by.variables.push_back(variable);
  }
  return by;
}

std::uint64_t keyOf(const PartitionBy &by, const AbstractInterpretation &interpretation, const AbstractState &state) {
  std::uint64_t key = 0;
  if (by.distanceGroup && state.codes[*by.distanceGroup].isSingle())
    key = mixed(1, state.codes[*by.distanceGroup].codes());
  for (const std::uint32_t variable : by.variables) {
    const AbstractValue *value = variable <= kLocalVariables ? &state.locals[variable] : state.variables.find(variable);
    std::uint64_t bits = 0;
    if (value && value->isVacant())
      bits = 1;
    else if (const auto constant = value ? interpretation.constantOf(*value) : std::nullopt)
      std::memcpy(&bits, &*constant, sizeof bits), bits += 2;
    if (bits != 0 || key != 0)
      key = mixed(key, bits);
  }
  return key;
}

Partitions::Part *Partitions::find(std::uint64_t key) {
  if (merged_)
    return parts_.empty() ? nullptr : &parts_.front();
  const auto at = std::find_if(parts_.begin(), parts_.end(), [&](const Part &part) { return part.key == key; });
  return at == parts_.end() ? nullptr : &*at;
}

void Partitions::merge(AbstractInterpretation &interpretation) {
  while (parts_.size() > 1) {
    joinInto(interpretation, parts_.front().state, parts_.back().state);
    parts_.pop_back();
  }
  merged_ = true;
}

void Partitions::add(AbstractInterpretation &interpretation, std::uint64_t key, AbstractState &&state) {
  if (Part *part = find(key)) {
    joinInto(interpretation, part->state, state);
    return;
  }
  const auto place = std::find_if(parts_.begin(), parts_.end(), [&](const Part &part) { return part.key > key; });
  parts_.insert(place, Part{key, std::move(state)});
  if (parts_.size() > kMost)
    merge(interpretation);
}

bool Partitions::grow(AbstractInterpretation &interpretation, const Partitions &incoming, const Growth &how) {
  bool changed = false;
  for (const Part &next : incoming.parts()) {
    Part *old = find(next.key);
    if (!old) {
      add(interpretation, next.key, AbstractState(next.state));
      changed = true;
    } else if (!leq(interpretation, next.state, old->state)) {
      const std::vector<AbstractNumber> counted = how.counters.numbersIn(old->state);
      if (how.widening)
        widenInto(interpretation, old->state, next.state, how.thresholds);
      else
        joinInto(interpretation, old->state, next.state);
      how.counters.extend(old->state, counted);
      changed = true;
    }
  }
  if (incoming.merged_ && !merged_)
    merge(interpretation);
  return changed;
}

Partitions Partitions::narrowedBy(const AbstractInterpretation &interpretation, const Partitions &incoming) const {
  Partitions result = *this;
  if (incoming.merged_ != merged_)
    return result;
  for (Part &part : result.parts_)
    if (const Part *next = incoming.find(part.key); next && leq(interpretation, next->state, part.state))
      part.state = next->state;
  return result;
}

bool Partitions::within(const AbstractInterpretation &interpretation, const Partitions &other) const {
  return std::all_of(parts_.begin(), parts_.end(), [&](const Part &part) {
    const Part *outer = other.find(part.key);
    return outer && leq(interpretation, part.state, outer->state);
  });
}

} // namespace feedhold
