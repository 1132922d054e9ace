// The arguments of the macro that is being called.
#include "surface/lsp/feature_arguments.h"
#include "surface/lsp/feature_handlers.h"
#include "surface/lsp/feature_meaning.h"

#include <fmt/format.h>

#include <algorithm>

namespace feedhold::lsp {

namespace {

/// The parameter of the word that holds the offset, or ends there; else the first one that is not passed yet.
std::size_t activeOf(const View &view, const Call &call, const std::vector<Parameter> &parameters,
                     std::uint32_t offset) {
  std::size_t next = parameters.size();
  for (std::size_t i = parameters.size(); i-- > 0;) {
    const auto passed = std::find_if(call.arguments.begin(), call.arguments.end(), [&](const Argument &argument) {
      return argument.variable == parameters[i].variable;
    });
    if (passed == call.arguments.end()) {
      next = i;
      continue;
    }
    const Span span = view.file().tree.words[passed->word].span();
    if (span.begin < offset && offset <= span.end)
      return i;
  }
  return next;
}

} // namespace

Json signatureHelp(const View &view, const Json &params) {
  const std::uint32_t offset = offsetOf(view, params);
  const auto at = macroCallAt(*view.programs, offset);
  if (!at)
    return nullptr;
  const std::vector<Parameter> parameters = parametersOf(*view.programs, at->callee);
  const ProjectFile &callee = view.programs->file(at->callee.file);
  std::string label = view.file().source.utf8(at->call->span);
  Json shown = Json::array();
  for (const Parameter &parameter : parameters) {
    const std::string text = parameter.name.empty() ? std::string(1, parameter.letter)
                                                    : fmt::format("{}<{}>", parameter.letter, parameter.name);
    label += " " + text;
    Json each{{"label", text}};
    if (!parameter.clause.empty())
      each["documentation"] = markdown(fmt::format("`{}`", parameter.clause));
    shown.push_back(std::move(each));
  }
  const std::string title = titleOf(callee, at->callee.program);
  Json signature{{"label", label}, {"parameters", shown}};
  signature["documentation"] = nameOf(*view.programs, at->callee) + (title.empty() ? "" : " " + title);
  return {{"signatures", Json::array({signature})},
          {"activeSignature", 0},
          {"activeParameter", activeOf(view, *at->call, parameters, offset)}};
}

} // namespace feedhold::lsp
