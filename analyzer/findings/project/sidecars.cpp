#include "findings/project/sidecars.h"

#include "findings/project/content.h"

#include <fmt/format.h>

#include <set>

namespace feedhold {

namespace fs = std::filesystem;

namespace {

constexpr std::string_view kExtension = ".contract";

/// Calls `visit(path, program)` for each; a name may come twice.
template <typename Visit> void forEachName(const fs::path &file, const ProgramModel &model, Visit visit) {
  const auto pathOf = [&](const std::string &stem) { return file.parent_path() / (stem + std::string(kExtension)); };
  for (const Program &program : model.programs)
    if (program.name.number) {
      visit(pathOf(fmt::format("O{}", *program.name.number)), program.name.number);
      visit(pathOf(fmt::format("O{:04}", *program.name.number)), program.name.number);
    }
  visit(pathOf(file.stem().generic_string()), std::optional<std::uint32_t>());
  visit(pathOf(file.filename().generic_string()), std::optional<std::uint32_t>());
}

Sidecar read(const fs::path &path, std::optional<std::uint32_t> program, const std::shared_ptr<const OpenTexts> &open) {
  Result<SourceFile> source = openSource(path, open);
  const auto notText = source ? whyNotText(source.value().text()) : std::nullopt;
  if (!source || notText)
    return {SourceFile::fromText(path.generic_string(), ""), program,
            source ? std::string(*notText) : source.error().message};
  return {source.take(), program, std::nullopt};
}

} // namespace

std::vector<fs::path> sidecarNames(const fs::path &file, const ProgramModel &model) {
  std::vector<fs::path> names;
  forEachName(file, model, [&](fs::path path, std::optional<std::uint32_t>) { names.push_back(std::move(path)); });
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
    std::error_code ignored; // what cannot be asked for is not there
    const bool isOpen = open && open->contains(fs::absolute(path).lexically_normal());
    if (seen.insert(path).second && (isOpen || fs::exists(path, ignored)))
      found.push_back(read(path, program, open));
  });
  return found;
}

} // namespace feedhold
