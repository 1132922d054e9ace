// tool-only-in-comment: `(T0202 - BORING BAR)` in a program of a lathe that has no T word.
#include "findings/rule/rule.h"

#include "base/support/text.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <string>
#include <string_view>

namespace feedhold::rules::tool_only_in_comment {
namespace {

/// `T0202`: a tool and its offset, as a word of the turret has it.
std::optional<std::string> toolIn(std::string_view comment) {
  for (std::size_t at = 0; at + 4 < comment.size(); ++at) {
    const bool isWord =
        toUpper(comment[at]) == 'T' && (at == 0 || !(isLetter(comment[at - 1]) || isDigit(comment[at - 1])));
    const std::string_view digits = comment.substr(at + 1, 4);
    const bool ends = at + 5 >= comment.size() || !(isLetter(comment[at + 5]) || isDigit(comment[at + 5]));
    if (isWord && ends && std::ranges::all_of(digits, isDigit) && digits.substr(0, 2) == digits.substr(2, 2))
      return "T" + std::string(digits);
  }
  return std::nullopt;
}

/// What a program has of tools and cuts.
struct Found {
  const Comment *comment = nullptr; // the first that names a tool
  std::string tool;
  bool hasTool = false; // a T word
  bool cuts = false;
  bool ends = false; // M02, M30
};

Found findIn(ProgramId program, const FileContext &context) {
  Found found;
  const Program &its = context.model.programs[program];
  for (BlockId block = its.first; block < its.last; block = block.next()) {
    for (const Comment &comment : context.tree.commentsOf(block))
      if (auto tool = found.comment ? std::nullopt : toolIn(context.text(comment.span))) {
        found.comment = &comment;
        found.tool = std::move(*tool);
      }
    found.hasTool = found.hasTool || findWord(context.tree, block, 'T');
    found.cuts = found.cuts || findAction(context.tree, block, context.dialect, {CodeAction::Linear}) ||
                 findTurningCycle(context.tree, block, context.dialect);
    found.ends = found.ends || findCode(context.tree, block, context.dialect, CodeRole::ProgramEnd);
  }
  return found;
}

void check(ProgramId program, const FileContext &context, const Reporter &reporter) {
  if (context.dialect.machine != MachineKind::Turning || !context.model.callsOf(program).empty())
    return;
  const Found found = findIn(program, context);
  if (!found.comment || found.hasTool || !found.cuts || !found.ends)
    return;
  reporter.report({.message = fmt::format("the program never calls {}: only this comment names it", found.tool),
                   .span = found.comment->span,
                   .notes = {"the part is cut with the tool that the turret happens to have, and with its offset",
                             fmt::format("write `{}` in a block of its own before the first move", found.tool)}});
}

} // namespace

extern const Rule toolOnlyInComment;
const Rule toolOnlyInComment{
    .info = {"tool-only-in-comment", Category::Comment, Severity::Warning,
             "Reports a program of a lathe that cuts, has no `T` word, and names a tool in a comment."},
    .hooks = {.program = check}};

} // namespace feedhold::rules::tool_only_in_comment
