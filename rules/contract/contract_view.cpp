#include "rules/contract/contract_view.h"

#include <fmt/format.h>

namespace feedhold::rules {

std::string programOf(const ContractIssue &issue, const FileContext &context) {
  const std::string name = issue.program ? toString(context.model.programs[*issue.program].name) : std::string();
  return name.empty() ? "the program" : name;
}

void pointAt(ClauseId id, std::string label, const FileContext &context, Diagnostic &diagnostic) {
  const FileContracts &contracts = *context.contracts[context.file.index()];
  const Clause &clause = contracts.clauses[id];
  if (clause.source == context.contractSource) {
    diagnostic.labels.push_back({clause.span, std::move(label)});
    return;
  }
  const SourceFile &source = contracts.source(clause.source);
  diagnostic.notes.push_back(fmt::format("{}: {} line {}", label, source.path(), source.lineOf(clause.span.begin)));
}

void pointAtContract(ClauseId id, FileId callee, const FileContext &context, Diagnostic &diagnostic) {
  const FileContracts &contracts = *context.contracts[callee.index()];
  const Clause &clause = contracts.clauses[id];
  if (clause.source == kProgramText)
    diagnostic.labels.push_back({clause.span, "the contract", callee});
  else
    diagnostic.notes.push_back(
        fmt::format("the contract says `{}` ({})", clause.text, contracts.source(clause.source).path()));
  diagnostic.notes.push_back("the macro is proved only for the calls that its contract allows");
}

} // namespace feedhold::rules
