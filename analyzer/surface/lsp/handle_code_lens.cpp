// What has been proved of each program, above its O word.
#include "surface/lsp/feature_handlers.h"
#include "surface/lsp/feature_json.h"
#include "surface/lsp/feature_meaning.h"
#include "surface/sink/prove_shown.h"

#include <fmt/format.h>

#include <algorithm>

namespace feedhold::lsp {

namespace {

struct Lens {
  std::string title;
  std::string command;
  Json argument;
};

/// The rounding of the control, programs that are not in the files, or the number of passes may break it.
bool isConditional(const prove::Obligation &obligation) {
  return obligation.verdict.exactOnly() || !assumedIn(obligation).empty();
}

/// `12 proved (2 on a condition), 1 refuted: run witness`
Lens lensOf(const DocumentProof &proved, Json argument) {
  std::size_t held = 0, conditional = 0, refuted = 0, unknown = 0;
  const prove::Obligation *shown = nullptr;
  for (const prove::Obligation &obligation : proved.proof.obligations)
    switch (obligation.verdict.kind()) {
    case prove::Verdict::Proved:
    case prove::Verdict::Unreachable:
      ++held;
      conditional += isConditional(obligation) ? 1U : 0U;
      break;
    case prove::Verdict::Unknown: ++unknown; break;
    case prove::Verdict::Refuted:
      ++refuted;
      shown = shown || !obligation.verdict.witness() ? shown : &obligation;
      break;
    }
  const std::string proofs =
      conditional == 0 ? std::string("proved") : fmt::format("proved ({} on a condition)", conditional);
  std::string title;
  for (const auto &[count, word] :
       {std::pair<std::size_t, std::string_view>{held, proofs}, {refuted, "refuted"}, {unknown, "unknown"}})
    if (count != 0)
      title += fmt::format("{}{} {}", title.empty() ? "" : ", ", count, word);
  if (proved.proof.incomplete)
    title += ", not all paths explored";
  if (!shown)
    return {title, "feedhold.prove", std::move(argument)};
  argument["obligation"] = shown->id;
  return {title + ": run witness", "feedhold.runWitness", std::move(argument)};
}

} // namespace

Json codeLens(const View &view, const Json &) {
  Json found = Json::array();
  for (std::size_t i = 0; i < view.file().model.programs.size(); ++i) {
    const ProgramId program(i);
    const Json argument{{"uri", view.uri}, {"program", toString(view.file().model.programs[program].name)}};
    std::optional<Lens> lens;
    if (view.file().contracts.of(program))
      lens = Lens{"prove", "feedhold.prove", argument};
    if (view.proofs)
      for (const DocumentProof &proved : *view.proofs)
        if (proved.program == program && !proved.proof.obligations.empty())
          lens = lensOf(proved, argument);
    if (lens)
      found.push_back(
          {{"range", rangeOf(view, kDocument, nameSpanOf(view.file(), program))},
           {"command",
            {{"title", lens->title}, {"command", lens->command}, {"arguments", Json::array({lens->argument})}}}});
  }
  return found;
}

} // namespace feedhold::lsp
