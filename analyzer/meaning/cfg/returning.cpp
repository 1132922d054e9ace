#include "meaning/cfg/returning.h"

#include "meaning/cfg/reached_programs.h"
#include "meaning/cfg/wto.h"

#include <algorithm>
#include <array>

namespace feedhold {

namespace {

bool isPlainCode(const Dialect &dialect, const Word &word) {
  constexpr std::array kLeftBehind = {CodeAction::Unmodelled,  CodeAction::Anything,   CodeAction::InterruptOn,
                                      CodeAction::ScalingOn,   CodeAction::MirrorOn,   CodeAction::RotationOn,
                                      CodeAction::PolarOn,     CodeAction::ScalingOff, CodeAction::MirrorOff,
                                      CodeAction::RotationOff, CodeAction::PolarOff,   CodeAction::Unclassified};
  const auto tenths = word.tenths();
  if (!tenths)
    return false;
  const Code *code = word.address() == 'G' ? findGCode(dialect, *tenths) : findMCode(dialect, *tenths);
  if (!code)
    return word.address() == 'M'; // of the machine builder
  return code->role != CodeRole::ModalCall && code->role != CodeRole::ModalCallEach &&
         code->role != CodeRole::DataSetting && std::ranges::find(kLeftBehind, code->action) == kLeftBehind.end();
}

bool isPlainText(const ProgramFile &file, const Program &program) {
  for (BlockId block = program.first; block < program.last; block = block.next()) {
    const Block &each = file.tree->blocks[block];
    if (each.has(Block::kBroken) || each.has(Block::kCommentTail))
      return false;
    for (const Word &word : file.tree->wordsOf(block))
      if (word.isCode() && !isPlainCode(*file.dialect, word))
        return false;
  }
  return true;
}

bool endsRun(const ProgramFile &file, ProgramId program) {
  const Wto reached(file.cfg, *file.model, file.cfg.entryOf(program));
  return std::ranges::any_of(reached.order(), [&](NodeId node) {
    return std::holds_alternative<EndProgram>(file.cfg.nodes[node].instruction);
  });
}

/// Or a part of itself, which is not reached from its head without the call.
bool callsOthers(const ProgramSet &programs, const ProgramFile &file, ProgramId program) {
  return std::ranges::any_of(file.model->callsOf(program), [&](const Call &call) {
    return call.kind != CallKind::ModalCancel &&
           (call.kind == CallKind::Local || programs.callGraph().candidates(file.file, call).empty());
  });
}

} // namespace

bool returnsBehindItsCall(const ProgramSet &programs, const Callee &callee) {
  const ReturnTargets &returns = programs.returns();
  if (returns.any || !returns.numbers.empty())
    return false;
  ReachedPrograms reached;
  collectReached(programs, {callee.file, callee.program}, reached);
  return !reached.orAny && std::ranges::all_of(reached.programs, [&](const ProgramRef &each) {
    const ProgramFile &file = programs.file(each.file);
    return isPlainText(file, file.model->programs[each.program]) && !endsRun(file, each.program) &&
           !callsOthers(programs, file, each.program);
  });
}

} // namespace feedhold
