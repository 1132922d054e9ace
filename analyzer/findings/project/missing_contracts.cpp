#include "findings/project/missing_contracts.h"

#include "language/parse/parse.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>

namespace feedhold {

namespace {

/// That calls name, and no program has.
std::set<std::uint32_t> missingNumbers(std::span<const std::shared_ptr<const ProjectFile>> files) {
  std::set<std::uint32_t> numbers;
  for (const auto &file : files)
    for (const Call &call : file->model.calls)
      if (call.callee.number)
        numbers.insert(*call.callee.number);
  for (const auto &file : files)
    for (const Program &program : file->model.programs)
      if (program.name.number)
        numbers.erase(*program.name.number);
  return numbers;
}

/// Null: nothing beside the programs speaks of it.
std::shared_ptr<const FileContracts> contractOf(std::uint32_t number, const std::filesystem::path &folder,
                                                const Dialect &dialect, const std::shared_ptr<const OpenTexts> &open) {
  ProgramModel model;
  model.programs.add({.name = {.number = number, .text = {}}, .header = {}, .first = BlockId(0), .last = BlockId(0)});
  const std::vector<Sidecar> sidecars = sidecarsOf(folder / fmt::format("O{}", number), model, open);
  if (std::ranges::none_of(sidecars, [](const Sidecar &each) { return each.scope == SidecarScope::Program; }))
    return nullptr;
  const SourceFile none = SourceFile::fromText("", "");
  return std::make_shared<const FileContracts>(readContracts(none, parse(none, dialect), model, dialect, sidecars));
}

} // namespace

MissingContracts missingContracts(std::span<const std::shared_ptr<const ProjectFile>> files,
                                  const std::filesystem::path &folder, const std::shared_ptr<const OpenTexts> &open) {
  MissingContracts found;
  for (const std::uint32_t number : missingNumbers(files))
    if (auto contracts = contractOf(number, folder, *files.front()->dialect, open))
      found.emplace(number, std::move(contracts));
  return found;
}

} // namespace feedhold
