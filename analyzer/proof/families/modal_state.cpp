#include "proof/families/modal_state.h"

#include "language/dialect/code_name.h"
#include "language/model/block_facts.h"
#include "meaning/cfg/reached_programs.h"
#include "proof/symbolic/modal_parts.h"

#include <algorithm>
#include <array>
#include <fmt/format.h>
#include <set>

namespace feedhold::prove {

using smt::TermId;

namespace {

std::vector<ModalPart> partsOf(const ExploredProgram &program, const ModalPreserved &clause,
                               const SymbolicState &state) {
  return modalParts(program.start.interpretation(), program.subject.dialect(), clause, program.start.entry(), state);
}

/// Codes outside of all groups act once; path control codes and unmodelled codes may set a mode.
bool maySetMode(const Code &code) {
  constexpr std::array kModes = {CodeAction::Tolerance, CodeAction::Unmodelled, CodeAction::Anything,
                                 CodeAction::OtherCycle, CodeAction::Device};
  return code.group == 0 && std::find(kModes.begin(), kModes.end(), code.action) != kModes.end();
}

/// With words of its own, it sets more than the code of its group: P of G64, the box of G22, S of G50.
bool keepsWord(const Code &code, char address) {
  struct Row {
    CodeAction action;
    std::string_view addresses;
  };
  constexpr Row kRows[] = {
      {CodeAction::Tolerance, "PQR"}, {CodeAction::Check, "XYZIJKPQR"}, {CodeAction::CoordinateSet, "SQ"}};
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
  for (const auto &[id, isKept] : partsOf(program, clause, state))
    kept = store.logicalAnd(kept, isKept);
  return kept;
}

std::string whyNotKept(const ExploredProgram &program, const ModalPreserved &clause) {
  std::set<std::string> names;
  if (const auto mode = modeNotTold(program))
    names.insert(*mode);
  for (const PathExit &exit : program.found.exits)
    for (const auto &[id, isKept] : partsOf(program, clause, exit.state))
      if (isKept != program.start.store().yes())
        names.insert(nameOfPart(id));
  std::string all;
  for (const std::string &name : names)
    all += fmt::format("{}{}", all.empty() ? "" : ", ", name);
  return all.empty() ? all : fmt::format("not proved to be restored: {}", all);
}

} // namespace feedhold::prove
