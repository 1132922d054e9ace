// undefined-named-parameter: `#<dept>` is read, and only `#<depth>` is set, or set later.
#include "rules/flow/flow_view.h"

#include "base/support/text.h"

#include <algorithm>
#include <fmt/format.h>
#include <map>
#include <numeric>
#include <set>
#include <vector>

namespace feedhold::rules::undefined_named_parameter {
namespace {

constexpr std::size_t kShortestName = 4; // without `#<` and `>`; shorter ones are alike by chance
constexpr std::size_t kLongName = 8;     // two letters may differ

/// Case and blanks do not count.
std::string canonical(std::string_view text) {
  std::string name;
  for (const char c : text)
    if (c != '#' && c != '<' && c != '>' && !isBlank(c))
      name.push_back(toUpper(c));
  return name;
}

/// How many letters have to be inserted, deleted or replaced.
std::size_t distanceBetween(std::string_view left, std::string_view right) {
  std::vector<std::size_t> row(right.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 1; i <= left.size(); ++i) {
    std::size_t diagonal = row[0];
    row[0] = i;
    for (std::size_t k = 1; k <= right.size(); ++k) {
      const std::size_t replaced = diagonal + (left[i - 1] == right[k - 1] ? 0 : 1);
      diagonal = row[k];
      row[k] = std::min({row[k] + 1, row[k - 1] + 1, replaced});
    }
  }
  return row.back();
}

std::string withoutDigits(std::string_view name) {
  std::string letters;
  std::ranges::copy_if(name, std::back_inserter(letters), [](char c) { return c < '0' || c > '9'; });
  return letters;
}

/// Misspelled, and not the next of a row of names.
bool isAlike(std::string_view read, std::string_view set) {
  const std::size_t most = std::min(read.size(), set.size()) >= kLongName ? 2 : 1;
  return std::min(read.size(), set.size()) >= kShortestName && withoutDigits(read) != withoutDigits(set) &&
         distanceBetween(read, set) <= most;
}

/// What the program sets by name.
std::set<std::string> namesSetIn(ProgramId program, const FileContext &context) {
  std::set<std::string> names;
  for (const VariableUse &use : context.model.variablesOf(program))
    if (const auto *named = as<NamedVariable>(context.tree, use.expression); named && use.write)
      names.insert(canonical(context.text(named->name)));
  return names;
}

/// Another program of the file sets a parameter of the name, which is not this one.
bool isSetElsewhere(const FlowFacts &facts, const FileContext &context, const std::string &name) {
  for (std::size_t i = 0; i < context.model.programs.size(); ++i)
    if (ProgramId(i) != facts.program && namesSetIn(ProgramId(i), context).contains(name))
      return true;
  return false;
}

/// Asked for by `EXISTS`: the program knows that they may not be there.
std::set<std::string> namesAskedFor(const FlowFacts &facts, const FileContext &context) {
  std::set<std::string> names;
  for (const BlockId block : blocksOf(facts.file, facts.program)) {
    for (const ExpressionId id : expressionsOf(facts.file, block)) {
      const auto *call = as<FunctionCall>(context.tree, id);
      if (!call || call->function != FunctionKind::Exists || call->arguments().empty())
        continue;
      if (const auto *named = asInside<NamedVariable>(context.tree, call->arguments().front()))
        names.insert(canonical(context.text(named->name)));
    }
  }
  return names;
}

/// M02 or M30: the text is no piece of a program.
bool comesToEnd(const FlowFacts &facts) {
  return std::ranges::any_of(facts.exits(), [&](const ExitFact &exit) {
    const auto *end = std::get_if<EndProgram>(&facts.node(exit.node).instruction);
    return end && end->end != ProgramEnd::EndOfFile;
  });
}

/// `#<depth> = #3`: parameters come by their numbers, from an `o.. call`; a remapped code gives them names.
bool takesNumbers(const FlowFacts &facts, const FileContext &context) {
  constexpr std::uint32_t kLastArgument = 30;
  const auto uses = context.model.variablesOf(facts.program);
  const auto isArgument = [&](const VariableUse &use) { return use.number && *use.number <= kLastArgument; };
  return std::ranges::any_of(uses, isArgument) &&
         std::ranges::none_of(uses, [&](const VariableUse &use) { return isArgument(use) && use.write; });
}

/// Names that no program sets may be given by the control or a remap (the prologue of a remapped code sets parameters
/// of the subroutine), unless the text shows who starts the program: an `o.. call`, or, where no subroutine is begun,
/// the operator.
bool isStartKnown(const FlowFacts &facts, const FileContext &context) {
  const Program &program = context.model.programs[facts.program];
  if (program.name.isSubroutine)
    return context.callGraph.isCalled({context.file, facts.program}) || takesNumbers(facts, context);
  const auto isOuter = [](const Program &each) { return !each.name.isSubroutine; };
  return !program.returns && comesToEnd(facts) && std::ranges::count_if(context.model.programs, isOuter) == 1;
}

/// Where parameters are read and surely not set yet.  A global name keeps what the run before has left, so it counts
/// only where nothing else may have set it.
class EarlyReads {
public:
  explicit EarlyReads(const FlowFacts &facts) : facts_(facts) {}

