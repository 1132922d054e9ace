// possibly-unset-variable: `#31` is set under conditions, and used where none of them need hold.
#include "rules/flow/consistent_path.h"

#include <algorithm>
#include <fmt/format.h>

namespace feedhold::rules::possibly_unset_variable {
namespace {

/// Nothing but the program itself can have set the variable before: it is a main program, or no letter passes it.
bool startsVacant(const FlowFacts &facts, bool isMain, std::uint32_t variable) {
  if (variable == kVacantVariable || !isLocal(facts.file, variable))
    return false;
  return isMain || (!letterOfArgument(*facts.file.dialect, variable) && !isCalledAsSubprogram(facts));
}

/// Where it is set, and the variable is not only carried on from pass to pass.
std::optional<Span> firstSetting(const FlowFacts &facts, const UnsetPaths &paths) {
  for (NodeId node = facts.entry(); node < facts.end(); node = node.next())
    if (paths.sets(node))
      return facts.file.tree->blocks[facts.node(node).block].span();
  return std::nullopt;
}

/// `IF[#7EQ12]THEN#30=..` one after the other, and none of them holds: cases of a value that the writer takes for all
/// that there are.
bool passesCases(const FlowFacts &facts, const UnsetPaths &paths, std::span<const NodeId> path) {
  const SyntaxTree &tree = *facts.file.tree;
  const auto isCase = [&](const Statement &statement) {
    const auto condition = conditionOf(statement);
    const auto *relation = condition ? asInside<BinaryOperation>(tree, *condition) : nullptr;
    return relation && relation->op == OperatorKind::Equal;
  };
  return std::ranges::any_of(path, [&](NodeId node) {
    const auto *test = std::get_if<Test>(&facts.node(node).instruction);
    return test && paths.sets(test->taken) && std::ranges::any_of(tree.statementsOf(facts.node(node).block), isCase);
  });
}

void checkRead(const Read &read, const FlowFacts &facts, const FileContext &context, const Reporter &reporter) {
  const auto node = nodeOf(facts, read.block, read.expression);
  const UnsetPaths paths(facts, *read.number);
  const auto setting = firstSetting(facts, paths);
  if (!node || !setting || !paths.reach(*node) || paths.isFirstUse(*node))
    return;
  const auto path = findConsistentPath(facts, *node, [&](NodeId each) { return paths.sets(each); });
  if (!path)
    return;
  const Span span = context.tree.expressions[read.expression].span;
  reporter.report(
      {.message = fmt::format("{} is not set on every path to this block", context.quoted(span)),
       .span = span,
       .labels = {{*setting, "set here"}},
       .flow = describePathPast(facts, *path, [&](NodeId each) { return paths.sets(each); }),
       .notes = {"without a value it is vacant: arithmetic reads it as 0, and the control ignores a word with it",
                 "set it before the conditions, or close the gap between them"}},
      passesCases(facts, paths, *path) ? Severity::Info : Severity::Warning);
}

void check(const FlowFacts &facts, const FileContext &context, const Reporter &reporter) {
  const bool isMain = isMainProgram(facts);
  const bool returns = facts.file.model->programs[facts.program].returns;
  if ((!isMain && !returns) || isTooLarge(facts))
    return;
  std::vector<std::uint32_t> done;
  for (const Read &read : readsOf(facts)) {
    if (!read.number || read.use == ReadUse::Equality || std::ranges::find(done, *read.number) != done.end() ||
        !startsVacant(facts, isMain, *read.number))
      continue;
    const AbstractValue *value = facts.valueOf(read.expression);
    if (!value || !value->mayBeVacant() || !maySet(facts, *read.number))
      continue;
    done.push_back(*read.number);
    if (!isTestedForVacancy(facts.file, facts.program, *read.number))
      checkRead(read, facts, context, reporter);
  }
}

} // namespace

extern const Rule possiblyUnsetVariable;
const Rule possiblyUnsetVariable{.info = {"possibly-unset-variable", Category::Flow, Severity::Warning,
                                          "Reports a local variable that is not set on every path to its use."},
                                 .hooks = {.flow = check}};

} // namespace feedhold::rules::possibly_unset_variable
