// Sequence numbers under another number.
#include "base/support/text.h"
#include "language/model/block_facts.h"
#include "surface/lsp/feature_meaning.h"
#include "surface/lsp/feature_rename.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>

namespace feedhold::lsp {

namespace {

constexpr std::uint32_t kFirstJumpOfMacroA = 80; // G65 H80 P..: GOTO

std::uint32_t numberOf(std::string_view name) {
  std::string_view digits = trimmed(name);
  if (!digits.empty() && isLetter(digits.front()))
    digits.remove_prefix(1);
  std::uint32_t number = 0;
  const char *end = digits.data() + digits.size();
  const auto [at, error] = std::from_chars(digits.data(), end, number);
  if (digits.empty() || error != std::errc() || at != end)
    throw Refused(fmt::format("`{}` is not a sequence number: write `N20` or `20`", name));
  return number;
}

/// The programs among `labels` are several: the one jump cannot say two numbers.
void checkOneTarget(const Project &programs, const LabelRef &label) {
  for (std::size_t i = 0; i < programs.files.size(); ++i)
    for (const Jump &jump : programs.files[i]->model.jumps) {
      if (jump.kind != JumpKind::ReturnTo || targetNumber(jump) != label.number)
        continue;
      const auto labels = labelsOf(programs, FileId(i), jump);
      if (labels.size() > 1 && std::find(labels.begin(), labels.end(), label) != labels.end())
        throw Refused(
            fmt::format("{} returns to N{} in several programs, so the number must stay the same in all of them",
                        nameOf(programs, {FileId(i), jump.program}), label.number));
    }
}

bool mayLeadInto(const Project &programs, FileId file, const Jump &jump, ProgramRef program) {
  const ProgramRef own{file, jump.program};
  switch (jump.kind) {
  case JumpKind::Goto:
  case JumpKind::LocalCall:
  case JumpKind::ContourFrom:
  case JumpKind::ContourTo: return own == program;
  case JumpKind::ReturnTo: {
    const auto callers = programs.set->callGraph().callers(own);
    return own == program || std::any_of(callers.begin(), callers.end(), [&](const CallGraph::Caller &caller) {
             return caller.file == program.file &&
                    programs.file(caller.file).model.calls[caller.call].caller == program.program;
           });
  }
  case JumpKind::CallAt: break;
  }
  const auto calls = programs.file(file).model.callsIn(jump.block, jump.block.next());
  return std::any_of(calls.begin(), calls.end(), [&](const Call &call) {
    return call.callee.empty() || programs.set->callGraph().callee(file, call) == program;
  });
}

void checkOtherJumps(const Project &programs, ProgramRef program) {
  const ProjectFile &file = programs.file(program.file);
  const Program &named = file.model.programs[program.program];
  for (BlockId block = named.first; block < named.last; block = block.next())
    if (findCode(file.tree, block, programs.dialect(), CodeRole::JumpOnInput))
      throw Refused(
          fmt::format("line {} has a jump on an external input, whose target is unknown", lineOf(file, block)));
  for (const Call &call : file.model.callsOf(program.program)) {
    const Word *operation = call.kind == CallKind::MacroA ? findWord(file.tree, call.block, 'H') : nullptr;
    if (operation && operation->integer().value_or(kFirstJumpOfMacroA) >= kFirstJumpOfMacroA)
      throw Refused(
          fmt::format("G65 H.. in line {} may jump to a sequence number that is unknown", lineOf(file, call.block)));
  }
}

} // namespace

void checkJumpsAreKnown(const Project &programs, ProgramRef program) {
  for (std::size_t i = 0; i < programs.files.size(); ++i)
    for (const Jump &jump : programs.files[i]->model.jumps)
      if (!targetNumber(jump) && mayLeadInto(programs, FileId(i), jump, program))
        throw Refused(fmt::format("the jump in line {}{} computes its target, which may be any sequence number",
                                  lineOf(*programs.files[i], jump.block),
                                  FileId(i) == program.file ? "" : " of " + programs.files[i]->shown));
  checkOtherJumps(programs, program);
}

std::vector<NamedBlock> blocksNamedBeside(const ProjectFile &file, ProgramId program) {
  constexpr std::string_view kAt = "@AT";
  std::vector<NamedBlock> found;
  for (const Clause &clause : file.contracts.clauses) {
    if (clause.source == kProgramText || clause.program != program)
      continue;
    const SourceFile &source = file.contracts.source(clause.source);
    const Span line = source.lineSpan(source.lineOf(clause.span.begin));
    const std::string head = toUpper(source.text(Span{line.begin, clause.span.begin}));
    const std::size_t at = head.find(kAt);
    const std::size_t n = at == std::string::npos ? at : head.find('N', at + kAt.size());
    if (n == std::string::npos)
      continue;
    const std::size_t end = std::min(head.find_first_not_of("0123456789", n + 1), head.size());
    std::uint32_t number = 0;
    if (std::from_chars(head.data() + n + 1, head.data() + end, number).ec == std::errc())
      found.push_back({clause.source,
                       {line.begin + static_cast<std::uint32_t>(n), line.begin + static_cast<std::uint32_t>(end)},
                       number});
  }
  return found;
}

std::string withNumber(const ProjectFile &file, Span span, std::uint32_t number) {
  const std::string_view text = file.source.text(span);
  const bool hasLetter = !text.empty() && isLetter(text.front());
  return (hasLetter ? std::string(1, text.front()) : std::string()) + std::to_string(number);
}

void checkLabelCanChange(const View &view, const LabelRef &label) {
  const Project &programs = *view.programs;
  if (programs.file(label.program.file).model.find(label.program.program, label.number).empty())
    throw Refused(fmt::format("{} has no N{}", nameOf(programs, label.program), label.number));
  checkJumpsAreKnown(programs, label.program);
  checkOneTarget(programs, label);
}

void renameLabel(const View &view, const LabelRef &label, std::string_view newName, Edits &edits) {
  const Project &programs = *view.programs;
  const std::uint32_t number = numberOf(newName);
  checkLabelCanChange(view, label);
  if (number == label.number)
    return;
  if (number > programs.dialect().limits.lastSequenceNumber ||
      (number == 0 && !programs.dialect().grammar.sequenceZero))
    throw Refused(fmt::format("sequence numbers on {} range from {} to {}", programs.dialect().title,
                              programs.dialect().grammar.sequenceZero ? 0 : 1,
                              programs.dialect().limits.lastSequenceNumber));
  for (const Use &use : usesOf(programs, LabelRef{label.program, number})) {
    const ProjectFile &file = programs.file(use.file);
    throw Refused(fmt::format("N{} is already in use: line {} of {} has `{}`", number,
                              file.source.lineOf(use.span.begin), file.shown, file.source.utf8(use.span)));
  }
  for (const Use &use : usesOf(programs, label))
    edits.replace(use.file, use.span, withNumber(programs.file(use.file), use.span, number));
  for (const NamedBlock &block : blocksNamedBeside(programs.file(label.program.file), label.program.program))
    if (block.number == label.number)
      edits.replace(label.program.file, block.source, block.span, fmt::format("N{}", number));
}

} // namespace feedhold::lsp
