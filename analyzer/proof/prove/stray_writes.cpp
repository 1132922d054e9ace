#include "proof/prove/stray_writes.h"

#include "language/model/block_facts.h"

#include <algorithm>
#include <fmt/format.h>
#include <set>

namespace feedhold::prove {

namespace {

class StrayWrites {
public:
  explicit StrayWrites(const ProofSubject &subject) : subject_(subject) {}

  std::optional<std::string> find() {
    std::vector<ProgramRef> queue = {{subject_.program.file, subject_.program.program}};
    std::set<std::pair<std::size_t, std::size_t>> met;
    while (!queue.empty()) {
      const ProgramRef program = queue.back();
      queue.pop_back();
      if (!met.emplace(program.file.index(), program.program.index()).second)
        continue;
      if (auto found = in(program))
        return found;
      for (const Call &call : modelOf(program.file).callsOf(program.program))
        for (const ProgramRef &callee : subject_.programs.callGraph().candidates(program.file, call))
          queue.push_back(callee);
    }
    return std::nullopt;
  }

private:
  const ProgramModel &modelOf(FileId file) const { return *subject_.programs.file(file).model; }

  std::optional<std::string> in(const ProgramRef &program) const {
    const ProgramFile &file = subject_.programs.file(program.file);
    for (const VariableUse &use : file.model->variablesOf(program.program))
      if (use.write && use.number && !isAllowed(*file.dialect, *use.number))
        return fmt::format(
            "line {} of {} writes #{}, which the clause does not name; a write counts on every path, also "
            "when an alarm follows or when it is undone",
            lineOf(file, use.block), nameOf(program), *use.number);
    return dataSetting(file, program);
  }

  /// G10 writes offsets and parameters.
  std::optional<std::string> dataSetting(const ProgramFile &file, const ProgramRef &program) const {
    const Program &text = file.model->programs[program.program];
    for (BlockId block = text.first; block < text.last; block = block.next())
      if (findCode(*file.tree, block, *file.dialect, CodeRole::DataSetting))
        return fmt::format("line {} of {} sets data of the control (G10), which the clause does not name",
                           lineOf(file, block), nameOf(program));
    return std::nullopt;
  }

  std::string nameOf(const ProgramRef &program) const {
    return subject_.nameOf(
        {program.file, subject_.programs.file(program.file).cfg.entryOf(program.program), program.program});
  }
  static std::size_t lineOf(const ProgramFile &file, BlockId block) {
    return file.source->lineOf(file.tree->blocks[block].span().begin);
  }

  bool isAllowed(const Dialect &dialect, std::uint32_t number) const {
    const VariableRange *row = findVariable(dialect, number);
    if (!row || row->kind == VariableKind::Local || row->kind == VariableKind::Vacant ||
        row->role == VariableRole::Alarm || row->role == VariableRole::MessageStop)
      return true;
    return names(number) || names(cellOf(dialect, number));
  }

  bool names(std::uint32_t number) const {
    for (const Assigns &assigns : subject_.contract()->assigns)
      if (std::ranges::any_of(assigns.variables, [&](const Assigns::Variables &range) {
            return range.first <= number && number <= range.last;
          }))
        return true;
    return false;
  }

  const ProofSubject &subject_;
};

} // namespace

std::optional<std::string> strayWrite(const ProofSubject &subject) { return StrayWrites(subject).find(); }

} // namespace feedhold::prove
