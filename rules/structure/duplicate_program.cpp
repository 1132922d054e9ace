// duplicate-program: `O2` twice in a file, or in two files of a folder.
#include "findings/rule/rule.h"

#include "rules/structure/structure_view.h"

#include <fmt/format.h>

#include <algorithm>

namespace feedhold::rules::duplicate_program {
namespace {

/// Programs of a file that stand before this one report nothing of it: the later one is loaded over them.
bool isReportedBy(ProgramRef program, const std::vector<ProgramRef> &namesakes) {
  return std::ranges::any_of(namesakes, [&](const ProgramRef &other) {
    return other.file != program.file || other.program < program.program;
  });
}

void check(ProgramId id, const FileContext &context, const Reporter &reporter) {
  const ProgramRef program{context.file, id};
  const Program &its = context.model.programs[id];
  const std::vector<ProgramRef> namesakes = context.callGraph.namesakes(program);
  if (its.name.isSubroutine || !isReportedBy(program, namesakes))
    return;
  std::vector<Label> labels;
  for (const ProgramRef &other : namesakes)
    if (other.file != program.file || other.program < program.program)
      labels.push_back(
          {context.callGraph.model(other.file).programs[other.program].header, "the other one", other.file});
  const bool inOneFile = std::ranges::any_of(namesakes, [&](const auto &other) { return other.file == program.file; });
  const bool isCalled = context.callGraph.isCalled(program);
  reporter.report(
      {.message = fmt::format("`{}` exists more than once", toString(its.name)),
       .span = its.header,
       .labels = std::move(labels),
       .notes = {isCalled ? "a call runs whichever one is in the memory of the control, so what it does is unknown"
                          : "the memory of the control holds only one of them",
                 "give each program its own number, or keep versions in separate folders"}},
      inOneFile || isCalled ? Severity::Warning : Severity::Info);
}

} // namespace

extern const Rule duplicateProgram;
const Rule duplicateProgram{.info = {"duplicate-program", Category::Structure, Severity::Warning,
                                     "Reports programs in one file or folder that have the same number or name."},
                            .hooks = {.program = check}};

} // namespace feedhold::rules::duplicate_program
