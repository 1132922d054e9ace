// documented-argument-unread: `(G65 P9012 H_)` at the head of a macro that reads #8 (E), and never #11 (H).
#include "rules/comments/header_call.h"
#include "rules/flow/common_table.h"
#include "rules/flow/definitions.h"

#include <algorithm>
#include <fmt/format.h>
#include <optional>
#include <vector>

namespace feedhold::rules::documented_argument_unread {
namespace {

bool isNamed(const FlowFacts &facts, std::uint32_t variable) {
  return std::ranges::any_of(facts.file.model->variablesOf(facts.program),
                             [&](const VariableUse &use) { return use.number == variable; });
}

/// The arguments of the remark that no block names, by their letters.
std::vector<char> unreadLetters(const FlowFacts &facts, const FileContext &context, const HeaderCall &header) {
  std::vector<char> unread;
  for (std::uint32_t variable = 1; variable <= kLocalVariables; ++variable)
    if (const auto letter = letterOfArgument(context.dialect, variable);
        letter && header.letters.contains(*letter) && !isNamed(facts, variable))
      unread.push_back(*letter);
  return unread;
}

/// Reads of arguments that the remark does not show, as the call has passed them; the first of each variable.
std::vector<Read> otherReads(const FlowFacts &facts, const FileContext &context, const HeaderCall &header) {
  std::vector<Read> found;
  for (const Read &read : readsOf(facts)) {
    const auto letter = read.number ? letterOfArgument(context.dialect, *read.number) : std::nullopt;
    const bool isKnown = std::ranges::any_of(found, [&](const Read &other) { return other.number == read.number; });
    if (!letter || header.letters.contains(*letter) || isKnown)
      continue;
    const auto node = nodeOf(facts, read.block, read.expression);
    const auto known = node ? definitionsOf(facts, *read.number, *node) : std::nullopt;
    if (known && known->fromEntry)
      found.push_back(read);
  }
  return found;
}

void check(const FlowFacts &facts, const FileContext &context, const Reporter &reporter) {
  if (isTooLarge(facts) || isCalledAsSubprogram(facts) ||
      std::ranges::any_of(facts.file.model->variablesOf(facts.program), [&](const VariableUse &use) {
        return mayReadLocal(facts.file, use) && !tableBase(facts, use.expression);
      }))
    return;
  const auto header = headerCallOf(context, facts.program);
  if (!header)
    return;
  const std::vector<char> unread = unreadLetters(facts, context, *header);
  const std::vector<Read> others = otherReads(facts, context, *header);
  if (unread.size() != 1 || others.size() != 1) // several: the remark is of an older macro
    return;
  const Read &read = others.front();
  const char letter = unread.front();
  std::uint32_t own = 1;
  while (letterOfArgument(context.dialect, own) != letter)
    ++own;
  reporter.report({.message = fmt::format("{} is read here, and the remark passes {}, which no block reads",
                                          describeVariable(context.dialect, *read.number), letter),
                   .span = context.tree.expressions[read.expression].span,
                   .labels = {{header->comment, fmt::format("{} is passed in `#{}`", letter, own)}},
                   .notes = {fmt::format("read `#{}`, or correct the remark", own)}});
}

} // namespace

extern const Rule documentedArgumentUnread;
const Rule documentedArgumentUnread{
    .info = {"documented-argument-unread", Category::Flow, Severity::Warning,
             "Reports a macro that reads the variable of another letter than the call in its head shows."},
    .hooks = {.flow = check}};

} // namespace feedhold::rules::documented_argument_unread
