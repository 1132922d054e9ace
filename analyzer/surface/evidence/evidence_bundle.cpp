#include "surface/evidence/evidence_bundle.h"

#include "base/source/path_text.h"
#include "base/support/match.h"
#include "base/support/sha256.h"
#include "proof/obligation/obligation_kinds.h"
#include "surface/evidence/reading_json.h"
#include "surface/sink/prove_shown.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>

namespace feedhold {

namespace {

using json::Json;
using prove::Obligation;
namespace fs = std::filesystem;

/// Ids hold names of programs, which may hold anything.
std::string fileNameOf(std::size_t number, const std::string &id) {
  constexpr std::size_t kLongest = 80;
  std::string name = fmt::format("{:04}-", number);
  for (const char c : id.substr(0, kLongest)) {
    const bool isPlain =
        (c >= '0' && c <= '9') || (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z') || c == '.' || c == '-' || c == '_';
    name += isPlain ? c : '_';
  }
  return name;
}

class BundleWriter {
public:
  BundleWriter(const BundleReading &reading, std::string_view version, const fs::path &folder)
      : reading_(reading), version_(version), folder_(folder) {}

  Bundle write(const ProofsResult &result) {
    std::vector<std::pair<std::string, const ProvedFile *>> files;
    for (const ProvedFile &file : result.files)
      files.emplace_back(pathFrom(folder_, file.file().path), &file);
    std::sort(files.begin(), files.end());
    Json rows = Json::array();
    for (const auto &[path, file] : files)
      rows.push_back(fileToJson(path, *file));
    const Json index = {
        {"version", 2}, {"feedhold", version_}, {"options", readingToJson(reading_, folder_)}, {"files", rows}};
    bundle_.emplace(kBundleIndex, json::documentText(index));
    return std::move(bundle_);
  }

private:
  /// The steps of a program come before its obligations, which rest on them.
  Json programToJson(const ProvedFile &file, const ProvedProgram &program) {
    const std::string name = toString(file.file().model.programs[program.program].name);
    const std::string folder = fileNameOf(++count_, name + ".steps");
    Json steps = Json::array();
    for (const auto &[claim, certificate] : program.steps)
      steps.push_back(certificateToJson({claim, certificate}, fmt::format("{}/{}", folder, steps.size() + 1)));
    return {{"name", name}, {"steps", std::move(steps)}};
  }
  Json fileToJson(const std::string &path, const ProvedFile &file) {
    Json programs = Json::array();
    for (const ProvedProgram &program : file.programs)
      programs.push_back(programToJson(file, program));
    Json obligations = Json::array();
    for (const ProvedProgram &program : file.programs)
      for (const Obligation &obligation : program.proof.obligations)
        obligations.push_back(obligationToJson(obligation, file, program));
    return {{"path", path},
            {"dialect", file.project->dialect().id},
            {"sources", sourcesOf(file)},
            {"programs", std::move(programs)},
            {"obligations", std::move(obligations)}};
  }
  /// All that was read: the program, its contract files, the programs of its folder.
  Json sourcesOf(const ProvedFile &file) const {
    std::map<std::string, std::string> hashes;
    for (const auto &loaded : file.project->files) {
      hashes[pathFrom(folder_, loaded->path)] = sha256(loaded->source.text());
      for (std::size_t i = 1; i < loaded->contracts.sources.size(); ++i) {
        const SourceFile &contract = loaded->contracts.sources[i];
        hashes[pathFrom(folder_, contract.path())] = sha256(contract.text());
      }
    }
    Json rows = Json::array();
    for (const auto &[path, hash] : hashes)
      rows.push_back({{"path", path}, {"sha256", hash}});
    return rows;
  }

  Json obligationToJson(const Obligation &obligation, const ProvedFile &file, const ProvedProgram &program) {
    const std::string name = fileNameOf(++count_, obligation.id);
    Json evidence = Json::array();
    if (const prove::verdict::Proved *proof = obligation.verdict.proved())
      for (const prove::Outcome &outcome : proof->proof.evidence)
        if (const auto *proved = std::get_if<prove::Proved>(&outcome.answer))
          evidence.push_back(evidenceToJson(*proved, fmt::format("{}/{}", name, evidence.size() + 1)));
    const auto orNull = [](std::string_view text) { return text.empty() ? Json() : Json(text); };
    return {{"id", obligation.id},
            {"program", toString(file.file().model.programs[program.program].name)},
            {"kind", prove::nameOf(obligation.kind)},
            {"line", file.file().source.lineOf(obligation.span.begin)},
            {"claim", claimOf(obligation, file.project->dialect())},
            {"verdict", prove::nameOf(obligation.verdict)},
            {"grade", obligation.verdict.grade() ? Json(prove::nameOf(*obligation.verdict.grade())) : Json()},
            {"reason", orNull(obligation.verdict.reason())},
            {"exactOnly", obligation.verdict.exactOnly()},
            {"bound", orNull(obligation.verdict.bound())},
            {"witness", obligation.verdict.witness() ? witnessToJson(*obligation.verdict.witness(), file) : Json()},
            {"evidence", std::move(evidence)}};
  }
  static Json witnessToJson(const prove::Witness &witness, const ProvedFile &file) {
    Json variables = Json::object();
    for (const auto &[variable, value] : witness.variables.entries())
      if (!value.vacant)
        variables[file.project->set->nameOfVariable(variable).substr(1)] = value.number;
    Json readings = Json::object();
    for (const auto &[variable, script] : witness.variables.readings.entries())
      readings[file.project->set->nameOfVariable(variable).substr(1)] = script;
    const GivenStart &start = witness.variables.start;
    std::vector<std::pair<char, double>> place;
    for (const auto &[axis, coordinate] : start.place)
      place.emplace_back(letterOf(axis), coordinate);
    return {{"variables", std::move(variables)},
            {"inputs", std::move(readings)},
            {"start", json::startToJson(modalWords(start, file.project->dialect()), place, settingsOf(start))},
            {"happened", witness.happened}};
  }
  Json evidenceToJson(const prove::Proved &proved, const std::string &name) {
    return match(
        proved.evidence,
        [&](const prove::CertificateEvidence &evidence) -> Json { return certificateToJson(evidence, name); },
        [&](const prove::SolverEvidence &evidence) -> Json {
          return {{"smtlib", keep(name + ".smt2", evidence.smtlib)}, {"solvers", evidence.solvers}};
        });
  }
  Json certificateToJson(const prove::CertificateEvidence &evidence, const std::string &name) {
    return {{"claim", keep(name + ".smt2", evidence.claim)},
            {"certificate", keep(name + ".certificate", evidence.certificate)}};
  }
  Json keep(const std::string &name, const std::string &text) {
    bundle_.emplace(name, text);
    return {{"file", name}, {"sha256", sha256(text)}};
  }

  const BundleReading &reading_;
  std::string_view version_;
  const fs::path &folder_;
  Bundle bundle_;
  std::size_t count_ = 0;
};

} // namespace

std::string pathFrom(const fs::path &folder, const fs::path &path) {
  if (path.empty())
    return "";
  const fs::path absolute = normalPath(absolutePath(path));
  const std::string relative = pathText(absolute.lexically_relative(normalPath(absolutePath(folder / ""))));
  return relative.empty() ? pathText(absolute) : relative;
}

Bundle makeBundle(const ProofsResult &result, const BundleReading &reading, std::string_view version,
                  const fs::path &folder) {
  return BundleWriter(reading, version, folder).write(result);
}

Result<BundleOrigin> originOf(const Bundle &bundle, const fs::path &folder) {
  const auto text = bundle.find(std::string(kBundleIndex));
  if (text == bundle.end())
    return Error{fmt::format("not an evidence bundle: it has no {}", kBundleIndex)};
  try {
    const Json index = Json::parse(text->second);
    BundleOrigin origin{.version = index.at("feedhold"), .paths = {}, .reading = {}};
    if (index.at("version") != 2)
      return Error{"the bundle has another format version"};
    for (const Json &file : index.at("files"))
      origin.paths.push_back(normalPath(folder / std::string(file.at("path"))));
    origin.reading = readingFrom(index.at("options"), folder);
    return origin;
  } catch (const Json::exception &) {
    return Error{fmt::format("{} cannot be read", kBundleIndex)};
  }
}

} // namespace feedhold
