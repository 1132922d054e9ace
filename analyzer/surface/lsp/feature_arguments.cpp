#include "surface/lsp/feature_arguments.h"

#include "surface/lsp/feature_meaning.h"

#include <algorithm>
#include <set>

namespace feedhold::lsp {

std::vector<Parameter> parametersOf(const Project &programs, ProgramRef program) {
  const ProjectFile &file = programs.file(program.file);
  std::set<std::uint32_t> variables;
  std::set<std::uint32_t> own; // written before anything reads them
  const Contract *contract = file.contracts.of(program.program);
  if (contract && !contract->params.empty()) {
    for (const EntryValue &param : contract->params)
      variables.insert(param.variable);
  } else {
    for (const VariableUse &use : file.model.variablesOf(program.program))
      if (use.number && !own.contains(*use.number) && !variables.contains(*use.number))
        (use.write ? own : variables).insert(*use.number);
  }
  std::vector<Parameter> found;
  for (const std::uint32_t variable : variables)
    if (const auto letter = letterOf(programs.dialect(), variable))
      found.push_back(
          {*letter, variable, meaningOf(programs, program, variable), clauseOf(programs, program, variable)});
  std::sort(found.begin(), found.end(), [](const Parameter &a, const Parameter &b) { return a.letter < b.letter; });
  return found;
}

std::optional<CallAtPlace> macroCallAt(const Project &programs, std::uint32_t offset) {
  const ProjectFile &file = programs.file(kDocument);
  const std::uint32_t line = file.source.lineOf(offset);
  const BlockId block = file.tree.blockAt(file.source.lineSpan(line).begin);
  for (const Call &call : file.model.callsIn(block, block.next())) {
    const bool passes = call.kind == CallKind::Macro || call.kind == CallKind::Modal ||
                        call.kind == CallKind::ModalEach || call.kind == CallKind::Code;
    const auto callee = programs.set->callGraph().callee(kDocument, call);
    if (passes && callee && file.tree.words[call.code].span().begin < offset)
      return CallAtPlace{&call, *callee};
  }
  return std::nullopt;
}

} // namespace feedhold::lsp
