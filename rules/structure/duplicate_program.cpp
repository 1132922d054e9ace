// duplicate-program: `O2` twice in a file, or in two files of a folder.
#include "findings/rule/rule.h"

#include "rules/structure/structure_view.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <span>

namespace feedhold::rules::duplicate_program {
namespace {

/// That are shown with a program: of many namesakes, each would name all the others.
constexpr std::size_t kMostOthers = 4;

/// "b.nc, line 1"
std::string placeOf(const ProgramRef &other, const FileContext &context) {
  const ProgramFile &file = context.programs->file(other.file);
  const std::string line =
      fmt::format("line {}", file.source->lineOf(file.model->programs[other.program].header.begin));
  if (other.file == context.file)
    return line;
  return fmt::format("{}, {}", std::filesystem::path(file.source->path()).filename().string(), line);
}

/// The programs of its name that one is reported with: of its own file only those before it, which it is loaded over.
/// LinuxCNC has no memory of programs: an O word is known in its file only.
std::vector<ProgramRef> othersOf(const ProgramRef &program, const FileContext &context) {
  std::vector<ProgramRef> others = context.callGraph.namesakes(program);
  const bool isLocal = context.dialect.grammar.oWords;
  if (context.model.programs[program.program].name.isSubroutine && !isLocal)
    return {};
  std::erase_if(others, [&](const ProgramRef &other) {
    // What stands before the only `O9010` of O9010.nc has its number from the file alone.
    const bool isHead = context.callGraph.model(other.file).programs[other.program].name.empty();
    return other.file == program.file ? isHead || program.program < other.program : isLocal;
  });
  return others;
}

void check(ProgramId id, const FileContext &context, const Reporter &reporter) {
  const ProgramRef program{context.file, id};
  const Program &its = context.model.programs[id];
  const std::vector<ProgramRef> others = othersOf(program, context);
  if (others.empty())
    return;
  std::vector<Label> labels;
  for (const ProgramRef &other : std::span(others).first(std::min(others.size(), kMostOthers)))
    labels.push_back({context.callGraph.model(other.file).programs[other.program].header, "the other one", other.file});
  const bool inOneFile = std::ranges::any_of(others, [&](const auto &other) { return other.file == program.file; });
  const bool isCalled = context.callGraph.isCalled(program);
  Diagnostic diagnostic{.message =
                            fmt::format("`{}` also begins in {}", toString(its.name), placeOf(others.front(), context)),
                        .span = its.header,
                        .labels = std::move(labels)};
  if (context.dialect.grammar.oWords)
    diagnostic.notes = {"calls enter the first one; where the interpreter comes to the second one, it stops",
                        "give each subroutine its own label"};
  else
    diagnostic.notes = {isCalled
                            ? "a call runs whichever one is in the memory of the control, so what it does is unknown"
                            : "the memory of the control holds only one of them",
                        "give each program its own number, or keep versions in separate folders"};
  reporter.report(std::move(diagnostic), inOneFile || isCalled ? Severity::Warning : Severity::Info);
}

void asksForPrograms(const FlowFacts &, const FileContext &, const Reporter &) {}

} // namespace

extern const Rule duplicateProgram;
const Rule duplicateProgram{.info = {"duplicate-program", Category::Structure, Severity::Warning,
                                     "Reports programs in one file or folder that have the same number or name."},
                            .hooks = {.program = check, .flow = asksForPrograms}};

} // namespace feedhold::rules::duplicate_program
