// undefined-named-parameter: `#<dept>` is read, and only `#<depth>` is set.
#include "rules/expressions/expression_view.h"

#include "base/support/text.h"

#include <algorithm>
#include <fmt/format.h>
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

/// Asked for by `EXISTS`: the program knows that it may not be there.
bool isAskedFor(const FileContext &context, std::string_view name) {
  for (std::size_t i = 0; i < context.tree.expressions.size(); ++i) {
    const auto *call = as<FunctionCall>(context.tree, ExpressionId(i));
    if (!call || call->function != FunctionKind::Exists || call->arguments().empty())
      continue;
    const auto *named = asInside<NamedVariable>(context.tree, call->arguments().front());
    if (named && canonical(context.text(named->name)) == name)
      return true;
  }
  return false;
}

void check(const FlowFacts &facts, const FileContext &context, const Reporter &reporter) {
  if (!context.dialect.grammar.namedParameters)
    return;
  const std::set<std::string> known = namesSetIn(facts.program, context);
  std::set<std::string> done;
  for (const VariableUse &use : context.model.variablesOf(facts.program)) {
    const auto *named = as<NamedVariable>(context.tree, use.expression);
    if (!named || use.write || context.tree.blocks[use.block].has(Block::kBroken) ||
        context.model.programOf(use.block) != facts.program)
      continue;
    const std::string name = canonical(context.text(named->name));
    // A global name may be set by the control, its screen, a remap or another program.
    if (name.starts_with('_') || known.contains(name) || !done.insert(name).second || isAskedFor(context, name))
      continue;
    const auto meant = std::ranges::find_if(known, [&](const std::string &each) { return isAlike(name, each); });
    if (meant == known.end())
      continue;
    const Span span = context.tree.expressions[use.expression].span;
    reporter.report({.message = fmt::format("{} is read, but nothing sets it", context.quoted(span)),
                     .span = span,
                     .notes = {"the interpreter stops with an error when it reads a named parameter that was never set",
                               fmt::format("`#<{}>` is set: correct the name", toLower(*meant))}});
  }
}

} // namespace

extern const Rule undefinedNamedParameter;
const Rule undefinedNamedParameter{
    .info = {"undefined-named-parameter", Category::Variable, Severity::Warning,
             "Reports a local named parameter that is read but never set, while one of nearly the same name is."},
    .hooks = {.flow = check, .flowRuns = FlowRuns::All}};

} // namespace feedhold::rules::undefined_named_parameter
