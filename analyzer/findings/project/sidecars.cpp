#include "findings/project/sidecars.h"

#include "base/source/path_text.h"
#include "findings/project/config.h"
#include "findings/project/content.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <iterator>
#include <set>

namespace feedhold {

namespace fs = std::filesystem;

namespace {

constexpr std::string_view kExtension = ".contract";
constexpr std::string_view kMachineFile = "machine.contract";

bool isThere(const fs::path &path, const std::shared_ptr<const OpenTexts> &open) {
  std::error_code ignored; // what cannot be asked for is not there
  return (open && open->contains(normalPath(absolutePath(path)))) || fs::exists(path, ignored);
}

/// The names of the set-up's file: in the folder of the program, then in those above, up to that of the project.
std::vector<fs::path> machineNames(const fs::path &file) {
  std::vector<fs::path> names;
  std::error_code ignored;
  fs::path shown = file.parent_path();
  for (fs::path folder = absolutePath(file).parent_path(); !folder.empty();
       folder = folder.parent_path(), shown /= "..") {
    names.push_back(normalPath(shown / kMachineFile));
    const bool isTop = fs::exists(folder / kConfigFileName, ignored) || fs::exists(folder / ".git", ignored);
    if (isTop || folder == folder.parent_path())
      break;
  }
  return names;
}

fs::path beside(const fs::path &file, const std::string &stem) {
  return file.parent_path() / (stem + std::string(kExtension));
}

std::array<fs::path, 2> namesOf(const fs::path &file, std::uint32_t program) {
  return {beside(file, fmt::format("O{}", program)), beside(file, fmt::format("O{:04}", program))};
}

/// Calls `visit(path, program)` for each; a name may come twice.
template <typename Visit> void forEachName(const fs::path &file, const ProgramModel &model, Visit visit) {
  for (const Program &program : model.programs)
    if (program.name.number)
      for (const fs::path &name : namesOf(file, *program.name.number))
        visit(name, program.name.number);
  visit(beside(file, pathText(file.stem())), std::optional<std::uint32_t>());
  visit(beside(file, pathText(file.filename())), std::optional<std::uint32_t>());
}

Sidecar read(const fs::path &path, std::optional<std::uint32_t> program, const std::shared_ptr<const OpenTexts> &open) {
  Result<SourceFile> source = openSource(path, open);
  const auto notText = source ? whyNotText(source.value().text()) : std::nullopt;
  if (!source || notText)
    return {SourceFile::fromText(pathText(path), ""), program, source ? std::string(*notText) : source.error().message};
  return {source.take(), program, std::nullopt};
}

} // namespace

std::vector<fs::path> sidecarNames(const fs::path &file, const ProgramModel &model) {
  std::vector<fs::path> names;
  forEachName(file, model, [&](fs::path path, std::optional<std::uint32_t>) { names.push_back(std::move(path)); });
  std::ranges::move(machineNames(file), std::back_inserter(names));
  return names;
}

std::vector<fs::path> sidecarNamesOfCalled(const fs::path &file, const ProgramModel &model) {
  std::vector<fs::path> names;
  for (const Call &call : model.calls)
    if (call.callee.number)
      std::ranges::move(namesOf(file, *call.callee.number), std::back_inserter(names));
  return names;
}

bool isSidecarName(const fs::path &file) { return file.extension() == kExtension; }

std::vector<Sidecar> sidecarsOf(const fs::path &file, const ProgramModel &model,
                                const std::shared_ptr<const OpenTexts> &open) {
  if (file.empty())
    return {};
  std::vector<Sidecar> found;
  std::set<fs::path> seen;
  forEachName(file, model, [&](const fs::path &path, std::optional<std::uint32_t> program) {
    if (seen.insert(path).second && isThere(path, open))
      found.push_back(read(path, program, open));
  });
  const std::vector<fs::path> ofMachine = machineNames(file);
  const auto nearest = std::ranges::find_if(ofMachine, [&](const fs::path &path) { return isThere(path, open); });
  if (nearest != ofMachine.end() && seen.insert(*nearest).second) {
    found.push_back(read(*nearest, std::nullopt, open));
    found.back().scope = SidecarScope::Machine;
  }
  return found;
}

} // namespace feedhold
