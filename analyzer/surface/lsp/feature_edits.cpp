#include "surface/lsp/feature_edits.h"

namespace feedhold::lsp {

void Edits::replace(FileId file, Span span, const std::string &text) {
  edits_[view_.uriOf(file)][span] = {{"range", rangeOf(view_, file, span)}, {"newText", text}};
}

void Edits::replace(FileId file, ContractSourceId source, Span span, const std::string &text) {
  if (source == kProgramText)
    return replace(file, span, text);
  const SourceFile &contract = view_.programs->file(file).contracts.source(source);
  edits_[view_.uris->of(contract.path())][span] = {{"range", Places(contract, view_.encoding).range(span)},
                                                   {"newText", text}};
}

Json Edits::workspaceEdit() const {
  Json changes = Json::object();
  for (const auto &[uri, edits] : edits_)
    for (const auto &[span, edit] : edits)
      changes[uri].push_back(edit);
  return {{"changes", changes}};
}

} // namespace feedhold::lsp
