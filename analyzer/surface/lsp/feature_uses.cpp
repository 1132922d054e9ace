#include "surface/lsp/feature_uses.h"

#include "base/support/match.h"

#include <algorithm>

namespace feedhold::lsp {

namespace {

std::vector<Use> inOrder(std::vector<Use> uses) {
  std::sort(uses.begin(), uses.end());
  uses.erase(std::unique(uses.begin(), uses.end()), uses.end());
  return uses;
}

Span calleeSpanOf(const ProjectFile &file, const Call &call) {
  return call.programWord ? file.tree.words[*call.programWord].span() : call.span;
}

/// Words that give a local variable its first value.
void addPassed(const Project &programs, const VariableRef &variable, std::vector<Use> &uses) {
  if (!variable.scope)
    return;
  for (const CallGraph::Caller &caller : programs.set->callGraph().callers(*variable.scope)) {
    const ProjectFile &file = programs.file(caller.file);
    for (const Argument &argument : file.model.calls[caller.call].arguments)
      if (argument.variable == variable.number && argument.role == ArgumentRole::Passed)
        uses.push_back({caller.file, file.tree.words[argument.word].span(), UseRole::Definition});
  }
}

/// The clause that says what it holds on entry.
void addClause(const Project &programs, const VariableRef &variable, std::vector<Use> &uses) {
  for (std::size_t i = 0; i < programs.files.size(); ++i) {
    const FileContracts &contracts = programs.files[i]->contracts;
    for (const Contract &contract : contracts.contracts) {
      if (variable.scope && *variable.scope != ProgramRef{FileId(i), contract.program})
        continue;
      for (const auto *entries : {&contract.params, &contract.globals})
        for (const EntryValue &entry : *entries)
          if (entry.variable == variable.number && contracts.clauses[entry.clause].source == kProgramText)
            uses.push_back({FileId(i), entry.variableSpan, UseRole::Definition});
    }
  }
}

std::vector<Use> usesOfLoop(const Project &programs, const Loop &loop) {
  const SyntaxTree &tree = programs.file(kDocument).tree;
  std::vector<Use> uses{{kDocument, tree.statements[loop.doStatement].span, UseRole::Definition}};
  if (loop.endStatement)
    uses.push_back({kDocument, tree.statements[*loop.endStatement].span, UseRole::Reference});
  return uses;
}

std::vector<Use> usesOfConstruct(const Project &programs, const OWordUse &oWord) {
  const ProjectFile &file = programs.file(kDocument);
  std::vector<Use> uses;
  if (!oWord.construct)
    return uses;
  for (const OWordId part : file.model.constructs[*oWord.construct].parts)
    uses.push_back({kDocument, file.tree.statements[file.model.oWords[part].statement].span,
                    uses.empty() ? UseRole::Definition : UseRole::Reference});
  return uses;
}

} // namespace

std::vector<Use> usesOf(const Project &programs, const LabelRef &label) {
  const ProjectFile &file = programs.file(label.program.file);
  std::vector<Use> uses;
  for (const SequenceNumber &each : file.model.find(label.program.program, label.number))
    uses.push_back({label.program.file, file.tree.words[each.word].span(), UseRole::Definition});
  for (std::size_t i = 0; i < programs.files.size(); ++i)
    for (const Jump &jump : programs.files[i]->model.jumps) {
      if (targetNumber(jump) != label.number)
        continue;
      const std::vector<LabelRef> labels = labelsOf(programs, FileId(i), jump);
      if (std::find(labels.begin(), labels.end(), label) != labels.end())
        uses.push_back({FileId(i), jump.targetSpan, UseRole::Reference});
    }
  return inOrder(std::move(uses));
}

std::vector<Use> usesOf(const Project &programs, const VariableRef &variable) {
  std::vector<Use> uses;
  for (std::size_t i = 0; i < programs.files.size(); ++i) {
    if (variable.scope && variable.scope->file != FileId(i))
      continue;
    const ProjectFile &file = *programs.files[i];
    for (const VariableUse &use : file.model.variables)
      if ((!use.number || use.number == variable.number) && variableOf(programs, FileId(i), use) == variable)
        uses.push_back({FileId(i), file.tree.expressions[use.expression].span,
                        use.write ? UseRole::Definition : UseRole::Reference});
  }
  addPassed(programs, variable, uses);
  addClause(programs, variable, uses);
  return inOrder(std::move(uses));
}

std::vector<Use> usesOf(const Project &programs, ProgramRef program) {
  std::vector<Use> uses;
  const Program &named = programs.file(program.file).model.programs[program.program];
  if (!named.name.empty())
    uses.push_back({program.file, named.header, UseRole::Definition});
  for (const CallGraph::Caller &caller : programs.set->callGraph().callers(program)) {
    const ProjectFile &file = programs.file(caller.file);
    uses.push_back({caller.file, calleeSpanOf(file, file.model.calls[caller.call]), UseRole::Reference});
  }
  return inOrder(std::move(uses));
}

std::vector<Use> usesOf(const Project &programs, const ProgramSymbol &symbol) {
  const ProjectFile &file = programs.file(kDocument);
  return match(
      symbol,
      [&](const HeaderSymbol &it) {
        return usesOf(programs, ProgramRef{kDocument, it.program});
      },
      [&](const LabelSymbol &it) { return usesOf(programs, it.label); },
      [&](const JumpSymbol &it) {
        std::vector<Use> uses;
        for (const LabelRef &label : labelsOf(programs, kDocument, file.model.jumps[it.jump]))
          for (const Use &use : usesOf(programs, label))
            uses.push_back(use);
        return inOrder(std::move(uses));
      },
      [&](const CallSymbol &it) {
        const auto callee = programs.set->callGraph().callee(kDocument, file.model.calls[it.call]);
        return callee ? usesOf(programs, *callee) : std::vector<Use>();
      },
      [&](const ArgumentSymbol &it) {
        const auto callee = programs.set->callGraph().callee(kDocument, file.model.calls[it.call]);
        return callee && it.argument.variable != 0
                   ? usesOf(programs, variableOf(programs, *callee, it.argument.variable))
                   : std::vector<Use>();
      },
      [&](const VariableSymbol &it) {
        const auto variable = variableOf(programs, kDocument, it.use);
        return variable ? usesOf(programs, *variable) : std::vector<Use>();
      },
      [&](const LoopSymbol &it) { return usesOfLoop(programs, file.model.loops[it.loop]); },
      [&](const OWordSymbol &it) { return usesOfConstruct(programs, file.model.oWords[it.oWord]); },
      [](const CodeSymbol &) { return std::vector<Use>(); }, [](const WordSymbol &) { return std::vector<Use>(); },
      [](const ClauseSymbol &) { return std::vector<Use>(); });
}

} // namespace feedhold::lsp
