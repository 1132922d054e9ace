// Variables under another number or name.
#include "base/support/text.h"
#include "surface/lsp/feature_meaning.h"
#include "surface/lsp/feature_rename.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>

namespace feedhold::lsp {

namespace {

bool isNamed(const VariableRef &variable) { return variable.number >= kFirstNamedVariable; }

/// The programs of the variable's scope.
template <typename Act> void eachProgram(const Project &programs, const VariableRef &variable, Act act) {
  if (variable.scope)
    return act(*variable.scope);
  for (std::size_t i = 0; i < programs.files.size(); ++i)
    for (std::size_t p = 0; p < programs.files[i]->model.programs.size(); ++p)
      act(ProgramRef{FileId(i), ProgramId(p)});
}

// ---- contracts ----

struct Mention {
  FileId file;
  ContractSourceId source;
  Span span; // `#21`, `#<depth>`
};

/// The end of `#21`, `# 021`, `#<depth>` at `at`, when it is the variable.
std::optional<std::size_t> endOfMention(const Project &programs, const VariableRef &variable, std::string_view text,
                                        std::size_t at) {
  std::size_t begin = at + 1;
  while (begin < text.size() && isBlank(text[begin]))
    ++begin;
  if (isNamed(variable)) {
    const std::size_t end = text.find('>', begin);
    const bool isName = begin < text.size() && text[begin] == '<' && end != std::string_view::npos;
    const std::string name = "#<" + (isName ? comparedName(text.substr(begin + 1, end - begin - 1)) : "") + ">";
    return isName && name == programs.set->nameOfVariable(variable.number) ? std::optional(end + 1) : std::nullopt;
  }
  std::uint32_t number = 0;
  const auto [end, error] = std::from_chars(text.data() + begin, text.data() + text.size(), number);
  if (begin >= text.size() || error != std::errc() || number != variable.number)
    return std::nullopt;
  return static_cast<std::size_t>(end - text.data());
}

std::vector<Mention> mentionsInContracts(const Project &programs, const VariableRef &variable) {
  std::vector<Mention> found;
  for (std::size_t i = 0; i < programs.files.size(); ++i) {
    const FileContracts &contracts = programs.files[i]->contracts;
    for (const Clause &clause : contracts.clauses) {
      if (variable.scope && *variable.scope != ProgramRef{FileId(i), clause.program})
        continue;
      const std::string_view text = contracts.source(clause.source).text(clause.span);
      for (std::size_t at = text.find('#'); at != std::string_view::npos; at = text.find('#', at + 1))
        if (const auto end = endOfMention(programs, variable, text, at))
          found.push_back({FileId(i),
                           clause.source,
                           {clause.span.begin + static_cast<std::uint32_t>(at),
                            clause.span.begin + static_cast<std::uint32_t>(*end)}});
    }
  }
  return found;
}

void checkNoRangeHolds(const Project &programs, const VariableRef &variable) {
  for (const auto &file : programs.files)
    for (const Contract &contract : file->contracts.contracts)
      for (const Assigns &assigns : contract.assigns)
        for (const Assigns::Variables &range : assigns.variables)
          if (!isNamed(variable) && range.first != range.last && range.first <= variable.number &&
              variable.number <= range.last)
            throw Refused(fmt::format("a contract in {} names the variable as part of a range: `{}`", file->shown,
                                      file->contracts.clauses[assigns.clause].text));
}

// ---- what may reach it indirectly ----

void checkNothingIsComputed(const Project &programs, const VariableRef &variable) {
  eachProgram(programs, variable, [&](ProgramRef program) {
    const ProjectFile &file = programs.file(program.file);
    for (const VariableUse &use : file.model.variablesOf(program.program))
      if (std::holds_alternative<IndirectVariable>(file.tree.expressions[use.expression].node))
        throw Refused(fmt::format("line {} of {} computes a variable number, which may be the number of this variable",
                                  lineOf(file, use.block), file.shown));
  });
}

void checkHasNoOtherName(const Project &programs, const VariableRef &variable) {
  for (const auto &file : programs.files)
    for (const Statement &statement : file->tree.statements) {
      const auto *naming = std::get_if<NameVariables>(&statement.node);
      if (naming && !variable.scope && !isNamed(variable))
        throw Refused(fmt::format("SETVN in line {} of {} assigns names to variables by number",
                                  file->source.lineOf(statement.span.begin), file->shown));
    }
}

bool sharesLocals(const Project &programs, const Call &call, const ProjectFile &file) {
  switch (call.kind) {
  case CallKind::Subprogram:
  case CallKind::External: return true;
  case CallKind::Code: {
    const Word &word = file.tree.words[call.code];
    const CodeCall *row = findCodeCall(programs.dialect(), word.address(), word.tenths().value_or(0));
    return !row || !row->isMacro;
  }
  case CallKind::Macro:
  case CallKind::Modal:
  case CallKind::ModalEach:
  case CallKind::ModalCancel:
  case CallKind::MacroA:
  case CallKind::Local:
  case CallKind::OWord: return false;
  }
  return false;
}

/// Programs called by M98 work on the locals of their caller.
void checkLocalsAreItsOwn(const Project &programs, ProgramRef program) {
  const ProjectFile &file = programs.file(program.file);
  for (const Call &call : file.model.callsOf(program.program))
    if (sharesLocals(programs, call, file))
      throw Refused(
          fmt::format("the program called in line {} uses the same local variables", lineOf(file, call.block)));
  for (const CallGraph::Caller &caller : programs.set->callGraph().callers(program)) {
    const ProjectFile &from = programs.file(caller.file);
    const Call &call = from.model.calls[caller.call];
    if (sharesLocals(programs, call, from))
      throw Refused(fmt::format("line {} of {} calls this program, which then uses the local variables of its caller",
                                lineOf(from, call.block), from.shown));
  }
}

/// It is written before anything reads it, so that no caller gives it its value.
bool isWrittenFirst(const ProjectFile &file, ProgramId program, std::uint32_t variable) {
  const auto uses = file.model.variablesOf(program);
  std::optional<BlockId> first;
  for (const VariableUse &use : uses)
    if (use.number == variable && (!first || use.block < *first))
      first = use.block;
  if (!first || file.tree.blocks[*first].has(Block::kSkip) || file.tree.blocks[*first].has(Block::kSkipInside))
    return false;
  const auto jumps = file.model.jumpsOf(program);
  if (std::any_of(jumps.begin(), jumps.end(), [&](const Jump &jump) { return jump.block <= *first; }))
    return false;
  std::size_t inBlock = 0;
  for (const VariableUse &use : file.model.variablesIn(*first, first->next()))
    inBlock += use.number == variable ? 1 : 0;
  for (const Statement &statement : file.tree.statementsOf(*first)) {
    const auto *assignment = std::get_if<Assignment>(&statement.node);
    if (assignment && !statement.nested && variableNumber(file.tree, assignment->target) == variable)
      return inBlock == 1;
  }
  return false;
}

void checkNoCallerGivesIt(const Project &programs, const VariableRef &variable) {
  const ProjectFile &file = programs.file(variable.scope->file);
  const Program &program = file.model.programs[variable.scope->program];
  const bool isCalled = program.returns || programs.set->callGraph().isCalled(*variable.scope);
  if (isNamed(variable) || !isCalled || isWrittenFirst(file, variable.scope->program, variable.number))
    return;
  const auto letter = letterOf(programs.dialect(), variable.number);
  throw Refused(fmt::format("`#{}`{} may hold an argument of the call: all calls would have to change as well",
                            variable.number, letter ? fmt::format(" (argument {})", *letter) : ""));
}

// ---- the new name ----

VariableRef newVariable(const Project &programs, const VariableRef &old, std::string_view name) {
  std::string_view digits = trimmed(name);
  if (digits.starts_with('#'))
    digits.remove_prefix(1);
  std::uint32_t number = 0;
  const char *end = digits.data() + digits.size();
  const auto [at, error] = std::from_chars(digits.data(), end, number);
  if (digits.empty() || error != std::errc() || at != end)
    throw Refused(fmt::format("`{}` is not a variable: write `#105` or `105`", name));
  const VariableRange *from = findVariable(programs.dialect(), old.number);
  const VariableRange *to = findVariable(programs.dialect(), number);
  if (!to || to->kind != from->kind)
    throw Refused(fmt::format("`#{}` is {}; `#{}` is {}", old.number, kindOf(programs, old.number), number,
                              to ? kindOf(programs, number) : "not a variable of this control"));
  return {number, old.scope};
}

/// `#<depth>` out of `depth`, `<depth>` or `#<depth>`.
std::string newNameOf(const Project &programs, const VariableRef &old, std::string_view name) {
  std::string_view bare = trimmed(name);
  for (const std::string_view sign : {"#", "<"})
    if (bare.starts_with(sign))
      bare.remove_prefix(1);
  if (bare.ends_with('>'))
    bare.remove_suffix(1);
  const bool isPlain = !bare.empty() && bare.find_first_of("<>()#[] \t") == std::string_view::npos;
  if (!isPlain || bare.starts_with('_') != programs.set->isGlobalName(old.number))
    throw Refused(fmt::format(
        "`{}` is not a valid name: names contain no spaces or brackets, and only global names begin with `_`", name));
  if (programs.set->variableNamed(comparedName(bare)))
    throw Refused(fmt::format("`#<{}>` is already in use", bare));
  return fmt::format("#<{}>", bare);
}

} // namespace

void checkVariableCanChange(const View &view, const VariableRef &variable) {
  const Project &programs = *view.programs;
  const VariableRange *range = isNamed(variable) ? nullptr : findVariable(programs.dialect(), variable.number);
  const bool isOurs =
      isNamed(variable) || (range && (range->kind == VariableKind::Local || range->kind == VariableKind::Common ||
                                      range->kind == VariableKind::Retentive));
  if (!isOurs)
    throw Refused(
        fmt::format("`#{}` is not a variable of the program: {}", variable.number, kindOf(programs, variable.number)));
  if (!isNamed(variable))
    checkNothingIsComputed(programs, variable);
  checkHasNoOtherName(programs, variable);
  checkNoRangeHolds(programs, variable);
  if (variable.scope) {
    checkNoCallerGivesIt(programs, variable);
    if (!isNamed(variable))
      checkLocalsAreItsOwn(programs, *variable.scope);
  }
}

void renameVariable(const View &view, const VariableRef &variable, std::string_view newName, Edits &edits) {
  const Project &programs = *view.programs;
  checkVariableCanChange(view, variable);
  std::string text;
  if (isNamed(variable)) {
    text = newNameOf(programs, variable, newName);
  } else {
    const VariableRef to = newVariable(programs, variable, newName);
    if (to == variable)
      return;
    const std::vector<Use> taken = usesOf(programs, to);
    if (!taken.empty() || !mentionsInContracts(programs, to).empty())
      throw Refused(fmt::format(
          "`#{}` is already in use{}", to.number,
          taken.empty() ? " in a contract"
                        : fmt::format(" in line {} of {}",
                                      programs.file(taken.front().file).source.lineOf(taken.front().span.begin),
                                      programs.file(taken.front().file).shown)));
    text = fmt::format("#{}", to.number);
  }
  for (const Use &use : usesOf(programs, variable))
    if (programs.file(use.file).source.text(use.span).starts_with('#')) // not the word of a caller
      edits.replace(use.file, use.span, text);
  for (const Mention &mention : mentionsInContracts(programs, variable))
    edits.replace(mention.file, mention.source, mention.span, text);
}

} // namespace feedhold::lsp
