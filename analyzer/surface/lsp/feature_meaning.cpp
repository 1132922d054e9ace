#include "surface/lsp/feature_meaning.h"

#include "base/support/text.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>

namespace feedhold::lsp {

namespace {

/// Without its parentheses.
std::string textOf(const ProjectFile &file, const Comment &comment) {
  std::string text = file.source.utf8(comment.span);
  if (text.starts_with('(') || text.starts_with(';'))
    text.erase(0, 1);
  if (comment.closed && text.ends_with(')'))
    text.pop_back();
  return std::string(trimmed(text));
}

bool isClause(std::string_view comment) { return comment.starts_with('@'); }

/// `T-SLOT` is one word.
std::size_t findSign(std::string_view comment) {
  for (std::size_t at = 0; at < comment.size(); ++at) {
    const bool isApart = at > 0 && isBlank(comment[at - 1]) && at + 1 < comment.size() && isBlank(comment[at + 1]);
    if (comment[at] == '=' || comment[at] == ':' || (comment[at] == '-' && isApart))
      return at;
  }
  return std::string_view::npos;
}

/// `#21 = DEPTH`, `U - DEPTH`, `U(#21): DEPTH`: what stands behind the sign, when the comment is about the variable.
std::optional<std::string> saidOf(std::string_view comment, std::uint32_t variable, std::optional<char> letter) {
  const std::size_t sign = findSign(comment);
  if (sign == std::string_view::npos || sign == 0)
    return std::nullopt;
  const std::string_view head = trimmed(comment.substr(0, sign));
  const std::string_view said = trimmed(comment.substr(sign + 1));
  const std::string number = fmt::format("#{}", variable);
  const bool isLetter = letter && !head.empty() && toUpper(head.front()) == *letter &&
                        (head.size() == 1 || head.substr(1).find(number) != std::string_view::npos);
  if (said.empty() || !(isLetter || head == number))
    return std::nullopt;
  return std::string(said);
}

/// The comment in the block of the first assignment, when the block does nothing else.
std::optional<std::string> saidBesideAssignment(const ProjectFile &file, ProgramId program, std::uint32_t variable) {
  for (const VariableUse &use : file.model.variablesOf(program)) {
    if (!use.write || use.number != variable)
      continue;
    const auto comments = file.tree.commentsOf(use.block);
    if (comments.size() != 1 || file.tree.statementsOf(use.block).size() != 1)
      return std::nullopt;
    const std::string text = textOf(file, comments.front());
    return text.empty() || isClause(text) ? std::nullopt : std::optional(text);
  }
  return std::nullopt;
}

const EntryValue *entryOf(const ProjectFile &file, ProgramId program, std::uint32_t variable) {
  const Contract *contract = file.contracts.of(program);
  if (!contract)
    return nullptr;
  for (const auto *entries : {&contract->params, &contract->globals})
    for (const EntryValue &entry : *entries)
      if (entry.variable == variable)
        return &entry;
  return nullptr;
}

} // namespace

std::string nameOf(const Project &programs, ProgramRef program) {
  const std::string name = toString(programs.file(program.file).model.programs[program.program].name);
  return name.empty() ? "this program" : name;
}

std::string titleOf(const ProjectFile &file, ProgramId program) {
  const Program &named = file.model.programs[program];
  if (named.name.empty())
    return {};
  for (const Comment &comment : file.tree.commentsOf(file.tree.blockAt(named.header.begin)))
    if (const std::string text = textOf(file, comment); comment.span.begin >= named.header.end && !isClause(text))
      return text;
  return {};
}

std::string meaningOf(const Project &programs, ProgramRef program, std::uint32_t variable) {
  const ProjectFile &file = programs.file(program.file);
  if (const EntryValue *entry = entryOf(file, program.program, variable); entry && !entry->name.empty())
    return entry->name;
  const VariableRange *range = findVariable(programs.dialect(), variable);
  if (variable >= kFirstNamedVariable || !range || range->kind == VariableKind::System)
    return {}; // its name, or the table of the control, says it
  const Program &named = file.model.programs[program.program];
  const auto letter = letterOf(programs.dialect(), variable);
  for (BlockId block = named.first; block < named.last && block.index() < file.tree.blockCount(); block = block.next())
    for (const Comment &comment : file.tree.commentsOf(block))
      if (auto said = saidOf(textOf(file, comment), variable, letter))
        return *said;
  return saidBesideAssignment(file, program.program, variable).value_or("");
}

std::string clauseOf(const Project &programs, ProgramRef program, std::uint32_t variable) {
  const FileContracts &contracts = programs.file(program.file).contracts;
  const EntryValue *entry = entryOf(programs.file(program.file), program.program, variable);
  return entry ? contracts.clauses[entry->clause].text : "";
}

std::optional<char> letterOf(const Dialect &dialect, std::uint32_t variable) {
  const auto &letters = dialect.argumentVariables;
  const auto found = std::find(letters.begin(), letters.end(), variable);
  if (variable == 0 || found == letters.end())
    return std::nullopt;
  return static_cast<char>('A' + (found - letters.begin()));
}

std::string kindOf(const Project &programs, std::uint32_t variable) {
  if (variable >= kFirstNamedVariable)
    return programs.set->isGlobalName(variable) ? "global named variable" : "local named variable";
  const VariableRange *range = findVariable(programs.dialect(), variable);
  if (!range)
    return fmt::format("does not exist on {}", programs.dialect().title);
  std::string text(range->meaning);
  if (const auto letter = letterOf(programs.dialect(), variable))
    text += fmt::format(", argument {}", *letter);
  if (!range->name.empty())
    text = fmt::format("`{}` {}", range->name, text);
  if (range->access == VariableAccess::ReadOnly)
    text += ", read-only";
  if (range->access == VariableAccess::WriteOnly)
    text += ", write-only";
  if (range->option == VariableOption::Optional)
    text += ", optional";
  return text;
}

std::string_view helpOf(ClauseKind kind) {
  switch (kind) {
  case ClauseKind::Param: return "an argument and its local variable: name, range, unit";
  case ClauseKind::Global: return "the value of a common variable on entry: name, range, unit";
  case ClauseKind::Require: return "a condition that must hold on entry";
  case ClauseKind::Modal: return "the G and M codes active on entry";
  case ClauseKind::Start: return "the tool position on entry";
  case ClauseKind::Tool: return "the shape and radius of the tool";
  case ClauseKind::Offset:
    return "what an offset holds: the radius of a D, for G41 and G42, or the zero point of G54 to G59";
  case ClauseKind::Length: return "the tool length that an H holds, for G43 and G44";
  case ClauseKind::Machine: return "the range of the axes in machine coordinates, and the reference position";
  case ClauseKind::Corner: return "how far the tool leaves the programmed path where the machine rounds corners";
  case ClauseKind::Fixed: return "regions and tool are the same at every angle of these axes";
  case ClauseKind::KeepIn: return "during cutting moves, the whole tool stays inside this region";
  case ClauseKind::KeepOut: return "the tool never enters this region";
  case ClauseKind::Clearance: return "rapid moves stay at or above this height";
  case ClauseKind::Travel: return "no programmed point is outside this range";
  case ClauseKind::Limit: return "the permitted feedrate or spindle speed while cutting";
  case ClauseKind::Ensure: return "a condition that holds whenever the program returns";
  case ClauseKind::Tolerance: return "how far numbers may differ that a promise calls equal";
  case ClauseKind::Assigns: return "the program writes no common variables but these";
  case ClauseKind::Guarded: return "a call that violates the contract raises an alarm before the first motion";
  case ClauseKind::Alarm: return "the calls that raise an alarm";
  case ClauseKind::Invariant: return "a condition that holds at the start of every iteration of the loop at this block";
  case ClauseKind::Variant: return "a value that falls at every iteration of the loop at this block";
  case ClauseKind::Eventually: return "an input that the program waits for comes in the end";
  case ClauseKind::Cyclic: return "the program is meant to run forever";
  }
  return "";
}

std::uint32_t lineOf(const ProjectFile &file, BlockId block) {
  return file.source.lineOf(file.tree.blocks[block].begin);
}

} // namespace feedhold::lsp
