#include "meaning/cfg/reached_programs.h"

#include <vector>

namespace feedhold {

namespace {

bool isComputed(const SyntaxTree &tree, const Call &call) {
  return call.callee.empty() && call.programWord && tree.words[*call.programWord].form() == WordForm::Expression;
}

} // namespace

void collectReached(const ProgramSet &programs, ProgramRef from, ReachedPrograms &reached) {
  std::vector<ProgramRef> open{from};
  while (!open.empty()) {
    const ProgramRef next = open.back();
    open.pop_back();
    if (!reached.programs.insert(next).second)
      continue;
    const ProgramFile &file = programs.file(next.file);
    for (const Call &call : file.model->callsOf(next.program)) {
      const auto callees = programs.callGraph().candidates(next.file, call);
      open.insert(open.end(), callees.begin(), callees.end());
      reached.orAny =
          reached.orAny || (callees.empty() && call.kind != CallKind::Local && isComputed(*file.tree, call));
    }
  }
}

} // namespace feedhold
