#include "proof/families/modal_state.h"

#include "language/dialect/code_name.h"
#include "language/model/block_facts.h"
#include "meaning/cfg/reached_programs.h"
#include "meaning/semantics/parts.h"

#include <algorithm>
#include <array>
#include <fmt/format.h>
#include <set>

namespace feedhold::prove {

using smt::TermId;

namespace {

/// In the words of the manual; empty for parts that are not of the modal state.
std::string nameOfPart(PartId id) {
  switch (id.part) {
  case Part::Code: return "modal G codes";
  case Part::ModalWord: return std::string(1, kModalWords[id.key]);
  case Part::CoordinateShift: return "the G92 offset";
  case Part::LocalShift: return "the G52 offset";
  case Part::LengthOffset: return "the tool length offset";
  case Part::Spindle: return "the spindle";
  case Part::CycleBottom:
  case Part::CycleRetract:
  case Part::CycleInitial:
  case Part::CyclePeck:
  case Part::CycleDwell: return "the words of a canned cycle";
  case Part::Scale:
  case Part::ScaleCentre:
  case Part::MirrorAt:
  case Part::RotationAngle:
  case Part::RotationCentre:
  case Part::OtherMapping:
  case Part::PendingCoordinate:
  case Part::Transformed: return "mirror, scaling and rotation";
  case Part::ModalCallRepeats:
  case Part::ModalCallLocal:
  case Part::OtherModalCalls: return "the modal call";
  case Part::LocalVariable:
  case Part::Variable:
  case Part::Position:
  case Part::KeptFirst: // of the position
  case Part::KeptSecond:
  case Part::LengthChanged:
  case Part::AxisTurned:
  case Part::CornerChamfer: // at the end none waits
  case Part::CornerRadius:
  case Part::CornerStart:
  case Part::EnteredLoop:
  case Part::Counter:
  case Part::SavedCode:
  case Part::SavedWord:
  case Part::RestoresModes: return "";
  }
  FEEDHOLD_UNREACHABLE("the switch names every part");
}

/// Parts that take effect only while a code of their group is active.
TermId isUsed(const ExploredProgram &program, PartId id, const SymbolicState &state) {
  smt::TermStore &store = program.start.store();
  const ModalTable modes(program.subject.dialect());
  const auto unless = [&](ModalKind kind, CodeAction cancel) {
    const auto group = modes.groupOf(kind);
    const CodeMask off = modes.maskOf(kind, {cancel});
    if (!group || off == 0)
      return store.yes();
    const TermId cancelled =
        program.start.interpretation().code(static_cast<std::uint8_t>(std::countr_zero(off))).index;
    return store.logicalNot(store.equal(state.codes[*group].index, cancelled));
  };
  constexpr std::array kOfCycle = {Part::CycleBottom, Part::CycleRetract, Part::CycleInitial, Part::CyclePeck,
                                   Part::CycleDwell};
  if (std::find(kOfCycle.begin(), kOfCycle.end(), id.part) != kOfCycle.end())
    return unless(ModalKind::Cycle, CodeAction::CycleOff);
  if (id.part == Part::LengthOffset)
    return unless(ModalKind::Length, CodeAction::LengthOff);
  const bool isCentre = id.part == Part::ScaleCentre || id.part == Part::RotationCentre;
  return isCentre ? store.no() : store.yes(); // an active mapping shows in its scale and its angle
}

/// Calls notKept(part, condition under which it is that of the entry) for each part of the modal state.
template <typename Visit>
void forEachModalPart(const ExploredProgram &program, const ModalPreserved &clause, const SymbolicState &state,
                      Visit visit) {
  SymbolicInterpretation &interpretation = program.start.interpretation();
  smt::TermStore &store = program.start.store();
  SymbolicState before = program.start.entry();
  SymbolicState now = state;
  if (!alignAll(interpretation, before, now))
    visit(PartId{Part::OtherModalCalls}, store.no());
  dropDifferentModalCalls(before, now);
  const ModalTable modes(program.subject.dialect());
  const auto equal = Overloaded{
      [&](const SymbolicValue &a, const SymbolicValue &b) {
        return store.logicalAnd(store.equal(a.vacant, b.vacant),
                                store.logicalOr(a.vacant, store.equal(a.number, b.number)));
      },
      [&](const SymbolicCode &a, const SymbolicCode &b) { return store.equal(a.index, b.index); },
      [&](const Condition &a, const Condition &b) { return store.ite(a.term, b.term, store.logicalNot(b.term)); }};
  forEachPart<Part::LocalVariable, Part::Variable, Part::Position, Part::KeptFirst, Part::KeptSecond,
              Part::LengthChanged, Part::AxisTurned, Part::EnteredLoop, Part::Counter, Part::SavedCode, Part::SavedWord,
              Part::RestoresModes>(
      [&](PartId id, const auto &a, const auto &b) {
        const bool isNoGroup = id.part == Part::Code && (id.key == 0 || modes.group(id.key).codes.empty());
        const bool isExcepted =
            id.part == Part::ModalWord && clause.except.find(kModalWords[id.key]) != std::string::npos;
        if (!isNoGroup && !isExcepted)
          visit(id, store.implies(isUsed(program, id, state), equal(a, b)));
      },
      before, now);
}

/// Codes outside of all groups act once; path control codes and unmodelled codes may set a mode.
bool maySetMode(const Code &code) {
  constexpr std::array kModes = {CodeAction::Tolerance, CodeAction::Unmodelled, CodeAction::Anything,
                                 CodeAction::OtherCycle, CodeAction::Device};
  return code.group == 0 && std::find(kModes.begin(), kModes.end(), code.action) != kModes.end();
}

/// With words of its own, it sets more than the code of its group: P of G54.1, P of G64, the box of G22, S of G50.
bool keepsWord(const Code &code, char address) {
  struct Row {
    CodeAction action;
    std::string_view addresses;
  };
  constexpr Row kRows[] = {{CodeAction::ExtendedWorkOffset, "P"},
                           {CodeAction::Tolerance, "PQR"},
                           {CodeAction::Check, "XYZIJKPQR"},
                           {CodeAction::CoordinateSet, "SQ"}};
  return std::any_of(std::begin(kRows), std::end(kRows), [&](const Row &row) {
    return row.action == code.action && row.addresses.find(address) != std::string_view::npos;
  });
}

const Code *modeOf(const ProgramFile &file, BlockId block) {
  const auto words = file.tree->wordsOf(block);
  for (const Word &word : words) {
    const Code *code = word.address() == 'G' ? codeOf(word, *file.dialect) : nullptr;
    if (code && (maySetMode(*code) || std::any_of(words.begin(), words.end(), [&](const Word &other) {
                   return keepsWord(*code, other.address());
                 })))
      return code;
  }
  return nullptr;
}

const Code *modeSetIn(const ProgramFile &file, const Program &program) {
  for (BlockId block = program.first; block < program.last; block = block.next())
    if (const Code *code = modeOf(file, block))
      return code;
  return nullptr;
}

/// In the text of the program or of one that it may call.
const Code *modeSetBy(const ProofSubject &subject) {
  ReachedPrograms reached;
  collectReached(subject.programs, {subject.program.file, subject.program.program}, reached);
  for (FileId id(0); id.index() < subject.programs.size(); id = id.next()) {
    const ProgramFile &file = subject.programs.file(id);
    for (ProgramId program(0); program.index() < file.model->programs.size(); program = program.next())
      if (reached.orAny || reached.programs.contains({id, program}))
        if (const Code *code = modeSetIn(file, file.model->programs[program]))
          return code;
  }
  return nullptr;
}

} // namespace

std::optional<std::string> modeNotTold(const ExploredProgram &program) {
  const Code *code = modeSetBy(program.subject);
  if (!code)
    return std::nullopt;
  return "the mode set by " + codeName('G', code->tenths);
}

TermId modalStateKept(const ExploredProgram &program, const ModalPreserved &clause, const SymbolicState &state) {
  smt::TermStore &store = program.start.store();
  TermId kept = store.yes();
  forEachModalPart(program, clause, state, [&](PartId, TermId isKept) { kept = store.logicalAnd(kept, isKept); });
  return kept;
}

std::string whyNotKept(const ExploredProgram &program, const ModalPreserved &clause) {
  std::set<std::string> names;
  if (const auto mode = modeNotTold(program))
    names.insert(*mode);
  for (const PathExit &exit : program.found.exits)
    forEachModalPart(program, clause, exit.state, [&](PartId id, TermId isKept) {
      if (isKept != program.start.store().yes())
        names.insert(nameOfPart(id));
    });
  std::string all;
  for (const std::string &name : names)
    all += fmt::format("{}{}", all.empty() ? "" : ", ", name);
  return all.empty() ? all : fmt::format("not proved to be restored: {}", all);
}

} // namespace feedhold::prove
