// Other names for sequence numbers and variables, and new sequence numbers throughout.
#include "base/support/match.h"
#include "surface/lsp/feature_handlers.h"
#include "surface/lsp/feature_meaning.h"
#include "surface/lsp/feature_rename.h"

#include <fmt/format.h>

#include <array>
#include <optional>

namespace feedhold::lsp {

namespace {

struct Renamed {
  std::variant<LabelRef, VariableRef> name;
  Span span;
};

LabelRef onlyLabel(const Project &programs, const Jump &jump) {
  const auto labels = labelsOf(programs, kDocument, jump);
  if (labels.empty())
    throw Refused("the jump target is computed and may be any sequence number of the program");
  if (labels.size() > 1)
    throw Refused("this block returns to several programs, so the number must stay the same in all of them");
  return labels.front();
}

Renamed namedAt(const View &view, const Json &params) {
  constexpr std::string_view kNothing = "only sequence numbers and variables can be renamed";
  const auto at = symbolAt(view, params);
  if (!at)
    throw Refused(std::string(kNothing));
  if (const auto *label = std::get_if<LabelSymbol>(&at->symbol))
    return {label->label, at->span};
  if (const auto *jump = std::get_if<JumpSymbol>(&at->symbol)) {
    const Jump &from = view.file().model.jumps[jump->jump];
    return {onlyLabel(*view.programs, from), from.targetSpan};
  }
  const auto *variable = std::get_if<VariableSymbol>(&at->symbol);
  if (!variable)
    throw Refused(std::string(kNothing));
  const auto ref = variableOf(*view.programs, kDocument, variable->use);
  if (!ref)
    throw Refused("the variable number is computed or depends on the control");
  return {*ref, at->span};
}

// ---- new numbers ----

constexpr std::array<std::uint32_t, 4> kSteps = {10, 5, 2, 1};

std::uint32_t stepFor(const View &view, std::size_t count, std::uint32_t wanted) {
  const std::uint64_t last = view.programs->dialect().limits.lastSequenceNumber;
  if (count * wanted <= last)
    return wanted;
  for (const std::uint32_t step : kSteps)
    if (step < wanted && count * step <= last)
      return step;
  throw Refused(fmt::format("the program has {} sequence numbers, more than the control can number", count));
}

class Renumbering {
public:
  Renumbering(const View &view, Edits &edits) : view_(view), file_(view.file()), edits_(edits) {}

  void program(ProgramId id, std::uint32_t wantedStep) {
    const ProgramRef ref{kDocument, id};
    const auto numbers = file_.model.sequenceNumbersOf(id);
    if (numbers.empty())
      return;
    checkJumpsAreKnown(*view_.programs, ref);
    checkJumpsStay(ref);
    const std::uint32_t step = stepFor(view_, numbers.size(), wantedStep);
    std::map<BlockId, std::uint32_t> fresh;
    for (const SequenceNumber &each : numbers)
      fresh[each.block] = static_cast<std::uint32_t>(fresh.size() + 1) * step;
    for (const SequenceNumber &each : numbers)
      replace(file_.tree.words[each.word].span(), fresh.at(each.block));
    for (const Jump &jump : file_.model.jumpsOf(id))
      if (jump.kind != JumpKind::CallAt && jump.target)
        replace(jump.targetSpan, fresh.at(*jump.target));
    for (const NamedBlock &block : blocksNamedBeside(file_, id))
      if (const auto named = file_.model.find(id, block.number); !named.empty())
        edits_.replace(kDocument, block.source, block.span, fmt::format("N{}", fresh.at(named.front().block)));
  }

private:
  void replace(Span span, std::uint32_t number) {
    std::string text = withNumber(file_, span, number);
    if (text != file_.source.text(span))
      edits_.replace(kDocument, span, text);
  }
  /// No jump misses its number, and none comes from another program or goes there.
  void checkJumpsStay(ProgramRef program) const {
    const Project &programs = *view_.programs;
    for (std::size_t i = 0; i < programs.files.size(); ++i)
      for (const Jump &jump : programs.files[i]->model.jumps) {
        const ProgramRef own{FileId(i), jump.program};
        for (const LabelRef &label : labelsOf(programs, FileId(i), jump)) {
          const std::uint32_t line = lineOf(*programs.files[i], jump.block);
          if (own == program && label.program == program && !jump.target)
            throw Refused(fmt::format(
                "line {} jumps to N{}, which does not exist; renumbering could give the jump a wrong target", line,
                label.number));
          if ((own == program) != (label.program == program) && jump.kind != JumpKind::CallAt)
            throw Refused(fmt::format("line {} of {} returns to N{} of {}", line, programs.files[i]->shown,
                                      label.number, nameOf(programs, label.program)));
          if (jump.kind == JumpKind::CallAt && label.program == program)
            throw Refused(fmt::format("line {} of {} calls {} at N{}", line, programs.files[i]->shown,
                                      nameOf(programs, program), label.number));
        }
      }
  }

  const View &view_;
  const ProjectFile &file_;
  Edits &edits_;
};

} // namespace

Json prepareRename(const View &document, const Json &params) {
  const View view = withFolder(document);
  const Renamed renamed = namedAt(view, params);
  match(
      renamed.name, [&](const LabelRef &label) { checkLabelCanChange(view, label); },
      [&](const VariableRef &variable) { checkVariableCanChange(view, variable); });
  return {{"range", rangeOf(view, kDocument, renamed.span)}, {"placeholder", view.file().source.utf8(renamed.span)}};
}

Json rename(const View &document, const Json &params) {
  const View view = withFolder(document);
  const std::string newName = params.at("newName").get<std::string>();
  const Renamed renamed = namedAt(view, params);
  Edits edits(view);
  match(
      renamed.name, [&](const LabelRef &label) { renameLabel(view, label, newName, edits); },
      [&](const VariableRef &variable) { renameVariable(view, variable, newName, edits); });
  return edits.workspaceEdit();
}

Json renumber(const View &document, const Json &params) {
  const View view = withFolder(document);
  const auto step = params.value("step", std::uint32_t{10});
  if (step == 0)
    throw Refused("the step must not be 0");
  if (!view.programs->dialect().grammar.sequenceJumps)
    throw Refused(fmt::format("jumps on {} do not go to sequence numbers", view.programs->dialect().title));
  Edits edits(view);
  Renumbering renumbering(view, edits);
  for (std::size_t i = 0; i < view.file().model.programs.size(); ++i)
    if (!view.file().model.programs[ProgramId(i)].within)
      renumbering.program(ProgramId(i), step);
  return edits.workspaceEdit();
}

} // namespace feedhold::lsp
