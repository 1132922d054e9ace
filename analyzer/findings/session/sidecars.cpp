#include "findings/session/sidecars.h"

#include "findings/session/content.h"

#include <fmt/format.h>

#include <set>

namespace feedhold {

namespace fs = std::filesystem;

namespace {

constexpr std::string_view kExtension = ".contract";

class Search {
public:
  Search(fs::path folder, const std::shared_ptr<const OpenTexts> &open) : folder_(std::move(folder)), open_(open) {}

  void look(const std::string &stem, std::optional<std::uint32_t> program) {
    const fs::path path = folder_ / (stem + std::string(kExtension));
    std::error_code ignored; // what cannot be asked for is not there
    if (!seen_.insert(path).second || !fs::exists(path, ignored))
      return;
    Result<SourceFile> source = openSource(path, open_);
    const auto notText = source ? whyNotText(source.value().text()) : std::nullopt;
    if (!source || notText)
      found_.push_back({SourceFile::fromText(path.generic_string(), ""), program,
                        source ? std::string(*notText) : source.error().message});
    else
      found_.push_back({source.take(), program, std::nullopt});
  }

  std::vector<Sidecar> finish() { return std::move(found_); }

private:
  fs::path folder_;
  const std::shared_ptr<const OpenTexts> &open_;
  std::set<fs::path> seen_;
  std::vector<Sidecar> found_;
};

} // namespace

std::vector<Sidecar> sidecarsOf(const fs::path &file, const ProgramModel &model,
                                const std::shared_ptr<const OpenTexts> &open) {
  if (file.empty())
    return {};
  Search search(file.parent_path(), open);
  for (const Program &program : model.programs)
    if (program.name.number) {
      search.look(fmt::format("O{}", *program.name.number), program.name.number);
      search.look(fmt::format("O{:04}", *program.name.number), program.name.number);
    }
  search.look(file.stem().generic_string(), std::nullopt);
  search.look(file.filename().generic_string(), std::nullopt);
  return search.finish();
}

} // namespace feedhold
