// See the header.
#include "findings/draft/settings.h"

#include "base/source/path_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>

namespace feedhold::draft {

namespace {

/// Where a variable is written in the files of a project.
struct Writes {
  std::size_t count = 0;
  const ProjectFile *file = nullptr;
  ProgramId program{0};
  BlockId block{0};
};

std::set<std::uint32_t> readOnlyIn(const ProjectFile &file, ProgramId program) {
  std::set<std::uint32_t> read;
  for (const VariableUse &use : file.model.variablesOf(program))
    if (!use.write && use.number)
      read.insert(*use.number);
  for (const VariableUse &use : file.model.variablesOf(program))
    if (use.write && use.number)
      read.erase(*use.number);
    else if (use.write) // it may write any
      return {};
  return read;
}

std::map<std::uint32_t, Writes> writesIn(const Project &project) {
  std::map<std::uint32_t, Writes> writes;
  for (const auto &file : project.files)
    for (std::size_t i = 0; i < file->model.programs.size(); ++i)
      for (const VariableUse &use : file->model.variablesOf(ProgramId(i)))
        if (use.write && use.number)
          writes[*use.number] = {writes[*use.number].count + 1, file.get(), ProgramId(i), use.block};
  return writes;
}

/// The number that the block gives to the variable; absent: it is computed.
std::optional<Decimal> valueAt(const Writes &write, std::uint32_t variable) {
  const SyntaxTree &tree = write.file->tree;
  for (const Statement &statement : tree.statementsOf(write.block))
    if (const auto *assignment = std::get_if<Assignment>(&statement.node);
        assignment && variableNumber(tree, assignment->target) == variable)
      return literalValue(tree, assignment->value);
  return std::nullopt;
}

/// It moves no axis itself, or it calls the reader: else it has the variable for itself.
bool setsFor(const Project &project, const Writes &write, ProgramId reader) {
  const Program &program = write.file->model.programs[write.program];
  bool moves = false;
  for (BlockId block = program.first; block < program.last; block = block.next())
    for (const Word &word : write.file->tree.wordsOf(block))
      moves = moves ||
              (std::string_view("XYZ").find(word.address()) != std::string_view::npos && !word.has(Word::kArgument));
  return !moves || std::ranges::any_of(project.callGraph.callers({FileId(0), reader}), [&](const auto &caller) {
    const ProjectFile &file = project.file(caller.file);
    return &file == write.file && file.model.calls[caller.call].caller == write.program;
  });
}

} // namespace

std::vector<Setting> settingsOf(const Project &project, ProgramId program) {
  const ProjectFile &own = project.file(FileId(0));
  const std::map<std::uint32_t, Writes> writes = writesIn(project);
  std::vector<Setting> settings;
  for (const std::uint32_t variable : readOnlyIn(own, program)) {
    const VariableRange *row = findVariable(*own.dialect, variable);
    const bool isCommon = row && (row->kind == VariableKind::Common || row->kind == VariableKind::Retentive);
    const auto write = writes.find(variable);
    if (!isCommon || write == writes.end() || write->second.count != 1)
      continue;
    const Writes &at = write->second;
    if (!setsFor(project, at, program))
      continue;
    const ProgramName &name = at.file->model.programs[at.program].name;
    if (const auto value = valueAt(at, variable))
      settings.push_back({variable, *value, name.empty() ? pathText(at.file->path.filename()) : toString(name),
                          at.file->source.lineOf(at.file->tree.blocks[at.block].begin)});
  }
  return settings;
}

std::string toldOf(const Setting &setting) {
  return fmt::format("{} in {} (line {})", setting.value.toString(), setting.program, setting.line);
}

} // namespace feedhold::draft