  bool contains(const VariableUse &use, std::uint32_t variable) {
    const auto node = nodeOf(facts_, use.block, use.expression);
    if (!node || isTooLarge(facts_))
      return false;
    const UnsetPaths &unset = paths_.try_emplace(variable, facts_, variable).first->second;
    return unset.reach(*node) && unset.isFirstUse(*node);
  }

private:
  const FlowFacts &facts_;
  std::map<std::uint32_t, UnsetPaths> paths_;
};

/// `(DEBUG, X is #<x>)`: the remark is printed with values in it.
bool isPrinted(const FileContext &context, const Comment &comment) {
  std::string head = canonical(context.text(comment.span).substr(0, 12));
  std::erase_if(head, [](char c) { return c == '(' || c == ';'; });
  return head.starts_with("DEBUG,") || head.starts_with("PRINT,") || head.starts_with("LOG,");
}

/// A local name in a message that nothing in the program sets.
void checkMessages(const FlowFacts &facts, const FileContext &context, const std::set<std::string> &known,
                   const Reporter &reporter) {
  std::set<std::string> done;
  for (const BlockId block : blocksOf(facts.file, facts.program))
    for (const Comment &comment : context.tree.commentsOf(block)) {
      const std::string_view text = context.text(comment.span);
      if (context.model.programOf(block) != facts.program || !isPrinted(context, comment))
        continue;
      for (std::size_t at = text.find("#<"); at != std::string_view::npos; at = text.find("#<", at + 1)) {
        const std::size_t end = text.find('>', at);
        const std::string name = end == std::string_view::npos ? "_" : canonical(text.substr(at, end - at));
        if (name.starts_with('_') || known.contains(name) || !done.insert(name).second)
          continue;
        const auto begin = comment.span.begin + static_cast<std::uint32_t>(at);
        const Span span{begin, begin + static_cast<std::uint32_t>(end + 1 - at)};
        reporter.report({.message = fmt::format("{} is printed, but nothing sets it", context.quoted(span)),
                         .span = span,
                         .notes = {"the message shows no number; correct the name, or set it before"}});
      }
    }
}

void check(const FlowFacts &facts, const FileContext &context, const Reporter &reporter) {
  if (!context.dialect.grammar.namedParameters)
    return;
  const std::set<std::string> known = namesSetIn(facts.program, context);
  const bool isStarted = isStartKnown(facts, context);
  // Nothing else in the run sets global names for it.
  const bool isAlone =
      context.model.callsOf(facts.program).empty() && !context.model.programs[facts.program].name.isSubroutine;
  const std::set<std::string> asked = namesAskedFor(facts, context);
  if (isStarted)
    checkMessages(facts, context, known, reporter);
  EarlyReads early(facts);
  std::set<std::string> done;
  for (const VariableUse &use : context.model.variablesOf(facts.program)) {
    const auto *named = as<NamedVariable>(context.tree, use.expression);
    if (!named || use.write || context.tree.blocks[use.block].has(Block::kBroken) ||
        context.model.programOf(use.block) != facts.program)
      continue;
    const std::string name = canonical(context.text(named->name));
    // A global name may be set by the control, its screen, a remap or another program.
    const bool isGlobal = name.starts_with('_');
    if (done.contains(name) || asked.contains(name) || (isGlobal && !known.contains(name)))
      continue;
    const auto variable = variableOf(facts, use.expression);
    const bool isEarly =
        known.contains(name) && variable && isStarted && (!isGlobal || isAlone) && early.contains(use, *variable);
    const auto meant = std::ranges::find_if(known, [&](const std::string &each) { return isAlike(name, each); });
    const bool isMeant = !known.contains(name) && meant != known.end();
    const bool isNeverSet = !known.contains(name) && isStarted && nodeOf(facts, use.block, use.expression);
    if ((!isEarly && !isMeant && !isNeverSet) || !done.insert(name).second)
      continue;
    const Span span = context.tree.expressions[use.expression].span;
    Diagnostic diagnostic{
        .message = fmt::format("{} is read, but {}", context.quoted(span),
                               isEarly ? "set only behind this block" : "nothing sets it"),
        .span = span,
        .notes = {"the interpreter stops with an error when it reads a named parameter that was never set"}};
    if (isMeant)
      diagnostic.notes.push_back(fmt::format("`#<{}>` is set: correct the name", toLower(*meant)));
    else if (isNeverSet && isSetElsewhere(facts, context, name))
      diagnostic.notes.emplace_back("a name without `_` in front is known only in the subroutine that sets it");
    reporter.report(std::move(diagnostic));
  }
}

} // namespace

extern const Rule undefinedNamedParameter;
const Rule undefinedNamedParameter{
    .info = {"undefined-named-parameter", Category::Variable, Severity::Warning,
             "Reports a named parameter that is read but never set, or set only behind the block that reads it."},
    .hooks = {.flow = check, .flowRuns = FlowRuns::All}};

} // namespace feedhold::rules::undefined_named_parameter
