// possibly-unset-variable: `#31` is set under conditions, and used where none of them need hold.
#include "rules/flow/consistent_path.h"

#include "base/support/text.h"
#include "rules/flow/definitions.h"
#include "rules/flow/loop_view.h"
#include "rules/motion/folder_programs.h"

#include <algorithm>
#include <fmt/format.h>

namespace feedhold::rules::possibly_unset_variable {
namespace {

/// Nothing but the program itself can have set the variable before: it is a main program, or no letter passes it.
bool startsVacant(const FlowFacts &facts, bool isMain, std::uint32_t variable) {
  if (facts.programs.isLocalName(variable))
    return isMain || !isCalledAsSubprogram(facts);
  if (variable == kVacantVariable || !isLocal(facts.file, variable))
    return false;
  return isMain || (!letterOfArgument(*facts.file.dialect, variable) && !isCalledAsSubprogram(facts));
}

/// The use may set the common variable: `#[2000+#11]=` does not.
bool mayWrite(const SyntaxTree &tree, const VariableUse &use, std::uint32_t variable) {
  if (!use.write || use.number)
    return use.write && use.number == variable;
  const auto *indirect = as<IndirectVariable>(tree, use.expression);
  const auto parts = indirect ? subexpressions(tree, indirect->index) : std::vector<ExpressionId>{};
  return std::ranges::none_of(parts, [&](ExpressionId part) {
    const auto base = literalValue(tree, part);
    return base && *base >= Decimal(1000, 0);
  });
}

/// `#121=#120-#111`: from common variables that the program sets itself.  A result of this run, nothing that is kept.
bool isResult(const FlowFacts &facts, const VariableUse &use) {
  for (NodeId node = facts.entry(); node < facts.end(); node = node.next()) {
    const auto assignment =
        facts.node(node).block == use.block && use.number ? assignmentTo(facts, node, *use.number) : std::nullopt;
    if (!assignment || variableNumber(*facts.file.tree, unwrapped(*facts.file.tree, assignment->value)))
      continue;
    const auto reads = readsIn(facts.file, assignment->value, use.block);
    return !reads.empty() && std::ranges::all_of(reads, [&](const Read &read) {
      return read.number && read.number != use.number && isPlain(facts.file, *read.number) &&
             !isLocal(facts.file, *read.number) && maySet(facts, *read.number);
    });
  }
  return false;
}

/// The programs of the file set the variable for themselves: they read it, too.
bool isScratchIn(const ProgramFile &file, std::uint32_t variable) {
  return std::ranges::any_of(file.model->variables,
                             [&](const VariableUse &use) { return !use.write && use.number == variable; });
}

/// A common variable with one assignment in the programs of the folder, which stands in this one: what it holds where
/// that is passed over, none of them has put there.  Where the assignment computes a result, other files may use the
/// variable for results of their own.
bool isSetOnlyHere(const FlowFacts &facts, const FileContext &context, std::uint32_t variable) {
  const VariableRange *range = variable >= kFirstNamedVariable ? nullptr : findVariable(context.dialect, variable);
  if (!range || range->kind != VariableKind::Common || context.dialect.grammar.oWords ||
      isPromised(facts, context, variable))
    return false;
  const auto mayWriteHere = [&](const VariableUse &use) { return mayWrite(context.tree, use, variable); };
  const auto own = context.model.variablesOf(facts.program);
  const auto write = std::ranges::find_if(own, mayWriteHere);
  if (write == own.end() || std::ranges::count_if(own, mayWriteHere) != 1 ||
      std::ranges::count_if(context.model.variables, mayWriteHere) != 1)
    return false;
  const bool isOwnResult = isResult(facts, *write);
  const auto calls = context.model.callsOf(facts.program);
  return std::ranges::none_of(filesOfFolder(context),
                              [&](FileId id) {
                                const ProgramFile &file = facts.programs.file(id);
                                const bool writes = id != context.file &&
                                                    std::ranges::any_of(file.model->variables, [&](const auto &use) {
                                                      return mayWrite(*file.tree, use, variable);
                                                    });
                                return writes && !(isOwnResult && isScratchIn(file, variable));
                              }) &&
         std::ranges::all_of(calls, [&](const Call &call) {
           return call.kind == CallKind::ModalCancel || call.kind == CallKind::Local ||
                  (context.callGraph.callee(context.file, call) &&
                   !context.callGraph.reachesEncrypted(context.file, call));
         });
}

/// `IF[#26NE#0]THEN#101=#26`: kept for the next call, in which the argument may be left out.
bool isKeptArgument(const FlowFacts &facts, const UnsetPaths &paths, std::uint32_t variable) {
  for (NodeId node = facts.entry(); node < facts.end(); node = node.next())
    for (const Assignment &assignment : paths.sets(node) ? assignmentsOf(facts, node) : std::vector<Assignment>{})
      if (variableOf(facts, assignment.target) == variable) {
        const auto source = variableOf(facts, assignment.value);
        return source && isParameter(facts, *source);
      }
  return false;
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

/// `EXISTS[#<depth>]`
bool isAskedFor(const FlowFacts &facts, std::uint32_t variable) {
  const SyntaxTree &tree = *facts.file.tree;
  for (std::size_t i = 0; i < tree.expressions.size(); ++i)
    if (const auto *call = as<FunctionCall>(tree, ExpressionId(i));
        call && call->function == FunctionKind::Exists && !call->arguments().empty() &&
        variableOf(facts, unwrapped(tree, call->arguments().front())) == variable)
      return true;
  return false;
}

/// By its number, or a name.
std::optional<std::uint32_t> readVariable(const FlowFacts &facts, const Read &read) {
  return read.number ? read.number : variableOf(facts, read.expression);
}

/// `(ABORT, ..)` ends the program.
bool abortsBetween(const FlowFacts &facts, BlockId from, BlockId to) {
  const auto isAbort = [&](const Comment &comment) {
    const std::string_view text = trimmed(facts.file.source->text(comment.span).substr(1));
    return toUpper(text.substr(0, 5)) == "ABORT";
  };
  for (BlockId block = from; block < to; block = block.next())
    if (std::ranges::any_of(facts.file.tree->commentsOf(block), isAbort))
      return true;
  return false;
}

/// The last decision of the path passes over the setting, and no loop makes it.  Decisions behind it may ask for what
/// the first one has asked for, which the analysis does not see in names.
bool isPlainlyPassed(const FlowFacts &facts, const UnsetPaths &paths, std::span<const NodeId> path) {
  for (std::size_t i = path.size(); i-- > 0;) {
    if (std::holds_alternative<CountDown>(facts.node(path[i]).instruction))
      return false;
    const auto *test = std::get_if<Test>(&facts.node(path[i]).instruction);
    if (!test)
      continue;
    const NodeId taken = i + 1 < path.size() ? path[i + 1] : path[i];
    const NodeId other = taken == test->taken ? facts.node(path[i]).next : test->taken;
    for (NodeId node = other; node != path.back(); node = facts.node(node).next) {
      if (paths.sets(node))
        return node > path[i] && !abortsBetween(facts, facts.node(path[i]).block, facts.node(path.back()).block);
      if (node == facts.node(node).next || std::holds_alternative<Test>(facts.node(node).instruction))
        return false;
    }
    return false;
  }
  return false;
}

/// True: it was reported.
bool checkRead(const Read &read, std::uint32_t variable, const FlowFacts &facts, const FileContext &context,
               const Reporter &reporter) {
  const auto node = nodeOf(facts, read.block, read.expression);
  const UnsetPaths paths(facts, variable);
  const auto setting = firstSetting(facts, paths);
  const bool isCommon = !facts.programs.isLocalName(variable) && !isLocal(facts.file, variable);
  if (!node || !setting || !paths.reach(*node) || paths.isFirstUse(*node) ||
      (isCommon && isKeptArgument(facts, paths, variable)))
    return false;
  const auto path = findConsistentPath(facts, *node, [&](NodeId each) { return paths.sets(each); });
  if (!path || (facts.programs.isLocalName(variable) && !isPlainlyPassed(facts, paths, *path)))
    return false;
  const Span span = context.tree.expressions[read.expression].span;
  reporter.report(
      {.message = fmt::format("{} is not set on every path to this block", context.quoted(span)),
       .span = span,
       .labels = {{*setting, "set here"}},
       .flow = describePathPast(facts, *path, [&](NodeId each) { return paths.sets(each); }),
       .notes = {facts.programs.isLocalName(variable)
                     ? "the interpreter stops with an error when it reads a named parameter that was never set"
                 : isCommon
                     ? "there it holds what an earlier run or another program has left, or is vacant"
                     : "without a value it is vacant: arithmetic reads it as 0, and the control ignores a word with it",
                 "set it before the conditions, or close the gap between them"}},
      passesCases(facts, paths, *path) ? Severity::Info : Severity::Warning);
  return true;
}

void check(const FlowFacts &facts, const FileContext &context, const Reporter &reporter) {
  const bool isMain = isMainProgram(facts);
  const bool returns = facts.file.model->programs[facts.program].returns;
  if (isTooLarge(facts))
    return;
  std::vector<std::uint32_t> done;
  for (const Read &read : readsOf(facts)) {
    const auto variable = readVariable(facts, read);
    if (!variable || read.use == ReadUse::Equality || std::ranges::find(done, *variable) != done.end())
      continue;
    const bool isName = facts.programs.isLocalName(*variable);
    const bool isOwn = (isMain || returns || isName) && startsVacant(facts, isMain, *variable);
    if (!isOwn && !isSetOnlyHere(facts, context, *variable))
      continue;
    const AbstractValue *value = facts.valueOf(read.expression);
    if (!value || (!isName && (!value->mayBeVacant() || !maySet(facts, *variable))))
      continue;
    const bool isAsked =
        isName ? isAskedFor(facts, *variable) : isTestedForVacancy(facts.file, facts.program, *variable);
    // A common variable may be read under the condition first, and without it later.
    if (isAsked || checkRead(read, *variable, facts, context, reporter) || isOwn)
      done.push_back(*variable);
  }
}

} // namespace

extern const Rule possiblyUnsetVariable;
const Rule possiblyUnsetVariable{
    .info = {"possibly-unset-variable", Category::Flow, Severity::Warning,
             "Reports a local variable, or a common one that a single block sets, that is not set "
             "on every path to its use."},
    .hooks = {.flow = check}};

} // namespace feedhold::rules::possibly_unset_variable
