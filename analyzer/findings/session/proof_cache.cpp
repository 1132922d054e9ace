// A file for each proof, `ab/cdef..`: a line that says what it is, its key, the hash of the rest, the record.
#include "findings/session/proof_cache.h"

#include "base/source/path_text.h"
#include "base/source/write_file.h"
#include "base/support/sha256.h"
#include "findings/project/config.h"
#include "findings/session/proof_record.h"
#include "proof/smt/solver.h"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <vector>

namespace feedhold {

namespace fs = std::filesystem;

namespace {

constexpr std::string_view kFormat = "feedhold proof 10";
/// Of the 256 folders: together 131072 proofs of some kilobytes each.
constexpr std::size_t kMostInFolder = 512;

/// Texts that cannot run into one another.
class Material {
public:
  void add(std::string_view text) { text_ += fmt::format("{} {}", text.size(), text); }
  void add(std::uint64_t number) { text_ += fmt::format("{} ", number); }
  std::string hash() const { return sha256(text_); }

private:
  std::string text_;
};

void addSidecars(Material &material, const FileContracts &contracts) {
  material.add(contracts.sources.size());
  for (std::size_t i = 1; i < contracts.sources.size(); ++i) {
    material.add(pathText(fs::path(contracts.sources[i].path()).filename()));
    material.add(contracts.sources[i].text());
  }
}

/// All files of the folder: what one of them calls, names or returns to may concern another.
void addFiles(Material &material, const Project &programs) {
  material.add(programs.files.size());
  for (const auto &file : programs.files) {
    material.add(pathText(file->path.filename()));
    material.add(file->source.text());
    addSidecars(material, file->contracts);
  }
  material.add(programs.missingContracts.size());
  for (const auto &[number, contracts] : programs.missingContracts)
    addSidecars(material, *contracts);
}

std::string nameOf(const std::string &key) { return key.substr(0, 2) + "/" + key.substr(2); }

fs::path placeOf(const ProofCache &cache, const std::string &key) { return cache.folder / nameOf(key); }

std::string headOf(const std::string &key, std::string_view record) {
  return fmt::format("{}\n{}\n{}\n", kFormat, key, sha256(record));
}

/// Makes room for one more; the oldest goes first.
void trim(const fs::path &folder) {
  std::vector<std::pair<fs::file_time_type, fs::path>> entries;
  for (const fs::directory_entry &entry : fs::directory_iterator(folder))
    entries.emplace_back(entry.last_write_time(), entry.path());
  if (entries.size() < kMostInFolder)
    return;
  std::sort(entries.begin(), entries.end());
  for (std::size_t i = 0; i + kMostInFolder <= entries.size(); ++i)
    fs::remove(entries[i].second);
}

std::optional<std::string> readEntry(const fs::path &place) {
  std::error_code ignored;
  if (!fs::is_regular_file(place, ignored))
    return std::nullopt;
  const Result<SourceFile> file = SourceFile::open(place);
  return file ? std::optional(std::string(file.value().text())) : std::nullopt;
}

void keepEntry(const ProofCache &cache, const std::string &key, const std::string &entry) {
  const fs::path place = placeOf(cache, key);
  try {
    fs::create_directories(place.parent_path());
    trim(place.parent_path());
  } catch (const fs::filesystem_error &) {
    // Another process has been here, or nobody may write: the next line decides.
  }
  static_cast<void>(putFile(place, entry));
}

} // namespace

std::string proverOf(const ProofCache &cache) {
  return fmt::format("{}, {}", cache.tool, smt::z3Version().value_or("no Z3"));
}

std::string proofKey(std::string_view prover, const Project &programs, ProgramId program,
                     const prove::ProveOptions &options) {
  // All of them: a new option has to be thought of here.  The contracts are among the files.
  const auto &[only, budget, steps, guards, arithmetic, missing, mayTakeFewPasses, takesFewPasses, missingChangeNothing,
               contractsOf, missingContracts] = options;
  static_cast<void>(contractsOf);
  static_cast<void>(missingContracts);
  const auto &[search, z3, cvc5] = budget;
  Material material;
  material.add(kFormat);
  material.add(prover);
  material.add(programs.dialect().id);
  material.add(textOf(programs.dialect().switches));
  material.add(only.size());
  for (const prove::ObligationKind kind : only)
    material.add(prove::nameOf(kind));
  for (const std::uint64_t number :
       {search, z3, cvc5, steps, static_cast<std::uint64_t>(guards), static_cast<std::uint64_t>(arithmetic),
        static_cast<std::uint64_t>(missing), static_cast<std::uint64_t>(mayTakeFewPasses),
        static_cast<std::uint64_t>(takesFewPasses), static_cast<std::uint64_t>(missingChangeNothing)})
    material.add(number);
  material.add(program.index());
  addFiles(material, programs);
  return material.hash();
}

std::optional<RememberedProof> recall(const ProofCache &cache, const std::string &key, const ProgramSet &programs) {
  std::optional<std::string> entry = readEntry(placeOf(cache, key));
  if (!entry && cache.shared != nullptr) {
    entry = cache.shared->fetch(nameOf(key));
    if (entry)
      keepEntry(cache, key, *entry); // whoever asks the server once need not ask again
  }
  if (!entry)
    return std::nullopt;
  const std::size_t head = headOf(key, "").size();
  if (entry->size() < head || entry->substr(0, head) != headOf(key, std::string_view(*entry).substr(head)))
    return std::nullopt;
  auto record = std::make_shared<const std::string>(entry->substr(head));
  std::optional<RecordedProof> read = readProofRecord(*record, programs);
  if (!read)
    return std::nullopt;
  return RememberedProof{std::move(read->proof), std::move(record)};
}

void remember(const ProofCache &cache, const std::string &key, const prove::ProgramProof &proof) {
  const std::string record = writeProofRecord(proof);
  const std::string entry = headOf(key, record) + record;
  keepEntry(cache, key, entry);
  if (cache.shared != nullptr)
    cache.shared->store(nameOf(key), entry);
}

} // namespace feedhold
