// Who calls a program, and whom it calls.
#include "base/source/path_text.h"
#include "base/support/match.h"
#include "surface/lsp/feature_handlers.h"
#include "surface/lsp/feature_json.h"
#include "surface/lsp/feature_meaning.h"

#include <map>

namespace feedhold::lsp {

namespace {

constexpr int kFunctionSymbol = 12; // SymbolKind

Json itemOf(const View &view, ProgramRef program) {
  const ProjectFile &file = view.programs->file(program.file);
  const std::string title = titleOf(file, program.program);
  const std::string folder = pathText(file.path.filename());
  return {{"name", nameOf(*view.programs, program)},
          {"kind", kFunctionSymbol},
          {"detail", title.empty() ? folder : title + ", " + folder},
          {"uri", view.uriOf(program.file)},
          {"range", rangeOf(view, program.file, spanOf(file, program.program))},
          {"selectionRange", rangeOf(view, program.file, nameSpanOf(file, program.program))}};
}

/// The program that an item of ours stands for; absent when the text has changed since.
std::optional<ProgramRef> programOf(const View &view, const Json &item) {
  const std::string uri = item.at("uri").get<std::string>();
  for (std::size_t i = 0; i < view.programs->files.size(); ++i) {
    if (view.uriOf(FileId(i)) != uri)
      continue;
    const ProjectFile &file = *view.programs->files[i];
    const std::uint32_t offset = view.places(FileId(i)).offset(item.at("selectionRange").at("start"));
    for (std::size_t p = 0; p < file.model.programs.size(); ++p)
      if (nameSpanOf(file, ProgramId(p)).begin == offset)
        return ProgramRef{FileId(i), ProgramId(p)};
  }
  return std::nullopt;
}

/// By the program at the other end: the spans of the calls.
using Calls = std::map<ProgramRef, std::vector<Json>>;

Json listed(const View &view, const Calls &calls, const char *end) {
  Json found = Json::array();
  for (const auto &[program, ranges] : calls)
    found.push_back({{end, itemOf(view, program)}, {"fromRanges", ranges}});
  return found;
}

} // namespace

Json prepareCallHierarchy(const View &view, const Json &params) {
  const auto at = symbolAt(view, params);
  if (!at)
    return nullptr;
  if (const auto *header = std::get_if<HeaderSymbol>(&at->symbol))
    return Json::array({itemOf(view, {kDocument, header->program})});
  const auto *call = std::get_if<CallSymbol>(&at->symbol);
  const auto callee =
      call ? view.programs->set->callGraph().callee(kDocument, view.file().model.calls[call->call]) : std::nullopt;
  return callee ? Json::array({itemOf(view, *callee)}) : Json();
}

Json incomingCalls(const View &document, const Json &params) {
  const View view = withFolder(document);
  const auto program = programOf(view, params.at("item"));
  if (!program)
    return nullptr;
  Calls calls;
  for (const CallGraph::Caller &caller : view.programs->set->callGraph().callers(*program)) {
    const Call &call = view.programs->file(caller.file).model.calls[caller.call];
    calls[{caller.file, call.caller}].push_back(rangeOf(view, caller.file, call.span));
  }
  return listed(view, calls, "from");
}

Json outgoingCalls(const View &view, const Json &params) {
  const auto program = programOf(view, params.at("item"));
  if (!program)
    return nullptr;
  Calls calls;
  for (const Call &call : view.programs->file(program->file).model.callsOf(program->program))
    if (const auto callee = view.programs->set->callGraph().callee(program->file, call);
        callee && call.caller == program->program)
      calls[*callee].push_back(rangeOf(view, program->file, call.span));
  return listed(view, calls, "to");
}

} // namespace feedhold::lsp
