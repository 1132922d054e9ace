// cycle-in-contour: a second `G71`, a call by `M98`, `G28`, or another tool, between the blocks that P and Q of a
// contour cycle name.
#include "findings/rule/rule.h"

#include "rules/structure/structure_view.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

namespace feedhold::rules::cycle_in_contour {
namespace {

/// FANUC controls take G00 to G03, G04 and modes there (PS0325).
const Word *refusedIn(BlockId block, const FileContext &context) {
  constexpr std::array kRoles = {CodeRole::ReferenceReturn, CodeRole::MachinePosition, CodeRole::Skip,
                                 CodeRole::DataSetting};
  constexpr std::array kActions = {CodeAction::Thread,        CodeAction::Inch,          CodeAction::Metric,
                                   CodeAction::LocalShift,    CodeAction::DiameterCycle, CodeAction::FaceCycle,
                                   CodeAction::ThreadCycle,   CodeAction::ThreadPasses,  CodeAction::FaceGroove,
                                   CodeAction::DiameterGroove};
  for (const Word &word : context.tree.wordsOf(block)) {
    if (word.address() == 'T' && word.isNumber() && !word.number().isZero())
      return &word;
    const Code *code = word.address() == 'G' ? codeOf(word, context.dialect) : nullptr;
    if (code && (std::ranges::find(kRoles, code->role) != kRoles.end() ||
                 std::ranges::find(kActions, code->action) != kActions.end()))
      return &word;
  }
  return nullptr;
}

/// The first thing in the contour that is no part of one.
std::optional<Span> strangerIn(const Contour &contour, ProgramId program, const FileContext &context) {
  std::optional<Span> first;
  const auto note = [&](BlockId block, Span span) {
    if (contour.contains(block) && (!first || span.begin < first->begin))
      first = span;
  };
  for (const Jump &jump : context.model.jumpsOf(program))
    if (jump.kind == JumpKind::ContourFrom)
      if (const Word *code = findCode(context.tree, jump.block, context.dialect, CodeRole::Contour))
        note(jump.block, code->span());
  for (const Call &call : context.model.callsIn(contour.first, contour.last.next()))
    if (call.kind == CallKind::Subprogram || call.kind == CallKind::Local)
      note(call.block, call.span);
  if (context.dialect.hasFanucParameters)
    for (BlockId block = contour.first; block <= contour.last; block = block.next())
      if (const Word *refused = refusedIn(block, context))
        note(block, refused->span());
  return first;
}

void check(ProgramId program, const FileContext &context, const Reporter &reporter) {
  std::vector<Span> told;
  for (const Contour &contour : contoursOf(program, context)) {
    const auto stranger = contour.standsBehindCycle() ? strangerIn(contour, program, context) : std::nullopt;
    if (!stranger || std::ranges::find(told, *stranger) != told.end())
      continue;
    told.push_back(*stranger);
    const auto lineOf = [&](BlockId block) { return context.source.lineOf(context.tree.blocks[block].begin); };
    reporter.report(
        {.message = fmt::format("{} stands inside the contour of a cycle", context.quoted(*stranger)),
         .span = *stranger,
         .labels = {{context.tree.blocks[contour.cycle->block].span(),
                     fmt::format("its contour is lines {} to {}", lineOf(contour.first), lineOf(contour.last))}},
         .notes = {context.text(*stranger).front() == 'T' || context.text(*stranger).front() == 't'
                       ? "roughing passes over the tool change, and the finishing cycle turns the turret in the contour"
                       : "a contour consists of moves only: the control stops when it reads the contour",
                   "close the first contour before it, or correct P and Q"}});
  }
}

} // namespace

extern const Rule cycleInContour;
const Rule cycleInContour{
    .info = {"cycle-in-contour", Category::Structure, Severity::Error,
             "Reports a cycle, a call by `M98`, a reference return, a tool or another code that is no part of a "
             "contour between the blocks that P and Q of a contour cycle name."},
    .hooks = {.program = check}};

} // namespace feedhold::rules::cycle_in_contour
